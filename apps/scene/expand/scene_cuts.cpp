#include "apps/scene/expand/scene_cuts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "apps/scene/expand/piece_blocks.hpp"
#include "apps/scene/expand/piece_names.hpp"
#include "apps/scene/expand/scene_cutter.hpp"
#include "apps/scene/expand/scene_solids.hpp"
#include "apps/scene/model/block_names.hpp"
#include "geometry/mesh/mesh_repair.hpp"
#include "geometry/solid/shape_loss.hpp"

namespace ashlar {
namespace {

using Pieces = std::vector<std::shared_ptr<const Polyhedron>>;

/// The planes of cuts that bound a piece, as text: the first few.
std::string planes_of(const Scene& scene, const CutRock& rock, const CutSolid& solid, int piece) {
  constexpr std::size_t named = 6;
  std::vector<std::string> planes;
  for (const PieceFace& face : solid.faces(piece)) {
    if (face.mark < 0) continue;
    const auto& [cut, plane] = rock.marks[static_cast<std::size_t>(face.mark)];
    const std::string of_cut = fmt::format("cut \"{}\"", scene.cut[cut].name);
    planes.push_back(scene.cut[cut].kind == SceneCut::Kind::planes ||
                             scene.cut[cut].kind == SceneCut::Kind::discs
                         ? fmt::format("plane {} of {}", plane, of_cut)
                         : of_cut);
  }
  std::sort(planes.begin(), planes.end());
  planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
  const bool more = planes.size() > named;
  if (more) planes.resize(named);
  return fmt::format("{}{}", fmt::join(planes, ", "), more ? ", ..." : "");
}

/// The last cut that made a face of a piece.
std::size_t last_cut_of(const CutRock& rock, const CutSolid& solid, int piece) {
  std::size_t last = 0;
  for (const PieceFace& face : solid.faces(piece))
    if (face.mark >= 0) last = std::max(last, rock.marks[static_cast<std::size_t>(face.mark)].cut);
  return last;
}

/// The solids of a block's pieces. Pieces lost by rounding are reported with their bounding planes.
Pieces solids_of(const Scene& scene, const CutRock& rock, std::size_t block, double resolution,
                 Diagnostics& diagnostics) {
  const CutSolid& solid = *rock.solids[block];
  const std::vector<std::string> names = piece_names(scene, rock, block);
  Pieces pieces;
  for (const int piece : solid.pieces()) {
    std::string fault;
    try {
      Polyhedron body(solid.mesh(piece, resolution), resolution);
      if (!is_lost_in_rounding(body)) {
        pieces.push_back(std::make_shared<const Polyhedron>(std::move(body)));
        continue;
      }
      fault = fmt::format("coordinates are known to {:.3g} m", resolution);
    } catch (const MeshError& error) {
      fault = error.what();
    }
    const std::size_t cut = last_cut_of(rock, solid, piece);
    if (const std::size_t parts = closed_components(solid.mesh(piece), 0.0).size(); parts > 1) {
      diagnostics.error(
          scene.places.key(fmt::format("cut.{}", cut)),
          fmt::format(
              "cut leaves a body around a hollow ({:.4g} m^3, \"{}\", its surface has {} parts), which is "
              "not supported: a [[cut]] by a plane through the hollow before this one is needed, with "
              "glued = true the body stays whole",
              solid.volume(piece), names[pieces.size()], parts));
      pieces.push_back(nullptr);
      continue;
    }
    diagnostics.error(
        scene.places.key(fmt::format("cut.{}", cut)),
        fmt::format(
            "cut makes a piece that is lost in rounding ({:.3g} m^3, \"{}\" between {}; {}), planes that "
            "make no such sliver, or a min_volume that glues it, are needed",
            solid.volume(piece), names[pieces.size()], planes_of(scene, rock, solid, piece), fault));
    pieces.push_back(nullptr);
  }
  return pieces;
}

/// The rounding errors of the contacts of slivers exceed their weight: a run needs hundreds of iterations for each
/// step (solver/notes/rounding_and_states.md).
void warn_of_slivers(const Scene& scene, const CutRock& rock, std::size_t block, const Pieces& pieces,
                     Diagnostics& diagnostics) {
  constexpr double share = 1e-6;  // of the mean volume
  double sum = 0.0;
  for (const auto& piece : pieces) sum += piece->volume();
  const double limit = share * sum / static_cast<double>(pieces.size());
  std::size_t slivers = 0, least = 0;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    slivers += pieces[k]->volume() < limit ? 1 : 0;
    if (pieces[k]->volume() < pieces[least]->volume()) least = k;
  }
  if (slivers == 0) return;
  const CutSolid& solid = *rock.solids[block];
  const std::size_t cut = last_cut_of(rock, solid, solid.pieces()[least]);
  diagnostics.warning(scene.places.key(fmt::format("cut.{}", cut)),
                      fmt::format("cuts leave {} sliver{} among {} pieces of block \"{}\" (the least, "
                                  "\"{}\", has {:.3g} m^3, a piece has "
                                  "{:.3g} m^3 in the mean): rounding errors of contact forces exceed their "
                                  "weight, which takes most of the "
                                  "time of a run; min_volume = {:.0e} glues {}",
                                  slivers, slivers == 1 ? "" : "s", pieces.size(), scene.block[block].name,
                                  piece_names(scene, rock, block)[least], pieces[least]->volume(),
                                  limit / share, 10.0 * limit, slivers == 1 ? "it" : "them"));
}

// Temporary path of the keys of blocks while pieces get their numbers.
const std::string uncut_blocks = "uncut block";

/// Keys of a piece refer to those of the block of its origin.
void record_origin(ScenePlaces& places, std::size_t uncut, std::size_t block, const PieceBlock* piece) {
  const std::string from = fmt::format("{}.{}", uncut_blocks, uncut), to = fmt::format("block.{}", block);
  places.record_origin(to, from);
  if (piece == nullptr) return;
  const auto record = [&](const char* key, const std::vector<std::size_t>& kept) {
    for (std::size_t i = 0; i < kept.size(); ++i)
      places.record_origin(fmt::format("{}.{}.{}", to, key, i), fmt::format("{}.{}.{}", from, key, kept[i]));
  };
  record("fix", piece->fix);
  record("load", piece->load);
}

/// Replaces the blocks by the pieces.
void replace_blocks(Scene& scene, CutRock& rock, const std::vector<std::optional<Polyhedron>>& solids,
                    Diagnostics& diagnostics) {
  std::vector<SceneBlock> blocks;
  ScenePlaces places = scene.places;
  places.move_list("block", uncut_blocks);
  for (std::size_t k = 0; k < scene.block.size(); ++k) {
    if (!rock.solids[k] || piece_names(scene, rock, k).size() == 1) {
      record_origin(places, k, blocks.size(), nullptr);
      rock.origin.push_back({k, -1});
      rock.other_names.emplace_back();
      blocks.push_back(scene.block[k]);
      continue;
    }
    const Pieces pieces = solids_of(scene, rock, k, resolution_of(scene.block[k], *solids[k]), diagnostics);
    if (!diagnostics.good()) continue;
    warn_of_slivers(scene, rock, k, pieces, diagnostics);
    const std::vector<std::string> names = piece_names(scene, rock, k);
    std::vector<PieceBlock> made = make_piece_blocks(scene, k, pieces, names, diagnostics);
    const std::vector<int> numbers = rock.solids[k]->pieces();
    for (auto& others : other_piece_names(scene, rock, k)) rock.other_names.push_back(std::move(others));
    for (std::size_t i = 0; i < made.size(); ++i) {
      record_origin(places, k, blocks.size(), &made[i]);
      rock.origin.push_back({k, numbers[i]});
      blocks.push_back(std::move(made[i].block));
    }
    move_measures(scene, scene.block[k].name, pieces, names);
  }
  if (!diagnostics.good()) return;
  scene.uncut = std::move(scene.block);
  scene.block = std::move(blocks);
  scene.places = std::move(places);
}

/// Joints cut blocks as a whole (limits.md).
void warn_of_extended_joints(const Scene& scene, const CutRock& rock, Diagnostics& diagnostics) {
  for (std::size_t k = 0; k < scene.cut.size(); ++k) {
    const int count = rock.extended[k];
    if (count == 0 || scene.cut[k].kind != SceneCut::Kind::discs) continue;
    diagnostics.warning(
        scene.places.value(fmt::format("cut.{}.file", k)),
        fmt::format("cut \"{}\" divides {} by joints that end inside, which are extended to the "
                    "faces; more strength of its joints may stand for the rock between",
                    scene.cut[k].name, count == 1 ? "1 piece" : fmt::format("{} pieces", count)));
  }
}

// Path of [[joint]] once joints of cuts stand before those of the scene.
const std::string written_joints = "written joint";

/// A tie that breaks, over all faces of a cut. Of [contact] it keeps friction, restitution and compressive strength.
SceneJoint joint_of_bond(const SceneCut& cut, const SceneJointLaw& contact) {
  const SceneBond& bond = *cut.bonded;
  SceneJoint joint;
  joint.blocks = {"*", "*"};
  joint.cut = cut.name;
  joint.made_by_cut = true;
  joint.tie = SceneTie{bond.tensile_strength, bond.cohesion};
  // The springs of a tie, which are automatic.
  joint.normal_stiffness.emplace(std::nullopt);
  joint.shear_stiffness.emplace(std::nullopt);
  joint.friction_angle = bond.friction_angle;
  if (contact.friction_angle_residual)
    joint.friction_angle_residual = bond.friction_angle.value_or(contact.friction_angle);
  joint.dilation_angle = 0.0;
  joint.damping = 0.0;
  joint.fracture_energy = bond.fracture_energy;
  if (!bond.fracture_energy && contact.fracture_energy) joint.fracture_energy = FractureEnergy{};
  return joint;
}

bool makes_a_face(const CutRock& rock, std::size_t cut) {
  return std::any_of(rock.common.begin(), rock.common.end(), [cut](const auto& border) {
    return std::find(border.second.begin(), border.second.end(), cut) != border.second.end();
  });
}

/// Puts the joints of bonded cuts before all others.
void add_bonds(Scene& scene, const CutRock& rock, Diagnostics& diagnostics) {
  std::vector<SceneJoint> joints;
  std::vector<std::string> origins;
  for (std::size_t k = 0; k < scene.cut.size(); ++k) {
    const SceneCut& cut = scene.cut[k];
    if (!cut.bonded) continue;
    const std::string key = fmt::format("cut.{}.bonded", k);
    if (!makes_a_face(rock, k))
      diagnostics.error(scene.places.key(key),
                        fmt::format("bonded cut makes no face between two blocks (\"{}\"), a cut that "
                                    "divides a block is needed",
                                    cut.name));
    joints.push_back(joint_of_bond(cut, scene.contact.law));
    origins.push_back(key);
  }
  if (joints.empty()) return;
  scene.places.move_list("joint", written_joints);
  for (std::size_t k = 0; k < scene.joint.size(); ++k)
    origins.push_back(fmt::format("{}.{}", written_joints, k));
  for (std::size_t k = 0; k < origins.size(); ++k)
    scene.places.record_origin(fmt::format("joint.{}", k), origins[k]);
  scene.joint.insert(scene.joint.begin(), std::make_move_iterator(joints.begin()),
                     std::make_move_iterator(joints.end()));
}

/// Ties the parts divided by glued cuts.
void add_ties(Scene& scene) {
  for (std::size_t k = 0; k < scene.cut.size(); ++k) {
    if (!scene.cut[k].glued) continue;
    const std::string key = fmt::format("cut.{}.glued", k);
    scene.places.record(fmt::format("joint.{}.tied", scene.joint.size()),
                        {scene.places.key(key), scene.places.value(key)});
    SceneJoint joint;
    joint.blocks = {"*", "*"};
    joint.cut = scene.cut[k].name;
    joint.tied = true;
    joint.made_by_cut = true;
    scene.joint.push_back(std::move(joint));
  }
}

}  // namespace

