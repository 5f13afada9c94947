#include "apps/scene/toml/input_file.hpp"

#include <gmock/gmock.h>

#include <sstream>

#include "apps/scene/records/record_file.hpp"
#include "support/temporary_folder.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::input_file_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// A file of this size that takes no place on the disk.
void write_hole(const std::filesystem::path& path, std::uintmax_t bytes) {
  write_text(path, "");
  std::filesystem::resize_file(path, bytes);
}

TEST(InputFile, StreamsAreReadUpToTheLimit) {
  const std::string text(200'000, 'x');
  std::istringstream enough(text), too_much(text);
  EXPECT_EQ(whole_stream(enough, 200'000), text);
  EXPECT_THAT([&] { (void)whole_stream(too_much, 199'999); },
              ThrowsMessage<std::runtime_error>(HasSubstr("too large (0.2 MB)")));
}

TEST(InputFile, WhatCannotBeReadIsNotEmpty) {
  EXPECT_THROW((void)whole_file("/proc/self/mem"), std::runtime_error);
}

TEST(InputFile, ScenesIncludesAndRecordsHaveALimit) {
  const TemporaryFolder folder;
  const std::string what = "too large (30.0 GB), at most 100 MB are allowed";
  write_hole(folder / "large", 30'000'000'000);
  Diagnostics of_scene;
  (void)read_scene(folder / "large", {}, of_scene);
  EXPECT_THAT(printed(of_scene), ElementsAre(HasSubstr(what)));

  write_text(folder / "main.toml", "include = [\"large\"]\n" + sample());
  Diagnostics of_include;
  (void)read_scene(folder / "main.toml", {}, of_include);
  EXPECT_THAT(printed(of_include),
              ElementsAre(HasSubstr("main.toml:1:12: error: included file cannot be read")));
  EXPECT_THAT(printed(of_include), ElementsAre(HasSubstr(what)));

  Diagnostics of_record;
  const SceneRecord record{"large", "t", {"a"}, 1.0, ""};
  EXPECT_FALSE(read_record(record, folder.path(), {"main.toml", 3, 4}, of_record));
  EXPECT_THAT(printed(of_record), ElementsAre(HasSubstr("main.toml:3:4: error: record cannot be read")));
  EXPECT_THAT(printed(of_record), ElementsAre(HasSubstr(what)));
}

TEST(InputFile, AllFilesOfASceneTogetherHaveTheLimit) {
  const TemporaryFolder folder;
  const std::string comment = "#" + std::string(60'000'000, '-') + "\n";
  write_text(folder / "one.toml", comment);
  write_text(folder / "two.toml", comment);
  write_text(folder / "main.toml", "include = [\"one.toml\", \"two.toml\"]\n" + sample());
  Diagnostics diagnostics;
  (void)read_scene(folder / "main.toml", {}, diagnostics);
  EXPECT_THAT(
      printed(diagnostics),
      ElementsAre(HasSubstr("two.toml: with all files before it too large (120.0 MB), at most 100 MB")));
}

}  // namespace
}  // namespace ashlar::test::input_file_test
