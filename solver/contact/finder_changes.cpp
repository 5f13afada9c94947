// Blocks and settings of a ContactFinder that change between steps.
#include "geometry/index.hpp"
#include "geometry/solid/face_axes.hpp"
#include "geometry/solid/rounded_convexity.hpp"
#include "solver/contact/contact_finder.hpp"

namespace ashlar {

void ContactFinder::renew(int block, const BlockModel& model, PairHistories& histories) {
  surfaces_[at(block)] = BlockSurface(model, settings_.search.subdivisions, axes_);
  placed_[at(block)].reset();
  tracks_[at(block)].box = Box{};
  for (auto& [blocks, pair] : histories) {
    if (blocks[0] != block && blocks[1] != block) continue;
    pair.clearance.reset();
    pair.cache.reset();
  }
}

void ContactFinder::set_presence(int block, const BlockModel& model, bool present, PairHistories& histories) {
  renew(block, model, histories);
  tracks_[at(block)] = {};
  absent_[at(block)] = !present;
  moving_[at(block)] = present && !model.fixed();
  thickness_[at(block)] = model.basis().volume() / surface_area(model.solid().mesh());
  convex_[at(block)] = !surfaces_[at(block)].surface().divided && is_convex_but_for_rounding(model.solid());
  sides_.set_fixed(block, present && model.fixed());
}

void ContactFinder::set_chord_tolerance(double tolerance, PairHistories& histories) {
  settings_.search.chord_tolerance = tolerance;
  for (auto& [blocks, pair] : histories) {
    pair.clearance.reset();
    pair.cache.reset();
  }
}

}  // namespace ashlar
