// The oracle against the corpus: 400 pairs whose answers were computed by another rational program. All
// comparisons are between fractions, except the ones that check the rounding itself.
#include "oracle/exact_oracle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

namespace ashlar::oracle::oracle_test {
namespace {

using Json = nlohmann::json;

Shape read_shape(const Json& json) {
  Shape shape;
  for (const Json& v : json.at("v")) {
    Point& point = shape.points.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) point[k] = std::strtod(v.at(k).get<std::string>().c_str(), nullptr);
  }
  for (const Json& f : json.at("f")) shape.triangles.push_back(f.get<std::array<int, 3>>());
  return shape;
}

mpq_class read_fraction(const Json& json) {
  return mpq_class(json.get<std::string>());
}

RationalVector read_vector(const Json& json) {
  return {read_fraction(json.at(0)), read_fraction(json.at(1)), read_fraction(json.at(2))};
}

std::set<RationalVector> read_region(const Json& json) {
  std::set<RationalVector> region;
  for (const Json& point : json.is_array() ? json : json.at("exact")) region.insert(read_vector(point));
  return region;
}

std::string ordered_name(const ExactContact& contact) {
  const std::string letters = "VEF";
  return {letters.at(static_cast<std::size_t>(contact.p_dimension)),
          letters.at(static_cast<std::size_t>(contact.q_dimension))};
}

/// "E12" of the triangle [2, 1, 0] -> {0, 1}: the corpus counts a triangle's corners in the order of its
/// face.
std::vector<int> read_carrier(const std::string& name, const Json& shape) {
  std::vector<int> corners;
  for (const char digit : name.substr(1)) corners.push_back(shape.at("f").at(0).at(digit - '0'));
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// The fields that both a pair and a pair after its minimal translation have.
void expect_contact(const ExactContact& contact, const Json& expected) {
  EXPECT_EQ(type_name(contact), expected.at("type"));
  if (expected.at("type") != "crossing") {
    EXPECT_EQ(ordered_name(contact), expected.at("ordered"));
  }
  EXPECT_EQ(contact.region_dimension, expected.at("dim"));
  std::set<RationalVector> on_p;
  std::set<RationalVector> on_q;
  for (const RegionPoint& point : contact.region) {
    on_p.insert(point.on_p);
    on_q.insert(point.on_q);
  }
  EXPECT_EQ(on_p.size(), contact.region.size()) << "a point is listed twice";
  EXPECT_EQ(on_p, read_region(expected.at("region_on_A")));
  EXPECT_EQ(on_q, read_region(expected.at("region_on_B")));
  if (expected.contains("carrierA_vertices")) {
    EXPECT_EQ(contact.p_carrier, expected.at("carrierA_vertices").get<std::vector<int>>());
    EXPECT_EQ(contact.q_carrier, expected.at("carrierB_vertices").get<std::vector<int>>());
  }
  if (!expected.contains("point_carrier_dims")) return;
  const Json& exact = expected.at("region_on_A").at("exact");
  for (std::size_t i = 0; i < exact.size(); ++i) {
    for (const RegionPoint& point : contact.region) {
      if (point.on_p != read_vector(exact[i])) continue;
      EXPECT_EQ(point.p_dimension, expected.at("point_carrier_dims").at(i).at(0));
      EXPECT_EQ(point.q_dimension, expected.at("point_carrier_dims").at(i).at(1));
    }
  }
}

void expect_depth(const ExactAnswer& answer, const Json& expected) {
  EXPECT_EQ(answer.squared_depth, read_fraction(expected.at("squared_depth")));
  ASSERT_EQ(answer.minimal_translations.size(), expected.at("minimal_translations").size());
  for (const Json& translation : expected.at("minimal_translations")) {
    const RationalVector vector = read_vector(translation.at("translation_of_A"));
    const auto match =
        std::find_if(answer.minimal_translations.begin(), answer.minimal_translations.end(),
                     [&](const ExactContact& contact) { return contact.translation == vector; });
    ASSERT_NE(match, answer.minimal_translations.end());
    expect_contact(*match, translation);
  }
}

TEST(ExactOracle, ReproducesTheCorpus) {
  std::ifstream file(ASHLAR_DATA_DIR "/corpora/contact_cases.jsonl");
  int cases = 0;
  for (std::string line; std::getline(file, line);) {
    const Json json = Json::parse(line);
    SCOPED_TRACE(json.at("id").get<std::string>());
    const Json& expected = json.at("expected");
    const ExactAnswer answer = classify_exactly(read_shape(json.at("A")), read_shape(json.at("B")));
    expect_contact(answer.contact, expected);
    EXPECT_EQ(answer.contact.intersecting, expected.at("intersect").get<bool>());
    EXPECT_EQ(answer.contact.squared_distance, read_fraction(expected.at("squared_distance")));
    EXPECT_EQ(round_to_double(answer.contact.squared_distance),
              std::strtod(expected.at("squared_distance_double").get<std::string>().c_str(), nullptr));
    const Json& rounded = expected.contains("region_on_A_double") ? expected.at("region_on_A_double")
                                                                  : expected.at("region_on_A").at("double");
    std::set<Point> rounded_region;
    for (const RegionPoint& point : answer.contact.region) {
      rounded_region.insert(
          {round_to_double(point.on_p[0]), round_to_double(point.on_p[1]), round_to_double(point.on_p[2])});
    }
    EXPECT_EQ(rounded_region, rounded.get<std::set<Point>>());
    if (expected.contains("carrierA")) {
      EXPECT_EQ(answer.contact.p_carrier, read_carrier(expected.at("carrierA"), json.at("A")));
      EXPECT_EQ(answer.contact.q_carrier, read_carrier(expected.at("carrierB"), json.at("B")));
    }
    if (expected.contains("squared_depth")) expect_depth(answer, expected);
    ++cases;
  }
  EXPECT_EQ(cases, 400);
}

TEST(ExactOracle, RefusesWhatIsNotConvexOrHasNoArea) {
  const Shape flat{{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {{0, 1, 2}}};
  const Shape corner{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                     {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  Shape inside_out = corner;
  for (auto& t : inside_out.triangles) std::swap(t[0], t[1]);
  EXPECT_THROW((void)classify_exactly(flat, corner), std::invalid_argument);
  EXPECT_THROW((void)classify_exactly(corner, inside_out), std::invalid_argument);
}

TEST(RoundToDouble, IsNearestWithTiesToEven) {
  const auto power = [](int e) { return mpq_class(mpz_class(1) << static_cast<unsigned long>(e)); };
  EXPECT_EQ(round_to_double(mpq_class(1, 3)), 1.0 / 3.0);
  EXPECT_EQ(round_to_double(mpq_class(-2, 3)), -2.0 / 3.0);
  EXPECT_EQ(round_to_double(power(53) + 1), std::ldexp(1.0, 53));
  EXPECT_EQ(round_to_double(power(53) + 3), std::ldexp(1.0, 53) + 4.0);
  EXPECT_EQ(round_to_double(power(54) - 1), std::ldexp(1.0, 54));
  EXPECT_EQ(round_to_double((power(54) + 2) + 1 / power(200)), std::ldexp(1.0, 54) + 4.0);
  EXPECT_EQ(round_to_double(1 / power(1074)), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(round_to_double(1 / power(1075)), 0.0);
  EXPECT_EQ(round_to_double(3 / power(1075)), 2 * std::numeric_limits<double>::denorm_min());
}

TEST(RoundQuotientByRoot, IsNearest) {
  EXPECT_EQ(round_quotient_by_root(3, 25), 0.6);
  EXPECT_EQ(round_quotient_by_root(-4, 25), -0.8);
  EXPECT_EQ(round_quotient_by_root(0, 7), 0.0);
  // sqrt is correctly rounded by IEEE 754, and 1/4 keeps it so.
  EXPECT_EQ(round_quotient_by_root(1, 8), std::sqrt(2.0) / 4);
  EXPECT_EQ(round_quotient_by_root(3, 48), std::sqrt(3.0) / 4);
  EXPECT_EQ(round_quotient_by_root(5, 80), std::sqrt(5.0) / 4);
}

TEST(SeparatingNormals, PointFromQToP) {
  const Shape corner{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                     {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  Shape below = corner;
  for (Point& point : below.points) point[2] -= 1.0;  // its top corner is the origin
  const auto normals = separating_normals(corner, below);
  EXPECT_NE(std::find(normals.begin(), normals.end(), RationalVector{0, 0, 1}), normals.end());
  EXPECT_EQ(std::find(normals.begin(), normals.end(), RationalVector{0, 0, -1}), normals.end());
  EXPECT_TRUE(separating_normals(corner, corner).empty());
}

}  // namespace
}  // namespace ashlar::oracle::oracle_test
