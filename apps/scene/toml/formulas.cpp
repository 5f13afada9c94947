#include "apps/scene/toml/formulas.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numbers>
#include <set>

#include "apps/scene/model/nearest_name.hpp"
#include "apps/scene/system/float_faults.hpp"
#include "apps/scene/toml/digit.hpp"
#include "geometry/exact/rounded_functions.hpp"
#include "geometry/text/parse_number.hpp"

namespace ashlar {
namespace {

struct UnaryFunction {
  const char* name;
  double (*call)(double);
};

constexpr std::array<UnaryFunction, 18> unary_functions = {{{"sin", correctly_rounded::sin},
                                                            {"cos", correctly_rounded::cos},
                                                            {"tan", correctly_rounded::tan},
                                                            {"asin", correctly_rounded::asin},
                                                            {"acos", correctly_rounded::acos},
                                                            {"atan", correctly_rounded::atan},
                                                            {"sinh", correctly_rounded::sinh},
                                                            {"cosh", correctly_rounded::cosh},
                                                            {"tanh", correctly_rounded::tanh},
                                                            {"exp", correctly_rounded::exp},
                                                            {"ln", correctly_rounded::log},
                                                            {"log10", correctly_rounded::log10},
                                                            {"sqrt", std::sqrt},
                                                            {"cbrt", correctly_rounded::cbrt},
                                                            {"abs", std::fabs},
                                                            {"floor", std::floor},
                                                            {"ceil", std::ceil},
                                                            {"round", std::round}}};

// The parser ensures that there is at least one.
double smallest(const double* values, int count) {
  return *std::min_element(values, values + count);
}

double largest(const double* values, int count) {
  return *std::max_element(values, values + count);
}

double quadrant_angle(double y, double x) {
  return correctly_rounded::atan2(y, x);
}

constexpr std::array<const char*, 3> other_functions = {"atan2", "min", "max"};
constexpr std::array<std::pair<const char*, double>, 2> constants = {
    {{"pi", std::numbers::pi}, {"deg", std::numbers::pi / 180.0}}};

bool is_function(std::string_view name) {
  return std::any_of(unary_functions.begin(), unary_functions.end(),
                     [&](const UnaryFunction& function) { return name == function.name; }) ||
         std::find(other_functions.begin(), other_functions.end(), name) != other_functions.end();
}

bool is_constant(std::string_view name) {
  return std::any_of(constants.begin(), constants.end(),
                     [&](const auto& constant) { return name == constant.first; });
}

// Letters of the parser, in any locale.
bool is_letter(char letter) {
  return letter == '_' || (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z');
}

// End of the number that begins at `at`: digits with a point and an exponent.
std::size_t end_of_number(const std::string& text, std::size_t at) {
  const auto digits = [&] {
    while (at < text.size() && (is_digit(text[at]) || text[at] == '.')) ++at;
  };
  digits();
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    std::size_t exponent = at + 1;
    if (exponent < text.size() && (text[exponent] == '+' || text[exponent] == '-')) ++exponent;
    if (exponent < text.size() && is_digit(text[exponent])) {
      at = exponent;
      digits();
    }
  }
  return at;
}

std::vector<Formulas::Name> names_in(const std::string& text) {
  std::vector<Formulas::Name> names;
  for (std::size_t at = 0; at < text.size();) {
    if (is_digit(text[at]) || text[at] == '.') {
      at = end_of_number(text, at);
    } else if (is_letter(text[at])) {
      const std::size_t start = at;
      while (at < text.size() && (is_letter(text[at]) || is_digit(text[at]))) ++at;
      names.push_back({text.substr(start, at - start), start});
    } else {
      ++at;
    }
  }
  return names;
}

// The parser reads 1e-400 as zero.
void refuse_numbers_out_of_range(const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    if (is_letter(text[at])) {
      while (at < text.size() && (is_letter(text[at]) || is_digit(text[at]))) ++at;
    } else if (is_digit(text[at]) || text[at] == '.') {
      const std::size_t end = end_of_number(text, at);
      double ignored = 0.0;
      if (parse_number(text.data() + at, text.data() + end, ignored).ec == std::errc::result_out_of_range)
        throw FormulaError(fmt::format("number is out of the range of double precision ({}), 4.9e-324 to "
                                       "1.7e308 is allowed",
                                       text.substr(at, end - at)),
                           at);
      at = end;
    } else {
      ++at;
    }
  }
}

// The parser would read `a = 2` as an assignment.
void refuse_assignment(const std::string& text) {
  for (std::size_t at = 1; at < text.size(); ++at) {
    if (text[at] != '=') continue;
    const bool compares = std::string_view("=<>!").find(text[at - 1]) != std::string_view::npos && at > 1;
    if (compares) continue;
    if (at + 1 < text.size() && text[at + 1] == '=') {
      ++at;
      continue;
    }
    throw FormulaError("= within a formula; use == to compare", at);
  }
}

std::string words_of(const mu::Parser::exception_type& error) {
  switch (error.GetCode()) {
    case mu::ecUNEXPECTED_EOF:
      return "it ends too early";
    case mu::ecMISSING_PARENS:
      return "a parenthesis is not closed";
    case mu::ecUNEXPECTED_PARENS:
      return "a parenthesis is out of place";
    case mu::ecUNEXPECTED_OPERATOR:
      return "an operator is out of place";
    case mu::ecUNEXPECTED_VAL:
      return "a number is out of place";
    case mu::ecUNEXPECTED_VAR:
    case mu::ecUNEXPECTED_FUN:
      return "a name is out of place";
    case mu::ecUNEXPECTED_ARG_SEP:
      return "a comma is out of place";
    case mu::ecTOO_MANY_PARAMS:
      return "a function has too many arguments";
    case mu::ecTOO_FEW_PARAMS:
      return "a function has too few arguments";
    default:
      return "the text from here on is not a formula";
  }
}

constexpr const char* allowed_words =
    "numbers, parameters, + - * / ^ ( ) and functions as sin(30*deg), sqrt(2), max(a, b) are allowed";

}  // namespace

