#include "apps/program/fragility/limit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "apps/program/result_names.hpp"
#include "apps/scene/model/nearest_name.hpp"
#include "apps/scene/toml/formulas.hpp"

namespace ashlar {
namespace {

constexpr const char* wanted = "as \"top.ux > 0.1\" or \"collapse\"";

[[noreturn]] void refuse(const std::string& text, const std::string& what) {
  throw std::invalid_argument(fmt::format("--limit {}: {}", text, what));
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

/// Places of < and > outside of quotes and brackets.
std::vector<std::size_t> comparisons_in(std::string_view text) {
  std::vector<std::size_t> places;
  int depth = 0;
  bool quoted = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (c == '\'') quoted = !quoted;
    if (quoted) continue;
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (depth == 0 && (c == '<' || c == '>')) places.push_back(k);
  }
  return places;
}

std::optional<std::size_t> index_of(std::string_view name, const std::vector<std::string>& columns) {
  for (const std::string& meant : {std::string(name), std::string(name) + ".drift"}) {
    const auto found = std::find(columns.begin(), columns.end(), meant);
    if (found != columns.end()) return static_cast<std::size_t>(found - columns.begin());
  }
  return std::nullopt;
}

/// A demand in the words of formulas: a variable in place of each column.
struct Translated {
  std::string formula = "= ";
  std::vector<std::string> variables;
  std::vector<std::size_t> columns;  ///< of the variables
};

std::size_t column_named(std::string_view name, const Limit& limit, const std::vector<std::string>& columns) {
  if (const auto column = index_of(name, columns)) return *column;
  refuse(limit.text,
         fmt::format("no column of history.csv has that name ({}), {}one of its columns is needed, as {}: a "
                     "[[measure]] of the scene adds some",
                     name, guess(name, columns), columns.empty() ? "time" : columns.back()));
}

Translated translated(const Limit& limit, const std::vector<std::string>& columns) {
  Translated result;
  const auto add = [&](std::string_view name) {
    result.variables.push_back(fmt::format("column_{}", result.variables.size()));
    result.columns.push_back(column_named(name, limit, columns));
    result.formula += result.variables.back();
  };
  std::string_view rest = limit.demand;
  while (!rest.empty()) {
    if (rest.front() == '\'') {
      const std::size_t end = rest.find('\'', 1);
      if (end == std::string_view::npos) refuse(limit.text, "a quote is not closed, ' is needed");
      add(rest.substr(1, end - 1));
      rest.remove_prefix(end + 1);
      continue;
    }
    const std::size_t length = plain_length(rest), name = name_length(rest);
    const std::string_view part = rest.substr(0, length);
    const bool is_function = length < rest.size() && rest[length] == '(';
    if (name > 0 && !is_function && part != "pi" && part != "deg")
      add(part);
    else
      result.formula += part;
    rest.remove_prefix(length);
  }
  return result;
}

/// A formula is read when it is evaluated. That it has no value, as by a division by zero, is no fault.
void refuse_unreadable(const Limit& limit, const std::function<void()>& evaluate) {
  try {
    evaluate();
  } catch (const FormulaError& fault) {
    const std::string_view what = fault.what();
    if (what.starts_with("formula cannot be read") || what.starts_with("formula has several values"))
      refuse(limit.text, std::string(what));
  }
}

}  // namespace

double Limit::worse(double one, double other) const {
  if (std::isnan(one) || std::isnan(other)) return std::isnan(one) ? other : one;
  return above ? std::max(one, other) : std::min(one, other);
}

Limit parse_limit(const std::string& text) {
  Limit limit;
  limit.text = trimmed(text);
  if (limit.text == "collapse") return limit;
  const std::vector<std::size_t> places = comparisons_in(limit.text);
  if (places.size() != 1)
    refuse(text,
           fmt::format("limit has {} comparisons, one of > >= < <= is needed, {}", places.size(), wanted));
  limit.above = limit.text[places[0]] == '>';
  limit.reached = limit.text.size() > places[0] + 1 && limit.text[places[0] + 1] == '=';
  limit.demand = trimmed(std::string_view(limit.text).substr(0, places[0]));
  const std::string bound(trimmed(std::string_view(limit.text).substr(places[0] + (limit.reached ? 2 : 1))));
  if (limit.demand.empty() || bound.empty())
    refuse(text, fmt::format("a side of the comparison is empty, {} is needed", wanted));
  try {
    limit.bound = Formulas().value("= " + bound);
  } catch (const FormulaError& fault) {
    refuse(text, fmt::format("the right side ({}) is no number: {}", bound, fault.what()));
  }
  return limit;
}

DemandOfRow demand_of_row(const Limit& limit, const std::vector<std::string>& columns) {
  if (limit.is_collapse()) return [](std::span<const double>) { return std::nan(""); };
  Translated parts = translated(limit, columns);
  if (parts.columns.empty())
    refuse(limit.text,
           fmt::format("the left side has no column of history.csv ({}), one is needed", limit.demand));
  if (parts.formula == "= column_0")
    return [column = parts.columns.front()](std::span<const double> row) { return row[column]; };
  const auto formula = Formulas().of_variables(parts.formula, parts.variables);
  refuse_unreadable(limit, [&] { (void)formula(std::vector<double>(parts.columns.size(), 1.0)); });
  return [formula, places = std::move(parts.columns)](std::span<const double> row) {
    std::vector<double> values;
    for (const std::size_t place : places) values.push_back(row[place]);
    if (std::any_of(values.begin(), values.end(), [](double value) { return !std::isfinite(value); }))
      return std::numeric_limits<double>::quiet_NaN();
    try {
      return formula(values);
    } catch (const FormulaError&) {
      return std::numeric_limits<double>::quiet_NaN();
    }
  };
}

}  // namespace ashlar
