// Formulas in place of numbers: "= 2*h + 0.1". They may contain numbers with a decimal point (in any locale), named
// values, + - * / ^ ( ), comparisons, && ||, and a ? b : c. Angles of sin, cos and tan are radians; sin(30*deg) uses
// degrees.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// A formula without a number as result; what() is "what is wrong, what is allowed", or empty if it uses a parameter
/// that was left out.
class FormulaError : public std::runtime_error {
 public:
  FormulaError(const std::string& what, std::size_t offset) : runtime_error(what), offset_(offset) {}
  /// 0-based byte of the fault in the formula's text.
  [[nodiscard]] std::size_t offset() const { return offset_; }

 private:
  std::size_t offset_;
};

/// True if a text in place of a number is a formula: it begins with "=".
[[nodiscard]] inline bool is_formula(std::string_view text) {
  return text.starts_with('=');
}

/// Largest number of characters of a formula.
inline constexpr std::size_t longest_formula = 1000;

/// Largest number of characters of a parameter's name, as limited by the parser.
inline constexpr std::size_t longest_parameter = 100;

/// Named values and evaluation of formulas. pi (3.14...) and deg (pi / 180) are predefined.
class Formulas {
 public:
  Formulas();
  ~Formulas();
  Formulas(Formulas&&) noexcept;
  Formulas& operator=(Formulas&&) noexcept;

  /// Adds a value. @param name valid (see fault_of_name) and not defined yet
  void define(const std::string& name, double value);
  /// Declares a parameter without a value, because of a fault that is reported elsewhere.
  void leave_out(const std::string& name);
  /// "what is wrong, what is allowed" for a name that is not valid for a parameter. Valid are a letter from a to z, A
  /// to Z or _, then letters and digits, at most longest_parameter in total, except names of functions and constants.
  /// Empty if valid.
  [[nodiscard]] static std::string fault_of_name(const std::string& name);

  /// @param text begins with "=". @return a finite number
  /// @throws FormulaError: malformed, longer than longest_formula, an unknown name (with the nearest known one), a
  /// division by zero or any other intermediate result that is not finite
  [[nodiscard]] double value(const std::string& text) const;

  /// A formula of named variables, which hide parameters of these names: a function of their values, in the order of the
  /// names. It throws FormulaError where the formula has no finite value. @throws FormulaError as value(), but for values
  [[nodiscard]] std::function<double(std::span<const double>)> of_variables(
      const std::string& text, const std::vector<std::string>& variables) const;
  /// A formula of a place, whose coordinates are x, y and z (m). They hide parameters of these names. The function throws
  /// FormulaError where the formula has no finite value. @throws FormulaError as value(), but for values
  [[nodiscard]] std::function<double(const Vector3&)> of_place(const std::string& text) const;
  /// The formula with its parameters, other than x, y and z, replaced by their values.
  [[nodiscard]] std::string with_values(const std::string& text) const;

  /// True for a parameter, whether it has a value or was left out.
  [[nodiscard]] bool knows(const std::string& name) const;

  /// A name in a formula.
  struct Name {
    std::string text;
    std::size_t offset;
  };
  /// Names in a text other than functions and constants, in order of appearance.
  [[nodiscard]] static std::vector<Name> parameters_in(const std::string& text);

 private:
  void check(const std::string& text) const;
  /// The value of the text that the parser holds.
  [[nodiscard]] double evaluated(const std::string& text) const;

  struct Parser;
  std::unique_ptr<Parser> parser_;
};

}  // namespace ashlar
