#include "geometry/any_solid/face_polygon_overlap.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "geometry/any_solid/flat_projection.hpp"

namespace ashlar {

namespace {

void bound(const Coordinate& x, const Coordinate& y, double& low, double& high) {
  low = std::min(least_value(x.tracked), least_value(y.tracked));
  high = std::max(greatest_value(x.tracked), greatest_value(y.tracked));
}

// Intersection of a side with a feature of the other piece in an inner point of the side.
struct Cut {
  Rational t;            // from 0 to 1 along the side
  ContactFeature other;  // corner or edge
  int other_side;        // of an edge
};

// A part of a side that runs along a side of the other piece.
struct Shared {
  Rational from, to;
  bool same_sense;
  int other_side;
};

struct Side {
  int from, to;  // indices into the corners of the outline
  int edge;
  double low_u, high_u, low_v, high_v;
  std::vector<Cut> cuts;
  std::vector<Shared> shared;
};

// One of the two pieces with the data of both.
struct Outline {
  std::vector<PlanePoint> corners;
  std::vector<int> numbers;  // of the corners
  std::vector<Side> sides;
  std::vector<ContactFeature> met;  // by corner: corner or edge of the other piece at it, or dimension -1
  int face;

  Outline(const FlatPiece& piece, const FlatProjection& projection, bool floating) : face(piece.face) {
    std::map<int, int> index;
    const auto add = [&](int v) {
      const auto [entry, is_new] = index.emplace(v, static_cast<int>(corners.size()));
      if (is_new) {
        corners.push_back(projection((*piece.points)[v]));
        numbers.push_back(v);
      }
      return entry->second;
    };
    for (const FlatSide& side : piece.sides) {
      const int from = add(side.from), to = add(side.to);
      constexpr double infinity = std::numeric_limits<double>::infinity();
      sides.push_back({from, to, side.edge, -infinity, infinity, -infinity, infinity, {}, {}});
    }
    met.resize(corners.size());
    if (floating)
      for (Side& side : sides) {
        bound(corners[side.from].u, corners[side.to].u, side.low_u, side.high_u);
        bound(corners[side.from].v, corners[side.to].v, side.low_v, side.high_v);
      }
  }
  [[nodiscard]] const PlanePoint& start(const Side& s) const { return corners[s.from]; }
  [[nodiscard]] const PlanePoint& end(const Side& s) const { return corners[s.to]; }
  /// Position of a point of a side's line, 0 at its start, 1 at its end.
  [[nodiscard]] Rational position(const Side& s, const PlanePoint& x) const {
    const PlanePoint &p = start(s), &q = end(s);
    if (p.u.exact != q.u.exact) return Rational((x.u.exact - p.u.exact) / (q.u.exact - p.u.exact));
    return Rational((x.v.exact - p.v.exact) / (q.v.exact - p.v.exact));
  }
  [[nodiscard]] PlanePoint at(const Side& s, const Rational& t) const {
    const PlanePoint &p = start(s), &q = end(s);
    return {coordinate(Rational(p.u.exact + t * (q.u.exact - p.u.exact)), false),
            coordinate(Rational(p.v.exact + t * (q.v.exact - p.v.exact)), false)};
  }
};

// The signs of four turns determine how two sides meet.
void meet(Outline& a, int i, Outline& b, int k, const PlaneSigns& signs) {
  Side &s = a.sides[i], &t = b.sides[k];
  if (s.high_u < t.low_u || t.high_u < s.low_u || s.high_v < t.low_v || t.high_v < s.low_v) return;
  const PlanePoint &p = a.start(s), &q = a.end(s), &x = b.start(t), &y = b.end(t);
  const int turn_x = signs.turn(p, q, x), turn_y = signs.turn(p, q, y);
  if (turn_x * turn_y > 0) return;
  const int turn_p = signs.turn(x, y, p), turn_q = signs.turn(x, y, q);
  if (turn_p * turn_q > 0) return;
  const auto corner = [](const Outline& o, int c) { return ContactFeature{0, o.numbers[c]}; };
  if (turn_x * turn_y < 0 && turn_p * turn_q < 0) {
    const Rational height_p((y.u.exact - x.u.exact) * (p.v.exact - x.v.exact) -
                            (y.v.exact - x.v.exact) * (p.u.exact - x.u.exact));
    const Rational height_q((y.u.exact - x.u.exact) * (q.v.exact - x.v.exact) -
                            (y.v.exact - x.v.exact) * (q.u.exact - x.u.exact));
    const Rational on_s(height_p / (height_p - height_q));
    const PlanePoint crossing = a.at(s, on_s);
    s.cuts.push_back({on_s, {1, t.edge}, k});
    t.cuts.push_back({b.position(t, crossing), {1, s.edge}, i});
    return;
  }
  const bool collinear = turn_x == 0 && turn_y == 0;
  // Corners of one side on the other one, at its ends or between them.
  const auto note = [&](Outline& own, Side& side, Outline& other, int c) {
    const PlanePoint& z = other.corners[c];
    for (const int end : {side.from, side.to}) {
      const PlanePoint& e = own.corners[end];
      if (signs.compare(z.u, e.u) == 0 && signs.compare(z.v, e.v) == 0) {
        own.met[end] = corner(other, c);
        other.met[c] = corner(own, end);
        return;
      }
    }
    if (!signs.is_between(own.start(side), own.end(side), z)) return;
    side.cuts.push_back({own.position(side, z), corner(other, c), -1});
    if (other.met[c].dimension != 0) other.met[c] = {1, side.edge};
  };
  if (turn_x == 0) note(a, s, b, t.from);
  if (turn_y == 0) note(a, s, b, t.to);
  if (turn_p == 0) note(b, t, a, s.from);
  if (turn_q == 0) note(b, t, a, s.to);
  if (!collinear) return;
  const auto share = [](const Outline& own, Side& side, const PlanePoint& from, const PlanePoint& to,
                        int other_side) {
    Rational low = own.position(side, from), high = own.position(side, to);
    const bool same_sense = low < high;
    if (!same_sense) std::swap(low, high);
    low = std::max(low, Rational(0));
    high = std::min(high, Rational(1));
    if (low < high) side.shared.push_back({low, high, same_sense, other_side});
  };
  share(a, s, x, y, k);
  share(b, t, p, q, i);
}

// By the parity of the sides above. @param x not on a side.
bool is_inside(const Outline& face, const PlanePoint& x, const PlaneSigns& signs) {
  const double low = least_value(x.v.tracked), high = greatest_value(x.v.tracked);
  bool inside = false;
  for (const Side& side : face.sides) {
    if (side.high_v < low || side.low_v > high) continue;
    const PlanePoint &p = face.start(side), &q = face.end(side);
    const bool p_above = signs.compare(p.v, x.v) > 0, q_above = signs.compare(q.v, x.v) > 0;
    if (p_above == q_above) continue;
    if (signs.turn(p, q, x) == (q_above ? 1 : -1)) inside = !inside;
  }
  return inside;
}

// A part of a side between two neighbouring cuts, with its points of the outline.
struct RimPiece {
  int start, end;
};

class Overlay {
 public:
  Overlay(const FlatSetting& setting, const FlatPiece& a, const FlatPiece& b, DecisionCounts& counts)
      : projection_(setting.direction, setting.coplanar),
        signs_(setting.floating, counts),
        given_a_(a),
        given_b_(b),
        a_(a, projection_, setting.floating),
        b_(b, projection_, setting.floating) {
    for (int i = 0; i < static_cast<int>(a_.sides.size()); ++i)
      for (int k = 0; k < static_cast<int>(b_.sides.size()); ++k) meet(a_, i, b_, k, signs_);
  }

