#include "solver/seams.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "mechanics/overlap_outline.hpp"

namespace ashlar {
namespace {

/// Cosines of 10 and 60 degrees.
constexpr double faces_across = 0.985;
constexpr double steep_sides = 0.5;
constexpr double sides_along = 0.17;  // cosine of 80 degrees

/// Largest cosine between a unit direction and any of some normals' lines.
double largest_cosine(const Vector3& direction, const std::vector<Vector3>& normals) {
  double largest = 0.0;
  for (const Vector3& normal : normals) largest = std::max(largest, std::abs(normal.dot(direction)));
  return largest;
}

/// What touches of a and of b.
struct Touching {
  std::vector<Vector3> of_a;
  std::vector<Vector3> of_b;
  std::vector<Vector3> normals;  ///< of the cells that touch, of crossed edges the normal across them
};

Touching touching(const PlacedSurface& a, const PlacedSurface& b, const CellOverlap& overlap) {
  return {a.corners(overlap.cell_a),
          b.corners(overlap.cell_b),
          {a.normal(overlap.cell_a), b.normal(overlap.cell_b)}};
}

Touching touching(const PlacedSurface& a, const PlacedSurface& b, const VertexContact& contact) {
  const PlacedSurface& with_cell = contact.vertex_of_a ? b : a;
  std::vector<Vector3> vertex = {(contact.vertex_of_a ? a : b).point(contact.point)};
  std::vector<Vector3> cell = with_cell.corners(contact.cell);
  const std::vector<Vector3> normals = {with_cell.normal(contact.cell)};
  return contact.vertex_of_a ? Touching{std::move(vertex), std::move(cell), normals}
                             : Touching{std::move(cell), std::move(vertex), normals};
}

Touching touching(const PlacedSurface& a, const PlacedSurface& b, const EdgeContact& contact) {
  const auto ends = [](const PlacedSurface& s, const CrossedSide& side) {
    return std::vector{s.point(side.ends[0]), s.point(side.ends[1])};
  };
  return {ends(a, contact.of_a), ends(b, contact.of_b), {contact.normal}};
}

/// Whether an edge is the rim of a cell that faces a direction.
bool looks(const PlacedSurface& s, const CrossedSide& side, const Vector3& direction) {
  const std::vector<SurfaceEdge>& edges = s.surface().edges;
  const auto edge = std::find_if(edges.begin(), edges.end(), [&](const SurfaceEdge& known) {
    return known.ends == side.ends || known.ends == std::array{side.ends[1], side.ends[0]};
  });
  return edge == edges.end() || std::any_of(edge->cells.begin(), edge->cells.end(), [&](int cell) {
           return s.normal(cell).dot(direction) > sides_along;
         });
}

/// Whether what a block would slide over lies in the way it comes from.
template <class Contact>
bool lies_below(const WayOut& way, const PlacedSurface& a, const PlacedSurface& b, const Contact& contact) {
  if constexpr (std::is_same_v<Contact, EdgeContact>) {
    return way.a_moves ? looks(b, contact.of_b, way.direction) : looks(a, contact.of_a, -way.direction);
  }
  return true;
}

/// Whether all of b that touches is below all of a when a has moved along the way.
template <class Contact>
bool undoes(const WayOut& way, const PlacedSurface& a, const PlacedSurface& b, const Contact& contact) {
  const Vector3& direction = way.direction;
  const Touching found = touching(a, b, contact);
  if (largest_cosine(direction, found.normals) > way.largest_cosine) return false;
  double lowest_of_a = std::numeric_limits<double>::infinity();
  double highest_of_b = -lowest_of_a;
  for (const Vector3& point : found.of_a) lowest_of_a = std::min(lowest_of_a, point.dot(direction));
  for (const Vector3& point : found.of_b) highest_of_b = std::max(highest_of_b, point.dot(direction));
  return highest_of_b - lowest_of_a <= way.height && (way.own || lies_below(way, a, b, contact));
}

/// Whether a condition holds for any contact of a pair.
template <class Condition>
bool any_of(const PairContacts& contacts, const Condition& holds) {
  const auto any = [&](const auto& some) { return std::any_of(some.begin(), some.end(), holds); };
  return any(contacts.overlaps) || any(contacts.vertices) || any(contacts.edges);
}

}  // namespace

WaysOut::WaysOut(const std::map<std::array<int, 2>, ContactMemory>& memory) {
  for (const auto& [blocks, pair] : memory) {
    if (!(pair.deepest() > 0.0)) continue;
    for (const ContactMemory::Entry& entry : pair.entries())
      if (entry.memory.state != ContactState::open) add(blocks, entry.normal, pair.deepest());
  }
}

void WaysOut::add(const std::array<int, 2>& blocks, const Vector3& normal, double depth) {
  // Directions that differ by less than a third of a degree are one way.
  constexpr double same_direction = 0.99998;
  const double height = depth > 0.0 ? 2.0 * depth : depth;
  const auto add_to = [&](int block, int other, const Vector3& direction) {
    std::vector<OutOf>& known = ways_[block];
    const bool there = std::any_of(known.begin(), known.end(), [&](const OutOf& way) {
      return way.other == other && way.direction.dot(direction) >= same_direction && way.height >= height;
    });
    if (!there) known.push_back({other, direction, height});
  };
  add_to(blocks[0], blocks[1], normal);
  add_to(blocks[1], blocks[0], -normal);
}

void WaysOut::add_touching(const std::array<int, 2>& blocks, const PlacedSurface& a, const PlacedSurface& b,
                           const PairContacts& contacts) {
  const double rounding = coordinate_rounding(a, b);
  for (const CellOverlap& overlap : contacts.overlaps)
    add(blocks, overlap.frame.w, rounding - *std::min_element(overlap.gaps.begin(), overlap.gaps.end()));
  for (const VertexContact& contact : contacts.vertices) {
    const PlacedSurface& with_cell = contact.vertex_of_a ? b : a;
    const Vector3 normal = with_cell.normal(contact.cell);
    const Vector3 apart =
        (contact.vertex_of_a ? a : b).point(contact.point) - with_cell.corners(contact.cell)[0];
    add(blocks, contact.vertex_of_a ? normal : Vector3(-normal), rounding - normal.dot(apart));
  }
}

double WaysOut::sunk(int block, int but, const Vector3& direction) const {
  double highest = 0.0;
  if (const auto known = ways_.find(block); known != ways_.end()) {
    for (const OutOf& way : known->second) {
      if (way.other != but && std::abs(way.direction.dot(direction)) > faces_across)
        highest = std::max(highest, way.height);
    }
  }
  return highest;
}

std::vector<WayOut> WaysOut::of_pair(int a, int b) const {
  std::vector<WayOut> ways;
  const auto add = [&](int block, int side, double sign) {
    const auto known = ways_.find(block);
    if (known == ways_.end()) return;
    for (const OutOf& way : known->second) {
      const bool own = way.other == side;
      const double supports =
          own ? 0.0 : sunk(way.other, block, way.direction) + sunk(side, block, way.direction);
      ways.push_back({sign * way.direction,
                      way.height + supports,
                      own ? steep_sides : faces_across,
                      {std::min(block, way.other), std::max(block, way.other)},
                      own,
                      sign > 0.0});
    }
  };
  add(a, b, 1.0);
  add(b, a, -1.0);
  return ways;
}

bool WaysOut::stands(const WayOut& way, const std::vector<FoundContacts>& found,
                     const std::function<const PlacedSurface&(int)>& placed) const {
  const auto pair = std::lower_bound(found.begin(), found.end(), way.out_of,
                                     [](const FoundContacts& contacts, const std::array<int, 2>& blocks) {
                                       return contacts.blocks < blocks;
                                     });
  if (pair == found.end() || pair->blocks != way.out_of) return false;
  const PlacedSurface& a = placed(pair->blocks[0]);
  const PlacedSurface& b = placed(pair->blocks[1]);
  const std::vector<WayOut> others = of_pair(pair->blocks[0], pair->blocks[1]);
  const Vector3& direction = way.direction;
  return any_of(pair->contacts, [&](const auto& contact) {
    return largest_cosine(direction, touching(a, b, contact).normals) > faces_across &&
           std::none_of(others.begin(), others.end(),
                        [&](const WayOut& other) { return undoes(other, a, b, contact); });
  });
}

void leave_out_seams(const PlacedSurface& a, const PlacedSurface& b, const std::vector<WayOut>& ways,
                     const std::function<bool(const WayOut&)>& stands, PairContacts& contacts) {
  for (const WayOut& way : ways) {
    const auto undone = [&](const auto& contact) { return undoes(way, a, b, contact); };
    // Asked before any is removed: the contacts may be among those that are looked at.
    if (!any_of(contacts, undone) || !stands(way)) continue;
    std::erase_if(contacts.overlaps, undone);
    std::erase_if(contacts.vertices, undone);
    std::erase_if(contacts.edges, undone);
  }
}

bool at_seam(const PlacedSurface& a, const PlacedSurface& b, const std::vector<WayOut>& ways,
             const std::function<bool(const WayOut&)>& stands, const Touch& touch) {
  return std::any_of(ways.begin(), ways.end(), [&](const WayOut& way) {
    return std::visit([&](const auto& contact) { return undoes(way, a, b, contact); }, touch.contact) &&
           stands(way);
  });
}

}  // namespace ashlar
