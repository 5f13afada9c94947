#include <fmt/format.h>

#include <utility>

#include "apps/program/mcp/argument_schema.hpp"
#include "apps/program/mcp/book.hpp"
#include "apps/program/mcp/book_resources.hpp"
#include "apps/program/mcp/tools/tools.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

ToolStart search_the_book(const Json& arguments) {
  constexpr std::size_t usual = 6;
  const auto words = arguments["query"].get<std::string>();
  Json found = Json::array();
  for (const BookPassage& passage : search_book(words, arguments.value("count", usual)))
    found.push_back({{"page", passage.page->name},
                     {"title", passage.page->title},
                     {"section", passage.heading},
                     {"uri", book_uri(passage.page->name)},
                     {"excerpt", passage.excerpt}});
  if (found.empty())
    return error_answer(fmt::format(
        "no page has these words ({}); try words of the field: friction, joint set, factor of safety, arch",
        words));
  return data_answer({{"passages", std::move(found)}});
}

ToolStart read_a_page(const Json& arguments) {
  const auto name = arguments["page"].get<std::string>();
  const BookPage* page = book_page(name);
  if (page == nullptr)
    throw ToolRefusal(
        "there is no such page; search_book names pages, such as howto/rock.md or scenes/slope.toml");
  return ToolAnswer{std::string(page->text), nullptr, "", false};
}

ToolStart find_keys(const Json& arguments) {
  constexpr std::size_t most = 60;
  const auto words = arguments["query"].get<std::string>();
  const std::vector<SceneKey> keys = keys_about(words);
  if (keys.empty())
    return error_answer(
        fmt::format("no key is called so or is about that ({}); give a path (analysis.time_step), a table "
                    "(block.fix) or words",
                    words));
  Json found = Json::array();
  for (std::size_t k = 0; k < std::min(keys.size(), most); ++k)
    found.push_back({{"table", keys[k].header},
                     {"key", keys[k].key},
                     {"value", keys[k].value},
                     {"default", keys[k].otherwise},
                     {"meaning", keys[k].meaning}});
  Json data = {{"keys", std::move(found)}};
  if (keys.size() > most) data["left_out"] = keys.size() - most;
  return data_answer(std::move(data));
}

}  // namespace

std::vector<Tool> book_tools() {
  std::vector<Tool> tools;
  tools.push_back(
      {"search_book", "Search the book",
       "Search the manual of Ashlar: tutorials, how-to pages, reference, theory, example scenes. Returns "
       "passages with the names of their pages; read_page returns a whole page.",
       arguments_schema({{"query", text_argument("Words to look for")},
                         {"count", whole_number_argument("At most so many passages; 6 by default", 1, 20)}},
                        {"query"}),
       true, search_the_book});
  tools.push_back(
      {"read_page", "Read a page of the book",
       "A whole page of the manual as Markdown, or an example scene as TOML.",
       arguments_schema({{"page", text_argument("Name, such as howto/rock.md or scenes/slope.toml")}},
                        {"page"}),
       true, read_a_page});
  tools.push_back(
      {"scene_keys", "Look up keys of a scene",
       "The keys that a scene (TOML) may have: accepted values, defaults, meaning. Ask by path "
       "(analysis.time_step), by table (block.fix, joint, cut) or by words.",
       arguments_schema({{"query", text_argument("Path of a key, name of a table, or words")}}, {"query"}),
       true, find_keys});
  return tools;
}

}  // namespace ashlar
