#include "apps/scene/model/diagnostics.hpp"

#include <gmock/gmock.h>

#include <sstream>

namespace ashlar::test::diagnostics_test {
namespace {

TEST(Diagnostics, PrintsInFileOrderWithArgumentsLast) {
  Diagnostics diagnostics;
  diagnostics.error({"--set a=1", 0, 0}, "first argument");
  diagnostics.error({"s.toml", 10, 2}, "tenth line");
  diagnostics.error({"s.toml", 9, 3}, "ninth line, later");
  diagnostics.error({"s.toml", 9, 1}, "ninth line, first found");
  diagnostics.error({"s.toml", 9, 1}, "ninth line, also");
  diagnostics.error({"--set b=1", 0, 0}, "second argument");
  std::ostringstream stream;
  diagnostics.print(stream);
  EXPECT_EQ(stream.str(),
            "s.toml:9:1: error: ninth line, first found\n"
            "s.toml:9:1: error: ninth line, also\n"
            "s.toml:9:3: error: ninth line, later\n"
            "s.toml:10:2: error: tenth line\n"
            "--set a=1: error: first argument\n"
            "--set b=1: error: second argument\n");
}

TEST(Diagnostics, PrintsEachFaultInOneLine) {
  const Place place{"s.toml", 1, 2};
  const Diagnostic fault{place, "wrong (a\nb\tc)"};
  EXPECT_EQ(to_string(fault), "s.toml:1:2: error: wrong (a b c)");
}

TEST(Diagnostics, LeavesTheMiddleOfLongLinesOut) {
  std::string message = "unknown name (";
  for (int k = 0; k < 100000; ++k) message += "\xC3\xA9";  // e with an accent
  message += "), one is needed";
  Diagnostics diagnostics;
  diagnostics.error({"s.toml", 1, 2}, message);
  const std::string line = to_string(diagnostics.sorted().front());
  EXPECT_LT(line.size(), longest_line + 40);
  EXPECT_THAT(line, ::testing::StartsWith("s.toml:1:2: error: unknown name (\xC3\xA9"));
  EXPECT_THAT(line, ::testing::HasSubstr("\xC3\xA9 [... 198"));
  EXPECT_THAT(line, ::testing::HasSubstr(" bytes ...] \xC3\xA9"));
  EXPECT_THAT(line, ::testing::EndsWith("\xC3\xA9), one is needed"));
}

TEST(Diagnostics, ListsTheSameFaultOnce) {
  Diagnostics diagnostics;
  EXPECT_TRUE(diagnostics.good());
  diagnostics.error({"s.toml", 1, 1}, "twice");
  diagnostics.error({"s.toml", 1, 1}, "twice");
  diagnostics.error({"s.toml", 2, 1}, "twice");
  EXPECT_FALSE(diagnostics.good());
  EXPECT_EQ(diagnostics.sorted().size(), 2u);
}

TEST(Diagnostics, WarningsAreListedButNoFaults) {
  Diagnostics diagnostics;
  diagnostics.warning({"s.toml", 2, 1}, "soft (5)");
  EXPECT_TRUE(diagnostics.good());
  diagnostics.error({"s.toml", 1, 1}, "wrong");
  EXPECT_FALSE(diagnostics.good());
  std::ostringstream stream;
  diagnostics.print(stream);
  EXPECT_EQ(stream.str(), "s.toml:1:1: error: wrong\ns.toml:2:1: warning: soft (5)\n");
}

TEST(Diagnostics, ManyOfAKindAreCounted) {
  Diagnostics diagnostics;
  for (int k = 1; k <= 50; ++k)
    diagnostics.error({"s.toml", k, 1}, "unknown key (k" + std::to_string(k) + "), none");
  diagnostics.error({"s.toml", 60, 1}, "wrong");
  std::ostringstream stream;
  diagnostics.print(stream);
  const std::string text = stream.str();
  EXPECT_NE(text.find("s.toml:20:1: error: unknown key (k20), none\ns.toml:60:1: error: wrong\n"),
            std::string::npos);
  EXPECT_NE(
      text.find(
          "s.toml:21:1: error: 30 more of this kind from here on (unknown key), the first 20 are listed\n"),
      std::string::npos);
  EXPECT_EQ(diagnostics.sorted().size(), 51u);
}

}  // namespace
}  // namespace ashlar::test::diagnostics_test
