#include "solver/limit/rigid_model.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "geometry/index.hpp"
#include "geometry/union_find.hpp"
#include "mechanics/block/rigid_body.hpp"
#include "mechanics/block/rigid_motions.hpp"
#include "solver/limit/crushing_joints.hpp"
#include "solver/limit/pressure_friction.hpp"
#include "solver/limit/rigid_bolts.hpp"
#include "solver/limit/rigid_points.hpp"

namespace ashlar {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Share of a motion that supports hold, 0 to the number of supported blocks of a body: a motion with less is free.
/// Smaller values mistake rounding errors for supports, larger ones ignore supports nearly parallel to others.
constexpr double as_good_as_free = 1e-6;
/// Records of joints: the force of a point that transmits none, of the largest one, and its shear at the friction limit,
/// of that limit. The answer of a programme has about this accuracy.
constexpr double no_force = 1e-9, at_friction_limit = 1.0 - 1e-6;

Eigen::Matrix3d cross_matrix(const Vector3& d) {
  Eigen::Matrix3d m;
  m << 0.0, -d.z(), d.y(), d.z(), 0.0, -d.x(), -d.y(), d.x(), 0.0;
  return m;
}

/// The velocity field of a block at its present position, for a rigid motion about a place.
/// @param k 0 to 2: translation along an axis, 3 to 5: rotation about one. @return (p, 3)
Eigen::MatrixX3d field(const BlockModel& block, const Eigen::MatrixX3d& position, const Vector3& about,
                       int k) {
  const Vector3 none = Vector3::Zero(), axis = Vector3::Unit(k % 3);
  return rigid_velocity(position, block.basis().volume(), about, k < 3 ? axis : none, k < 3 ? none : axis);
}

/// Centre of gravity, m.
Vector3 middle_of(const BlockModel& block, const Eigen::MatrixX3d& position) {
  const Eigen::VectorXd one = constant_function(position.rows(), block.basis().volume());
  return position.transpose() * one / one.squaredNorm();
}

/// Motions about a place that the supports of a block prevent, as a sum of projectors onto them; lengths relative to
/// a size.
Matrix6 held_by_supports(const BlockModel& block, const Vector3& about, double size) {
  const std::vector<RigidMotion> motions = admissible_rigid_motions(block);
  Eigen::MatrixXd left(6, static_cast<Eigen::Index>(motions.size()));
  for (std::size_t k = 0; k < motions.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    left.col(column).head<3>() =
        motions[k].translation + motions[k].rotation.cross(about - block.basis().centroid());
    left.col(column).tail<3>() = size * motions[k].rotation;
  }
  if (motions.empty()) return Matrix6::Identity();
  const Eigen::MatrixXd q = left.colPivHouseholderQr().householderQ() *
                            Eigen::MatrixXd::Identity(6, static_cast<Eigen::Index>(motions.size()));
  return Matrix6::Identity() - q * q.transpose();
}

/// Rigid motions allowed by all supports of a body, as columns.
Eigen::MatrixXd motions_left(const BlockSystem& system, const RigidBody& body) {
  double size = 0.0;
  for (const int k : body.blocks) size = std::max(size, system.blocks()[at(k)].size());
  Matrix6 held = Matrix6::Zero();
  for (const int k : body.blocks) {
    const BlockModel& block = system.blocks()[at(k)];
    if (block.fixed()) return Eigen::MatrixXd(6, 0);
    if (block.supported()) held += held_by_supports(block, body.middle, size);
  }
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(held);
  const auto count = static_cast<Eigen::Index>((solver.eigenvalues().array() < as_good_as_free).count());
  Eigen::MatrixXd left = solver.eigenvectors().leftCols(count);
  left.bottomRows<3>() /= size;
  return left;
}

/// Blocks and centroids of all bodies that may move. Marks fixed blocks.
std::vector<RigidBody> bodies_of(const BlockSystem& system, const RunState& state,
                                 std::vector<int>& body_of) {
  UnionFind tied(system.blocks().size());
  for (const TiedBlocks& tie : system.ties()) tied.unite(tie.a, tie.b);
  std::map<int, RigidBody> by_root;
  for (int k = 0; k < system.count(); ++k) {
    if (!system.present(k)) continue;
    if (system.blocks()[at(k)].incremental() != nullptr)
      throw std::invalid_argument("incremental blocks have no limit analysis");
    by_root[tied.find(k)].blocks.push_back(k);
  }
  std::vector<RigidBody> bodies;
  for (auto& [root, body] : by_root) {
    for (const int k : body.blocks) {
      const BlockModel& block = system.blocks()[at(k)];
      if (block.fixed()) continue;
      const double mass = block.mass();
      body.mass += mass;
      body.middle += mass * middle_of(block, state.states[at(k)].position);
    }
    if (!(body.mass > 0.0)) continue;
    body.middle /= body.mass;
    const Eigen::MatrixXd left = motions_left(system, body);
    if (left.cols() == 0) continue;
    body.freedom = static_cast<int>(left.cols());
    body.motion.leftCols(left.cols()) = left;
    for (const int k : body.blocks) body_of[at(k)] = static_cast<int>(bodies.size());
    bodies.push_back(std::move(body));
  }
  return bodies;
}

/// Makes the mass matrix of a body's coordinates the unit mass times the unit matrix.
void normalize(const BlockSystem& system, const RunState& state, double unit, RigidBody& body) {
  Matrix6 mass = Matrix6::Zero();
  for (const int k : body.blocks) {
    const BlockModel& block = system.blocks()[at(k)];
    std::array<Eigen::MatrixX3d, 6> fields;
    for (int i = 0; i < 6; ++i) fields[at(i)] = field(block, state.states[at(k)].position, body.middle, i);
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j)
        mass(i, j) += block.material().density * fields[at(i)].cwiseProduct(fields[at(j)]).sum();
  }
  const Eigen::MatrixXd motion = body.motion.leftCols(body.freedom);
  const Eigen::MatrixXd own = motion.transpose() * mass * motion / unit;
  const Eigen::LLT<Eigen::MatrixXd> factor(own);
  body.motion.leftCols(body.freedom) = factor.matrixL().solve(motion.transpose()).transpose();
}