struct Formulas::Parser {
  mu::Parser parser;
  // Variables, not constants: the branch of a ? b : c that is not taken is not evaluated.
  std::map<std::string, double> values;
  std::set<std::string> left_out;

  Parser() {
    // Only documented names: the parser's own log, for example, has changed its base between versions.
    parser.ClearFun();
    parser.ClearConst();
    for (const UnaryFunction& function : unary_functions) parser.DefineFun(function.name, function.call);
    parser.DefineFun("atan2", quadrant_angle);
    parser.DefineFun("min", smallest);
    parser.DefineFun("max", largest);
    for (const auto& [name, value] : constants) add(name, value);
  }

  void add(const std::string& name, double value) {
    double& kept = values[name];
    kept = value;
    parser.DefineVar(name, &kept);
  }
};

Formulas::Formulas() : parser_(std::make_unique<Parser>()) {}
Formulas::~Formulas() = default;
Formulas::Formulas(Formulas&&) noexcept = default;
Formulas& Formulas::operator=(Formulas&&) noexcept = default;

void Formulas::define(const std::string& name, double value) {
  parser_->left_out.erase(name);
  parser_->add(name, value);
}

void Formulas::leave_out(const std::string& name) {
  parser_->left_out.insert(name);
}

std::string Formulas::fault_of_name(const std::string& name) {
  if (name.size() > longest_parameter)
    return fmt::format("parameter has too long a name ({} characters), at most {} are allowed", name.size(),
                       longest_parameter);
  const bool good = !name.empty() && is_letter(name.front()) &&
                    std::all_of(name.begin(), name.end(),
                                [](char letter) { return is_letter(letter) || is_digit(letter); });
  if (!good)
    return fmt::format(
        "parameter cannot be used in formulas ({}), a letter, then letters, digits and _ are "
        "allowed",
        name);
  if (is_function(name) || is_constant(name))
    return fmt::format("parameter has a name that is taken ({}), formulas know it as a {}", name,
                       is_function(name) ? "function" : "constant");
  return {};
}

std::vector<Formulas::Name> Formulas::parameters_in(const std::string& text) {
  std::vector<Name> names = names_in(text);
  std::erase_if(names, [](const Name& name) { return is_function(name.text) || is_constant(name.text); });
  return names;
}

