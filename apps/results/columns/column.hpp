// Columns of results, declared once: header, rows, units, reference, page and Python read them from here.
#pragma once

#include <string>

namespace ashlar {

/// A column of a table.
struct Column {
  std::string name;
  std::string unit;     ///< SI, "1": a number without one
  std::string group;    ///< what columns that are drawn together have in common: "velocity"
  std::string meaning;  ///< plain text
  std::string measure;  ///< that it belongs to; empty: the run
};

/// The declaration of a column whose values are taken from `Source`.
template <class Source>
struct ColumnOf {
  const char* name;
  const char* unit;
  const char* group;
  const char* meaning;
  double (*value)(const Source&);
};

}  // namespace ashlar
