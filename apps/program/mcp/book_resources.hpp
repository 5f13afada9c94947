// The book as resources of the Model Context Protocol.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace ashlar {

/// "ashlar://book/howto/rock.md"
[[nodiscard]] std::string book_uri(std::string_view page);

/// Entries of resources/list: the pages, the example scenes and the schema of scenes.
[[nodiscard]] nlohmann::ordered_json resource_list();

/// Result of resources/read; empty if there is no resource of that address.
[[nodiscard]] std::optional<nlohmann::ordered_json> resource_contents(const std::string& uri);

}  // namespace ashlar
