#include "apps/scene/import/poly_range.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/scene/toml/lower_case.hpp"
#include "geometry/mesh/text_scanner.hpp"

namespace ashlar {
namespace {

constexpr int most_named_in_named = 100;

}  // namespace

PolyRange::PolyRange(PolyStatement& statement, const Named& named) {
  while (!statement.done()) {
    Element element;
    if (statement.take_if("union", 3)) {
      any_ = true;
      continue;
    }
    if (statement.take_if("region", 3)) {
      do element.regions.push_back(statement.whole_number("region"));
      while (statement.at_number());
    } else if (statement.take_if("nrange", 3)) {
      do {
        const std::string name = lower_case(statement.take().text);
        const auto found = named.find(name);
        if (found == named.end())
          statement.fail(fmt::format("range before here ({}) is unknown, a name of `range name` is needed",
                                     printable(name)));
        element.named.push_back(found->second);
        depth_ = std::max(depth_, 1 + found->second->depth_);
      } while (!statement.done() && named.contains(lower_case(statement.front().text)));
    } else {
      const std::string axis = lower_case(statement.front().text);
      if (axis != "x" && axis != "y" && axis != "z")
        statement.fail(
            fmt::format("element of a range ({}) is not read, allowed are region, nrange, x, y, z and union",
                        printable(statement.front().text)));
      (void)statement.take();
      element.axis = axis.front() - 'x';
      element.low = statement.number("lower limit");
      element.high = statement.number("upper limit");
    }
    elements_.push_back(std::move(element));
  }
  if (depth_ > most_named_in_named)
    statement.fail(
        fmt::format("ranges name others {} deep, at most {} are allowed", depth_, most_named_in_named));
}

std::vector<bool> PolyRange::select(const std::vector<PolyPlace>& places) const {
  Selections made;
  return select(places, made);
}

const std::vector<bool>& PolyRange::select(const std::vector<PolyPlace>& places, Selections& made) const {
  if (const auto found = made.find(this); found != made.end()) return found->second;
  std::vector<bool> selected(places.size(), !any_);
  for (const Element& element : elements_) {
    std::vector<bool> in(places.size(), false);
    for (const auto& range : element.named) {
      const std::vector<bool>& other = range->select(places, made);
      for (std::size_t k = 0; k < in.size(); ++k) in[k] = in[k] || other[k];
    }
    for (std::size_t k = 0; k < in.size() && element.named.empty(); ++k) {
      const double along = places[k].centroid[element.axis];
      in[k] = element.regions.empty() ? along >= element.low && along <= element.high
                                      : std::find(element.regions.begin(), element.regions.end(),
                                                  places[k].region) != element.regions.end();
    }
    for (std::size_t k = 0; k < in.size(); ++k)
      selected[k] = any_ ? selected[k] || in[k] : selected[k] && in[k];
  }
  return made[this] = std::move(selected);
}

}  // namespace ashlar
