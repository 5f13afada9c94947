// Origin of the contacts of two blocks: each contact that a stage of detection found, and the stage that removed it.
//
// The stages are those of a step (contact/contact_stages.hpp), run once more on a copy of the present state without
// caches of earlier searches. The lists before and after each stage are compared: contacts with the same features are
// the same.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "solver/contact/contact_stages.hpp"
#include "solver/state/block_system.hpp"
#include "solver/state/run_state.hpp"

namespace ashlar {

/// Features that meet.
enum class ContactFeatures { faces, vertex_and_face, edges };

/// One contact of blocks a < b.
struct ExplainedContact {
  ContactFeatures features = ContactFeatures::faces;
  bool vertex_of_a = false;  ///< vertex_and_face: true if the vertex belongs to a
  /// Face of a, then of b; for a vertex or edge an adjacent face
  std::array<int, 2> faces = {-1, -1};
  Vector3 place = Vector3::Zero();   ///< m, on the surface of b or, for a vertex of b, of a
  Vector3 normal = Vector3::Zero();  ///< unit, out of b
  double gap = 0.0;                  ///< m, least over the contact; negative: penetration
  double area = 0.0;                 ///< m^2, of the overlap, or tributary
  ContactStage added = ContactStage::search;
  std::optional<ContactStage> removed;  ///< empty: the step uses it
};

/// Result of the selection of two blocks for a search.
enum class PairSearch {
  searched,   ///< surfaces are within reach, or boxes alone do not show that they are farther apart
  both_held,  ///< neither moves: both are fixed
  absent,     ///< one of them is absent in this stage
  tied,       ///< they are bonded as a whole
  far_apart,  ///< their boxes are farther apart than the blocks can move in a step
};

struct ContactExplanation {
  PairKey blocks = {-1, -1};
  PairSearch search = PairSearch::searched;
  double reach = 0.0;  ///< m, search distance: contact distance and possible motion of both in a step
  /// m, a lower bound of the distance of both surfaces; empty: they have contacts, or were not searched
  std::optional<double> clearance;
  std::optional<ContactType> type;         ///< of two convex blocks as a whole
  std::vector<ExplainedContact> contacts;  ///< in the order in which stages added them
};

/// @param divisions of the surfaces, as the finder of the run has them. @param a,b in any order
/// @throws std::invalid_argument if there are no such blocks or they are the same
[[nodiscard]] ContactExplanation explain_contacts(const BlockSystem& system, const RunState& state,
                                                  const FinderState& divisions, int a, int b);

}  // namespace ashlar
