#include "apps/scene/meshes/json_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "geometry/mesh/text_scanner.hpp"

namespace ashlar {
namespace {

/// A fault at a byte, counted from 1, of a text.
MeshFileError error_at(std::string_view text, std::size_t position, const std::string& what) {
  const std::string_view read = text.substr(0, position == 0 ? 0 : position - 1);
  const auto line = 1 + std::count(read.begin(), read.end(), '\n');
  const std::size_t begin = read.rfind('\n') + 1;  // 0 in the first line
  return {what, static_cast<int>(line), static_cast<int>(read.size() - begin) + 1};
}

/// Checks the text before a tree is built.
class SyntaxCheck {
 public:
  using Json = nlohmann::json;

  SyntaxCheck(std::string_view text, std::string_view kind) : text_(text), kind_(kind) {}

  bool null() { return true; }
  bool boolean(bool) { return true; }
  bool number_integer(Json::number_integer_t) { return true; }
  bool number_unsigned(Json::number_unsigned_t) { return true; }
  bool number_float(Json::number_float_t value, const Json::string_t& digits) {
    if (value != 0.0) return true;
    if (digits.substr(0, digits.find_first_of("eE")).find_first_of("123456789") != std::string::npos)
      throw error_at(text_, place_of(digits), out_of_range(digits));
    return true;
  }
  bool string(Json::string_t&) { return true; }
  bool binary(Json::binary_t&) { return true; }
  bool key(Json::string_t&) { return true; }
  bool start_object(std::size_t) { return open(); }
  bool end_object() { return close(); }
  bool start_array(std::size_t) { return open(); }
  bool end_array() { return close(); }
  bool parse_error(std::size_t position, const std::string& digits,
                   const nlohmann::detail::exception& fault) {
    constexpr int number_overflow = 406;
    if (fault.id == number_overflow)
      throw error_at(text_, position - std::min(position, digits.size()) + 1, out_of_range(digits));
    throw error_at(text_, position, fmt::format("text is no JSON from here on, {} is JSON", kind_));
  }

 private:
  static std::string out_of_range(const std::string& digits) {
    return fmt::format("number is out of the range of double precision ({}), allowed 4.9e-324 to 1.7e308",
                       printable(digits));
  }
  /// Byte, counted from 1, of the first number of exactly these digits.
  [[nodiscard]] std::size_t place_of(const std::string& digits) const {
    constexpr std::string_view of_numbers = "0123456789.+-eE";
    const auto continues = [&](std::size_t at) {
      return at < text_.size() && of_numbers.find(text_[at]) != std::string_view::npos;
    };
    std::size_t at = text_.find(digits);
    while (at != std::string_view::npos && (continues(at - 1) || continues(at + digits.size())))
      at = text_.find(digits, at + 1);
    return at == std::string_view::npos ? 0 : at + 1;
  }

  bool open() {
    if (++levels_ > most_json_levels)
      throw MeshFileError(
          fmt::format("JSON is nested more than {} deep, which is what is allowed", most_json_levels), 0, 0);
    return true;
  }
  bool close() {
    --levels_;
    return true;
  }

  std::string_view text_, kind_;
  std::size_t levels_ = 0;
};

}  // namespace

nlohmann::json parse_json_file(std::string_view text, std::string_view kind) {
  SyntaxCheck check(text, kind);
  nlohmann::json::sax_parse(text.begin(), text.end(), &check);
  return nlohmann::json::parse(text.begin(), text.end());
}

JsonNode::JsonNode(std::shared_ptr<const nlohmann::json> value, std::string path)
    : value_(std::move(value)), path_(std::move(path)) {}

void JsonNode::fail(const std::string& fault, const std::string& allowed) const {
  throw MeshFileError(fmt::format("{} {}, allowed {}", path_.empty() ? "file" : path_, fault, allowed), 0, 0);
}

std::optional<JsonNode> JsonNode::find(const char* key) const {
  if (!value_->is_object()) fail("is no object", "{...}");
  const auto found = value_->find(key);
  if (found == value_->end()) return std::nullopt;
  return JsonNode(part(*found), path_.empty() ? key : fmt::format("{}.{}", path_, key));
}

JsonNode JsonNode::at(const char* key) const {
  std::optional<JsonNode> member = find(key);
  if (!member)
    throw MeshFileError(fmt::format("{} has no \"{}\", which it needs", path_.empty() ? "file" : path_, key),
                        0, 0);
  return *std::move(member);
}

std::size_t JsonNode::size() const {
  if (!value_->is_array()) fail("is no array", "[...]");
  return value_->size();
}

JsonNode JsonNode::at(std::size_t index) const {
  if (index >= size()) fail(fmt::format("has {} elements", size()), fmt::format("more than {}", index));
  return {part((*value_)[index]), fmt::format("{}[{}]", path_, index)};
}

std::vector<std::pair<std::string, JsonNode>> JsonNode::members() const {
  if (!value_->is_object()) fail("is no object", "{...}");
  std::vector<std::pair<std::string, JsonNode>> members;
  for (const auto& [name, value] : value_->items())
    members.emplace_back(name,
                         JsonNode(part(value), path_.empty() ? name : fmt::format("{}.{}", path_, name)));
  const auto is_number = [](const std::string& name) {
    return !name.empty() && name.find_first_not_of("0123456789") == std::string::npos;
  };
  std::stable_sort(members.begin(), members.end(), [&](const auto& a, const auto& b) {
    if (!is_number(a.first) || !is_number(b.first)) return is_number(a.first) && !is_number(b.first);
    return a.first.size() != b.first.size() ? a.first.size() < b.first.size() : a.first < b.first;
  });
  return members;
}

const std::string& JsonNode::text() const {
  if (!value_->is_string()) fail("is no text", "\"...\"");
  return value_->get_ref<const std::string&>();
}

double JsonNode::number() const {
  if (!value_->is_number()) fail("is no number", "a number");
  return value_->get<double>();
}

bool JsonNode::boolean() const {
  if (!value_->is_boolean()) fail("is no truth value", "true or false");
  return value_->get<bool>();
}

std::size_t JsonNode::count() const {
  constexpr std::uint64_t most = 0xffffffffU;
  if (!value_->is_number_unsigned() || value_->get<std::uint64_t>() > most)
    fail(fmt::format("is no count ({})", value_->is_primitive() ? printable(value_->dump()) : "..."),
         fmt::format("a whole number from 0 to {}", most));
  return value_->get<std::uint64_t>();
}

std::size_t JsonNode::index(std::size_t size) const {
  const std::size_t index = count();
  if (index >= size) fail(fmt::format("is {}", index), size == 0 ? "none" : fmt::format("0 to {}", size - 1));
  return index;
}

}  // namespace ashlar
