#include "apps/program/verify/cases/case_expression.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>

#include "apps/program/result_names.hpp"
#include "apps/results/text/json_path.hpp"

namespace ashlar {
namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// A part of a text. @param offset of its first byte in the whole
struct Part {
  std::string_view text;
  std::size_t offset;
};

Part trimmed(Part part) {
  while (!part.text.empty() && part.text.front() == ' ') {
    part.text.remove_prefix(1);
    ++part.offset;
  }
  while (!part.text.empty() && part.text.back() == ' ') part.text.remove_suffix(1);
  return part;
}

/// Evaluates expressions of one run.
class CaseEvaluation {
 public:
  CaseEvaluation(const Formulas& names, const CaseResults& results) : names_(names), results_(results) {}

  /// A function of a row, whose values columns have.
  using OfRow = std::function<double(std::size_t)>;

  [[nodiscard]] OfRow compiled(Part part) const {
    std::string formula = "= ";
    std::vector<OfRow> operands;
    std::vector<std::string> variables;
    std::string_view rest = part.text;
    const auto here = [&] { return part.offset + static_cast<std::size_t>(rest.data() - part.text.data()); };
    while (!rest.empty()) {
      std::size_t length = 0;
      if (OfRow operand = operand_at({rest, here()}, length)) {
        variables.push_back(fmt::format("result_{}", operands.size()));
        formula += variables.back();
        operands.push_back(std::move(operand));
        rest.remove_prefix(length);
        // A column alone needs no parser.
        if (rest.empty() && formula == "= result_0") return operands.front();
        continue;
      }
      length = plain_length(rest);
      formula += rest.substr(0, length);
      rest.remove_prefix(length);
    }
    return of(std::move(operands), named_place(part, [&] { return names_.of_variables(formula, variables); }),
              part);
  }

  [[nodiscard]] double value(Part part, std::size_t row) const { return compiled(part)(row); }

 private:
  [[nodiscard]] static OfRow constant(double number) {
    return [number](std::size_t) { return number; };
  }

  [[nodiscard]] static OfRow of(std::vector<OfRow> operands,
                                std::function<double(std::span<const double>)> formula, Part part) {
    return [operands = std::move(operands), formula = std::move(formula), part](std::size_t row) {
      std::vector<double> values;
      for (const OfRow& operand : operands) {
        values.push_back(operand(row));
        if (!std::isfinite(values.back())) return no_value;
      }
      return named_place(part, [&] { return formula(values); });
    };
  }

  /// Faults of `evaluate` have the place of the part.
  template <class Evaluate>
  static std::invoke_result_t<Evaluate> named_place(Part part, Evaluate evaluate) {
    try {
      return evaluate();
    } catch (const FormulaError& error) {
      throw FormulaError(error.what(), part.offset);
    }
  }

  /// The result at the start of a text, and its length. @return null if none begins there
  [[nodiscard]] OfRow operand_at(Part part, std::size_t& length) const {
    const std::string_view text = part.text;
    if (text.front() == '\'') {
      const std::size_t end = text.find('\'', 1);
      if (end == std::string_view::npos)
        throw FormulaError("a quote is not closed, ' is needed", part.offset);
      length = end + 1;
      return result(text.substr(1, end - 1), part.offset);
    }
    length = name_length(text);
    if (length == 0) return nullptr;
    const std::string_view name = text.substr(0, length);
    if (length < text.size() && text[length] == '(') {
      if (!is_function(name)) return nullptr;
      const std::size_t open = length, end = closing(part, open);
      length = end + 1;
      const std::vector<Part> arguments =
          divided({text.substr(open + 1, end - open - 1), part.offset + open + 1});
      if (name == "before" && arguments.size() == 1)
        return [e = compiled(arguments[0])](std::size_t row) { return row == 0 ? no_value : e(row - 1); };
      return constant(function(name, arguments, part.offset));
    }
    const bool dotted = name.find('.') != std::string_view::npos;
    if (!dotted && (names_.knows(std::string(name)) || !column(name))) return nullptr;
    return result(name, part.offset);
  }

  [[nodiscard]] std::optional<std::size_t> column(std::string_view name) const {
    const auto found = std::find(results_.columns.begin(), results_.columns.end(), name);
    if (found == results_.columns.end()) return std::nullopt;
    return static_cast<std::size_t>(found - results_.columns.begin());
  }

