// Ctrl-C during a render: status 130, no file left, an older map intact.

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <thread>

#include "run_program.h"
#include "sample_files.h"
#include "test_folder.h"

namespace fathom::test {
namespace {

/// Renders something that takes far longer than the test, and sends `signal` once the temporary
/// file is there, which is created before the first pixel.
void interrupt_with(int signal) {
  const TestFolder folder;
  std::string mesh = square_obj;
  for (int i = 0; i < 5000; ++i) mesh += "f 1 2 3\n";
  folder.write("squares.obj", mesh);
  folder.write("map.exr", "older");
  const auto before = folder.names();

  const pid_t process = start_fathom(
      {"render", "squares.obj", "--size", "4000x3000", "-o", "map.exr"}, {.folder = folder.path()});
  while (folder.names() == before && ::waitpid(process, nullptr, WNOHANG) == 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
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
