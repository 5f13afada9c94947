#include "apps/scene/system/digest.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

namespace ashlar::digest_test {
namespace {

std::string hexadecimal(const Sha256Bytes& bytes) {
  std::string digits;
  for (const unsigned char byte : bytes) digits += fmt::format("{:02x}", byte);
  return digits;
}

// The examples of FIPS 180-2, appendix B: one block, and two.
TEST(Digest, Sha256IsThatOfTheStandard) {
  Sha256 one;
  one.add("abc");
  EXPECT_EQ(hexadecimal(one.bytes().value()),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  Sha256 parts;
  parts.add("abcdbcdecdefdefgefghfghig");
  parts.add("");
  parts.add("hijhijkijkljklmklmnlmnomnopnopq");
  EXPECT_EQ(hexadecimal(parts.bytes().value()),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

// The examples of RFC 4648, section 10.
TEST(Digest, Base64IsThatOfTheStandard) {
  EXPECT_EQ(base64_digits(""), "");
  EXPECT_EQ(base64_digits("f"), "Zg==");
  EXPECT_EQ(base64_digits("fo"), "Zm8=");
  EXPECT_EQ(base64_digits("foobar"), "Zm9vYmFy");
  EXPECT_EQ(bytes_of_base64("Zm9vYmFy"), "foobar");
  EXPECT_EQ(bytes_of_base64("Zm8="), std::string("fo\0", 3));
}

}  // namespace
}  // namespace ashlar::digest_test