  FlatOverlap faces() {
    for (Side& side : a_.sides) add_pieces(a_, side, b_, false);
    for (Side& side : b_.sides) add_pieces(b_, side, a_, true);
    FlatOverlap result;
    Rational twice_area(0);
    for (const RimPiece& piece : rim_) {
      const PlanePoint &p = points_[piece.start].place, &q = points_[piece.end].place;
      const PlanePoint& o = points_[rim_[0].start].place;
      twice_area += (p.u.exact - o.u.exact) * (q.v.exact - o.v.exact) -
                    (p.v.exact - o.v.exact) * (q.u.exact - o.u.exact);
    }
    result.squared_area = twice_area * twice_area * projection_.squared_scale() / 4;
    std::vector<std::vector<int>> neighbours(points_.size());
    for (const RimPiece& piece : rim_) {
      neighbours[piece.start].push_back(piece.end);
      neighbours[piece.end].push_back(piece.start);
    }
    for (std::size_t k = 0; k < points_.size(); ++k) {
      closure_.emplace_back(points_[k].a, points_[k].b);
      if (neighbours[k].size() == 2 && is_straight(neighbours[k][0], static_cast<int>(k), neighbours[k][1]))
        continue;
      result.vertices.push_back(output(points_[k]));
    }
    result.closure = std::move(closure_);
    return result;
  }

