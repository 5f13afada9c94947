// [analysis]: type of analysis of a scene (scene.hpp), its times, integrator and gravity.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/scene/model/scene_pushover.hpp"
#include "apps/scene/model/scene_record.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// Default times of a static analysis of constant loads, s. If only one of them is given, the other one is adapted to
/// it.
inline constexpr double default_static_end_time = 1.0;
inline constexpr double default_static_time_step = 1e-3;
/// Steps of a dynamic analysis from which accuracy starts.
inline constexpr int automatic_steps = 256;

/// [analysis]
struct SceneAnalysis {
  enum class Type {
    dynamic,   ///< "dynamic": motion in time
    statics,   ///< "static": equilibrium
    safety,    ///< "factor-of-safety": static analyses with reduced strength
    capacity,  ///< "capacity": static analyses with increased load
    thrust,    ///< "thrust": least and largest thrust on supports, and their range of movement
    pushover,  ///< "pushover": multiplier of horizontal forces along the mechanism
  };
  /// Method of a search for a factor (notes/factor_of_safety.md).
  enum class Method {
    automatic,  ///< "auto": limit unless a joint loses strength permanently, otherwise elastic
    limit,      ///< "limit": rigid blocks, by cone programmes
    elastic,    ///< "elastic": static analyses of the blocks as modelled
  };
  enum class Integrator {
    dda,                   ///< "dda": Newmark beta 1/2, gamma 1
    average_acceleration,  ///< "average-acceleration": Newmark beta 1/4, gamma 1/2
    generalized_alpha,     ///< "generalized-alpha": spectral radius at infinity is spectral_radius
  };
  enum class Formulation {
    total,        ///< "total": polynomials in the reference configuration
    incremental,  ///< "incremental", and "paper" (see `paper`): polynomials in the coordinates of each step's start
  };
  enum class InitialState {
    as_placed,    ///< "as-placed": undeformed
    equilibrium,  ///< "equilibrium": each supported block first settles under gravity, without contacts
    statics,      ///< "static": preceded by a static analysis of all blocks, with contacts
  };
  enum class Solver { automatic, cholmod, cg };
  /// safety = { joints, tolerance, lower, upper }, capacity = { blocks, tolerance, lower, upper }
  struct FactorSearch {
    /// Names or globs: of cuts, and of blocks on either side of joints with reduced strength; of blocks with
    /// increased loads.
    std::vector<std::string> of = {"*"};
    double tolerance = 0.01;  ///< > 0, at most 1: relative width of the bracket
    double lower = 0.1;       ///< > 0
    double upper = 10.0;      ///< > lower
  };
  /// movement = { supports, direction, limit, tolerance }
  struct SupportSearch {
    std::vector<std::string> supports;  ///< names or globs of fixed blocks; empty: none is moved
    std::optional<Vector3> direction;   ///< of any length > 0; empty: away from the structure
    std::optional<double> limit;        ///< m, > 0; empty: half the structure's size
    std::optional<double> tolerance;    ///< m, > 0; empty: 1e-4 of the structure's size
  };
  struct Gravity {
    double time = 0.0;                ///< s
    Vector3 value = Vector3::Zero();  ///< m/s^2
  };

  Type type = Type::dynamic;
  /// s, > 0; required unless the analysis is static without histories: then arbitrary
  double end_time = 0.0;
  /// s, > 0, <= end_time; required like end_time. The largest step; in statics the interval between load levels of a
  /// history, and the initial inertia of the first iteration
  double time_step = 0.0;
  bool automatic_step =
      false;  ///< dynamic, with accuracy: not given, or "auto"; time_step is that of the pilot
  /// 0 to 1: orders, sub-faces and the step that are not given are chosen for it (solver/accuracy)
  std::optional<double> accuracy;
  Integrator integrator = Integrator::dda;
  double spectral_radius = 0.8;  ///< 0 to 1; only used by generalized-alpha
  Formulation formulation = Formulation::total;
  bool paper = false;  ///< formulation = "paper": incremental, and [contact] has point springs
  InitialState initial_state = InitialState::as_placed;
  Vector3 gravity = Vector3(0.0, 0.0, -9.81);  ///< m/s^2, unless it has a history
  std::vector<Gravity> gravity_history;        ///< times increase, linear between; empty: constant
  std::optional<SceneRecord> gravity_file;     ///< its file, if not in the scene
  Solver solver = Solver::automatic;           ///< "auto"
  double mass_damping = 0.0;                   ///< 1/s, >= 0
  double stiffness_damping = 0.0;              ///< s, >= 0, Rayleigh's beta
  bool sleeping = true;                        ///< true: islands at rest are held until woken
  Method method = Method::automatic;           ///< of types safety and capacity
  FactorSearch safety;                         ///< of type safety
  FactorSearch capacity;                       ///< of type capacity
  SupportSearch movement;                      ///< of type thrust
  ScenePushover pushover;                      ///< of type pushover
  SceneSpectrum spectrum;                      ///< of type pushover
  /// m, > 0, of types safety and capacity: blocks that yield by more do not stand; empty: a hundredth of the size of the
  /// smallest block that can move
  std::optional<double> allowed_displacement;
  std::optional<double> memory_limit;  ///< bytes, > 0, largest estimated memory; empty: auto
};

}  // namespace ashlar
