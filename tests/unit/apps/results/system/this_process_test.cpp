#include "apps/results/system/this_process.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <system_error>
#include <vector>

#include "apps/results/system/process_copy.hpp"
#include "support/temporary_folder.hpp"

namespace ashlar::this_process_test {
namespace {

TEST(ThisProcess, MemoryGrowsWithWhatIsUsed) {
  const auto grown = told_by_copy([]() -> std::optional<std::string> {
    const std::uint64_t before = peak_memory_bytes();
    const std::vector<char> used(std::size_t{256} << 20U, 'x');
    return peak_memory_bytes() - before >= used.size() * 3 / 4 ? "yes" : "no";
  });
  EXPECT_EQ(grown, "yes");
}

TEST(ThisProcess, TimePassesWithWork) {
  const double start = processor_time();
  double sum = 0.0;
  while (processor_time() - start < 0.01) sum += std::sqrt(sum + 1.0);
  EXPECT_GT(sum, 0.0);
}

TEST(ThisProcess, EndsAtOnce) {
  const ProcessCopy copy([]() -> int { end_at_once(5); });
  std::optional<int> status;
  while (!status) status = copy.ended();
  EXPECT_EQ(*status, 5);
}

TEST(ThisProcess, PrivateFoldersAreNewAndClosedToOthers) {
  const TemporaryFolder folder;
  const std::filesystem::path a = new_private_folder(folder / "x-"), b = new_private_folder(folder / "x-");
  EXPECT_NE(a, b);
  EXPECT_TRUE(a.string().starts_with((folder / "x-").string()));
  EXPECT_EQ(std::filesystem::status(a).permissions(), std::filesystem::perms::owner_all);
  EXPECT_THROW((void)new_private_folder(folder / "none/x-"), std::system_error);
}

}  // namespace
}  // namespace ashlar::this_process_test
