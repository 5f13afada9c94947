#include "apps/results/text/json_text.hpp"

#include <cmath>
#include <iterator>
#include <stdexcept>
#include <vector>

namespace ashlar {
namespace {

constexpr std::size_t most_levels = 100;
constexpr int most_keys = 1000;

// Checks the text before a tree is built.
class LimitCheck {
 public:
  using Json = nlohmann::ordered_json;

  bool null() { return true; }
  bool boolean(bool) { return true; }
  bool number_integer(Json::number_integer_t) { return true; }
  bool number_unsigned(Json::number_unsigned_t) { return true; }
  bool number_float(Json::number_float_t, const Json::string_t&) { return true; }
  bool string(Json::string_t&) { return true; }
  bool binary(Json::binary_t&) { return true; }
  bool start_object(std::size_t) { return open(); }
  bool end_object() { return close(); }
  bool start_array(std::size_t) { return open(); }
  bool end_array() { return close(); }
  bool key(Json::string_t&) {
    if (++keys_.back() > most_keys)
      throw std::runtime_error(fmt::format("an object has more than {} keys", most_keys));
    return true;
  }
  bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception&) {
    throw std::runtime_error(fmt::format("it is no JSON from byte {} on", position));
  }

 private:
  bool open() {
    if (keys_.size() == most_levels)
      throw std::runtime_error(fmt::format("it is nested more than {} deep", most_levels));
    keys_.push_back(0);
    return true;
  }
  bool close() {
    keys_.pop_back();
    return true;
  }

  std::vector<int> keys_;  // of each open object and array
};

}  // namespace

void append_json_number(fmt::memory_buffer& text, double value) {
  constexpr std::string_view none = "null";
  constexpr std::string_view fraction = ".0";
  if (!std::isfinite(value)) {
    text.append(none.data(), none.data() + none.size());
    return;
  }
  const std::size_t start = text.size();
  fmt::format_to(std::back_inserter(text), "{}", value);
  const std::string_view digits(text.data() + start, text.size() - start);
  if (digits.find_first_of(".e") == std::string_view::npos)
    text.append(fraction.data(), fraction.data() + fraction.size());
}

std::string json_text(const nlohmann::ordered_json& json, int indent) {
  return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

nlohmann::ordered_json parse_json(std::string_view text) {
  LimitCheck check;
  nlohmann::ordered_json::sax_parse(text.begin(), text.end(), &check);
  return nlohmann::ordered_json::parse(text.begin(), text.end());
}

}  // namespace ashlar
