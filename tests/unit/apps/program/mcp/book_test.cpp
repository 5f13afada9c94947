#include "apps/program/mcp/book.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "support/temporary_folder.hpp"

namespace ashlar::book_test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

TEST(Book, HasItsPagesAndExamplesAsTheyAre) {
  const BookPage* page = book_page("reference/scene.md");
  ASSERT_NE(page, nullptr);
  EXPECT_EQ(page->title, "Keys of a scene");
  const BookPage* scene = book_page("scenes/slope.toml");
  ASSERT_NE(scene, nullptr);
  EXPECT_EQ(scene->title, "A stone on a slope");
  EXPECT_EQ(scene->text, read_text(std::filesystem::path(ASHLAR_DATA_DIR) / "scenes" / "slope.toml"));
  EXPECT_EQ(book_page("reference/none.md"), nullptr);
  EXPECT_THAT(example_names(), Contains("arch_stands"));
  for (const BookPage& one : book_pages()) EXPECT_FALSE(one.text.empty()) << one.name;
}

std::vector<std::string> pages_about(const char* words, std::size_t most) {
  std::vector<std::string> pages;
  for (const BookPassage& passage : search_book(words, most)) pages.emplace_back(passage.page->name);
  return pages;
}

TEST(SearchBook, PutsSectionsAboutTheWordsFirst) {
  EXPECT_EQ(pages_about("Goodman Bray toppling columns", 1).front(), "scenes/columns.toml");
  EXPECT_THAT(pages_about("pushover kinematic check", 3), Contains("howto/pushover.md"));
  EXPECT_EQ(pages_about("friction", 3).size(), 3U);
  EXPECT_TRUE(search_book("xyzzyplugh", 3).empty());
  EXPECT_TRUE(search_book(" .,;|", 3).empty());
}

TEST(SearchBook, FindsWordsInAnyCaseByTheirBeginning) {
  EXPECT_EQ(pages_about("PUSHOVER Kinematic check", 5), pages_about("pushover kinematic check", 5));
  EXPECT_EQ(pages_about("voronoi", 1), pages_about("vorono", 1));
  for (const BookPassage& passage : search_book("friction angle", 10)) {
    std::string excerpt = passage.excerpt;
    std::transform(excerpt.begin(), excerpt.end(), excerpt.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    EXPECT_THAT(excerpt, HasSubstr("friction"));
  }
}

TEST(KeysAbout, FindsByPathByTableAndByWords) {
  const std::vector<SceneKey> one = keys_about("analysis.time_step");
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one.front().header, "[analysis]");
  EXPECT_EQ(one.front().value, "a number > 0 or \"auto\"");
  EXPECT_EQ(one.front().otherwise, "required");
  EXPECT_THAT(std::string(one.front().meaning), HasSubstr("the largest step"));
  for (const char* table : {"block.fix", "[[block.fix]]"}) {
    const std::vector<SceneKey> keys = keys_about(table);
    ASSERT_GT(keys.size(), 3U);
    for (const SceneKey& key : keys) EXPECT_EQ(key.table, "block.fix");
  }
  const std::vector<SceneKey> words = keys_about("residual friction");
  EXPECT_TRUE(
      std::any_of(words.begin(), words.end(), [](const SceneKey& key) { return key.table == "joint"; }));
  EXPECT_TRUE(keys_about("xyzzyplugh").empty());
  EXPECT_TRUE(keys_about("").empty());
  EXPECT_EQ(keys_about("title").front().table, "");
}

}  // namespace
}  // namespace ashlar::book_test
