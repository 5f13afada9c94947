#include "apps/scene/toml/fault_text.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <new>
#include <stdexcept>

namespace ashlar::fault_text_test {
namespace {

/// The words for what `action` throws.
template <class Action>
std::string words_of(Action action) {
  try {
    action();
  } catch (const std::exception& error) {
    return fault_text(error);
  }
  return "nothing thrown";
}

TEST(FaultText, NamesTheFileAndTheReason) {
  EXPECT_EQ(words_of([] { std::filesystem::create_directories("/proc/none/there"); }),
            "cannot create directories /proc/none/there: No such file or directory");
  EXPECT_EQ(words_of([] { (void)std::filesystem::directory_iterator("/none"); }),
            "cannot open directory /none: No such file or directory");
  EXPECT_EQ(words_of([] { std::filesystem::rename("/none/a", "/none/b"); }),
            "cannot rename /none/a to /none/b: No such file or directory");
  const std::string long_name(300, 'n');
  EXPECT_EQ(words_of([&] { (void)std::filesystem::exists("/" + long_name); }),
            "cannot use /" + long_name + ": File name too long");
}

TEST(FaultText, StreamsSayTheReasonAlone) {
  std::ifstream stream("/proc/self/mem");
  stream.exceptions(std::ios::badbit);
  EXPECT_EQ(words_of([&] { (void)stream.get(); }), "Input/output error");
}

TEST(FaultText, MissingMemoryIsOneWording) {
  struct NeedsMore : std::bad_alloc {
    [[nodiscard]] const char* what() const noexcept override { return "out of memory: 3 bytes are needed"; }
  };
  EXPECT_EQ(words_of([] { throw std::bad_alloc(); }), "out of memory");
  EXPECT_EQ(words_of([] { throw NeedsMore(); }), "out of memory: 3 bytes are needed");
  EXPECT_EQ(words_of([] { throw std::runtime_error("as it was"); }), "as it was");
}

}  // namespace
}  // namespace ashlar::fault_text_test
