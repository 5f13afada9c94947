#include "apps/scene/survey_fit.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "geometry/solid/fitted_solids.hpp"

namespace ashlar {
namespace {

FitLimits limits_of(double fit) {
  constexpr double farthest = 10.0;  // of fit
  constexpr double same_way = 0.5;   // within 60 degrees
  constexpr double dependent = 1e-3;
  constexpr double rounding = 0x1p-46;
  return {fit, farthest * fit, same_way, dependent, rounding};
}

}  // namespace

void fit_to_survey(Scene& scene, std::vector<std::optional<Polyhedron>>& solids,
                   std::vector<std::shared_ptr<const Polyhedron>>& shapes, Diagnostics& diagnostics) {
  if (scene.contact.fit == 0.0 || !diagnostics.good()) return;
  const std::vector<std::optional<Polyhedron>> before = solids;
  try {
    const SolidFit fit = fit_solids(solids, limits_of(scene.contact.fit));
    for (std::size_t k = 0; k < solids.size(); ++k)
      if (solids[k] && solids[k]->mesh().points != before[k]->mesh().points)
        shapes[k] = std::make_shared<const Polyhedron>(*solids[k]);
    scene.notes.push_back(
        fmt::format("fit: {} corners of {} blocks moved by up to {:.3g} m, neighbours share {} "
                    "planes",
                    fit.corners, fit.solids, fit.farthest, fit.planes));
  } catch (const std::invalid_argument& error) {
    solids = before;
    diagnostics.error(scene.places.value("contact.fit"),
                      fmt::format("blocks cannot be fitted: {}", error.what()));
  }
}

}  // namespace ashlar
