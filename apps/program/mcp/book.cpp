#include "apps/program/mcp/book.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>

#include "apps/program/embedded_file.hpp"

ASHLAR_EMBED(ashlar_book, ASHLAR_BOOK)

namespace ashlar {
namespace {

constexpr char page_mark = '\x1e';  // collect_book.cmake

/// First line of a text, which is shortened to the rest.
std::string_view taken_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

std::string_view title_of(const BookPage& page) {
  std::string_view rest = page.text;
  constexpr std::string_view of_scene = "title = \"";
  while (!rest.empty()) {
    const std::string_view line = taken_line(rest);
    if (line.starts_with("# ") && page.name.ends_with(".md")) return line.substr(2);
    if (line.starts_with(of_scene)) {
      const std::string_view title = line.substr(of_scene.size());
      return title.substr(0, title.find('"'));
    }
  }
  return page.name;
}

std::vector<BookPage> read_book() {
  std::vector<BookPage> pages;
  std::string_view rest = ASHLAR_EMBEDDED(ashlar_book);
  while (!rest.empty()) {
    rest.remove_prefix(1);
    BookPage page;
    page.name = taken_line(rest);
    page.text = rest.substr(0, rest.find(page_mark));
    rest.remove_prefix(page.text.size());
    page.title = title_of(page);
    pages.push_back(page);
  }
  return pages;
}

struct BookSection {
  const BookPage* page;
  std::string_view heading;
  std::string_view text;
  std::string lower;  ///< heading and text
};

std::string lowered(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  return lower;
}

/// Sections of a page begin at its headings outside of blocks of code.
void add_sections(const BookPage& page, std::vector<BookSection>& sections) {
  std::string_view rest = page.text;
  std::string_view heading = page.title;
  std::size_t begin = 0;
  bool code = false;
  const auto close = [&](std::size_t end) {
    const std::string_view text = page.text.substr(begin, end - begin);
    if (!text.empty()) sections.push_back({&page, heading, text, lowered(text)});
    begin = end;
  };
  while (!rest.empty()) {
    const std::size_t place = page.text.size() - rest.size();
    const std::string_view line = taken_line(rest);
    if (line.starts_with("```")) code = !code;
    if (code || !line.starts_with('#') || !page.name.ends_with(".md")) continue;
    close(place);
    heading = without_blanks(line.substr(std::min(line.find_first_not_of('#'), line.size())));
  }
  close(page.text.size());
}

const std::vector<BookSection>& book_sections() {
  static const std::vector<BookSection> sections = [] {
    std::vector<BookSection> all;
    for (const BookPage& page : book_pages()) add_sections(page, all);
    return all;
  }();
  return sections;
}

bool is_letter_or_digit(unsigned char c) {
  return std::isalnum(c) != 0 || c >= 128;
}

std::vector<std::string> words_in(std::string_view text) {
  std::vector<std::string> words;
  std::string word;
  for (const char c : lowered(text) + ' ') {
    if (is_letter_or_digit(static_cast<unsigned char>(c)) || c == '_') {
      word += c;
    } else if (!word.empty()) {
      if (std::find(words.begin(), words.end(), word) == words.end()) words.push_back(word);
      word.clear();
    }
  }
  return words;
}

/// Number of words of a text that begin with a word. @param first place of the first one
std::size_t count_of(const std::string& word, std::string_view text, std::size_t* first = nullptr) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
    if (at > 0 && is_letter_or_digit(static_cast<unsigned char>(text[at - 1]))) continue;
    if (count++ == 0 && first != nullptr) *first = at;
  }
  return count;
}

/// Weight of a word for a section, 0 if it is not there: Okapi's BM25, in which repetitions and words of long texts count
/// less, and more for words of the heading.
double weight_of(const std::string& word, const BookSection& section) {
  constexpr double of_heading = 2.0, saturation = 1.2, share_of_length = 0.75, usual_length = 1500.0;
  const auto count = static_cast<double>(count_of(word, section.lower));
  if (count == 0.0) return 0.0;
  const double length = static_cast<double>(section.text.size()) / usual_length;
  const double weight =
      (saturation + 1.0) * count / (count + saturation * (1.0 - share_of_length + share_of_length * length));
  return weight + (count_of(word, lowered(section.heading)) > 0 ? of_heading : 0.0);
}

/// Pages that tell how come before those that tell what was tested, or how the code is written.
double weight_of_page(std::string_view name) {
  constexpr double how = 1.5, about_the_project = 0.5;
  if (name.starts_with("howto/") || name.starts_with("tutorial/") || name.starts_with("scenes/")) return how;
  return name == "validation.md" || name == "contributing.md" || name == "style.md" ? about_the_project : 1.0;
}

