#include "apps/results/system/input_lines.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <string_view>
#include <vector>

namespace ashlar::input_lines_test {
namespace {

constexpr std::chrono::milliseconds at_once(0), soon(2000);

/// Standard input from a pipe while it exists.
class Input {
 public:
  Input() : before_(::dup(STDIN_FILENO)) {
    EXPECT_EQ(::pipe(ends_.data()), 0);
    EXPECT_EQ(::dup2(ends_[0], STDIN_FILENO), STDIN_FILENO);
    ::close(ends_[0]);
  }
  ~Input() {
    end();
    ::dup2(before_, STDIN_FILENO);
    ::close(before_);
  }
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;

  void write(std::string_view text) {
    ASSERT_EQ(::write(ends_[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  void end() {
    if (ends_[1] >= 0) ::close(ends_[1]);
    ends_[1] = -1;
  }

 private:
  int before_;
  std::array<int, 2> ends_{-1, -1};
};

TEST(InputLines, AreTakenWhenTheyAreComplete) {
  Input input;
  InputLines lines(100);
  lines.wait(at_once);
  EXPECT_FALSE(lines.next());
  input.write("one\n\nthr");
  lines.wait(soon);
  EXPECT_EQ(lines.next()->text, "one");
  EXPECT_EQ(lines.next()->text, "");
  EXPECT_FALSE(lines.next());
  input.write("ee\nlast");
  lines.wait(soon);
  EXPECT_EQ(lines.next()->text, "three");
  EXPECT_FALSE(lines.next());
  EXPECT_FALSE(lines.ended());
  input.end();
  lines.wait(soon);
  EXPECT_FALSE(lines.ended());
  EXPECT_EQ(lines.next()->text, "last");
  EXPECT_FALSE(lines.next());
  EXPECT_TRUE(lines.ended());
}

TEST(InputLines, ThatAreTooLongAreSkipped) {
  Input input;
  InputLines lines(10);
  std::vector<bool> too_long;
  // Eleven letters at once, and 30 in three parts; ten are allowed.
  for (const std::string_view part :
       {"01234567890\n", "0123456789\n", "0123456789", "0123456789", "0123456789\nab", "\n"}) {
    input.write(part);
    lines.wait(soon);
    while (const auto line = lines.next()) {
      too_long.push_back(line->too_long);
      EXPECT_EQ(line->text, line->too_long ? "" : too_long.size() == 2 ? "0123456789" : "ab");
    }
  }
  EXPECT_EQ(too_long, (std::vector<bool>{true, false, true, false}));
}

}  // namespace
}  // namespace ashlar::input_lines_test