  [[nodiscard]] OfRow result(std::string_view name, std::size_t offset) const {
    if (const auto index = column(name))
      return [this, index = *index](std::size_t row) {
        return row < results_.rows.size() ? results_.rows[row][index] : no_value;
      };
    return constant(number_of_summary(name, offset));
  }

  [[nodiscard]] double number_of_summary(std::string_view name, std::size_t offset) const {
    constexpr std::string_view prefix = "summary.";
    if (!name.starts_with(prefix))
      throw FormulaError(
          fmt::format("unknown result ({}), a column of history.csv or summary.PATH is needed", name),
          offset);
    const nlohmann::ordered_json* value = value_at(results_.summary, name.substr(prefix.size()));
    if (value == nullptr)
      throw FormulaError(fmt::format("unknown result ({}), a path in summary.json is needed", name), offset);
    if (value->is_null()) return no_value;
    if (value->is_boolean()) return value->get<bool>() ? 1.0 : 0.0;
    if (!value->is_number())
      throw FormulaError(fmt::format("result is no number ({}), a number in summary.json is needed", name),
                         offset);
    return value->get<double>();
  }

  static bool is_function(std::string_view name) { return argument_counts().contains(name); }

  /// Numbers of arguments that functions of results may have.
  static const std::map<std::string_view, std::vector<std::size_t>, std::less<>>& argument_counts() {
    static const std::map<std::string_view, std::vector<std::size_t>, std::less<>> all = {
        {"first", {1}},   {"last", {1}},    {"largest", {1, 3}}, {"smallest", {1, 3}},
        {"mean", {1, 3}}, {"hann", {1, 3}}, {"at", {2}},         {"crossing", {2}},
        {"rising", {3}},  {"middle", {1}},  {"known", {1}},      {"before", {1}}};
    return all;
  }

  /// @param open place of the bracket. @return that of the one that closes it
  static std::size_t closing(Part part, std::size_t open) {
    int depth = 0;
    bool quoted = false;
    for (std::size_t k = open; k < part.text.size(); ++k) {
      const char c = part.text[k];
      if (c == '\'') quoted = !quoted;
      if (quoted) continue;
      if (c == '(') ++depth;
      if (c == ')' && --depth == 0) return k;
    }
    throw FormulaError("a bracket is not closed, ) is needed", part.offset + open);
  }

  /// Arguments between commas.
  static std::vector<Part> divided(Part part) {
    std::vector<Part> parts;
    int depth = 0;
    bool quoted = false;
    std::size_t begin = 0;
    for (std::size_t k = 0; k <= part.text.size(); ++k) {
      const char c = k < part.text.size() ? part.text[k] : ',';
      if (c == '\'') quoted = !quoted;
      if (c == '(') ++depth;
      if (c == ')') --depth;
      if (c != ',' || (k < part.text.size() && (quoted || depth > 0))) continue;
      parts.push_back(trimmed({part.text.substr(begin, k - begin), part.offset + begin}));
      begin = k + 1;
    }
    return parts;
  }

  /// Times and values of an expression in all rows where it has a value.
  struct Series {
    std::vector<double> times, values;
  };

  [[nodiscard]] Series series(Part part, double from, double to) const {
    const std::size_t time = *column("time");
    const std::optional<std::size_t> stage = column("stage");
    double begun = 0.0;  // s, when the present stage began
    const OfRow expression = compiled(part);
    Series all;
    for (std::size_t row = 0; row < results_.rows.size(); ++row) {
      if (stage && row > 0 && results_.rows[row][*stage] != results_.rows[row - 1][*stage])
        begun += results_.rows[row - 1][time];
      const double t = begun + results_.rows[row][time];
      if (t < from || t > to) continue;
      const double v = expression(row);
      if (std::isnan(v)) continue;
      all.times.push_back(t);
      all.values.push_back(v);
    }
    return all;
  }

  static double mean(const Series& all, bool windowed) {
    if (all.times.size() < 2) return all.times.empty() ? no_value : all.values.front();
    const double from = all.times.front(), length = all.times.back() - from;
    const auto weight = [&](std::size_t k) {
      return windowed ? 1.0 - std::cos(2.0 * std::numbers::pi * (all.times[k] - from) / length) : 1.0;
    };
    double sum = 0.0, weights = 0.0;
    for (std::size_t k = 1; k < all.times.size(); ++k) {
      const double half = 0.5 * (all.times[k] - all.times[k - 1]);
      sum += half * (weight(k - 1) * all.values[k - 1] + weight(k) * all.values[k]);
      weights += half * (weight(k - 1) + weight(k));
    }
    return sum / weights;
  }

