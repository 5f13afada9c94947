// Reports on bad input: every fault with its place, all in one run.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

namespace ashlar {

/// Place of a fault: in a file, or in an argument of the command line.
struct Place {
  std::string origin;  ///< the file as the user named it, or the whole argument, e.g. "--set block.B.order=0"
  int line = 0;        ///< 1-based; 0 if the origin has no lines (an argument)
  int column = 0;      ///< 1-based, in characters; 0 with line 0

  friend bool operator==(const Place&, const Place&) = default;
};

/// "FILE:LINE:COLUMN", or only the origin if it has no lines.
[[nodiscard]] std::string to_string(const Place& place);

enum class Severity {
  error,    ///< the input cannot be used
  warning,  ///< usable, but implausible
};

/// One fault. The message reads "what is wrong (value), what is allowed", without a full stop.
struct Diagnostic {
  Place place;
  std::string message;
  Severity severity = Severity::error;
};

/// Longest reported line, bytes; longer ones are shortened in the middle.
inline constexpr std::size_t longest_line = 2000;

/// "PLACE: error: MESSAGE" or "PLACE: warning: MESSAGE" in one line: control characters are replaced by blanks.
[[nodiscard]] std::string to_string(const Diagnostic& diagnostic);

/// Number of faults of one kind listed by print(); the others are counted.
inline constexpr std::size_t listed_of_a_kind = 20;

/// All faults found so far.
class Diagnostics {
 public:
  void error(Place place, std::string message) { all_.push_back({std::move(place), std::move(message)}); }
  void warning(Place place, std::string message) {
    all_.push_back({std::move(place), std::move(message), Severity::warning});
  }
  /// True if the input can be used: there may be warnings, but no errors.
  [[nodiscard]] bool good() const;
  /// In file order; faults of arguments come after those of files. Faults at one place keep the order in which they
  /// were found; duplicates are listed once.
  [[nodiscard]] std::vector<Diagnostic> sorted() const;
  /// As sorted(), but only the first listed_of_a_kind of faults that differ in names and numbers; at the end one for
  /// the others of each kind, with their number, at the place of the first of them.
  [[nodiscard]] std::vector<Diagnostic> listed() const;
  /// Prints listed(), one line each.
  void print(std::ostream& stream) const;

 private:
  std::vector<Diagnostic> all_;
};

}  // namespace ashlar
