// Formulas in place of numbers: "= 2*h + 0.1". What is in them: numbers with a decimal point (of whatever
// locale the program runs in), named values, + - * / ^ ( ), comparisons, && ||, and a ? b : c. Angles of sin,
// cos and tan are radians; sin(30*deg) is that of degrees.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace ashlar {

/// A formula that gives no number; what() is "what is wrong, what is allowed", or empty where it uses a
/// parameter that was left out.
class FormulaError : public std::runtime_error {
 public:
  FormulaError(const std::string& what, std::size_t offset) : runtime_error(what), offset_(offset) {}
  /// 0-based byte of the formula's text that the fault is at.
  [[nodiscard]] std::size_t offset() const { return offset_; }

 private:
  std::size_t offset_;
};

/// Whether a text in place of a number is meant as a formula: it begins with "=".
[[nodiscard]] inline bool is_formula(std::string_view text) {
  return text.starts_with('=');
}

/// Characters that a formula may have.
inline constexpr std::size_t longest_formula = 1000;

/// Characters that a parameter's name may have: no more than the parser takes.
inline constexpr std::size_t longest_parameter = 100;

/// Named values and what formulas of them come to. Each of pi (3.14...) and deg (pi / 180) is always there.
class Formulas {
 public:
  Formulas();
  ~Formulas();
  Formulas(Formulas&&) noexcept;
  Formulas& operator=(Formulas&&) noexcept;

  /// Adds a value. @param name a good one, see fault_of_name; not defined yet
  void define(const std::string& name, double value);
  /// Says that a name is a parameter without a value, because of a fault that is reported elsewhere.
  void leave_out(const std::string& name);
  /// "what is wrong, what is allowed" of a name that cannot be a parameter's: a letter from a to z, A to Z or
  /// _, then letters and digits are, at most longest_parameter in all; names of functions and constants are
  /// not. Empty for a good one.
  [[nodiscard]] static std::string fault_of_name(const std::string& name);

  /// @param text begins with "=". @return a finite number
  /// @throws FormulaError: malformed, longer than longest_formula, an unknown name (with the nearest known
  /// one), a division by zero or anything else that is no finite number on the way to the result
  [[nodiscard]] double value(const std::string& text) const;

  /// A name in a formula.
  struct Name {
    std::string text;
    std::size_t offset;
  };
  /// Names in a text that are no functions and no constants, in order of appearance.
  [[nodiscard]] static std::vector<Name> parameters_in(const std::string& text);

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

}  // namespace ashlar
