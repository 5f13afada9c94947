#include "apps/program/blocks/block_report.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "apps/scene/check/initial_overlap.hpp"
#include "geometry/boxes/box_pairs.hpp"
#include "geometry/contacts/contact_report.hpp"
#include "geometry/exact/rounded_functions.hpp"

namespace ashlar {
namespace {

/// Faces whose normals differ by less are in contact.
constexpr double parallel_sine = 1e-6;

bool is_piece(const LoadedScene& loaded, std::size_t block) {
  return loaded.scene.rock && loaded.scene.rock->origin[block].piece >= 0;
}

/// Merges borders of one block and cut; the plane is that of the largest part.
std::vector<BlockBorder> merged(std::vector<BlockBorder> borders) {
  std::sort(borders.begin(), borders.end(), [](const BlockBorder& a, const BlockBorder& b) {
    return std::tuple(a.block, a.cut, a.plane, a.below) < std::tuple(b.block, b.cut, b.plane, b.below);
  });
  return borders;
}

}  // namespace

BlockReport::BlockReport(std::shared_ptr<const LoadedScene> loaded)
    : loaded_(std::move(loaded)), whole_(loaded_->solids.size()) {
  for (std::size_t k = 0; k < loaded_->solids.size(); ++k) {
    const Polyhedron& body = loaded_->solids[k];
    if (!is_piece(*loaded_, k)) whole_[k].emplace(body);
    BlockEntry& entry = blocks_.emplace_back();
    entry.volume = is_piece(*loaded_, k) ? solid(k).solid->volume(solid(k).piece) : body.volume();
    for (const PieceFace& face : solid(k).solid->faces(solid(k).piece))
      entry.surface += solid(k).solid->area(face);
  }
  add_borders_of_pieces();
  add_contacts();
  for (BlockEntry& entry : blocks_) entry.borders = merged(std::move(entry.borders));
}

BlockSolid BlockReport::solid(std::size_t block) const {
  if (whole_[block]) return {&*whole_[block], 0};
  const auto& [uncut, piece] = loaded_->scene.rock->origin[block];
  return {&*loaded_->scene.rock->solids[uncut], piece};
}

bool BlockReport::is_there(std::size_t block) const {
  return loaded_->scene.absent.empty() || !loaded_->scene.absent[block];
}

std::size_t BlockReport::neighbour(std::size_t block, const PieceFace& face) const {
  return block_of_.at({loaded_->scene.rock->origin[block].uncut, face.neighbour});
}

bool BlockReport::is_bare(std::size_t block, const PieceFace& face) const {
  return face.neighbour < 0 || !is_there(neighbour(block, face));
}

void BlockReport::add_borders_of_pieces() {
  if (!loaded_->scene.rock) return;
  const CutRock& rock = *loaded_->scene.rock;
  for (std::size_t k = 0; k < rock.origin.size(); ++k)
    block_of_[{rock.origin[k].uncut, rock.origin[k].piece}] = k;
  for (std::size_t k = 0; k < rock.origin.size(); ++k) {
    if (rock.origin[k].piece < 0 || !is_there(k)) continue;
    const auto [of, piece] = solid(k);
    for (const PieceFace& face : of->faces(piece)) {
      if (is_bare(k, face)) continue;
      std::optional<std::size_t> cut;
      if (face.mark >= 0) cut = rock.marks[static_cast<std::size_t>(face.mark)].cut;
      blocks_[k].borders.push_back({neighbour(k, face), of->area(face), cut, face.plane, face.below});
    }
  }
}

void BlockReport::add_contacts() {
  std::vector<Box> boxes;
  for (std::size_t k = 0; k < loaded_->solids.size(); ++k)
    boxes.push_back(
        box_of(loaded_->solids[k].mesh().points)
            .grown(allowed_initial_overlap * correctly_rounded::cbrt(loaded_->solids[k].volume())));
  for (const auto& [first, second] : meeting_boxes(boxes)) {
    const auto a = static_cast<std::size_t>(first), b = static_cast<std::size_t>(second);
    const bool same = is_piece(*loaded_, a) && is_piece(*loaded_, b) &&
                      loaded_->scene.rock->origin[a].uncut == loaded_->scene.rock->origin[b].uncut;
    if (!same && is_there(a) && is_there(b)) add_contact(a, b);
  }
}

void BlockReport::add_contact(std::size_t a, std::size_t b) {
  const Polyhedron &first = loaded_->solids[a], &second = loaded_->solids[b];
  const double distance =
      allowed_initial_overlap * correctly_rounded::cbrt(std::min(first.volume(), second.volume()));
  const ReportedSolid one(first), other(second);
  const bool convex = one.shape() != nullptr && other.shape() != nullptr;
  const ContactReport report = report_contact(one, other, Resolution{distance, convex ? parallel_sine : 0.0});
  if (convex && report.relation == Relation::apart && report.squared_distance > distance * distance) return;
  for (const ReportedContact& contact : report.contacts) {
    if (contact.type != ContactType::face_face || contact.area == 0.0) continue;
    Vector3 direction = report.convex ? report.convex->direction : contact.direction;  // from B to A
    if (contact.b.dimension == 2 && contact.b.index >= 0)
      direction = second.faces()[static_cast<std::size_t>(contact.b.index)].normal;
    add_border(a, b, -direction, contact.area);
    add_border(b, a, direction, contact.area);
  }
}

void BlockReport::add_border(std::size_t block, std::size_t other, const Vector3& normal, double area) {
  const auto [of, piece] = solid(block);
  const std::vector<PieceFace> faces = of->faces(piece);
  const auto along = [&normal, &cut = *of](const PieceFace& face) { return cut.normal(face).dot(normal); };
  const auto best = std::max_element(faces.begin(), faces.end(), [&](const PieceFace& f, const PieceFace& g) {
    return along(f) < along(g);
  });
  blocks_[block].borders.push_back({other, area, std::nullopt, best->plane, best->below});
}

double BlockReport::volume() const {
  // Neumaier's sum: rounding errors of additions are added at the end.
  double sum = 0.0, lost = 0.0;
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    if (!is_there(k)) continue;
    const double volume = blocks_[k].volume, next = sum + volume;
    lost += std::abs(sum) >= volume ? (sum - next) + volume : (volume - next) + sum;
    sum = next;
  }
  return sum + lost;
}

std::vector<double> BlockReport::areas_by_cut() const {
  std::vector<double> areas(loaded_->scene.cut.size(), 0.0);
  for (std::size_t k = 0; k < blocks_.size(); ++k)
    for (const BlockBorder& border : blocks_[k].borders)
      if (border.cut && border.block > k) areas[*border.cut] += border.area;
  return areas;
}

}  // namespace ashlar
