#include "apps/scene/model/scene_places.hpp"

#include <type_traits>
#include <utility>
#include <vector>

namespace ashlar {

std::string ScenePlaces::origin_of(std::string path) const {
  for (bool found = true; found;) {
    found = false;
    if (origins_.empty() || (places_.contains(path) && !origins_.contains(path))) break;
    for (std::size_t end = path.size(); end != std::string::npos && end > 0; end = path.rfind('.', end - 1)) {
      const auto origin = origins_.find(path.substr(0, end));
      if (origin == origins_.end()) continue;
      path = origin->second + path.substr(end);
      found = true;
      break;
    }
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
  const auto move = [&](auto& paths) {
    std::vector<typename std::remove_reference_t<decltype(paths)>::node_type> moved;
    for (auto at = paths.lower_bound(start); at != paths.end() && at->first.starts_with(start);)
      moved.push_back(paths.extract(at++));
    for (auto& node : moved) {
      node.key() = folder + node.key().substr(list.size());
      paths.insert(std::move(node));
    }
  };
  move(places_);
  move(origins_);
}

}  // namespace ashlar
