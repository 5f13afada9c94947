// Columns of results, declared once: header, rows, units, reference, page and Python read them from here.
//
// Components of a vector or tensor follow each other, in the order x, y, z or xx, yy, zz, xy, yz, xz, so that they can be
// rotated without knowing what they are. In the group "position" they are of a place, which is shifted too.
#pragma once

#include <string>

namespace ashlar {

/// A column of a table.
struct Column {
  std::string name;
  std::string unit;     ///< SI, "1": a number without one, empty: a text
  std::string group;    ///< what columns that are drawn together have in common: "velocity"
  std::string meaning;  ///< plain text
  std::string measure;  ///< that it belongs to; empty: the run
  /// "x", "y", "z" of a vector, "xx", "yy", "zz", "xy", "yz", "xz" of a symmetric tensor; empty: a number
  std::string component = {};
};

/// The declaration of a column whose values are taken from `Source`.
template <class Source>
struct ColumnOf {
  const char* name;
  const char* unit;
  const char* group;
  const char* meaning;
  double (*value)(const Source&);
  const char* component = "";
};

}  // namespace ashlar