  static double value_at_time(const Series& all, double time, std::size_t offset) {
    for (std::size_t k = 0; k < all.times.size(); ++k) {
      if (all.times[k] < time) continue;
      if (all.times[k] == time) return all.values[k];
      if (k == 0) break;
      const double share = (time - all.times[k - 1]) / (all.times[k] - all.times[k - 1]);
      return all.values[k - 1] + share * (all.values[k] - all.values[k - 1]);
    }
    throw FormulaError(fmt::format("time is outside the run ({} s), one of its times is needed", time),
                       offset);
  }

  static double crossing(const Series& all, int number) {
    // Zeros have no sign: what starts at zero has not crossed it.
    std::optional<std::size_t> last;
    for (std::size_t k = 0; k < all.values.size(); ++k) {
      if (all.values[k] == 0.0) continue;
      const std::optional<std::size_t> before = std::exchange(last, k);
      if (!before || (all.values[k] > 0.0) == (all.values[*before] > 0.0) || --number > 0) continue;
      if (*before + 1 < k) return all.times[*before + 1];
      const double share = all.values[*before] / (all.values[*before] - all.values[k]);
      return all.times[*before] + share * (all.times[k] - all.times[*before]);
    }
    return no_value;
  }

  [[nodiscard]] double rising(Part of, Part condition, int number) const {
    const OfRow changes = compiled(condition);
    bool above = true;
    for (std::size_t row = 0; row < results_.rows.size(); ++row) {
      const bool was = std::exchange(above, changes(row) > 0.0);
      if (above && !was && --number == 0) return value(of, row);
    }
    return no_value;
  }

  [[nodiscard]] double middle(Part part) const {
    const std::string name(part.text);
    const auto end = [&](const char* key) { return number_of_summary(name + key, part.offset); };
    if (name.starts_with("summary.") && value_at(results_.summary, name.substr(8) + ".lower") == nullptr)
      throw FormulaError(fmt::format("no bracket ({}), lower and upper are needed", name), part.offset);
    return std::sqrt(end(".lower") * end(".upper"));
  }

  [[nodiscard]] double function(std::string_view name, std::span<const Part> arguments,
                                std::size_t offset) const {
    const std::vector<std::size_t>& allowed = argument_counts().find(name)->second;
    if (std::find(allowed.begin(), allowed.end(), arguments.size()) == allowed.end())
      throw FormulaError(fmt::format("{} has {} arguments, {} are needed", name, arguments.size(),
                                     fmt::join(allowed, " or ")),
                         offset);
    // A run that failed before its first row.
    if (results_.rows.empty() && name != "middle" && name != "known") return no_value;
    const std::size_t last = results_.rows.empty() ? 0 : results_.rows.size() - 1;
    const auto number = [&](std::size_t k) { return value(arguments[k], last); };
    if (name == "middle") return middle(arguments[0]);
    if (name == "known") return std::isnan(number(0)) ? 0.0 : 1.0;
    if (name == "first") return value(arguments[0], 0);
    if (name == "last") return value(arguments[0], last);
    if (name == "rising") return rising(arguments[0], arguments[1], static_cast<int>(number(2)));
    const bool windowed = arguments.size() == 3;
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const Series all =
        series(arguments[0], windowed ? number(1) : -infinite, windowed ? number(2) : infinite);
    if (name == "at") return value_at_time(all, number(1), offset);
    if (all.values.empty()) return no_value;
    if (name == "largest") return *std::max_element(all.values.begin(), all.values.end());
    if (name == "smallest") return *std::min_element(all.values.begin(), all.values.end());
    if (name == "crossing") return crossing(all, static_cast<int>(number(1)));
    return mean(all, name == "hann");
  }

  const Formulas& names_;
  const CaseResults& results_;
};

}  // namespace

double value_of(const std::string& text, const Formulas& names, const CaseResults& results) {
  const std::size_t last = results.rows.empty() ? 0 : results.rows.size() - 1;
  return CaseEvaluation(names, results).value({text, 0}, last);
}

}  // namespace ashlar
