#include "apps/diagnostics.hpp"

#include <gmock/gmock.h>

#include <sstream>

namespace ashlar::test {
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
  EXPECT_EQ(to_string(Diagnostic{{"s.toml", 1, 2}, "wrong (a\nb\tc)"}), "s.toml:1:2: error: wrong (a b c)");
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

}  // namespace
}  // namespace ashlar::test
