// Why two blocks have the contacts that they have: each contact that a stage of detection found, and the stage that
// removed it.
//
// The stages are those of a step (contact/contact_stages.hpp), run once more on a copy of the present state with nothing
// kept from earlier searches. The lists before and after each stage are compared: a contact is the same in both if its
// features are.
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
  bool vertex_of_a = false;  ///< vertex_and_face: whether a has the vertex
  /// Of a, then of b: the face; the face beside the vertex or edge where that is what meets
  std::array<int, 2> faces = {-1, -1};
  Vector3 place = Vector3::Zero();   ///< m, on the surface of b or, of a vertex of b, of a
  Vector3 normal = Vector3::Zero();  ///< unit, out of b
  double gap = 0.0;                  ///< m, least over the contact; negative: penetration
  double area = 0.0;                 ///< m^2, of the overlap, or tributary
  ContactStage added = ContactStage::search;
  std::optional<ContactStage> removed;  ///< empty: the step uses it
};

/// Why two blocks are searched, or not.
enum class PairSearch {
  searched,   ///< their surfaces are within reach, or could not be told to be farther apart from boxes alone
  both_held,  ///< neither moves: both are fixed
  absent,     ///< one of them is not there in this stage
  tied,       ///< they are bonded as a whole
  far_apart,  ///< their boxes are farther apart than they can come in a step
};

struct ContactExplanation {
  PairKey blocks = {-1, -1};
  PairSearch search = PairSearch::searched;
  double reach = 0.0;  ///< m, gaps up to this are searched: contact distance and what both may move in a step
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
