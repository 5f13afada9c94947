#include "apps/scene/scene_places.hpp"

namespace ashlar {

ScenePlaces::KeyPlaces ScenePlaces::find(std::string path) const {
  while (true) {
    const auto found = places_.find(path);
    if (found != places_.end()) return found->second;
    if (path.empty()) return {};
    const auto dot = path.rfind('.');
    path.erase(dot == std::string::npos ? 0 : dot);
  }
}

}  // namespace ashlar
