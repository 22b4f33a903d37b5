// Ctrl-C during a render: status 130, no file left, an older map intact.

#include <gtest/gtest.h>
#include <signal.h>

#include "faults.h"
#include "run_program.h"
#include "test_folder.h"

namespace fathom::test {
namespace {

/// Renders something that takes far longer than the test, and sends `signal` once the output is
/// staged, which is done before the first pixel.
void interrupt_with(int signal) {
  const TestFolder folder;
  folder.write("squares.obj", long_work());
  folder.write("map.exr", "older");
  const auto before = folder.names();

  const pid_t process = start_fathom(
      {"render", "squares.obj", "--size", "4000x3000", "-o", "map.exr"}, {.folder = folder.path()});
  EXPECT_TRUE(wait_until_staged(process, folder));
  ::kill(process, signal);
  EXPECT_EQ(wait_for(process), 130);
  EXPECT_EQ(folder.read("map.exr"), "older");
  EXPECT_EQ(folder.names(), before);
}

TEST(Interruption, BySigint) {
  interrupt_with(SIGINT);
}
TEST(Interruption, BySigterm) {
  interrupt_with(SIGTERM);
}
TEST(Interruption, BySighup) {
  interrupt_with(SIGHUP);
}

}  // namespace
}  // namespace fathom::test