/// Lines about the first places of words, at most a few hundred letters.
std::string excerpt_of(const BookSection& section, const std::vector<std::string>& words) {
  constexpr std::size_t most = 500;
  std::map<std::size_t, std::size_t> lines;  // begin, end
  for (const std::string& word : words) {
    std::size_t at = 0;
    if (count_of(word, section.lower, &at) == 0) continue;
    const std::size_t line = section.text.rfind('\n', at);
    const std::size_t begin = at == 0 || line == std::string_view::npos ? 0 : line + 1;
    lines[begin] = std::min(section.text.find('\n', at), section.text.size());
  }
  std::string text;
  for (const auto& [begin, end] : lines) {
    if (text.size() > most) break;
    const std::string_view line = section.text.substr(begin, end - begin);
    if (!text.empty()) text += '\n';
    text += line.substr(0, most);
    if (line.size() > most) text += "...";
  }
  return text;
}

/// Cells of a row of a table, with "\|" as part of one.
std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  std::size_t begin = 1;
  for (std::size_t k = 1; k < line.size(); ++k) {
    if (line[k] != '|' || line[k - 1] == '\\') continue;
    cells.push_back(without_blanks(line.substr(begin, k - begin)));
    begin = k + 1;
  }
  return cells;
}

std::vector<SceneKey> read_keys() {
  std::vector<SceneKey> keys;
  const BookPage* page = book_page("reference/scene.md");
  std::string_view rest = page == nullptr ? "" : page->text;
  std::string_view header;
  while (!rest.empty()) {
    const std::string_view line = taken_line(rest);
    if (line.starts_with("#")) {
      const std::size_t tick = line.find("`[");
      header = tick == std::string_view::npos ? "" : line.substr(tick + 1);
      header = header.substr(0, header.find('`'));
    }
    if (!line.starts_with("| `")) continue;
    const std::vector<std::string_view> cells = cells_of(line);
    if (cells.size() != 4 || cells[0].size() < 3 || !cells[0].ends_with('`')) continue;
    std::string_view table = header;
    while (table.starts_with('[')) table.remove_prefix(1);
    while (table.ends_with(']')) table.remove_suffix(1);
    keys.push_back({table, header, cells[0].substr(1, cells[0].size() - 2), cells[1], cells[2], cells[3]});
  }
  return keys;
}

}  // namespace

const std::vector<BookPage>& book_pages() {
  static const std::vector<BookPage> pages = read_book();
  return pages;
}

const BookPage* book_page(std::string_view name) {
  const auto found = std::find_if(book_pages().begin(), book_pages().end(),
                                  [&](const BookPage& page) { return page.name == name; });
  return found == book_pages().end() ? nullptr : &*found;
}

std::vector<std::string> example_names() {
  constexpr std::string_view folder = "scenes/", ending = ".toml";
  std::vector<std::string> names;
  for (const BookPage& page : book_pages())
    if (page.name.starts_with(folder) && page.name.ends_with(ending))
      names.emplace_back(page.name.substr(folder.size(), page.name.size() - folder.size() - ending.size()));
  return names;
}

std::vector<BookPassage> search_book(std::string_view text, std::size_t most) {
  const std::vector<std::string> words = words_in(text);
  const std::vector<BookSection>& sections = book_sections();
  std::vector<double> scores(sections.size(), 0.0);
  for (const std::string& word : words) {
    std::vector<double> weights(sections.size(), 0.0);
    std::size_t with_word = 0;
    for (std::size_t k = 0; k < sections.size(); ++k) {
      weights[k] = weight_of(word, sections[k]);
      if (weights[k] > 0.0) ++with_word;
    }
    // Rare words tell more (inverse document frequency).
    const double rarity =
        std::log(1.0 + static_cast<double>(sections.size()) / (1.0 + static_cast<double>(with_word)));
    for (std::size_t k = 0; k < sections.size(); ++k)
      scores[k] += rarity * weights[k] * weight_of_page(sections[k].page->name);
  }
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < sections.size(); ++k)
    if (scores[k] > 0.0) order.push_back(k);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return scores[a] > scores[b]; });
  order.resize(std::min(order.size(), most));
  std::vector<BookPassage> found;
  for (const std::size_t k : order)
    found.push_back({sections[k].page, sections[k].heading, excerpt_of(sections[k], words)});
  return found;
}

const std::vector<SceneKey>& scene_keys() {
  static const std::vector<SceneKey> keys = read_keys();
  return keys;
}

std::vector<SceneKey> keys_about(std::string_view text) {
  const std::string name(without_blanks(text));
  std::vector<SceneKey> found;
  const auto keep = [&](const auto& wanted) {
    std::copy_if(scene_keys().begin(), scene_keys().end(), std::back_inserter(found), wanted);
    return !found.empty();
  };
  const auto path_of = [](const SceneKey& key) {
    return key.table.empty() ? std::string(key.key) : std::string(key.table) + '.' + std::string(key.key);
  };
  if (name.empty()) return found;
  if (keep([&](const SceneKey& key) { return path_of(key) == name; })) return found;
  if (keep([&](const SceneKey& key) { return key.table == name || key.header == name; })) return found;
  const std::vector<std::string> words = words_in(text);
  if (words.empty()) return found;
  keep([&](const SceneKey& key) {
    const std::string all =
        lowered(path_of(key) + ' ' + std::string(key.meaning) + ' ' + std::string(key.value));
    return std::all_of(words.begin(), words.end(),
                       [&](const std::string& word) { return count_of(word, all) > 0; });
  });
  return found;
}

}  // namespace ashlar
