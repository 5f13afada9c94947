#include "apps/scene/model/nearest_name.hpp"

#include <gmock/gmock.h>

namespace ashlar::test::nearest_name_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(NearestName, EditDistanceCountsSingleChanges) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("abc", ""), 3u);
  EXPECT_EQ(edit_distance("order", "ordre"), 1u);     // swap of neighbours
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);  // two replacements, one insertion
  EXPECT_EQ(edit_distance("ca", "abc"), 3u);          // no change inside a swapped pair
  EXPECT_EQ(edit_distance("Young", "yOUNG"), 0u);
}

TEST(NearestName, TakesTheFirstOfEquals) {
  EXPECT_EQ(nearest_name("axc", {"abc", "adc"}), "abc");
  EXPECT_EQ(nearest_name("time_stp", {"end_time", "time_step", "type"}), "time_step");
  EXPECT_EQ(nearest_name("x", {}), "");
}

TEST(NearestName, KnowsShortForms) {
  // yung -> name needs 4 changes, -> young (the beginning of young_modulus) 1, and 1 for the rest.
  EXPECT_EQ(nearest_name("yung", {"name", "young_modulus"}), "young_modulus");
  EXPECT_EQ(nearest_name("friction", {"function", "friction_angle"}), "friction_angle");
}

TEST(NearestName, NamesThatContainTheTextComeFirst) {
  // slide needs one change to glide and to side, the beginning of side-slide, and four to incline.
  EXPECT_THAT(likely_names("slide", {"glide", "Incline-Slide", "side-slide"}),
              ElementsAre("side-slide", "Incline-Slide"));
  EXPECT_EQ(nearest_name("slide", {"glide", "incline-slide"}), "incline-slide");
  EXPECT_THAT(likely_names("glede", {"incline-slide", "glide"}), ElementsAre("glide"));
  EXPECT_THAT(likely_names("or", {"for", "orders", "at"}), ElementsAre("orders"));
  EXPECT_THAT(likely_names("slide", {}), IsEmpty());
}

TEST(NearestName, NothingIsGuessedBeyondAThirdOfTheLetters) {
  const std::vector<std::string> keys = {"analysis", "block",   "contact", "joint",
                                         "material", "measure", "output"};
  for (const char* name : {"include", "water", "foo", "stage", "C", ""})
    EXPECT_EQ(nearest_name(name, keys), "") << name;
  EXPECT_EQ(nearest_name("help", {"run", "check", "verify", "picture"}), "");
  EXPECT_EQ(nearest_name("blcok", keys), "block");
  EXPECT_EQ(nearest_name("outprt", keys), "output");
  EXPECT_EQ(nearest_name("meesura", keys), "measure");
  EXPECT_EQ(guess("blok", keys), "did you mean block? ");
  EXPECT_EQ(guess("blok", keys, "\""), "did you mean \"block\"? ");
  EXPECT_EQ(guess("foo", keys), "");
}

TEST(NearestName, BlocksThatBeginAlikeAreListedBySeries) {
  const std::vector<std::string> names = {"floor",         "rock.1",        "rock.2",    "rock.inside.1",
                                          "rock.inside.2", "rock.inside.3", "rocky.7.a", "wall.top"};
  EXPECT_EQ(guess_block("rock.1.inside*", names),
            "did you mean \"rock.inside.1\"? \"rock.1\" to \"rock.2\", \"rock.inside.1\" to "
            "\"rock.inside.3\" begin "
            "alike; ");
  EXPECT_EQ(guess_block("rock.inside.9.?", names),
            "did you mean \"rock.inside.1\"? \"rock.inside.1\" to \"rock.inside.3\" begin alike; ");
  EXPECT_EQ(guess_block("wall.tip", names), "did you mean \"wall.top\"? \"wall.top\" begin alike; ");
  EXPECT_EQ(guess_block("flor", names), "did you mean \"floor\"? ");
  EXPECT_EQ(guess_block("dam.1", names), "");
  std::vector<std::string> many;
  for (const char* row : {"a", "b", "c", "d", "e", "f"}) many.push_back(std::string("w.") + row);
  EXPECT_EQ(guess_block("w.x.*", many), "\"w.a\", \"w.b\", \"w.c\", \"w.d\" and 2 more begin alike; ");
}

}  // namespace
}  // namespace ashlar::test::nearest_name_test
