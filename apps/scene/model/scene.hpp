// A scene as written by the user, with defaults: one plain struct per TOML table, one member per key of the same
// name. SI units; angles in degrees. It contains no mechanics; the builders of the model read it. "auto" is an empty
// optional, to be replaced by the user of the value.
//
// A scene from load_scene (scene_loading.hpp) satisfies all ranges and cross-references stated here.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/scene/model/scene_analysis.hpp"
#include "apps/scene/model/scene_block.hpp"
#include "apps/scene/model/scene_bolt.hpp"
#include "apps/scene/model/scene_boundary.hpp"
#include "apps/scene/model/scene_contact.hpp"
#include "apps/scene/model/scene_cracking.hpp"
#include "apps/scene/model/scene_initial_stress.hpp"
#include "apps/scene/model/scene_measure.hpp"
#include "apps/scene/model/scene_moving_load.hpp"
#include "apps/scene/model/scene_places.hpp"
#include "apps/scene/model/scene_shape.hpp"
#include "apps/scene/model/scene_water.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ashlar {

struct CutRock;

/// [[material]]
struct SceneMaterial {
  enum class Elasticity { linear, st_venant_kirchhoff };

  std::string name;            ///< unique; required
  double density = 0.0;        ///< kg/m^3, > 0; required
  double young_modulus = 0.0;  ///< Pa, > 0; required
  double poisson_ratio = 0.0;  ///< 0 to less than 0.5; required
  Elasticity elasticity = Elasticity::linear;
};

/// [[cut]]: cuts the matching blocks by parallel planes, the faces of a solid, or the cells around points.
struct SceneCut {
  enum class Kind { planes, solid, voronoi, discs };
  enum class Spacing { normal, lognormal, uniform, exponential };

  std::string name;                   ///< unique; required
  std::vector<std::string> blocks;    ///< names or globs; each matches a block or its pieces; required
  std::optional<SceneRegion> inside;  ///< only pieces inside, as they are before the cut
  Kind kind = Kind::planes;
  double dip = 0.0;                 ///< deg, 0 to 90
  double dip_direction = 0.0;       ///< deg from north (y) towards east (x)
  Vector3 point = Vector3::Zero();  ///< m, on the plane numbered 0
  std::optional<double> spacing;    ///< m, > 0, the mean; empty: one plane
  Spacing law = Spacing::normal;    ///< distribution of spacings, if they deviate
  double deviation = 0.0;           ///< m, >= 0, standard deviation of spacings
  double fisher = 0.0;              ///< Fisher's k, >= 0; 0: no scatter of orientation
  double persistence = 1.0;         ///< 0 to 1, probability that a plane cuts a block that it meets
  std::optional<double> radius;     ///< m, > 0, of disc-shaped planes; empty: infinite
  std::optional<int> number;        ///< planes to each side of `point`, >= 0; empty: as many as meet blocks
  int seed = 1;                     ///< >= 0
  double min_volume = 0.0;          ///< m^3, >= 0
  bool glued = false;               ///< blocks on both sides are tied
  std::optional<SceneBond> bonded;  ///< blocks on both sides are bonded up to a strength; excludes glued
  int most_blocks = 100000;         ///< >= 1, of all blocks of the scene after the cut
  SceneShape solid;                 ///< box, mesh, hull or sphere; kind solid
  std::filesystem::path file;       ///< table of measured joints (disc_table.hpp), as written; kind discs
  int count = 0;                    ///< >= 1; kind voronoi: points in each block
};

/// [[stage]]: changes before the run continues. Names and globs match blocks, and pieces of cut blocks.
struct SceneStage {
  /// [[stage.fix]], [[stage.load]]: a support or load of the matching blocks, from here on
  struct Fix {
    std::vector<std::string> blocks;
    SceneFix fix;
    std::optional<SceneRegion> inside = {};  ///< only those of `blocks` inside
  };
  struct Load {
    std::vector<std::string> blocks;
    SceneLoad load;
    std::optional<SceneRegion> inside = {};
  };

  std::string name;        ///< unique; required
  SceneAnalysis analysis;  ///< [analysis], key by key replaced by the stage's `analysis`; times start at 0
  std::vector<std::string> remove;  ///< blocks that are removed
  /// Blocks added as they were placed. A block that is added before it is ever removed is absent until then.
  std::vector<std::string> add;
  std::optional<SceneRegion> remove_inside, add_inside;  ///< only those of `remove` and `add` inside
  std::vector<Fix> fix;
  std::vector<Load> load;
  std::vector<SceneJoint> joint;        ///< after all earlier ones
  std::vector<SceneMaterial> material;  ///< in place of the [[material]] of that name
  std::vector<SceneWater> water;        ///< in place of the [[water]] of that name, or beside the others
  std::vector<SceneBolt> bolt;          ///< installed here
  std::vector<SceneProp> prop;
  std::vector<std::string> remove_support;  ///< names or globs of bolts and props that are removed
  bool reset_displacement = false;          ///< true: results count displacements from here on
};