  FlatOverlap edge() {
    has_left_ = false;
    add_pieces(a_, a_.sides[0], b_, false);
    FlatOverlap result;
    // Neighbouring pieces are one segment: the cut between them only touches the edge.
    for (std::size_t k = 0; k < rim_.size(); ++k) {
      if (k == 0 || rim_[k - 1].end != rim_[k].start)
        result.vertices.push_back(output(points_[rim_[k].start]));
      if (k + 1 == rim_.size() || rim_[k + 1].start != rim_[k].end)
        result.vertices.push_back(output(points_[rim_[k].end]));
    }
    for (const RimPoint& p : points_) result.closure.emplace_back(p.a, p.b);
    return result;
  }

 private:
  struct RimPoint {
    ContactFeature a, b;
    int a_side, b_side;  // sides where the features of dimension 1 were met
    PlanePoint place;
  };

  [[nodiscard]] bool is_straight(int p, int x, int q) const {
    const PlanePoint &before = points_[p].place, &at = points_[x].place, &after = points_[q].place;
    return signs_.turn(before, at, after) == 0 && signs_.is_between(before, after, at);
  }

  // For pieces on both outlines those of A are used.
  void add_pieces(Outline& own, Side& side, const Outline& other, bool own_is_b) {
    std::sort(side.cuts.begin(), side.cuts.end(), [](const Cut& x, const Cut& y) { return x.t < y.t; });
    side.cuts.erase(std::unique(side.cuts.begin(), side.cuts.end(),
                                [](const Cut& x, const Cut& y) { return x.t == y.t; }),
                    side.cuts.end());
    const int side_index = static_cast<int>(&side - own.sides.data());
    Rational from(0);
    for (std::size_t k = 0; k <= side.cuts.size(); ++k) {
      const Rational to = k < side.cuts.size() ? side.cuts[k].t : Rational(1);
      const Rational middle = (from + to) / 2;
      const Shared* shared = shared_at(side, middle);
      const bool is_rim = shared != nullptr ? shared->same_sense && !own_is_b && has_left_
                                            : is_inside(other, own.at(side, middle), signs_);
      if (is_rim) {
        const ContactFeature edge{1, side.edge};
        const ContactFeature over = shared != nullptr
                                        ? ContactFeature{1, other.sides[shared->other_side].edge}
                                        : ContactFeature{2, other.face};
        closure_.emplace_back(own_is_b ? over : edge, own_is_b ? edge : over);
        const int start = k == 0 ? corner_point(own, side.from, other, own_is_b)
                                 : cut_point(own, side, side.cuts[k - 1], side_index, own_is_b);
        const int end = k == side.cuts.size() ? corner_point(own, side.to, other, own_is_b)
                                              : cut_point(own, side, side.cuts[k], side_index, own_is_b);
        rim_.push_back({start, end});
      }
      from = to;
    }
  }
  static const Shared* shared_at(const Side& side, const Rational& t) {
    const auto found = std::find_if(side.shared.begin(), side.shared.end(),
                                    [&](const Shared& s) { return s.from < t && t < s.to; });
    return found == side.shared.end() ? nullptr : &*found;
  }
  int corner_point(const Outline& own, int c, const Outline& other, bool own_is_b) {
    const ContactFeature corner{0, own.numbers[c]};
    const ContactFeature over = own.met[c].dimension >= 0 ? own.met[c] : ContactFeature{2, other.face};
    const int over_side = over.dimension == 1 ? side_of(other, over.index, own.corners[c]) : -1;
    return point(corner, -1, over, over_side, own.corners[c], own_is_b);
  }
  int cut_point(const Outline& own, const Side& side, const Cut& cut, int side_index, bool own_is_b) {
    const ContactFeature edge{1, side.edge};
    return point(edge, side_index, cut.other, cut.other_side, own.at(side, cut.t), own_is_b);
  }
  // An edge is one side of a face, unless both its faces are parts of a piece seen along another direction.
  [[nodiscard]] int side_of(const Outline& outline, int edge, const PlanePoint& x) const {
    for (int k = 0; k < static_cast<int>(outline.sides.size()); ++k) {
      const Side& side = outline.sides[k];
      if (side.edge == edge && signs_.turn(outline.start(side), outline.end(side), x) == 0) return k;
    }
    return -1;
  }
  int point(const ContactFeature& own, int own_side, const ContactFeature& other, int other_side,
            const PlanePoint& place, bool own_is_b) {
    const RimPoint p = own_is_b ? RimPoint{other, own, other_side, own_side, place}
                                : RimPoint{own, other, own_side, other_side, place};
    const auto key = std::array<int, 4>{p.a.dimension, p.a.index, p.b.dimension, p.b.index};
    const auto [entry, is_new] = point_of_.emplace(key, static_cast<int>(points_.size()));
    if (is_new) points_.push_back(p);
    return entry->second;
  }

