// [analysis]: what is asked of a scene (scene.hpp), and the times, integrator and gravity of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/scene/scene_record.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// Times of a static analysis of constant loads that does not give them, s; each gives way to the other one
/// where that is given.
inline constexpr double default_static_end_time = 1.0;
inline constexpr double default_static_time_step = 1e-3;

/// [analysis]
struct SceneAnalysis {
  enum class Type {
    dynamic,   ///< "dynamic": motion in time
    statics,   ///< "static": equilibrium
    safety,    ///< "factor-of-safety": static analyses with less and less strength
    capacity,  ///< "capacity": static analyses with more and more load
    thrust,    ///< "thrust": least and most thrust on supports, and how far these can move
  };
  /// How a factor is found (notes/factor_of_safety.md).
  enum class Method {
    automatic,  ///< "auto": limit where no joint loses strength for good, elastic where one does
    limit,      ///< "limit": rigid blocks, by cone programmes
    elastic,    ///< "elastic": static analyses of the blocks as they are
  };
  enum class Integrator {
    dda,                   ///< "dda": Newmark beta 1/2, gamma 1
    average_acceleration,  ///< "average-acceleration": Newmark beta 1/4, gamma 1/2
    generalized_alpha,     ///< "generalized-alpha": spectral radius at infinity is spectral_radius
  };
  enum class Formulation { total, incremental };
  enum class InitialState {
    as_placed,    ///< "as-placed": undeformed
    equilibrium,  ///< "equilibrium": each supported block first settles under gravity, contacts off
    statics,      ///< "static": a static analysis of all blocks comes first, contacts on
  };
  enum class Solver { automatic, cholmod, cg };
  /// safety = { joints, tolerance, lower, upper }, capacity = { blocks, tolerance, lower, upper }
  struct FactorSearch {
    /// Names or globs: of cuts, and of blocks on either side, whose joints lose strength; of blocks whose
    /// loads grow.
    std::vector<std::string> of = {"*"};
    double tolerance = 0.01;  ///< > 0, at most 1: relative width of the bracket
    double lower = 0.1;       ///< > 0
    double upper = 10.0;      ///< > lower
  };
  /// movement = { supports, direction, limit, tolerance }
  struct SupportSearch {
    std::vector<std::string> supports;  ///< names or globs of blocks that do not move; empty: none is moved
    std::optional<Vector3> direction;   ///< of any length > 0; empty: away from the structure
    std::optional<double> limit;        ///< m, > 0; empty: half the structure's size
    std::optional<double> tolerance;    ///< m, > 0; empty: 1e-4 of the structure's size
  };
  struct Gravity {
    double time = 0.0;                ///< s
    Vector3 value = Vector3::Zero();  ///< m/s^2
  };

  Type type = Type::dynamic;
  /// s, > 0; required unless the analysis is static and nothing has a history: then a time like any other
  double end_time = 0.0;
  /// s, > 0, <= end_time; required like end_time. The largest step; static: between the loads that a history
  /// goes through, and how gently the first iteration starts
  double time_step = 0.0;
  Integrator integrator = Integrator::dda;
  double spectral_radius = 0.8;  ///< 0 to 1; only used by generalized-alpha
  Formulation formulation = Formulation::total;
  InitialState initial_state = InitialState::as_placed;
  Vector3 gravity = Vector3(0.0, 0.0, -9.81);  ///< m/s^2, unless it has a history
  std::vector<Gravity> gravity_history;        ///< times increase, linear between; empty: constant
  std::optional<SceneRecord> gravity_file;     ///< where it comes from, if not from the scene
  Solver solver = Solver::automatic;           ///< "auto"
  double mass_damping = 0.0;                   ///< 1/s, >= 0
  double stiffness_damping = 0.0;              ///< s, >= 0, Rayleigh's beta
  bool sleeping = true;                ///< whether islands that have come to rest are held until woken
  Method method = Method::automatic;   ///< of types safety and capacity
  FactorSearch safety;                 ///< of type safety
  FactorSearch capacity;               ///< of type capacity
  SupportSearch movement;              ///< of type thrust
  std::optional<double> memory_limit;  ///< bytes, > 0, that the estimate may reach; empty: auto
};

}  // namespace ashlar