void cut_scene(Scene& scene, Diagnostics& diagnostics, Preparation* preparation) {
  if (scene.cut.empty()) return;
  const std::vector<std::optional<Polyhedron>> solids =
      build_solids(scene, diagnostics, nullptr, preparation);
  if (!diagnostics.good()) return;
  SceneCutter cutter(scene, solids, diagnostics);
  for (std::size_t k = 0; k < scene.cut.size() && diagnostics.good(); ++k) {
    if (preparation != nullptr)
      preparation->phase(fmt::format("cut {} ({} of {})", scene.cut[k].name, k + 1, scene.cut.size()));
    cutter.make_cut(k);
  }
  if (!diagnostics.good()) return;
  auto rock = std::make_shared<CutRock>(cutter.take());
  if (preparation != nullptr) preparation->phase("solids of all pieces");
  replace_blocks(scene, *rock, solids, diagnostics);
  if (!diagnostics.good()) return;
  warn_of_extended_joints(scene, *rock, diagnostics);
  rock->find_borders();
  scene.rock = std::move(rock);
  for (SceneMeasure& measure : scene.measure)
    for (std::string* name : {&measure.block, &measure.pair[0], &measure.pair[1]})
      *name = own_name(scene, *name);
  add_bonds(scene, *scene.rock, diagnostics);
  add_ties(scene);
}

}  // namespace ashlar