  [[nodiscard]] OverlapPoint output(const RimPoint& p) const {
    return {p.a, p.b, in_space(given_a_, a_, p.a, p.a_side, p.place),
            in_space(given_b_, b_, p.b, p.b_side, p.place)};
  }
  static std::optional<RationalVector> in_space(const FlatPiece& given, const Outline& outline,
                                                const ContactFeature& feature, int side,
                                                const PlanePoint& place) {
    if (feature.dimension == 0) return to_rational((*given.points)[feature.index]);
    if (feature.dimension == 2) return std::nullopt;
    const FlatSide& s = given.sides[side];
    const RationalVector from = to_rational((*given.points)[s.from]), to = to_rational((*given.points)[s.to]);
    return sum(from, multiple(difference(to, from), outline.position(outline.sides[side], place)));
  }

  FlatProjection projection_;
  PlaneSigns signs_;
  const FlatPiece &given_a_, &given_b_;
  Outline a_, b_;
  bool has_left_ = true;                        // A is a face
  std::map<std::array<int, 4>, int> point_of_;  // by the features of a point
  std::vector<RimPoint> points_;
  std::vector<RimPiece> rim_;
  std::vector<FeaturePair> closure_;
};

}  // namespace

FlatOverlap overlap_faces(const FlatSetting& setting, const FlatPiece& a, const FlatPiece& b,
                          DecisionCounts& counts) {
  return Overlay(setting, a, b, counts).faces();
}

FlatOverlap overlap_edge(const FlatSetting& setting, const FlatPiece& a, const FlatPiece& b,
                         DecisionCounts& counts) {
  return Overlay(setting, a, b, counts).edge();
}

}  // namespace ashlar
