#include "apps/scene/expand/piece_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace ashlar {
namespace {

const std::string inside_word = "inside";

/// The cuts by solids that contain a piece, in order.
std::vector<std::size_t> insides_of(const CutRock& rock, const CutSolid& solid, int piece) {
  const int label = solid.label(piece);
  if (label == 0) return {};
  return rock.insides[static_cast<std::size_t>(label) - 1];
}

bool is_whole(const CutSolid& solid, const std::vector<int>& pieces) {
  return pieces.size() == 1 && solid.label(pieces[0]) == 0;
}

/// NAME.K and NAME.inside.K.
std::vector<std::string> plain_names(const std::string& block, const CutSolid& solid,
                                     const std::vector<int>& pieces) {
  std::vector<std::string> names;
  int outside = 0, inside = 0;
  names.reserve(pieces.size());
  for (const int piece : pieces)
    names.push_back(solid.label(piece) == 0 ? fmt::format("{}.{}", block, ++outside)
                                            : fmt::format("{}.{}.{}", block, inside_word, ++inside));
  return names;
}

/// Names by the cuts that contain a piece: NAME.C.inside.K, in the order of the cuts.
std::vector<std::vector<std::string>> names_inside(const Scene& scene, const CutRock& rock, std::size_t block,
                                                   const std::vector<int>& pieces) {
  std::map<std::size_t, int> counts;
  std::vector<std::vector<std::string>> names;
  for (const int piece : pieces) {
    std::vector<std::string>& of_piece = names.emplace_back();
    for (const std::size_t cut : insides_of(rock, *rock.solids[block], piece))
      of_piece.push_back(fmt::format("{}.{}.{}.{}", scene.block[block].name, scene.cut[cut].name, inside_word,
                                     ++counts[cut]));
  }
  return names;
}

/// Cuts with a face of a piece that are not those of the solids around it.
std::set<std::size_t> bordering_cuts(const CutRock& rock, const CutSolid& solid, int piece) {
  std::set<std::size_t> cuts;
  for (const PieceFace& face : solid.faces(piece))
    if (face.mark >= 0) cuts.insert(rock.marks[static_cast<std::size_t>(face.mark)].cut);
  for (const std::size_t around : insides_of(rock, solid, piece)) cuts.erase(around);
  return cuts;
}

}  // namespace

std::vector<std::string> piece_names(const Scene& scene, const CutRock& rock, std::size_t block) {
  const CutSolid& solid = *rock.solids[block];
  const std::vector<int> pieces = solid.pieces();
  if (is_whole(solid, pieces)) return {scene.block[block].name};
  std::vector<std::string> names = plain_names(scene.block[block].name, solid, pieces);
  std::set<std::size_t> around;
  for (const int piece : pieces)
    for (const std::size_t cut : insides_of(rock, solid, piece)) around.insert(cut);
  if (around.size() < 2) return names;
  const std::vector<std::vector<std::string>> by_cut = names_inside(scene, rock, block, pieces);
  for (std::size_t k = 0; k < pieces.size(); ++k)
    if (!by_cut[k].empty()) names[k] = by_cut[k].back();
  return names;
}

std::vector<std::vector<std::string>> other_piece_names(const Scene& scene, const CutRock& rock,
                                                        std::size_t block) {
  const CutSolid& solid = *rock.solids[block];
  const std::vector<int> pieces = solid.pieces();
  if (is_whole(solid, pieces)) return {{}};
  const std::vector<std::string> own = piece_names(scene, rock, block);
  const std::vector<std::string> plain = plain_names(scene.block[block].name, solid, pieces);
  std::vector<std::vector<std::string>> others = names_inside(scene, rock, block, pieces);
  std::map<std::size_t, int> counts;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    others[k].push_back(plain[k]);
    for (const std::size_t cut : bordering_cuts(rock, solid, pieces[k]))
      if (scene.cut[cut].name != inside_word)
        others[k].push_back(
            fmt::format("{}.{}.{}", scene.block[block].name, scene.cut[cut].name, ++counts[cut]));
    std::erase(others[k], own[k]);
  }
  return others;
}

}  // namespace ashlar
