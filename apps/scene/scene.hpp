// A scene as the user wrote it, with defaults filled in: one plain struct per TOML table, one member per key
// of the same name. SI units; angles in degrees. Nothing here knows how a block moves; the builders of the
// model read this. "auto" is an empty optional: whoever needs the number chooses it.
//
// A scene that came out of load_scene (scene_loading.hpp) satisfies every range and cross-reference stated
// here.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "apps/scene/scene_places.hpp"
#include "geometry/solid/polyhedron.hpp"
#include "geometry/triangle_mesh.hpp"
#include "mechanics/supports/recorded_motion.hpp"

namespace ashlar {

struct CutRock;

/// Times of a static analysis of constant loads that does not give them, s; each gives way to the other one
/// where that is given.
inline constexpr double default_static_end_time = 1.0;
inline constexpr double default_static_time_step = 1e-3;

/// { file, time, values, scale } in place of the rows of a history.
struct SceneRecord {
  std::filesystem::path file;  ///< CSV, as written; relative paths are relative to the scene file's folder
  std::string time;            ///< name of the column of times
  std::vector<std::string> values;  ///< names of the columns of values; an empty one: zero
  double scale = 1.0;               ///< of the values
  std::string sha256;               ///< of the file as it was read
};

/// [analysis]
struct SceneAnalysis {
  enum class Type {
    dynamic,   ///< "dynamic": motion in time
    statics,   ///< "static": equilibrium
    safety,    ///< "factor-of-safety": static analyses with less and less strength
    capacity,  ///< "capacity": static analyses with more and more load
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
  FactorSearch safety;                 ///< of type safety
  FactorSearch capacity;               ///< of type capacity
  std::optional<double> memory_limit;  ///< bytes, > 0, that the estimate may reach; empty: auto
};

/// The law between the faces of two blocks. Strengths default to none: a joint's strength has to be stated.
struct SceneJointLaw {
  std::optional<double> normal_stiffness;  ///< Pa/m (area springs) or N/m (point springs), > 0; empty: auto
  std::optional<double> shear_stiffness;   ///< as normal_stiffness
  double friction_angle = 0.0;             ///< deg, 0 to less than 90
  double cohesion = 0.0;                   ///< Pa, >= 0
  double tensile_strength = 0.0;           ///< Pa, >= 0
  /// Of what has failed, or touches later; at most the values above. Empty: friction_angle, no cohesion, none
  std::optional<double> friction_angle_residual, cohesion_residual, tensile_strength_residual;
  double dilation_angle = 0.0;  ///< deg, 0 to friction_angle and its residual value
  double damping = 0.0;         ///< share of critical, of the joint's springs, 0 to 1
  bool tied = false;            ///< bonded over the common face; a key of [[joint]] only

  [[nodiscard]] bool gives_stiffness() const { return normal_stiffness || shear_stiffness; }
};

/// [contact]
struct SceneContact {
  enum class Springs { area, point };
  enum class Surface { curved, flat };

  Springs springs = Springs::area;
  Surface surface = Surface::curved;
  SceneJointLaw law;                      ///< keys of the same names, for every pair without a [[joint]]
  std::optional<double> distance;         ///< m, > 0; empty: auto
  std::optional<double> angle;            ///< deg, 0 to 45; empty: auto
  std::optional<double> chord_tolerance;  ///< m, > 0; empty: auto, or subdivisions
  std::optional<int> subdivisions;        ///< uniform levels, 0 to 8; excludes chord_tolerance
  std::optional<bool> augmented;          ///< multipliers: no deeper than penetration_tolerance; empty: auto
  std::optional<double> penetration_tolerance;  ///< m, > 0; empty: auto
  double fit = 0.0;                             ///< m, >= 0; 0: blocks stay as they are placed
  std::optional<double> allowed_depth;          ///< m, > 0; empty: auto, 1e-2 of the smaller block
};

/// [[joint]]: what differs from [contact] between two blocks; the last entry that matches a pair wins, key by
/// key.
struct SceneJoint {
  std::array<std::string, 2> blocks;  ///< names or globs (* ? [...]), in any order; match at least one pair
  std::string cut;  ///< if not empty, only pairs that this [[cut]] has parted; blocks are then "*" by default
  bool of_glued_cut = false;  ///< it stands in no scene: a [[cut]] with `glued` ties what it has parted
  /// An outer empty optional: not given here. An inner empty one: given as "auto".
  std::optional<std::optional<double>> normal_stiffness;
  std::optional<std::optional<double>> shear_stiffness;
  std::optional<double> friction_angle;
  std::optional<double> cohesion;
  std::optional<double> tensile_strength;
  std::optional<double> friction_angle_residual, cohesion_residual, tensile_strength_residual;
  std::optional<double> dilation_angle, damping;
  std::optional<bool> tied;
};

/// [[material]]
struct SceneMaterial {
  enum class Elasticity { linear, st_venant_kirchhoff };

