#include "apps/scene/records/file_hash.hpp"

#include <gtest/gtest.h>

#include "support/temporary_folder.hpp"

namespace ashlar::file_hash_test {
namespace {

// Values of FIPS 180-4's examples.
TEST(FileHash, IsTheStandardsSha256) {
  const TemporaryFolder folder;
  write_text(folder / "abc", "abc");
  EXPECT_EQ(sha256_of(folder / "abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  write_text(folder / "none", "");
  EXPECT_EQ(sha256_of(folder / "none"), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  write_text(folder / "million", std::string(1'000'000, 'a'));
  EXPECT_EQ(sha256_of(folder / "million"),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  EXPECT_EQ(sha256_of(folder / "missing"), "");
}

}  // namespace
}  // namespace ashlar::file_hash_test
