#include "benchmarks/studies/studies.hpp"

#include <array>

#include "benchmarks/studies/conditioning_study.hpp"
#include "benchmarks/studies/contact_study.hpp"
#include "benchmarks/studies/cost_study.hpp"
#include "benchmarks/studies/stability_study.hpp"
#include "benchmarks/studies/sub_face_study.hpp"

namespace ashlar {

std::span<const Study> developer_studies() {
  static constexpr std::array<Study, 5> all = {
      {{"subfaces", "chord error of sub-faces and its certified bound, by order and tolerance",
        without_progress<study_sub_faces>},
       {"conditioning", "condition and lost digits of monomial and orthonormal bases",
        without_progress<study_conditioning>},
       {"contact", "error of contact against time: sub-faces, springs, surface, kn, steps",
        without_progress<study_contact>},
       {"cost", "time and memory of a step against blocks and order, with exponents", study_cost},
       {"stability", "error far from ordinary orders, places, shapes, masses, stiffness, sizes and steps",
        without_progress<study_stability>}}};
  return all;
}

}  // namespace ashlar
