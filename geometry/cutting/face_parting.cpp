#include "geometry/cutting/face_parting.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "geometry/cutting/flat_view.hpp"
#include "geometry/cutting/plane_regions.hpp"

namespace ashlar {
namespace {

class FaceParting {
 public:
  FaceParting(CellComplex& complex, int face, int plane)
      : complex_(complex),
        face_(face),
        plane_(plane),
        own_(complex.face(face).plane),
        view_(complex.plane(own_)) {}

  void part() {
    const std::vector<int> edges = complex_.face(face_).edges;
    for (const int edge : edges) {
      const auto [from, to] = complex_.edge(edge).points;
      if (side(from) * side(to) < 0) complex_.divide_edge(edge, plane_);
    }
    sort_sides();
    find_line();
    add_sides_on_line();
    add_new_sides();
    std::vector<FaceOutline> outlines = plane_regions(complex_, complex_.plane(own_), below_);
    for (FaceOutline& outline : plane_regions(complex_, complex_.plane(own_), above_))
      outlines.push_back(std::move(outline));
    complex_.divide_face(face_, std::move(outlines));
  }

 private:
  /// A point in the plane, with the numbers of sides that go up and down from it.
  struct LinePoint {
    int point, up = 0, down = 0;
  };

  [[nodiscard]] int side(int point) const { return complex_.side(plane_, point); }
  [[nodiscard]] const ExactPoint& at(int point) const { return complex_.point(point).place; }

  void sort_sides() {
    for (const OutlineSide& of : sides_of(complex_.face(face_))) {
      const int where = side(of.from) + side(of.to);
      (where > 0 ? above_ : where < 0 ? below_ : on_line_).push_back(of);
    }
  }

  /// Sorts the points along the line.
  void find_line() {
    std::map<int, LinePoint> points;
    const auto count = [&](int point, int other) {
      LinePoint& of = points.emplace(point, LinePoint{point}).first->second;
      (side(other) > 0 ? of.up : of.down) += 1;
    };
    for (const std::vector<OutlineSide>* sides : {&above_, &below_}) {
      for (const OutlineSide& of : *sides) {
        if (side(of.from) == 0) count(of.from, of.to);
        if (side(of.to) == 0) count(of.to, of.from);
      }
    }
    for (const OutlineSide& of : on_line_)
      for (const int point : {of.from, of.to}) points.emplace(point, LinePoint{point});
    for (const auto& [point, of] : points) line_.push_back(of);
    std::sort(line_.begin(), line_.end(), [&](const LinePoint& a, const LinePoint& b) {
      return view_.compare(at(a.point), at(b.point)) < 0;
    });
    const OutlineSide& up = above_.front();
    const int high = side(up.from) > 0 ? up.from : up.to;
    above_is_left_ = view_.turn(at(line_.front().point), at(line_.back().point), at(high)) > 0;
  }

  /// The face is to the left of its own sides.
  void add_sides_on_line() {
    for (const OutlineSide& of : on_line_) {
      const bool onward = view_.compare(at(of.from), at(of.to)) < 0;
      (onward == above_is_left_ ? above_ : below_).push_back(of);
    }
  }

  /// Along the line, just above it and just below, the parity of the sides met so far determines the inside.
  void add_new_sides() {
    std::set<std::pair<int, int>> there;
    for (const OutlineSide& of : on_line_) there.insert(std::minmax(of.from, of.to));
    bool above = false, below = false;
    for (std::size_t k = 0; k + 1 < line_.size(); ++k) {
      above = above != (line_[k].up % 2 == 1);
      below = below != (line_[k].down % 2 == 1);
      int from = line_[k].point, to = line_[k + 1].point;
      if (!above || !below || there.contains(std::minmax(from, to))) continue;
      const int edge = complex_.add_edge(from, to, {own_, plane_});
      if (!above_is_left_) std::swap(from, to);
      above_.push_back({from, to, edge});
      below_.push_back({to, from, edge});
    }
  }

  CellComplex& complex_;
  int face_, plane_, own_;
  FlatView view_;
  std::vector<OutlineSide> above_, below_, on_line_;
  std::vector<LinePoint> line_;
  bool above_is_left_ = true;
};

}  // namespace

void part_face(CellComplex& complex, int face, int plane) {
  if (complex.face(face).convex)
    complex.divide_convex_face(face, plane);
  else
    FaceParting(complex, face, plane).part();
}

}  // namespace ashlar
