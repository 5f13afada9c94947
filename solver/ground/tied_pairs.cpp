#include "solver/ground/tied_pairs.hpp"

#include "geometry/boxes/box.hpp"

namespace ashlar {

TieRequest automatic_tie(int a, int b, const StiffnessSource& source_a, const StiffnessSource& source_b) {
  return {a, b, automatic_tie_stiffness(source_a, source_b)};
}

bool have_common_face(const BlockModel& a, const BlockModel& b) {
  const Box first = box_of(a.solid().mesh().points), second = box_of(b.solid().mesh().points);
  if (!first.meets(second)) return false;
  return tie_between(a.solid(), a.basis(), b.solid(), b.basis()).area > 0.0;
}

}  // namespace ashlar
