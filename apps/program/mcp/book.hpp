// The book of the program, embedded in it: pages, keys of scenes, example scenes, and a search of their words.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ashlar {

/// A page or a file of an example.
struct BookPage {
  std::string_view name;   ///< "howto/rock.md", "scenes/slope.toml"
  std::string_view title;  ///< first heading of a page, title of a scene; otherwise the name
  std::string_view text;
};

/// All of them, pages first.
[[nodiscard]] const std::vector<BookPage>& book_pages();
/// Null if there is none of that name.
[[nodiscard]] const BookPage* book_page(std::string_view name);
/// Names of the example scenes without folder and ending: "slope".
[[nodiscard]] std::vector<std::string> example_names();

/// A passage that a search has found.
struct BookPassage {
  const BookPage* page;
  std::string_view heading;  ///< of its section
  std::string excerpt;       ///< lines with the words, shortened
};

/// Sections with most of the words, those with rare words and with words in their heading first. Upper and lower case are
/// equal, and a word is found at the beginning of longer ones.
/// @param words separated by blanks and signs. @return at most `most`, none for a text without words
[[nodiscard]] std::vector<BookPassage> search_book(std::string_view words, std::size_t most);

/// A key of a scene, as its reference describes it.
struct SceneKey {
  std::string_view table;                      ///< "block.fix"; empty: the top level
  std::string_view header;                     ///< "[[block.fix]]" as a scene has it; empty for the top level
  std::string_view key;                        ///< "plane.point"
  std::string_view value, otherwise, meaning;  ///< what is accepted, the default, what it does
};

[[nodiscard]] const std::vector<SceneKey>& scene_keys();

/// Keys by path ("analysis.time_step"), all of a table ("block.fix"), or, if none has that name, those whose name or
/// meaning has all words.
[[nodiscard]] std::vector<SceneKey> keys_about(std::string_view words);

}  // namespace ashlar
