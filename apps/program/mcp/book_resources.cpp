#include "apps/program/mcp/book_resources.hpp"

#include "apps/program/mcp/book.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/scene/assemble/scene_schema.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view book_address = "ashlar://book/";
constexpr std::string_view schema_address = "ashlar://schema/scene.json";

std::string_view media_type(std::string_view name) {
  if (name.ends_with(".md")) return "text/markdown";
  return name.ends_with(".toml") ? "application/toml" : "text/csv";
}

Json contents(const std::string& uri, std::string_view type, std::string text) {
  return {{"contents", {{{"uri", uri}, {"mimeType", type}, {"text", std::move(text)}}}}};
}

}  // namespace

std::string book_uri(std::string_view page) {
  return std::string(book_address) + std::string(page);
}

Json resource_list() {
  Json list = Json::array();
  for (const BookPage& page : book_pages())
    list.push_back({{"uri", book_uri(page.name)},
                    {"name", page.name},
                    {"title", page.title},
                    {"mimeType", media_type(page.name)},
                    {"size", page.text.size()}});
  list.push_back({{"uri", schema_address},
                  {"name", "scene.schema.json"},
                  {"title", "JSON schema of scenes"},
                  {"mimeType", "application/schema+json"}});
  return list;
}

std::optional<Json> resource_contents(const std::string& uri) {
  if (uri == schema_address) return contents(uri, "application/schema+json", json_text(scene_schema(), 1));
  if (!uri.starts_with(book_address)) return std::nullopt;
  const BookPage* page = book_page(std::string_view(uri).substr(book_address.size()));
  if (page == nullptr) return std::nullopt;
  return contents(uri, media_type(page->name), std::string(page->text));
}

}  // namespace ashlar