  std::string name;            ///< unique; required
  double density = 0.0;        ///< kg/m^3, > 0; required
  double young_modulus = 0.0;  ///< Pa, > 0; required
  double poisson_ratio = 0.0;  ///< 0 to less than 0.5; required
  Elasticity elasticity = Elasticity::linear;
};

/// box = { min, max }
struct SceneBox {
  Vector3 min = Vector3::Zero();  ///< m, less than max in every component
  Vector3 max = Vector3::Zero();  ///< m
};

/// mesh = { file, scale, split, group, weld, flip, repair }
struct SceneMesh {
  enum class Split {
    none,        ///< "none": the file is one stone
    components,  ///< "components": each closed surface is one
    groups,      ///< "groups": each object or group of an OBJ file is one, each physical group of an MSH file
    tetrahedra,  ///< "tetrahedra": each of an MSH file is one
  };
  enum class Flip {
    automatic,  ///< "auto": surfaces that are inside out are turned
    always,     ///< true: all surfaces are turned
    never,      ///< false
  };
  std::filesystem::path file;  ///< as written; relative paths are relative to the scene file's folder
  double scale = 1.0;          ///< > 0
  Split split = Split::none;
  std::string group;  ///< of an MSH file: the only physical group that is read, by name or number; empty: all
  double weld = 0.0;  ///< m, >= 0: corners this near are one
  Flip flip = Flip::never;
  bool repair = false;  ///< whether holes are filled and the like (surface_repair.hpp)
  /// What a block gets of a file that is split, in the file's units, and its 1-based number there.
  std::shared_ptr<const TriangleMesh> stone;
  int number = 0;
};

/// hull = { points }
struct SceneHull {
  std::vector<Vector3> points;  ///< m, at least 4, not coplanar
};

/// sphere = { center, radius, subdivisions }
struct SceneSphere {
  Vector3 center = Vector3::Zero();  ///< m
  double radius = 0.0;               ///< m, > 0; required
  int subdivisions = 3;              ///< 0 to 7
};

/// A piece of a block that a [[cut]] has cut, already placed. No scene can say it.
struct ScenePiece {
  std::shared_ptr<const Polyhedron> solid;
};

/// Empty (monostate) only if the scene has a fault there.
using SceneShape = std::variant<std::monostate, SceneBox, SceneMesh, SceneHull, SceneSphere, ScenePiece>;

/// rotate = { axis, angle, about }
struct SceneRotation {
  Vector3 axis = Vector3::UnitZ();  ///< not zero, any length
  double angle = 0.0;               ///< deg, right-handed about axis
  Vector3 about = Vector3::Zero();  ///< m
};

/// A plane in placed coordinates. It names the faces of the block that lie in it, whichever side they face.
struct ScenePlane {
  Vector3 point = Vector3::Zero();   ///< m
  Vector3 normal = Vector3::Zero();  ///< not zero, any length
};

/// [[block.fix]]: clamped faces or a fixed point.
struct SceneFix {
  struct Motion {
    double time = 0.0;                ///< s
    Vector3 value = Vector3::Zero();  ///< m, m/s or m/s^2
  };
  std::variant<ScenePlane, Vector3>
      where;  ///< a plane with at least one face, or a point, m, placed coordinates
  std::array<bool, 3> components = {true, true, true};  ///< x, y, z held
  /// What the rows of the history are; displacements are linear or cubic between rows (`interpolation`).
  MotionRecord record = MotionRecord::displacement;
  std::vector<Motion> history;      ///< the rows of the history that is given; times increase; empty: at rest
  std::optional<SceneRecord> file;  ///< where they come from, if not from the scene
};

/// The key of a support's history: "displacement_history", "velocity_history" or "acceleration_history".
[[nodiscard]] const char* history_key(const SceneFix& fix);

/// [[block.load]]: traction on faces, or a force on faces or at a point.
struct SceneLoad {
  struct Factor {
    double time = 0.0;  ///< s
    double factor = 1.0;
  };
  enum class Kind {
    traction,  ///< Pa, on the plane's faces
    force,     ///< N, spread evenly over the plane's faces, or at the point
  };
  std::variant<ScenePlane, Vector3> where;  ///< as SceneFix::where; a traction needs a plane
  Kind kind = Kind::traction;
  Vector3 vector = Vector3::Zero();  ///< Pa or N
  std::vector<Factor> history;       ///< times increase; empty: factor 1 always
  std::optional<SceneRecord> file;   ///< where it comes from, if not from the scene
  bool of_fill = false;              ///< weight of an arch's fill, which a fixed block does without
};

/// array = { count, step, stagger }
struct SceneArray {
  std::vector<int> count;             ///< (1 to 3), blocks in each direction, >= 1
  std::vector<Vector3> step;          ///< as many, m, from one to the next
  Vector3 stagger = Vector3::Zero();  ///< m, of every second one of the last direction
};

/// [[block]]
struct SceneBlock {
  std::string name;      ///< unique; required
  std::string material;  ///< name of a [[material]]; only a fixed block may leave it out (empty)
  int order = 1;         ///< 0 to 12; 0: rigid
  SceneShape shape;      ///< exactly one of box, mesh, hull, sphere
  std::optional<SceneRotation> rotate;
  Vector3 translate = Vector3::Zero();         ///< m, after rotate
  Vector3 velocity = Vector3::Zero();          ///< m/s
  Vector3 angular_velocity = Vector3::Zero();  ///< rad/s about the centroid
  bool fixed = false;                          ///< the whole block never moves; then no fix, load or velocity
  std::vector<SceneFix> fix;
  std::vector<SceneLoad> load;
  std::optional<SceneArray> array;  ///< empty in a scene that has been read: there its copies are blocks
};

/// [[assign]]: properties of the blocks that patterns match; of several entries the last one counts, key by
/// key, but supports and loads add up.
struct SceneAssign {
  std::vector<std::string> blocks;  ///< names or globs, each matches at least one block
  std::optional<std::string> material;
  std::optional<int> order;
  std::optional<bool> fixed;
  std::optional<Vector3> velocity;
  std::optional<Vector3> angular_velocity;
  std::vector<SceneFix> fix;
  std::vector<SceneLoad> load;
};

/// [[cut]]: what cuts the blocks that match: parallel planes, the faces of a solid, or the cells around
/// points.
struct SceneCut {
  enum class Kind { planes, solid, voronoi };
  enum class Spacing { normal, lognormal, uniform, exponential };

