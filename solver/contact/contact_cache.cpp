#include "solver/contact/contact_cache.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// The first function of a basis is constant: 1 over the root of the volume.
double constant_function(const BlockModel& model) {
  return 1.0 / std::sqrt(model.basis().volume());
}

Eigen::MatrixX3d change_since(const Eigen::MatrixX3d& found, const ContactBody& body) {
  if (body.model->fixed()) return Eigen::MatrixX3d::Zero(found.rows(), 3);
  return body.state->position - found;
}

/// Displacement of a material point, m. @param change (p, 3)
Vector3 displacement(const ContactBody& body, const Vector3& material, const Eigen::MatrixX3d& change) {
  if (body.model->fixed()) return Vector3::Zero();
  return change.transpose() * body.model->basis().values(material);
}

/// True if pressure ends in each overlap where it did. @param points of the pair, at the present state
bool rules_last(const ContactCache& cache, const ContactBody& a, const ContactBody& b,
                const RelativeMotion& motion, const std::vector<ContactPoint>& points) {
  for (const RuledOverlap& overlap : cache.found.overlaps) {
    std::vector<double> gaps;
    gaps.reserve(overlap.count);
    if (!overlap.end) {
      for (std::size_t k = 0; k < overlap.count; ++k) gaps.push_back(points[overlap.first + k].gap);
    } else {
      for (const ContactPoint& point : overlap.whole)
        gaps.push_back(point.gap + point.normal.dot(displacement(a, point.material_a, motion.changes[0]) -
                                                    displacement(b, point.material_b, motion.changes[1])));
    }
    if (!rule_lasts(overlap, gaps, cache.law.rounding, cache.law.normal_spring())) return false;
  }
  return true;
}

}  // namespace

RelativeMotion motion_since(const ContactCache& cache, const ContactBody& a, const ContactBody& b) {
  RelativeMotion motion{{change_since(cache.positions[0], a), change_since(cache.positions[1], b)}};
  if (a.model->fixed() || b.model->fixed()) return motion;
  motion.shift = 0.5 * (constant_function(*a.model) * motion.changes[0].row(0).transpose() +
                        constant_function(*b.model) * motion.changes[1].row(0).transpose());
  return motion;
}

std::optional<KeptContacts> kept_contacts(
    const std::shared_ptr<const ContactCache>& cache, const ContactBody& a, const ContactBody& b,
    const JointLaw& law, const LastingLimits& limits,
    const std::array<std::function<double(const Eigen::MatrixX3d&)>, 2>& bounds) {
  const RelativeMotion motion = motion_since(*cache, a, b);
  double moved = 0.0;
  for (std::size_t k = 0; k < 2; ++k) {
    Eigen::MatrixX3d change = motion.changes[k];
    change.row(0) -= motion.shift.transpose() / constant_function(*(k == 0 ? a : b).model);
    moved += bounds[k](change);
  }
  JointLaw known = law;
  known.rounding = cache->law.rounding;
  if (!(moved <= limits.motion) || !(limits.reach + moved - cache->reach <= limits.motion) ||
      !(known == cache->law))
    return std::nullopt;
  KeptContacts kept{cache, motion.shift, cache->found.points};
  if (kept.points.empty()) return kept;
  const Eigen::Matrix3Xd of_a = cache->rows->a.displacements(motion.changes[0]);
  const Eigen::Matrix3Xd of_b = cache->rows->b.displacements(motion.changes[1]);
  for (std::size_t k = 0; k < kept.points.size(); ++k) {
    ContactPoint& point = kept.points[k];
    const auto column = static_cast<Eigen::Index>(k);
    Vector3 apart = Vector3::Zero();
    if (of_a.cols() > 0) {
      point.place_a += of_a.col(column);
      apart += of_a.col(column);
    }
    if (of_b.cols() > 0) {
      point.place_b += of_b.col(column);
      apart -= of_b.col(column);
    }
    point.gap += point.normal.dot(apart);
  }
  if (!rules_last(*cache, a, b, motion, kept.points)) return std::nullopt;
  return kept;
}

namespace {

/// True if all cells and points of contacts exist in two surfaces.
bool fits(const PairContacts& contacts, const SubFaceSurface& a, const SubFaceSurface& b) {
  const auto within = [](int index, std::size_t count) { return index >= 0 && at(index) < count; };
  const auto is_side = [&](const CrossedSide& side, const SubFaceSurface& surface) {
    return within(side.cell, surface.cells.size()) && within(side.ends[0], surface.points.size()) &&
           within(side.ends[1], surface.points.size());
  };
  return std::all_of(contacts.overlaps.begin(), contacts.overlaps.end(),
                     [&](const CellOverlap& overlap) {
                       return within(overlap.cell_a, a.cells.size()) &&
                              within(overlap.cell_b, b.cells.size());
                     }) &&
         std::all_of(contacts.vertices.begin(), contacts.vertices.end(),
                     [&](const VertexContact& contact) {
                       const SubFaceSurface& with_vertex = contact.vertex_of_a ? a : b;
                       const SubFaceSurface& with_cell = contact.vertex_of_a ? b : a;
                       return within(contact.point, with_vertex.points.size()) &&
                              within(contact.own_cell, with_vertex.cells.size()) &&
                              within(contact.cell, with_cell.cells.size());
                     }) &&
         std::all_of(contacts.edges.begin(), contacts.edges.end(), [&](const EdgeContact& contact) {
           return is_side(contact.of_a, a) && is_side(contact.of_b, b);
         });
}

bool fits(const std::vector<ContactPoint>& points, const BlockModel& a, const BlockModel& b) {
  return std::all_of(points.begin(), points.end(), [&](const ContactPoint& point) {
    return point.face_a >= 0 && at(point.face_a) < a.solid().faces().size() && point.face_b >= 0 &&
           at(point.face_b) < b.solid().faces().size() && point.normal.allFinite() &&
           std::isfinite(point.gap);
  });
}

/// True if the overlaps match a pair's points.
bool fits(const ContactPoints& found) {
  return std::all_of(found.overlaps.begin(), found.overlaps.end(), [&](const RuledOverlap& overlap) {
    const bool is_rule = overlap.degree >= 0 && overlap.degree <= 2 * PolynomialBasis::max_order &&
                         overlap.outline.size() >= 3;
    return is_rule && (overlap.end ? overlap.whole.size() == overlap.count
                                   : overlap.first <= found.points.size() &&
                                         overlap.count <= found.points.size() - overlap.first);
  });
}

}  // namespace

std::shared_ptr<const ContactCache> with_rows(const ContactCache& cache, const BlockModel& a,
                                              const BlockModel& b, const BlockSurface& surface_a,
                                              const BlockSurface& surface_b) {
  const bool sizes_fit =
      cache.positions[0].rows() == a.basis().size() && cache.positions[1].rows() == b.basis().size();
  // Curved surfaces are divided before their contacts are evaluated.
  const bool divided = surface_a.curves() || surface_b.curves();
  if (!sizes_fit || (!divided && !fits(cache.contacts, surface_a.surface(), surface_b.surface())) ||
      !fits(cache.found.points, a, b) || !fits(cache.found))
    throw std::invalid_argument("cached contacts belong to other blocks");
  ContactCache completed = cache;
  if (!completed.found.points.empty()) completed.rows = PairRows::values_of(a, b, completed.found.points);
  return std::make_shared<const ContactCache>(std::move(completed));
}

PairContacts shifted(PairContacts contacts, const Vector3& shift) {
  for (CellOverlap& overlap : contacts.overlaps) overlap.frame.origin += shift;
  return contacts;
}

}  // namespace ashlar
