#include "geometry/text/write_number.hpp"

#include <charconv>

namespace ashlar {

char* write_number(char* begin, double value, NumberForm form) {
  char* const end = begin + longest_number;
  switch (form) {
    case NumberForm::shorter:
      return std::to_chars(begin, end, value).ptr;
    case NumberForm::fixed:
      return std::to_chars(begin, end, value, std::chars_format::fixed).ptr;
    case NumberForm::scientific:
      return std::to_chars(begin, end, value, std::chars_format::scientific).ptr;
  }
  return begin;
}

}  // namespace ashlar