  std::string name;                 ///< unique; required
  std::vector<std::string> blocks;  ///< names or globs; each matches a block or its pieces; required
  Kind kind = Kind::planes;
  double dip = 0.0;                 ///< deg, 0 to 90
  double dip_direction = 0.0;       ///< deg from north (y) towards east (x)
  Vector3 point = Vector3::Zero();  ///< m, on the plane numbered 0
  std::optional<double> spacing;    ///< m, > 0, the mean; empty: one plane
  Spacing law = Spacing::normal;    ///< of spacings, if they deviate
  double deviation = 0.0;           ///< m, >= 0, standard deviation of spacings
  double fisher = 0.0;              ///< Fisher's k, >= 0; 0: no scatter of orientation
  double persistence = 1.0;         ///< 0 to 1, chance that a plane cuts a block that it meets
  std::optional<double> radius;     ///< m, > 0, of the discs that planes are; empty: infinite
  std::optional<int> number;        ///< planes to each side of `point`, >= 0; empty: as many as meet blocks
  int seed = 1;                     ///< >= 0
  double min_volume = 0.0;          ///< m^3, >= 0
  bool glued = false;               ///< blocks on both sides are tied
  int most_blocks = 100000;         ///< >= 1, of all blocks of the scene after the cut
  SceneShape solid;                 ///< box, mesh, hull or sphere; kind solid
  int count = 0;                    ///< >= 1; kind voronoi: points in each block
};

/// [[measure]]: a material point, a block or a pair of blocks, of which the history has columns.
struct SceneMeasure {
  std::string name;                 ///< unique; required; heads columns of the history
  std::string block;                ///< name of a [[block]]; empty: `pair` is measured
  std::optional<Vector3> point;     ///< m, in the placed, undeformed block; empty: the block as a whole
  std::array<std::string, 2> pair;  ///< names of two blocks, whose contacts are measured; else empty
};

/// [[stage]]: what changes before the run goes on. Names and globs mean blocks, and pieces of cut blocks.
struct SceneStage {
  /// [[stage.fix]], [[stage.load]]: a support or load of the blocks that match, from here on
  struct Fix {
    std::vector<std::string> blocks;
    SceneFix fix;
  };
  struct Load {
    std::vector<std::string> blocks;
    SceneLoad load;
  };