/// Loads on a body's coordinates, N. @param forces (p, 3) of a block
template <class Forces>
BodyVelocity load_on(const BlockSystem& system, const RunState& state, const RigidBody& body,
                     const Forces& forces) {
  BodyVelocity wrench = BodyVelocity::Zero();
  for (const int k : body.blocks) {
    const Eigen::MatrixX3d force = forces(k);
    if (force.size() == 0) continue;
    const BlockModel& block = system.blocks()[at(k)];
    for (int i = 0; i < 6; ++i)
      wrench[i] += field(block, state.states[at(k)].position, body.middle, i).cwiseProduct(force).sum();
  }
  return body.motion.transpose() * wrench;
}

ConeRows rows_of(const RigidBody& body, const RigidPoint& point, FrictionAt friction) {
  Eigen::Matrix<double, 3, 6> field;
  field << Eigen::Matrix3d::Identity(), -cross_matrix(point.place - body.middle);
  Eigen::Matrix<double, 3, 6> rows = point.frame * field;
  if (friction == FrictionAt::corners) return rows * body.motion;
  field.rightCols<3>() = -cross_matrix(point.friction_place - body.middle);
  rows.bottomRows<2>() = point.frame.bottomRows<2>() * field;
  return rows * body.motion;
}

}  // namespace

void set_points(RigidModel& model, std::vector<RigidPoint> points) {
  // Points of the same two bodies are consecutive.
  model.pairs.clear();
  const auto key = [](const RigidPoint& point) {
    const auto [a, b] = std::minmax(point.bodies[0], point.bodies[1]);
    return std::pair(a, b);
  };
  std::stable_sort(points.begin(), points.end(),
                   [&](const RigidPoint& x, const RigidPoint& y) { return key(x) < key(y); });
  for (std::size_t k = 0; k < points.size(); ++k) {
    RigidPoint& point = points[k];
    if (k > 0 && key(point) == key(points[k - 1])) {
      // Two tied blocks may be on different sides of a third one in the order of numbers.
      if (point.bodies != model.pairs.back().bodies) {
        std::swap(point.blocks[0], point.blocks[1]);
        std::swap(point.bodies[0], point.bodies[1]);
        point.frame = -point.frame;
        point.frame.row(2) *= -1.0;
      }
      model.pairs.back().end = k + 1;
    } else {
      model.pairs.push_back({point.bodies, k, k + 1});
    }
  }
  model.points = std::move(points);
}

