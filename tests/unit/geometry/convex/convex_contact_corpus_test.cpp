// Every field of the public contact cases (data/corpora/contact_cases.jsonl), whose exact answers were
// computed by an independent rational program from the definition.
#include <gmp.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <tuple>

#include "geometry/convex/convex_contact.hpp"

namespace ashlar::convex_contact_corpus_test {
namespace {

using Json = nlohmann::json;
using Triple = std::array<double, 3>;

double hexadecimal(const Json& text) {
  return std::strtod(text.get<std::string>().c_str(), nullptr);
}

TriangleMesh mesh_of(const Json& solid) {
  TriangleMesh mesh;
  for (const Json& v : solid["v"])
    mesh.points.emplace_back(hexadecimal(v[0]), hexadecimal(v[1]), hexadecimal(v[2]));
  for (const Json& f : solid["f"]) mesh.triangles.push_back({f[0], f[1], f[2]});
  return mesh;
}

ConvexShape shape_of(const Json& json, bool triangle) {
  const TriangleMesh mesh = mesh_of(json);
  if (!triangle) return ConvexShape::from_mesh(mesh);
  const auto& f = mesh.triangles[0];  // carriers are named by the position in f
  return ConvexShape::from_triangle(mesh.points[f[0]], mesh.points[f[1]], mesh.points[f[2]]);
}

struct Rational {
  mpq_t q;
  Rational() { mpq_init(q); }
  ~Rational() { mpq_clear(q); }
  Rational(const Rational&) = delete;
  Rational& operator=(const Rational&) = delete;
};

// No double is nearer to the fraction than x.
bool is_nearest(double x, const std::string& fraction) {
  Rational exact, distance, other;
  mpq_set_str(exact.q, fraction.c_str(), 10);
  mpq_canonicalize(exact.q);
  mpq_set_d(distance.q, x);
  mpq_sub(distance.q, distance.q, exact.q);
  mpq_abs(distance.q, distance.q);
  for (const double neighbour : {std::nextafter(x, -INFINITY), std::nextafter(x, INFINITY)}) {
    mpq_set_d(other.q, neighbour);
    mpq_sub(other.q, other.q, exact.q);
    mpq_abs(other.q, other.q);
    if (mpq_cmp(distance.q, other.q) > 0) return false;
  }
  return true;
}

// Vertices of a region with their pair of carriers.
using PointSet = std::multiset<std::tuple<Triple, Triple, int, int>>;

Triple triple(const Vector3& v) {
  return {v[0] + 0.0, v[1] + 0.0, v[2] + 0.0};
}
Triple triple(const Json& v) {
  return {v[0].get<double>() + 0.0, v[1].get<double>() + 0.0, v[2].get<double>() + 0.0};
}

PointSet points_of(const ContactRegion& region, bool with_pairs) {
  PointSet points;
  for (const RegionVertex& p : region.points)
    points.emplace(triple(p.on_a), triple(p.on_b), with_pairs ? p.a.dimension : 0,
                   with_pairs ? p.b.dimension : 0);
  return points;
}

PointSet expected_points(const Json& on_a, const Json& on_b, const Json* pairs) {
  PointSet points;
  for (std::size_t k = 0; k < on_a.size(); ++k)
    points.emplace(triple(on_a[k]), triple(on_b[k]), pairs ? (*pairs)[k][0].get<int>() : 0,
                   pairs ? (*pairs)[k][1].get<int>() : 0);
  return points;
}

std::set<int> corners_of(const ConvexShape& shape, const ContactFeature& f) {
  std::set<int> corners;
  const auto add = [&](int v) { corners.insert(shape.source_points()[v]); };
  if (f.dimension == 0) add(f.index);
  if (f.dimension == 1)
    for (const int v : shape.edges()[f.index].corners) add(v);
  if (f.dimension == 2)
    for (const int v : shape.facet(f.index)) add(v);
  if (f.dimension == 3)
    for (int v = 0; v < static_cast<int>(shape.corners().size()); ++v) add(v);
  return corners;
}

// "E12" -> {1, 2}, [0, 1] -> {0, 1}.
std::set<int> expected_corners(const Json& carrier) {
  std::set<int> corners;
  if (carrier.is_array())
    for (const Json& v : carrier) corners.insert(v.get<int>());
  else
    for (const char c : carrier.get<std::string>().substr(1)) corners.insert(c - '0');
  return corners;
}

std::string ordered(const ContactRegion& region) {
  if (region.dimension == 3) return "crossing";
  return {"VEF"[region.a_dimension], "VEF"[region.b_dimension]};
}

void check_polyhedron_region(const ContactRegion& region, const ConvexShape& a, const ConvexShape& b,
                             const Json& expected) {
  EXPECT_EQ(to_string(region.type), expected["type"].get<std::string>());
  EXPECT_EQ(ordered(region), expected["ordered"].get<std::string>());
  EXPECT_EQ(region.dimension, expected["dim"].get<int>());
  EXPECT_EQ(corners_of(a, region.a), expected_corners(expected["carrierA_vertices"]));
  EXPECT_EQ(corners_of(b, region.b), expected_corners(expected["carrierB_vertices"]));
  EXPECT_EQ(points_of(region, true),
            expected_points(expected["region_on_A"]["double"], expected["region_on_B"]["double"],
                            &expected["point_carrier_dims"]));
}

void check_depth(const ConvexContact& contact, const ConvexShape& a, const ConvexShape& b,
                 const Json& expected) {
  EXPECT_TRUE(is_nearest(contact.squared_depth, expected["squared_depth"].get<std::string>()));
  const Json& translations = expected["minimal_translations"];
  ASSERT_EQ(contact.minimal_translations.size(), translations.size());
  std::set<std::size_t> used;
  for (const MinimalTranslation& found : contact.minimal_translations)
    for (std::size_t k = 0; k < translations.size(); ++k) {
      const Json& exact = translations[k]["translation_of_A"];
      bool same = true;
      for (int i = 0; i < 3; ++i)
        same = same && is_nearest(found.translation[i], exact[i].get<std::string>());
      if (!same || !used.insert(k).second) continue;
      check_polyhedron_region(found.region, a, b, translations[k]);
      break;
    }
  EXPECT_EQ(used.size(), translations.size());
}

void check_case(const Json& json) {
  SCOPED_TRACE(json["id"].get<std::string>() + " " + json["family"].get<std::string>() + " " +
               json["gap"].get<std::string>() + " " + json["transform"].get<std::string>());
  const bool triangle = json["kind"] == "tri";
  const ConvexShape a = shape_of(json["A"], triangle), b = shape_of(json["B"], triangle);
  const ConvexContact contact = classify(a, b);
  const Json& expected = json["expected"];
  EXPECT_EQ(to_string(contact.type()), expected["type"].get<std::string>());
  EXPECT_EQ(contact.relation == Relation::apart, !expected["intersect"].get<bool>());
  EXPECT_EQ(contact.relation == Relation::crossing, expected["type"] == "crossing");
  EXPECT_EQ(contact.squared_distance, hexadecimal(expected["squared_distance_double"]));
  EXPECT_TRUE(is_nearest(contact.squared_distance, expected["squared_distance"].get<std::string>()));
  if (triangle) {
    EXPECT_EQ(ordered(contact.region), expected["ordered"].get<std::string>());
    EXPECT_EQ(contact.region.dimension, expected["dim"].get<int>());
    EXPECT_EQ(corners_of(a, contact.region.a), expected_corners(expected["carrierA"]));
    EXPECT_EQ(corners_of(b, contact.region.b), expected_corners(expected["carrierB"]));
    EXPECT_EQ(points_of(contact.region, false),
              expected_points(expected["region_on_A_double"], expected["region_on_B_double"], nullptr));
  } else {
    check_polyhedron_region(contact.region, a, b, expected);
    if (contact.relation == Relation::crossing) check_depth(contact, a, b, expected);
  }
}

TEST(ConvexContactCorpus, EveryFieldOfEveryCase) {
  std::ifstream file(ASHLAR_DATA_DIR "/corpora/contact_cases.jsonl");
  int count = 0;
  for (std::string line; std::getline(file, line); ++count) check_case(Json::parse(line));
  EXPECT_EQ(count, 400);
}

}  // namespace
}  // namespace ashlar::convex_contact_corpus_test
