#include "apps/scene/scene_places.hpp"

#include <utility>
#include <vector>

namespace ashlar {

std::string ScenePlaces::origin_of(std::string path) const {
  if (origins_.empty() || (places_.contains(path) && !origins_.contains(path))) return path;
  // An origin is a path of what was read, which has no origin of its own.
  for (std::size_t end = path.size(); end != std::string::npos; end = path.rfind('.', end - 1)) {
    const auto found = origins_.find(path.substr(0, end));
    if (found != origins_.end()) return found->second + path.substr(end);
    if (end == 0) break;
  }
  return path;
}

ScenePlaces::KeyPlaces ScenePlaces::find(std::string path) const {
  path = origin_of(std::move(path));
  while (true) {
    const auto found = places_.find(path);
    if (found != places_.end()) return found->second;
    if (path.empty()) return {};
    const auto dot = path.rfind('.');
    path.erase(dot == std::string::npos ? 0 : dot);
  }
}

void ScenePlaces::move_list(const std::string& list, const std::string& folder) {
  const std::string start = list + ".";
  std::vector<std::pair<std::string, KeyPlaces>> moved;
  auto place = places_.lower_bound(start);
  while (place != places_.end() && place->first.starts_with(start)) {
    moved.emplace_back(folder + place->first.substr(list.size()), std::move(place->second));
    place = places_.erase(place);
  }
  for (auto& [path, places] : moved) places_[path] = std::move(places);
}

}  // namespace ashlar