  std::string name;        ///< unique; required
  SceneAnalysis analysis;  ///< [analysis], key by key replaced by the stage's `analysis`; times start at 0
  std::vector<std::string> remove;  ///< blocks that are there no more
  /// Blocks that are there from here on, as they were placed. What is added before it is ever removed is held back
  /// until then.
  std::vector<std::string> add;
  std::vector<Fix> fix;
  std::vector<Load> load;
  std::vector<SceneJoint> joint;        ///< later than all that came before
  std::vector<SceneMaterial> material;  ///< in place of the [[material]] of that name
  bool reset_displacement = false;      ///< whether results count displacements from here on
};

/// Steps between frames where a scene tells neither every nor interval.
inline constexpr int default_frame_distance = 10;

/// [output]
struct SceneOutput {
  struct Fields {
    bool displacement = true;
    bool velocity = true;
    bool stress = true;
    bool principal_stress = false;
  };
  std::optional<int> every;        ///< steps between frames, >= 1; exactly one of every and interval is set
  std::optional<double> interval;  ///< s between frames, > 0
  int history_every = 1;           ///< steps between rows of the history, >= 1
  Fields fields;                   ///< by name in the array `fields`
  bool curved = false;             ///< blocks as Lagrange cells; not with formulation incremental
  bool solid = false;              ///< blocks as volumes; not with formulation incremental
};

/// The whole scene.
struct Scene {
  std::filesystem::path file;  ///< as the user named it; paths in the scene are relative to its folder
  std::string title;
  SceneAnalysis analysis;
  SceneContact contact;
  std::vector<SceneJoint> joint;        ///< in file order
  std::vector<SceneMaterial> material;  ///< in file order
  std::vector<SceneBlock> block;        ///< in file order, then pieces of masonry; at least one
  std::vector<SceneAssign> assign;      ///< in file order; already applied in a scene that has been read
  std::vector<SceneCut> cut;            ///< in file order
  std::vector<SceneMeasure> measure;    ///< in file order
  SceneOutput output;
  /// In file order; empty: there is one analysis. Else `analysis` is that of the first one.
  std::vector<SceneStage> stage;
  std::vector<bool> absent;             ///< of one stage, by block: those that are not there; empty: none
  std::vector<std::string> notes;       ///< what was done with mesh files, a line each
  ScenePlaces places;                   ///< of every key that was given
  std::vector<SceneBlock> uncut;        ///< if there are cuts: `block` as the file has it
  std::shared_ptr<const CutRock> rock;  ///< which block is a piece of what (cut_rock.hpp); null without cuts
};

/// What a joint gives replaces what the law had.
void override_law(SceneJointLaw& law, const SceneJoint& joint);

/// The law between two blocks: [contact], overridden by every [[joint]] that matches the pair and is not of a
/// [[cut]]. Of many pairs, and of cuts, ask a JointTable.
[[nodiscard]] SceneJointLaw joint_law_between(const Scene& scene, const std::string& block_a,
                                              const std::string& block_b);

/// Whether nothing moves in time.
[[nodiscard]] bool is_static(const SceneAnalysis& analysis);

/// Whether a static analysis comes before the first step of a motion in time.
[[nodiscard]] bool starts_from_statics(const Scene& scene);

/// Whether multipliers hold contact: as the scene says; else in statics between blocks whose joints have no
/// stiffness given, and in motion that starts from statics where no joint has. Stages hand on the forces of
/// contact, so the answer is one for all.
[[nodiscard]] bool has_multipliers(const Scene& scene);

/// The material called so, or null.
[[nodiscard]] const SceneMaterial* find_material(const Scene& scene, const std::string& name);

}  // namespace ashlar
