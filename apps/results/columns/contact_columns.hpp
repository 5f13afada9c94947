// The columns of contacts.csv: a row for each pair of blocks with contact points and each frame.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "apps/results/columns/column.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

[[nodiscard]] std::vector<Column> contact_columns();

/// The first line of the file.
[[nodiscard]] std::string contact_header();

/// The lines of all pairs after the last step.
[[nodiscard]] std::string contact_rows(const Simulation& simulation);

}  // namespace ashlar
