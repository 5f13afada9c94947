#include "apps/scene/model/preparation.hpp"

#include <gmock/gmock.h>

#include <sstream>

namespace ashlar::preparation_test {
namespace {

using ::testing::HasSubstr;
using namespace std::chrono_literals;

TEST(Preparation, TellsWhatTakesLong) {
  std::ostringstream err;
  {
    Preparation preparation(false, err, 1ms);
    preparation.phase("solid of block A (1 of 2)");
    std::this_thread::sleep_for(50ms);
  }
  EXPECT_THAT(err.str(), HasSubstr("preparing: solid of block A (1 of 2) (0 s)\n"));
}

TEST(Preparation, SaysNothingOfWhatIsDoneAtOnceOrQuiet) {
  std::ostringstream err;
  { Preparation preparation(false, err, 1h); }
  {
    Preparation preparation(true, err, 1ms);
    std::this_thread::sleep_for(20ms);
  }
  EXPECT_EQ(err.str(), "");
}

}  // namespace
}  // namespace ashlar::preparation_test
