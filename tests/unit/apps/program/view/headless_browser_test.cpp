// A script in place of Chromium stores its arguments.
#include "apps/program/view/headless_browser.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "support/temporary_folder.hpp"

namespace ashlar::headless_browser_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr uid_t nobody = 65534;

class HeadlessBrowser : public ::testing::Test {
 protected:
  HeadlessBrowser() {
    std::filesystem::permissions(folder_.path(), std::filesystem::perms::all);
    if (::geteuid() == 0) changed_ = ::seteuid(nobody) == 0;
  }
  ~HeadlessBrowser() override {
    if (!changed_) return;
    EXPECT_EQ(::seteuid(0), 0);
  }

  /// @param script of sh. @return the page
  std::string page_by(const std::string& script) {
    write_text(browser_, "#!/bin/sh\necho \"$@\" >> '" + calls_.string() + "'\n" + script);
    std::filesystem::permissions(browser_, std::filesystem::perms::all);
    return loaded_page(browser_, folder_.path(), folder_ / "page.html", "a=1", std::chrono::seconds(20));
  }

  const TemporaryFolder folder_;
  std::filesystem::path browser_ = folder_ / "browser";
  std::filesystem::path calls_ = folder_ / "calls";
  bool changed_ = false;  ///< the effective user, from root
};

TEST_F(HeadlessBrowser, KeepsTheSandbox) {
  EXPECT_EQ(page_by("echo page"), "page\n");
  EXPECT_THAT(read_text(calls_), Not(HasSubstr("--no-sandbox")));
  EXPECT_THAT(read_text(calls_), HasSubstr("page.html#a=1\n"));
}

TEST_F(HeadlessBrowser, GoesWithoutWhereTheBrowserSaysThatThereIsNone) {
  const std::string script =
      "case \"$*\" in *--no-sandbox*) echo page;; *) echo 'FATAL: No usable sandbox! Update your kernel' "
      ">&2; exit 1;; "
      "esac";
  EXPECT_EQ(page_by(script), "page\n");
}

TEST_F(HeadlessBrowser, OtherFaultsAreTold) {
  try {
    (void)page_by("echo 'FATAL: no such display' >&2; exit 1");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("no such display"));
  }
  EXPECT_THAT(read_text(calls_), Not(HasSubstr("--no-sandbox")));
}

TEST(HeadlessBrowserOfRoot, HasNoSandbox) {
  if (::geteuid() != 0) GTEST_SKIP() << "not root";
  const TemporaryFolder folder;
  write_text(folder / "browser", "#!/bin/sh\necho \"$@\"\n");
  std::filesystem::permissions(folder / "browser", std::filesystem::perms::all);
  EXPECT_THAT(
      loaded_page(folder / "browser", folder.path(), folder / "page.html", "", std::chrono::seconds(20)),
      HasSubstr("--no-sandbox"));
}

}  // namespace
}  // namespace ashlar::headless_browser_test