/// Steps between frames if a scene has neither every nor interval.
inline constexpr int default_frame_distance = 10;

/// [output]
struct SceneOutput {
  struct Fields {
    bool displacement = true;
    bool velocity = true;
    bool stress = true;
    bool principal_stress = false;
  };
  /// Files of frames.
  enum class Format {
    vtu,     ///< a file for each frame and a .pvd file for each series
    vtkhdf,  ///< results.vtkhdf, one file for all frames
  };
  /// Of real numbers in frames; tables have doubles always.
  enum class Precision {
    automatic,  ///< single in results.vtkhdf, double in .vtu
    of_single,
    of_double
  };
  std::optional<int> every;        ///< steps between frames, >= 1; exactly one of every and interval is set
  std::optional<double> interval;  ///< s between frames, > 0
  int history_every = 1;           ///< steps between rows of the history, >= 1
  Fields fields;                   ///< by name in the array `fields`
  bool curved = false;             ///< blocks as Lagrange cells; not with formulation incremental
  bool solid = false;              ///< blocks as volumes; not with formulation incremental
  Format format = Format::vtu;
  Precision precision = Precision::automatic;
};

/// The whole scene.
struct Scene {
  std::filesystem::path file;  ///< as the user named it; paths in the scene are relative to its folder
  /// m, in the user's coordinates: all positions of the scene, its solids and its simulation are relative to it
  /// (model_position.hpp). Zero near the user's origin
  Vector3 origin = Vector3::Zero();
  std::string title;
  SceneAnalysis analysis;
  SceneContact contact;
  std::vector<SceneJoint> joint;        ///< in file order
  std::vector<SceneMaterial> material;  ///< in file order
  std::vector<SceneBlock> block;        ///< in file order, then pieces of masonry; at least one
  std::vector<SceneAssign> assign;      ///< in file order; already applied in a scene that has been read
  std::vector<SceneCut> cut;            ///< in file order
  std::vector<SceneBolt> bolt;          ///< in file order; of one stage: those of all stages
  std::vector<SceneProp> prop;          ///< the same
  std::vector<SceneMovingLoad> load;    ///< in file order
  std::vector<SceneMeasure> measure;    ///< in file order
  std::vector<SceneWater> water;        ///< in file order
  SceneInitialStress initial_stress;
  std::vector<SceneBoundary> boundary;  ///< in file order
  std::vector<SceneCracking> crack;     ///< in file order
  SceneOutput output;
  /// In file order; empty: a single analysis. Otherwise `analysis` is that of the first one.
  std::vector<SceneStage> stage;
  std::vector<bool> absent;             ///< of one stage, by block: true for absent blocks; empty: none
  std::vector<std::string> notes;       ///< changes made to mesh files, a line each
  ScenePlaces places;                   ///< of every key that was given
  std::vector<SceneBlock> uncut;        ///< if there are cuts: `block` before them
  std::shared_ptr<const CutRock> rock;  ///< origin of pieces (cut_rock.hpp); null without cuts
};

/// The key of a support's history: "displacement_history", "velocity_history" or "acceleration_history".
[[nodiscard]] const char* history_key(const SceneFix& fix);

/// Replaces values of a law by those given by a joint.
void override_law(SceneJointLaw& law, const SceneJoint& joint);

/// The law between two blocks: [contact], overridden by every [[joint]] that matches the pair and does not belong to
/// a [[cut]] or a region. For many pairs, cuts and regions, use a JointTable.
[[nodiscard]] SceneJointLaw joint_law_between(const Scene& scene, const std::string& block_a,
                                              const std::string& block_b);

/// True if the analysis is static.
[[nodiscard]] bool is_static(const SceneAnalysis& analysis);

/// True if a static analysis precedes the first step of a dynamic one.
[[nodiscard]] bool starts_from_statics(const Scene& scene);

/// True if contact uses multipliers: as the scene specifies; otherwise in statics between blocks whose joints have no
/// given stiffness, and in dynamics that starts from statics if no joint has. Stages pass on the forces of contact,
/// so that the result is the same for all. Joints of cuts have springs in any case and do not count.
[[nodiscard]] bool has_multipliers(const Scene& scene);

/// The material of this name, or null.
[[nodiscard]] const SceneMaterial* find_material(const Scene& scene, const std::string& name);

}  // namespace ashlar
