// Limits of control groups, from trees of files as systems and containers show them.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "fathom/memory/available_memory.h"

namespace fathom::memory {
namespace {

namespace fs = std::filesystem;

class ControlGroups : public testing::Test {
 protected:
  ControlGroups() {
    std::string name = fs::temp_directory_path() / "fathom-groups-XXXXXX";
    if (::mkdtemp(name.data()) == nullptr) std::abort();
    root_ = name;
  }
  ~ControlGroups() override {
    std::error_code ignored;
    fs::remove_all(root_, ignored);
  }
  void write(const std::string& file, const std::string& text) const {
    fs::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text << '\n';
  }
  [[nodiscard]] std::optional<std::uint64_t> limit() const { return control_group_limit(root_); }

  fs::path root_;
};

const std::string unified =
    "24 30 0:22 / /proc rw,nosuid - proc proc rw\n"
    "35 24 0:30 / /sys/fs/cgroup rw,nosuid shared:9 - cgroup2 cgroup2 rw,nsdelegate";

TEST_F(ControlGroups, NoneWhereNothingIsMounted) {
  EXPECT_EQ(limit(), std::nullopt);
  write("proc/self/cgroup", "0::/a");
  write("proc/self/mountinfo", "24 30 0:22 / /proc rw,nosuid - proc proc rw");
  EXPECT_EQ(limit(), std::nullopt);
}

TEST_F(ControlGroups, SecondVersionTheLeastOfTheWholePath) {
  write("proc/self/cgroup", "0::/user.slice/user-0.slice/a.scope");
  write("proc/self/mountinfo", unified);
  write("sys/fs/cgroup/user.slice/user-0.slice/a.scope/memory.max", "max");
  EXPECT_EQ(limit(), std::nullopt);
  write("sys/fs/cgroup/user.slice/memory.max", "4000000000");
  EXPECT_EQ(limit(), 4000000000U);
  write("sys/fs/cgroup/user.slice/user-0.slice/a.scope/memory.max", "3000000000");
  EXPECT_EQ(limit(), 3000000000U);
  write("sys/fs/cgroup/user.slice/user-0.slice/a.scope/memory.high", "2000000000");
  EXPECT_EQ(limit(), 2000000000U);
  write("sys/fs/cgroup/other.slice/memory.max", "1000");
  EXPECT_EQ(limit(), 2000000000U);
}

/// With a namespace of its own, a container is at the root of what it sees.
TEST_F(ControlGroups, SecondVersionInAContainer) {
  write("proc/self/cgroup", "0::/");
  write("proc/self/mountinfo", unified);
  write("sys/fs/cgroup/memory.max", "536870912");
  EXPECT_EQ(limit(), 536870912U);
}

TEST_F(ControlGroups, SecondVersionOutsideItsNamespace) {
  write("proc/self/cgroup", "0::/../other");
  write("proc/self/mountinfo", unified);
  write("sys/fs/cgroup/memory.max", "536870912");
  write("sys/fs/other/memory.max", "1000");
  EXPECT_EQ(limit(), 536870912U);
}

const std::string first_version =
    "40 35 0:31 / /sys/fs/cgroup/cpu rw - cgroup cgroup rw,cpu,cpuacct\n"
    "41 35 0:32 / /sys/fs/cgroup/memory rw - cgroup cgroup rw,memory";

TEST_F(ControlGroups, FirstVersion) {
  write("proc/self/cgroup", "9:name=systemd:/\n4:memory:/box/1234\n1:cpu,cpuacct:/box\n0::/");
  write("proc/self/mountinfo", first_version);
  write("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712");
  write("sys/fs/cgroup/memory/box/1234/memory.limit_in_bytes", "9223372036854771712");
  EXPECT_EQ(limit(), std::nullopt);
  write("sys/fs/cgroup/memory/box/memory.limit_in_bytes", "700000000");
  EXPECT_EQ(limit(), 700000000U);
  write("sys/fs/cgroup/memory/box/1234/memory.limit_in_bytes", "600000000");
  EXPECT_EQ(limit(), 600000000U);
}

/// Docker mounts the container's own group where the root of all would be.
TEST_F(ControlGroups, FirstVersionInAContainer) {
  write("proc/self/cgroup", "4:cpu,memory:/docker/1234/below");
  write("proc/self/mountinfo",
        "41 35 0:32 /docker/1234 /sys/fs/cgroup/memory ro - cgroup cgroup rw,memory");
  write("sys/fs/cgroup/memory/memory.limit_in_bytes", "800000000");
  EXPECT_EQ(limit(), 800000000U);
  write("sys/fs/cgroup/memory/below/memory.limit_in_bytes", "300000000");
  EXPECT_EQ(limit(), 300000000U);
}

TEST_F(ControlGroups, WordsThatAreNoNumbers) {
  write("proc/self/cgroup", "0::/a\nnonsense\n:\n");
  write("proc/self/mountinfo", unified + "\nnonsense - cgroup2\n");
  write("sys/fs/cgroup/a/memory.max", "plenty");
  write("sys/fs/cgroup/memory.max", "");
  EXPECT_EQ(limit(), std::nullopt);
}

}  // namespace
}  // namespace fathom::memory
