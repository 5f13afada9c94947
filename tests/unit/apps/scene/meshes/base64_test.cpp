#include "apps/scene/meshes/base64.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace ashlar::base64_test {
namespace {

// The examples of RFC 4648, section 10.
TEST(Base64, ExamplesOfTheStandard) {
  const std::string text = "foobar";
  const char* const expected[] = {"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
  for (std::size_t size = 0; size <= text.size(); ++size) {
    EXPECT_EQ(to_base64(text.substr(0, size)), expected[size]);
    EXPECT_EQ(from_base64(expected[size]), text.substr(0, size));
  }
}

TEST(Base64, EveryByteComesBack) {
  std::string bytes;
  for (int i = 0; i < 256; ++i) bytes += static_cast<char>(i);
  EXPECT_EQ(from_base64(to_base64(bytes)), bytes);
  // 11111111 11101111 is 111111 111110 1111(00)
  EXPECT_EQ(to_base64("\xff\xef"), "/+8=");
}

TEST(Base64, RefusesOtherText) {
  for (const char* text : {"Z", "Zg=", "Z===", "Zm9\n", "Zg==Zg=="}) {
    EXPECT_THROW((void)from_base64(text), std::invalid_argument) << text;
  }
}

}  // namespace
}  // namespace ashlar::base64_test
