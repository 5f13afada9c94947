#include "geometry/contact_type.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace ashlar::contact_type_test {
namespace {

TEST(ContactType, NamesBothDimensionsTheSmallerFirst) {
  const std::string letters = "VEF";
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      const std::string name = {letters[std::min(a, b)], '-', letters[std::max(a, b)]};
      EXPECT_EQ(to_string(contact_type(a, b)), name);
    }
  }
  EXPECT_EQ(to_string(ContactType::crossing), "crossing");
  for (const int other : {-1, 3}) EXPECT_THROW((void)contact_type(0, other), std::logic_error);
}

TEST(ContactType, PairsNameTheFeatureOfTheFirstSolidFirst) {
  const std::string letters = "VEFS";
  for (int a = 0; a < 4; ++a) {
    for (int b = 0; b < 4; ++b) {
      // Vertices of a region are corners, or corners of their projections: of edges that cross or pierce a face.
      if (a + b > 3) {
        EXPECT_THROW((void)pair_kind(a, b), std::logic_error) << a << b;
      } else {
        EXPECT_EQ(to_string(pair_kind(a, b)), (std::string{letters[a], '-', letters[b]}));
      }
    }
  }
}

TEST(ContactType, RelationsHaveNames) {
  EXPECT_EQ(to_string(Relation::apart), "apart");
  EXPECT_EQ(to_string(Relation::touching), "touching");
  EXPECT_EQ(to_string(Relation::crossing), "crossing");
}

}  // namespace
}  // namespace ashlar::contact_type_test