void Formulas::check(const std::string& text) const {
  if (text.size() > longest_formula)
    throw FormulaError(fmt::format("formula is too long ({} characters), at most {} are allowed", text.size(),
                                   longest_formula),
                       0);
  for (std::size_t at = 0; at < text.size(); ++at)
    if (static_cast<unsigned char>(text[at]) >= 0x80 || static_cast<unsigned char>(text[at]) < ' ')
      throw FormulaError(fmt::format("formula has a character that it cannot have, {}", allowed_words), at);
  for (const Name& name : parameters_in(text)) {
    if (parser_->values.contains(name.text)) continue;
    if (parser_->left_out.contains(name.text)) throw FormulaError("", name.offset);
    std::vector<std::string> known;
    for (const auto& [other, value] : parser_->values) known.push_back(other);
    for (const UnaryFunction& function : unary_functions) known.emplace_back(function.name);
    known.insert(known.end(), other_functions.begin(), other_functions.end());
    throw FormulaError(fmt::format("unknown name in a formula ({}), {}a key of [parameters] or a function is "
                                   "needed",
                                   name.text, guess(name.text, known)),
                       name.offset);
  }
  refuse_numbers_out_of_range(text);
  refuse_assignment(text);
}

double Formulas::value(const std::string& text) const {
  check(text);
  parser_->parser.SetExpr(text.substr(1));
  return evaluated(text);
}

double Formulas::evaluated(const std::string& text) const {
  try {
    forget_float_faults();
    const double result = parser_->parser.Eval();
    const FloatFaults faults = float_faults(result);
    if (parser_->parser.GetNumResults() != 1)
      throw FormulaError("formula has several values (a comma), one is needed", 0);
    if (faults.division) throw FormulaError("formula divides by zero, another divisor is needed", 0);
    if (faults.any() || !std::isfinite(result))
      throw FormulaError(fmt::format("formula has no finite value ({}), a number is needed",
                                     faults.invalid ? "not a number" : "too large"),
                         0);
    return result;
  } catch (const mu::Parser::exception_type& error) {
    // Positions are relative to the text after "=".
    const std::size_t offset =
        std::min(static_cast<std::size_t>(std::max(error.GetPos(), 0)) + 1, text.size());
    throw FormulaError(fmt::format("formula cannot be read ({}), {}", words_of(error), allowed_words),
                       offset);
  }
}

std::function<double(std::span<const double>)> Formulas::of_variables(
    const std::string& text, const std::vector<std::string>& variables) const {
  const auto formulas = std::make_shared<Formulas>();
  for (const auto& [name, value] : parser_->values)
    if (!is_constant(name)) formulas->define(name, value);
  formulas->parser_->left_out = parser_->left_out;
  // The parser reads variables from here, and the text once.
  std::vector<double*> places;
  for (const std::string& name : variables) {
    formulas->define(name, 0.0);
    places.push_back(&formulas->parser_->values.at(name));
  }
  formulas->check(text);
  formulas->parser_->parser.SetExpr(text.substr(1));
  // Simulations of one scene may be built by several threads.
  return [formulas, text, places = std::move(places),
          alone = std::make_shared<std::mutex>()](std::span<const double> values) {
    const std::lock_guard<std::mutex> lock(*alone);
    for (std::size_t k = 0; k < places.size(); ++k) *places[k] = values[k];
    return formulas->evaluated(text);
  };
}

std::function<double(const Vector3&)> Formulas::of_place(const std::string& text) const {
  return [formula = of_variables(text, {"x", "y", "z"})](const Vector3& place) {
    return formula({place.data(), 3});
  };
}

bool Formulas::knows(const std::string& name) const {
  return parser_->values.contains(name) || parser_->left_out.contains(name);
}

std::string Formulas::with_values(const std::string& text) const {
  std::string result = text;
  std::vector<Name> names = parameters_in(text);
  std::reverse(names.begin(), names.end());
  for (const Name& name : names) {
    const auto found = parser_->values.find(name.text);
    if (found == parser_->values.end() || name.text == "x" || name.text == "y" || name.text == "z") continue;
    result.replace(name.offset, name.text.size(), fmt::format("({})", found->second));
  }
  return result;
}

}  // namespace ashlar
