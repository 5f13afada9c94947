#include "solver/contact/internal_edges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "geometry/index.hpp"
#include "mechanics/contact/overlap_outline.hpp"

namespace ashlar {
namespace {

/// Cosines of 10 and 60 degrees.
constexpr double faces_across = 0.985;
constexpr double steep_sides = 0.5;
constexpr double sides_along = 0.17;  // cosine of 80 degrees
/// Cosine of a third of a degree: directions that differ by less count as one.
constexpr double one_way = 0.99998;
/// Cosine of 9.5 degrees: normals this close to the first direction of a bundle satisfy faces_across for all of them.
constexpr double bundle_across = 0.9863;

/// Largest cosine between a unit direction and any of some normals' lines.
double largest_cosine(const Vector3& direction, const std::vector<Vector3>& normals) {
  double largest = 0.0;
  for (const Vector3& normal : normals) largest = std::max(largest, std::abs(normal.dot(direction)));
  return largest;
}

/// Touching features of a and of b.
struct Touching {
  std::vector<int> of_a;  ///< points
  std::vector<int> of_b;
  std::vector<Vector3> normals;  ///< of the touching cells, or for crossed edges their common normal
};

const std::vector<int>& corners(const PlacedSurface& s, int cell) {
  return s.surface().cells[static_cast<std::size_t>(cell)].corners;
}

Touching touching(const PlacedSurface& a, const PlacedSurface& b, const CellOverlap& overlap) {
  return {corners(a, overlap.cell_a),
          corners(b, overlap.cell_b),
          {a.normal(overlap.cell_a), b.normal(overlap.cell_b)}};
}

Touching touching(const PlacedSurface& a, const PlacedSurface& b, const VertexContact& contact) {
  const std::vector<int> vertex = {contact.point};
  if (contact.vertex_of_a) return {vertex, corners(b, contact.cell), {b.normal(contact.cell)}};
  return {corners(a, contact.cell), vertex, {a.normal(contact.cell)}};
}

Touching touching(const PlacedSurface& /*a*/, const PlacedSurface& /*b*/, const EdgeContact& contact) {
  const auto ends = [](const CrossedSide& side) {
    return std::vector<int>(side.ends.begin(), side.ends.end());
  };
  return {ends(contact.of_a), ends(contact.of_b), {contact.normal}};
}

/// The last of some points along a direction.
struct Farthest {
  double at = -std::numeric_limits<double>::infinity();
  int point = -1;
};

Farthest farthest(const PlacedSurface& s, const std::vector<int>& points, const Vector3& direction) {
  Farthest result;
  for (const int point : points) {
    const double at = s.point(point).dot(direction);
    if (at > result.at) result = {at, point};
  }
  return result;
}

/// True if a corner, or a point of an edge, bounds a cell that faces a direction.
bool ends_there(const PlacedSurface& s, int point, const Vector3& direction) {
  const int vertex = s.surface().vertex_of_point[static_cast<std::size_t>(point)];
  if (vertex < 0) return true;
  const std::vector<int>& cells = s.surface().vertices[static_cast<std::size_t>(vertex)].cells;
  return std::any_of(cells.begin(), cells.end(),
                     [&](int cell) { return s.normal(cell).dot(direction) > sides_along; });
}

/// True if all touching features of b are below those of a after the retraction of a, and the blocks end there.
template <class Contact>
bool undoes(const Retraction& retraction, const PlacedSurface& a, const PlacedSurface& b,
            const Contact& contact) {
  const Vector3& direction = retraction.direction;
  const Touching found = touching(a, b, contact);
  if (largest_cosine(direction, found.normals) > (retraction.own ? steep_sides : faces_across)) return false;
  const Farthest bottom = farthest(a, found.of_a, -direction);
  const Farthest top = farthest(b, found.of_b, direction);
  return bottom.at + top.at <= retraction.height &&
         (retraction.own || (ends_there(a, bottom.point, -direction) && ends_there(b, top.point, direction)));
}

/// True if a condition holds for any contact of a pair.
template <class Condition>
bool any_of(const PairContacts& contacts, const Condition& holds) {
  const auto any = [&](const auto& some) { return std::any_of(some.begin(), some.end(), holds); };
  return any(contacts.overlaps) || any(contacts.vertices) || any(contacts.edges);
}

}  // namespace

ContactNormals normals_of(const PlacedSurface& a, const PlacedSurface& b, const PairContacts& contacts) {
  ContactNormals normals;
  const auto add = [&](const auto& some) {
    for (const auto& contact : some) normals.push_back(touching(a, b, contact).normals);
  };
  add(contacts.overlaps);
  add(contacts.vertices);
  add(contacts.edges);
  return normals;
}

ContactNormals normals_of(const PlacedSurface& a, const PlacedSurface& b, const Touch& touch) {
  return {std::visit([&](const auto& contact) { return touching(a, b, contact).normals; }, touch.contact)};
}

Retractions::Retractions(const PairHistories& histories, const std::vector<bool>& moving) {
  for (const auto& [blocks, pair] : histories) {
    if (!moving[at(blocks[0])] && !moving[at(blocks[1])]) continue;
    if (!(pair.memory.deepest() > 0.0)) continue;
    for (const ContactMemory::Entry& entry : pair.memory.entries())
      if (entry.memory.state != ContactState::open)
        add(blocks, entry.normal, pair.overlap + pair.memory.deepest());
  }
}

void Retractions::add(const PairKey& blocks, const Vector3& normal, double depth) {
  const double height = depth > 0.0 ? 2.0 * depth : depth;
  const auto add_to = [&](int block, int other, const Vector3& direction) {
    std::vector<Bundle>& bundles = bundles_[block];
    auto bundle = std::find_if(bundles.begin(), bundles.end(), [&](const Bundle& known) {
      return known.direction.dot(direction) >= one_way;
    });
    if (bundle == bundles.end()) bundle = bundles.insert(bundles.end(), Bundle{direction, {}, {}});
    std::vector<OutOf>& known = bundle->out_of[other];
    if (std::any_of(known.begin(), known.end(),
                    [&](const OutOf& retraction) { return retraction.height >= height; }))
      return;
    known.push_back({direction, height, count_++});
    auto& [first, second] = bundle->highest;
    if (height > first.height && other != first.other) second = std::exchange(first, {other, height});
    if (height > first.height) first.height = height;
    if (other != first.other && height > second.height) second = {other, height};
  };
  add_to(blocks[0], blocks[1], normal);
  add_to(blocks[1], blocks[0], -normal);
}

void Retractions::add_touching(const PairKey& blocks, const PlacedSurface& a, const PlacedSurface& b,
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

double Retractions::sunk(int block, int but, const Vector3& direction,
                         const BlockCompression& compression_of) const {
  double highest = 0.0;
  if (const auto known = bundles_.find(block); known != bundles_.end()) {
    for (const Bundle& bundle : known->second) {
      if (!(std::abs(bundle.direction.dot(direction)) > faces_across)) continue;
      const Highest& high = bundle.highest[bundle.highest[0].other == but ? 1 : 0];
      highest = std::max(highest, high.height);
    }
  }
  return compression_of ? highest + 2.0 * compression_of(block, direction) : highest;
}

std::vector<Retraction> Retractions::of_pair(int a, int b, const ContactNormals& normals,
                                             const BlockCompression& compression_of) const {
  std::vector<std::pair<std::size_t, Retraction>> numbered;
  const auto across_all = [&](const Vector3& direction) {
    return std::all_of(normals.begin(), normals.end(), [&](const std::vector<Vector3>& of_contact) {
      return largest_cosine(direction, of_contact) > bundle_across;
    });
  };
  const auto add = [&](int block, int side, double sign) {
    const auto known = bundles_.find(block);
    if (known == bundles_.end()) return;
    for (const Bundle& bundle : known->second) {
      if (across_all(bundle.direction)) continue;
      for (const auto& [other, retractions] : bundle.out_of) {
        const bool own = other == side;
        for (const OutOf& retraction : retractions) {
          const double supports = own ? 0.0
                                      : sunk(other, block, retraction.direction, compression_of) +
                                            sunk(side, block, retraction.direction, compression_of);
          numbered.emplace_back(retraction.number,
                                Retraction{sign * retraction.direction,
                                           retraction.height + supports,
                                           {std::min(block, other), std::max(block, other)},
                                           own});
        }
      }
    }
    std::sort(numbered.begin(), numbered.end(),
              [](const auto& x, const auto& y) { return x.first < y.first; });
  };
  std::vector<Retraction> retractions;
  for (const auto& [block, side, sign] : {std::tuple{a, b, 1.0}, std::tuple{b, a, -1.0}}) {
    numbered.clear();
    add(block, side, sign);
    for (const auto& [number, retraction] : numbered) retractions.push_back(retraction);
  }
  return retractions;
}

bool Retractions::stands(const Retraction& retraction, const std::vector<FoundContacts>& found,
                         const std::function<const PlacedSurface&(int)>& placed,
                         const BlockCompression& compression_of) const {
  const auto pair = std::lower_bound(
      found.begin(), found.end(), retraction.out_of,
      [](const FoundContacts& contacts, const PairKey& blocks) { return contacts.blocks < blocks; });
  if (pair == found.end() || pair->blocks != retraction.out_of) return false;
  const PlacedSurface& a = placed(pair->blocks[0]);
  const PlacedSurface& b = placed(pair->blocks[1]);
  const std::vector<Retraction> others =
      of_pair(pair->blocks[0], pair->blocks[1], normals_of(a, b, pair->contacts), compression_of);
  const Vector3& direction = retraction.direction;
  return any_of(pair->contacts, [&](const auto& contact) {
    return largest_cosine(direction, touching(a, b, contact).normals) > faces_across &&
           std::none_of(others.begin(), others.end(),
                        [&](const Retraction& other) { return undoes(other, a, b, contact); });
  });
}

void remove_internal_edges(const PlacedSurface& a, const PlacedSurface& b,
                           const std::vector<Retraction>& retractions,
                           const std::function<bool(const Retraction&)>& stands, PairContacts& contacts) {
  for (const Retraction& retraction : retractions) {
    const auto undone = [&](const auto& contact) { return undoes(retraction, a, b, contact); };
    // Evaluated before any is removed: `stands` may refer to the same contacts.
    if (!any_of(contacts, undone) || !stands(retraction)) continue;
    std::erase_if(contacts.overlaps, undone);
    std::erase_if(contacts.vertices, undone);
    std::erase_if(contacts.edges, undone);
  }
}

bool at_internal_edge(const PlacedSurface& a, const PlacedSurface& b,
                      const std::vector<Retraction>& retractions,
                      const std::function<bool(const Retraction&)>& stands, const Touch& touch) {
  return std::any_of(retractions.begin(), retractions.end(), [&](const Retraction& retraction) {
    return std::visit([&](const auto& contact) { return undoes(retraction, a, b, contact); },
                      touch.contact) &&
           stands(retraction);
  });
}

}  // namespace ashlar
