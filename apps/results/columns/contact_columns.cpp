#include "apps/results/columns/contact_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/results/columns/history_columns.hpp"
#include "apps/results/text/csv_text.hpp"
#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// A pair in one frame.
struct ContactRow {
  const Simulation& simulation;
  const PairRecord& pair;
  std::array<int, 3> closed = {0, 0, 0};  ///< points by type
  double area = 0.0;                      ///< m^2, of these
  Vector3 normal = Vector3::Zero();       ///< N, on block a
  Vector3 shear = Vector3::Zero();
};

ContactRow row_of(const Simulation& simulation, const PairRecord& pair) {
  ContactRow row{simulation, pair};
  for (std::size_t k = 0; k < pair.points.size(); ++k) {
    const ContactPoint& point = pair.points[k];
    const PointResponse& response = pair.responses[k];
    // A point that is open at the end may have transmitted force in the step.
    if (response.state != ContactState::open) {
      ++row.closed[static_cast<std::size_t>(point.type)];
      row.area += point.area;
    }
    row.normal += response.force[0] * point.normal;
    row.shear += response.force[1] * point.tangent_1 + response.force[2] * point.tangent_2;
  }
  return row;
}

std::string block_name(const ContactRow& row, int block) {
  return quote_csv_field(row.simulation.blocks()[at(block)].name());
}

/// A column whose values are written as text.
struct TextColumn {
  const char* name;
  const char* unit;
  const char* meaning;
  std::string (*text)(const ContactRow&);
  const char* component = "";
};

constexpr const char* closed_points = "closed contact points by type";
constexpr const char* normal_sum =
    "sum of the normal forces **on block_a**, in the axes of the scene; block_b has the opposite";
constexpr const char* shear_sum = "sum of the forces of friction and shear springs on block_a";
constexpr TextColumn columns[] = {
    {"step", "1", "of the frame",
     [](const ContactRow& r) { return fmt::format("{}", r.simulation.steps()); }},
    {"time", "s", "of the frame", [](const ContactRow& r) { return fmt::format("{}", r.simulation.time()); }},
    {"block_a", "", "name of the block that stands first in the scene",
     [](const ContactRow& r) { return block_name(r, r.pair.a); }},
    {"block_b", "", "name of the other block", [](const ContactRow& r) { return block_name(r, r.pair.b); }},
    {"points.face_face", "1", closed_points,
     [](const ContactRow& r) { return fmt::format("{}", r.closed[0]); }},
    {"points.vertex_face", "1", closed_points,
     [](const ContactRow& r) { return fmt::format("{}", r.closed[1]); }},
    {"points.edge_edge", "1", closed_points,
     [](const ContactRow& r) { return fmt::format("{}", r.closed[2]); }},
    {"area", "m^2", "area of the closed contact points",
     [](const ContactRow& r) { return fmt::format("{}", r.area); }},
    {"normal_force.x", "N", normal_sum, [](const ContactRow& r) { return fmt::format("{}", r.normal.x()); },
     "x"},
    {"normal_force.y", "N", normal_sum, [](const ContactRow& r) { return fmt::format("{}", r.normal.y()); },
     "y"},
    {"normal_force.z", "N", normal_sum, [](const ContactRow& r) { return fmt::format("{}", r.normal.z()); },
     "z"},
    {"shear_force.x", "N", shear_sum, [](const ContactRow& r) { return fmt::format("{}", r.shear.x()); },
     "x"},
    {"shear_force.y", "N", shear_sum, [](const ContactRow& r) { return fmt::format("{}", r.shear.y()); },
     "y"},
    {"shear_force.z", "N", shear_sum, [](const ContactRow& r) { return fmt::format("{}", r.shear.z()); },
     "z"},
    {"work", "J", "of the contact forces on both blocks since the start",
     [](const ContactRow& r) { return fmt::format("{}", r.pair.work); }},
};

}  // namespace

std::vector<Column> contact_columns() {
  std::vector<Column> all;
  for (const TextColumn& column : columns)
    all.push_back({column.name, column.unit, "", column.meaning, "", column.component});
  return all;
}

std::string contact_header() {
  return fmt::format("{}\n", fmt::join(names_of(contact_columns()), ","));
}

std::string contact_rows(const Simulation& simulation) {
  std::string rows;
  for (const PairRecord& pair : simulation.contacts()) {
    const ContactRow row = row_of(simulation, pair);
    for (const TextColumn& column : columns) rows += column.text(row) + ",";
    rows.back() = '\n';
  }
  return rows;
}

}  // namespace ashlar