namespace {

/// A model with the friction of its joints' laws.
RigidModel plain_model(const BlockSystem& system, const RunState& state, double end_time,
                       const std::vector<bool>& multiplied, RigidPointKind kind) {
  RigidModel model;
  model.body_of.assign(at(system.count()), -1);
  model.bodies = bodies_of(system, state, model.body_of);
  double mass = 0.0;
  for (const RigidBody& body : model.bodies) mass += body.mass;
  if (!model.bodies.empty()) model.units.mass = mass / static_cast<double>(model.bodies.size());
  std::vector<RigidPoint> points = rigid_points(system, state, model.body_of, kind, model.areas);
  for (auto* some : {&points, &model.areas})
    for (RigidPoint& point : *some)
      point.bodies = {model.body_of[at(point.blocks[0])], model.body_of[at(point.blocks[1])]};
  add_bars(system, state, model, points);
  set_points(model, std::move(points));
  if (kind == RigidPointKind::limit)
    divide_joints(model, [](const RigidPoint& point) { return crushes(point); });
  const Vector3 gravity = system.settings().gravity_at(end_time);
  double largest = 0.0;
  for (RigidBody& body : model.bodies) {
    if (body.blocks.empty()) {
      model.steady.push_back(BodyVelocity::Zero());
      model.multiplied.push_back(BodyVelocity::Zero());
      continue;
    }
    normalize(system, state, model.units.mass, body);
    const auto grows = [&](int k) { return !multiplied.empty() && multiplied[at(k)]; };
    const BodyVelocity all = load_on(system, state, body, [&](int k) {
      return system.blocks()[at(k)].fixed() ? Eigen::MatrixX3d()
                                            : system.blocks()[at(k)].external_force(gravity, end_time);
    });
    const BodyVelocity part = load_on(system, state, body, [&](int k) {
      return grows(k) && !system.blocks()[at(k)].fixed() ? system.blocks()[at(k)].load_force(end_time)
                                                         : Eigen::MatrixX3d();
    });
    model.steady.push_back(all - part);
    model.multiplied.push_back(part);
    largest = std::max({largest, (all - part).norm(), part.norm()});
  }
  if (largest > 0.0) model.units.acceleration = largest / model.units.mass;
  for (auto* loads : {&model.steady, &model.multiplied})
    for (BodyVelocity& load : *loads) load /= model.units.force();
  return model;
}

}  // namespace

RigidModel rigid_model(const BlockSystem& system, const RunState& state, double end_time,
                       const std::vector<bool>& multiplied, RigidPointKind kind) {
  RigidModel model = plain_model(system, state, end_time, multiplied, kind);
  if (!has_pressure_friction(model)) return model;
  if (kind == RigidPointKind::limit)
    set_pressure_friction(model, LimitFactors{});
  else
    set_pressure_friction(model, pressure_friction(rigid_model(system, state, end_time, multiplied)));
  return model;
}

std::vector<bool> reduced_points(const RigidModel& model, const std::function<bool(int, int)>& reduced) {
  std::vector<bool> points;
  points.reserve(model.points.size());
  for (const RigidPoint& point : model.points)
    points.push_back(!point.bar && reduced(point.blocks[0], point.blocks[1]));
  return points;
}

ConeStrength strength_of(const RigidModel& model, const RigidPoint& point, double factor, JointUse use) {
  if (point.bar) {
    const double unit = model.units.force();
    return {0.0, point.bar->shear / unit, point.bar->tension / unit, point.bar->compression / unit};
  }
  double friction = point.law.friction / factor;
  if (use == JointUse::pulled && point.law.tensile_strength > 0.0)
    friction = std::min(friction, point.law.cohesion / point.law.tensile_strength);
  if (point.area == 0.0) return {friction, 0.0, 0.0};
  const double cohesion = point.law.cohesion * point.area / factor / model.units.force();
  const double tension = point.law.tensile_strength * point.area / factor / model.units.force();
  const double compression = point.law.compressive_strength * point.area / factor / model.units.force();
  if (point.spring.normal > 0.0) {
    ConeStrength strength{friction, cohesion, tension, compression};
    strength.keeps_cohesion = true;
    return strength;
  }
  if (use == JointUse::either)
    return {friction, std::max(cohesion, friction * tension), tension, compression};
  const bool has_tip = use == JointUse::pressed && friction > 0.0;
  return {friction, cohesion, has_tip ? std::min(tension, cohesion / friction) : tension, compression};
}

std::vector<ConePoint> cone_points(const RigidModel& model, FrictionAt friction) {
  std::vector<ConePoint> points;
  for (const ConePair& pair : model.pairs) {
    for (std::size_t k = pair.begin; k < pair.end; ++k) {
      ConePoint point;
      const auto rows = [&](int body) { return rows_of(model.bodies[at(body)], model.points[k], friction); };
      if (pair.bodies[0] >= 0) point.first = rows(pair.bodies[0]);
      if (pair.bodies[1] >= 0) point.second = rows(pair.bodies[1]);
      point.strength = strength_of(model, model.points[k], 1.0);
      points.push_back(point);
    }
  }
  return points;
}

