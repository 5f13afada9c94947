#include "apps/results/text/json_path.hpp"

#include <gtest/gtest.h>

namespace ashlar::json_path_test {
namespace {

using Json = nlohmann::ordered_json;

TEST(JsonPath, GoesByKeysNamesAndNumbers) {
  const Json json = {{"a", {{"b", 1}}},
                     {"a.b", {{"c", 2}}},
                     {"list", {{{"name", "pier 1"}, {"least", 3}}, {{"name", "0"}, {"least", 4}}}},
                     {"row", {5, 6}}};
  const auto value = [&](const char* path) {
    const Json* found = value_at(json, path);
    return found == nullptr ? Json("none") : *found;
  };
  EXPECT_EQ(value("a.b"), 1);
  EXPECT_EQ(value("a.b.c"), 2) << "keys may have dots";
  EXPECT_EQ(value("list.pier 1.least"), 3);
  EXPECT_EQ(value("list.1.least"), 4);
  EXPECT_EQ(value("list.0.least"), 4) << "a name goes before a number";
  EXPECT_EQ(value("row.1"), 6);
  for (const char* path : {"row.2", "row.-1", "list.x", "a.c", "row.1.2"})
    EXPECT_EQ(value(path), "none") << path;
}

}  // namespace
}  // namespace ashlar::json_path_test
