#include "apps/scene/toml/parameters.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace ashlar {
namespace {

struct Parameter {
  const toml::node* node = nullptr;
  std::set<std::string> needs;  ///< other parameters named by its formula
};

/// Parameters in an order in which each comes after those it uses.
class ParameterOrder {
 public:
  explicit ParameterOrder(std::map<std::string, Parameter> parameters) : parameters_(std::move(parameters)) {
    std::map<std::string, std::size_t> missing;
    std::map<std::string, std::vector<std::string>> users;
    for (const auto& [name, parameter] : parameters_) {
      missing[name] = parameter.needs.size();
      for (const std::string& need : parameter.needs) users[need].push_back(name);
      if (parameter.needs.empty()) order_.push_back(name);
    }
    for (std::size_t k = 0; k < order_.size(); ++k) {
      const auto found = users.find(order_[k]);
      if (found == users.end()) continue;
      for (const std::string& user : found->second)
        if (--missing[user] == 0) order_.push_back(user);
    }
  }

  /// All parameters, except those of cycles and those that use them.
  [[nodiscard]] const std::vector<std::string>& order() const { return order_; }

  /// One cycle, "a", "b", "a"; empty if there is none.
  [[nodiscard]] std::vector<std::string> circle() const {
    const std::set<std::string> done(order_.begin(), order_.end());
    const auto is_left = [&](const std::string& name) { return !done.contains(name); };
    std::string name;
    for (const auto& [candidate, parameter] : parameters_)
      if (name.empty() && is_left(candidate)) name = candidate;
    // Each remaining parameter uses another remaining one.
    std::vector<std::string> chain;
    while (!name.empty()) {
      const auto seen = std::find(chain.begin(), chain.end(), name);
      if (seen != chain.end()) {
        chain.erase(chain.begin(), seen);
        chain.push_back(name);
        return chain;
      }
      chain.push_back(name);
      const std::set<std::string>& needs = parameters_.at(name).needs;
      name = *std::find_if(needs.begin(), needs.end(), is_left);
    }
    return chain;
  }

  [[nodiscard]] const toml::node& node(const std::string& name) const { return *parameters_.at(name).node; }

 private:
  std::map<std::string, Parameter> parameters_;
  std::vector<std::string> order_;
};

std::map<std::string, Parameter> good_parameters(const toml::table& table, TomlReading& reading) {
  std::map<std::string, Parameter> parameters;
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    const std::string fault = Formulas::fault_of_name(name);
    if (!fault.empty()) {
      reading.error(reading.place(key.source()), fault);
    } else if (!TomlReading::has_number(node)) {
      reading.error(node,
                    fmt::format("{} has the wrong type ({}), a number or a formula in quotes (\"= 2*h\") "
                                "is needed",
                                name, describe(node)));
    } else {
      parameters[name].node = &node;
    }
  }
  for (auto& [name, parameter] : parameters) {
    const auto* text = parameter.node->as_string();
    if (text == nullptr) continue;
    for (const Formulas::Name& used : Formulas::parameters_in(**text))
      if (parameters.contains(used.text)) parameter.needs.insert(used.text);
  }
  return parameters;
}

}  // namespace

Formulas read_parameters(const toml::table& document, TomlReading& reading) {
  Formulas formulas;
  const toml::node* node = document.get("parameters");
  if (node == nullptr) return formulas;
  const toml::table* table = node->as_table();
  if (table == nullptr) {
    reading.error(*node,
                  fmt::format("parameters has the wrong type ({}), a table is needed", describe(*node)));
    return formulas;
  }
  if (table->size() > most_parameters) {
    reading.error(*node, fmt::format("too many parameters ({}), at most {} are allowed", table->size(),
                                     most_parameters));
    return formulas;
  }
  TomlReading::KnownTable& known = reading.add_table(*table, "parameters", "parameters");
  for (const auto& [key, value] : *table) known.keys.emplace(key.str());
  const ParameterOrder parameters(good_parameters(*table, reading));
  // All count as faulty until they have a value.
  for (const auto& [key, value] : *table) formulas.leave_out(std::string(key.str()));
  for (const std::string& name : parameters.order()) {
    const auto value = reading.number(parameters.node(name), name, formulas);
    if (value && std::isfinite(*value))
      formulas.define(name, *value);
    else if (value)
      reading.error(parameters.node(name), fmt::format("{} is not finite ({}), a number is needed", name,
                                                       describe(parameters.node(name))));
  }
  if (const std::vector<std::string> circle = parameters.circle(); !circle.empty())
    reading.error(parameters.node(circle.front()),
                  fmt::format("circular definition of parameters ({}); give one of them without the others",
                              fmt::join(circle, " -> ")));
  return formulas;
}

}  // namespace ashlar