ConeProgram program_of(const RigidModel& model, int threads, FrictionAt friction) {
  std::vector<int> freedom;
  for (const RigidBody& body : model.bodies) freedom.push_back(body.freedom);
  ConeProgram program(std::move(freedom), model.pairs, cone_points(model, friction), threads);
  program.set_loaded_bodies(loaded_bodies(model));
  return program;
}

std::size_t loaded_bodies(const RigidModel& model) {
  return static_cast<std::size_t>(std::count_if(model.bodies.begin(), model.bodies.end(),
                                                [](const RigidBody& body) { return !body.blocks.empty(); }));
}

std::vector<Eigen::Vector3d> in_newtons(const RigidModel& model, std::vector<Eigen::Vector3d> force) {
  for (Eigen::Vector3d& f : force) f *= model.units.force();
  return force;
}

std::vector<PairRecord> contact_records(const RigidModel& model, const std::vector<Eigen::Vector3d>& force,
                                        const std::vector<bool>& divided, double factor) {
  double largest = 0.0;
  for (const Eigen::Vector3d& f : force) largest = std::max(largest, f.norm());
  std::map<PairKey, PairRecord> records;
  for (std::size_t k = 0; k < model.points.size(); ++k) {
    const RigidPoint& point = model.points[k];
    if (point.bar) continue;
    const PairKey key{std::min(point.blocks[0], point.blocks[1]), std::max(point.blocks[0], point.blocks[1])};
    PairRecord& record = records.try_emplace(key, PairRecord{key[0], key[1], {}, {}, {}, 0.0}).first->second;
    const double sign = point.blocks[0] == key[0] ? 1.0 : -1.0;
    const Vector3 on_a = sign * (point.frame.transpose() * force[k]);
    PointResponse response{ContactState::open, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero(), 0.0, 0.0};
    response.force = in_frame(point.contact, on_a);
    const bool weaker = !divided.empty() && divided[k];
    const ConeStrength strength = strength_of(model, point, weaker ? factor : 1.0);
    const double shear = force[k].tail<2>().norm();
    const double limit =
        strength.friction * std::max(force[k][0], 0.0) + strength.cohesion * model.units.force();
    const bool slides = shear > no_force * largest && shear >= at_friction_limit * limit;
    response.state = force[k].norm() <= no_force * largest ? ContactState::open
                     : slides                              ? ContactState::sliding
                                                           : ContactState::locked;
    if (response.state == ContactState::open) response.force.setZero();
    record.points.push_back(point.contact);
    record.responses.push_back(response);
    record.gaps.push_back(std::max(point.contact.gap, 0.0));
  }
  std::vector<PairRecord> result;
  result.reserve(records.size());
  for (auto& [key, record] : records) result.push_back(std::move(record));
  return result;
}

bool multiplies_loads(const RigidModel& model) {
  return std::any_of(model.multiplied.begin(), model.multiplied.end(),
                     [](const BodyVelocity& load) { return load.squaredNorm() > 0.0; });
}

bool loses_strength(const RigidModel& model) {
  return std::any_of(model.points.begin(), model.points.end(), [](const RigidPoint& point) {
    return !point.bar && point_law(point.law, 1.0, true).weakens();
  });
}

void keep_residual_strength(RigidModel& model) {
  if (!loses_strength(model)) return;
  model.has_residual_strength = true;
  for (RigidPoint& area : model.areas) area.law = failed_law(area.law);
  std::vector<RigidPoint> points;
  std::vector<ConePair> pairs;
  for (ConePair pair : model.pairs) {
    const std::size_t begin = points.size();
    for (std::size_t k = pair.begin; k < pair.end; ++k) {
      RigidPoint& point = model.points[k];
      if (!point.bar) point.law = failed_law(point.law);
      const JointLaw& law = point.law;
      // Parts of overlaps transmit cohesion and tension alone, but those that stand in place of corners.
      const bool part = !point.bar && !point.part && point.area > 0.0 && point.spring.normal == 0.0;
      if (!part || law.cohesion > 0.0 || law.tensile_strength > 0.0) points.push_back(std::move(point));
    }
    if (points.size() > begin) pairs.push_back({pair.bodies, begin, points.size()});
  }
  model.points = std::move(points);
  model.pairs = std::move(pairs);
}

RigidMotionOf motion_of(const RigidBody& body, const BodyVelocity& coordinates) {
  const BodyVelocity motion = body.motion * coordinates;
  return {motion.head<3>(), motion.tail<3>()};
}

}  // namespace ashlar
