#include "geometry/exact/contact_direction.hpp"

#include <algorithm>

namespace ashlar {

ContactDirection::ContactDirection() = default;
ContactDirection::~ContactDirection() = default;
ContactDirection::ContactDirection(ContactDirection&&) noexcept = default;
ContactDirection& ContactDirection::operator=(ContactDirection&&) noexcept = default;

ContactDirection::ContactDirection(Kind kind, const Difference& first, const Difference& second)
    : kind_(kind), first_(first), second_(second) {
  numbers_.tracked = evaluate<TrackedNumber>();
  set_bound();
}

void ContactDirection::set_bound() {
  const auto largest = [&](auto part) {
    return std::max({part(numbers_.tracked.x), part(numbers_.tracked.y), part(numbers_.tracked.z)});
  };
  const double error = largest([](const TrackedNumber& n) { return n.error; });
  const double value = largest([](const TrackedNumber& n) { return std::abs(n.value); });
  numbers_.bound = (error + 8.0 * TrackedNumber::unit_roundoff * value) * (1.0 + 0x1p-20);
}

ContactDirection ContactDirection::along(const Difference& d) {
  return {Kind::difference, d, {}};
}
ContactDirection ContactDirection::cross(const Difference& e1, const Difference& e2) {
  return {Kind::cross, e1, e2};
}
ContactDirection ContactDirection::cross(const Difference& e1, const Difference& e2,
                                         const DirectionNumbers& numbers) {
  ContactDirection w;
  w.kind_ = Kind::cross;
  w.first_ = e1;
  w.second_ = e2;
  w.numbers_ = numbers;
  w.has_double_double_ = true;
  return w;
}
ContactDirection ContactDirection::rejection(const Difference& d, const Difference& e) {
  return {Kind::rejection, d, e};
}

ContactDirection ContactDirection::copy() const {
  ContactDirection result;
  result.kind_ = kind_;
  result.reversed_ = reversed_;
  result.first_ = first_;
  result.second_ = second_;
  result.numbers_ = numbers_;
  result.has_double_double_ = has_double_double_;
  return result;
}

void ContactDirection::reverse() {
  reversed_ = !reversed_;
  exact_.reset();
  if (has_double_double_) {
    NumberVector<DoubleDouble>& d = numbers_.double_double;
    d = {-d.x, -d.y, -d.z};
  }
  for (TrackedNumber* n : {&numbers_.tracked.x, &numbers_.tracked.y, &numbers_.tracked.z})
    n->value = -n->value;
}

void ContactDirection::compute_double_double() const {
  numbers_.double_double = evaluate<DoubleDouble>();
  has_double_double_ = true;
}

const DoubleDouble& ContactDirection::squared_length() const {
  if (!has_squared_length_) {
    squared_length_ = dot(double_double(), double_double());
    has_squared_length_ = true;
  }
  return squared_length_;
}

}  // namespace ashlar
