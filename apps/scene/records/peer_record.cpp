#include "apps/scene/records/peer_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "geometry/text/parse_number.hpp"

namespace ashlar {
namespace {

constexpr int head_lines = 4;
constexpr std::string_view blanks = " \t\r,";

/// The number at the beginning of a text, after blanks and at most one plus. @param end set to its end
std::optional<double> leading_number(std::string_view text, std::size_t* end = nullptr) {
  const std::size_t start = text.find_first_not_of(blanks);
  if (start == std::string_view::npos) return std::nullopt;
  std::string_view digits = text.substr(start);
  if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
  double value = 0.0;
  const auto [stop, status] = parse_number(digits.data(), digits.data() + digits.size(), value);
  if (status != std::errc() || !std::isfinite(value)) return std::nullopt;
  if (end != nullptr) *end = static_cast<std::size_t>(stop - text.data());
  return value;
}

struct PeerHead {
  double count = 0.0;
  double interval = 0.0;  ///< s
};

/// NPTS and DT of the last header line, each after its name and an equals sign, or both before their names.
std::optional<PeerHead> head_of(std::string_view line) {
  const std::size_t names = line.find("NPTS");
  const std::size_t interval = line.find("DT", names == std::string_view::npos ? 0 : names);
  if (names == std::string_view::npos || interval == std::string_view::npos) return std::nullopt;
  const std::size_t first = line.find('=', names);
  const std::size_t second = line.find('=', interval);
  std::optional<double> count, step;
  if (first != std::string_view::npos && second != std::string_view::npos) {
    count = leading_number(line.substr(first + 1));
    step = leading_number(line.substr(second + 1));
  } else {
    std::size_t end = 0;
    count = leading_number(line, &end);
    if (count) step = leading_number(line.substr(end));
  }
  if (!count || !step || !(*count >= 1.0) || *count != std::floor(*count) || !(*step > 0.0))
    return std::nullopt;
  return PeerHead{*count, *step};
}

class PeerReader {
 public:
  PeerReader(const SceneRecord& record, const std::string& name, Diagnostics& diagnostics)
      : record_(record), name_(name), diagnostics_(diagnostics) {}

  std::optional<std::vector<std::vector<double>>> read(std::istream& content) {
    content.exceptions(std::ios::badbit);
    std::string line;
    std::optional<PeerHead> head;
    while (std::getline(content, line)) {
      ++line_;
      if (line_ < head_lines) continue;
      if (line_ > head_lines) {
        if (!add_values(line, *head)) return std::nullopt;
        continue;
      }
      head = head_of(line);
      if (!head) {
        fault(1,
              "head of a PEER record has no number of values and no time step; \"NPTS= n, DT= s SEC\" is "
              "needed in its "
              "fourth line");
        return std::nullopt;
      }
    }
    if (!head) {
      fault(1, fmt::format("PEER record ends in its head ({} lines); {} lines and values are needed", line_,
                           head_lines));
      return std::nullopt;
    }
    if (static_cast<double>(rows_.size()) != head->count) {
      fault(1, fmt::format("record has {} values; its head says NPTS = {}", rows_.size(), head->count));
      return std::nullopt;
    }
    return std::move(rows_);
  }

 private:
  void fault(std::size_t column, std::string message) {
    diagnostics_.error({name_, line_, static_cast<int>(column)}, std::move(message));
  }

  bool add_values(std::string_view line, const PeerHead& head) {
    std::size_t start = 0;
    while ((start = line.find_first_not_of(blanks, start)) != std::string_view::npos) {
      const std::size_t end = std::min(line.find_first_of(blanks, start), line.size());
      std::size_t stop = 0;
      const std::string_view field = line.substr(start, end - start);
      const std::optional<double> value = leading_number(field, &stop);
      constexpr std::size_t longest_shown = 60;
      if (!value || stop != field.size()) {
        fault(start + 1,
              fmt::format("no number (\"{}\"); a finite number is needed", field.substr(0, longest_shown)));
        return false;
      }
      const double scaled = *value * record_.scale;
      if (!std::isfinite(scaled)) {
        fault(start + 1, fmt::format("value times scale is not finite ({} times {}); a number is needed",
                                     *value, record_.scale));
        return false;
      }
      std::vector<double> row = {static_cast<double>(rows_.size()) * head.interval};
      for (const std::string& column : record_.values) row.push_back(column.empty() ? 0.0 : scaled);
      rows_.push_back(std::move(row));
      start = end;
    }
    return true;
  }

  const SceneRecord& record_;
  const std::string& name_;
  Diagnostics& diagnostics_;
  int line_ = 1;  ///< the first was read before
  std::vector<std::vector<double>> rows_;
};

}  // namespace

bool begins_peer_record(std::string_view line) {
  return line.starts_with("PEER ");
}

std::optional<std::vector<std::vector<double>>> parse_peer_record(const SceneRecord& record,
                                                                  std::istream& content,
                                                                  const std::string& name,
                                                                  Diagnostics& diagnostics) {
  return PeerReader(record, name, diagnostics).read(content);
}

}  // namespace ashlar
