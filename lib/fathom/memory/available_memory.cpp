#include "fathom/memory/available_memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "fathom/failures/errors.h"

namespace fathom::memory {
namespace {

namespace fs = std::filesystem;

/// A hierarchy of groups that has limits of memory, and the files that hold them.
struct Hierarchy {
  /// What stands between the colons of its line in /proc/self/cgroup.
  const char* controller;
  const char* file_system;
  std::vector<const char*> limits;
};
const Hierarchy second_version{"", "cgroup2", {"memory.max", "memory.high"}};
const Hierarchy first_version{"memory", "cgroup", {"memory.limit_in_bytes"}};

/// Without a limit, version 1 of control groups has a number near 2⁶³.
constexpr std::uint64_t no_limit = std::uint64_t{1} << 62;

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, at);) parts.push_back(part);
  return parts;
}

bool is_one_of(const std::string& list, const std::string& word) {
  const std::vector<std::string> words = split(list, ',');
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// The group of this process, from the root of the hierarchy: "0::/user.slice/a.scope" or
/// "4:memory:/docker/1234".
std::optional<fs::path> own_group(const fs::path& root, const Hierarchy& hierarchy) {
  std::ifstream file(root / "proc/self/cgroup");
  for (std::string line; std::getline(file, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const std::string wanted = hierarchy.controller;
    if (controllers == wanted || (!wanted.empty() && is_one_of(controllers, wanted))) {
      return line.substr(second + 1);
    }
  }
  return std::nullopt;
}

struct Mount {
  fs::path group;  ///< the group that is mounted, "/" if all are
  fs::path place;
};

/// "36 35 0:30 / /sys/fs/cgroup rw,nosuid shared:9 - cgroup2 cgroup2 rw,nsdelegate"
std::optional<Mount> mount_of(const fs::path& root, const Hierarchy& hierarchy) {
  std::ifstream file(root / "proc/self/mountinfo");
  for (std::string line; std::getline(file, line);) {
    const std::vector<std::string> words = split(line, ' ');
    const auto dash = std::find(words.begin(), words.end(), "-");
    if (words.size() < 10 || words.end() - dash < 4 || dash[1] != hierarchy.file_system) continue;
    const std::string controller = hierarchy.controller;
    if (!controller.empty() && !is_one_of(dash[3], controller)) continue;
    return Mount{words[3], words[4]};
  }
  return std::nullopt;
}

/// The group's folder below the mount point; empty if the group is not visible there.
fs::path below(const fs::path& group, const Mount& mount) {
  const fs::path below = group.lexically_relative(mount.group);
  return below.empty() || *below.begin() == ".." ? fs::path() : below;
}

std::uint64_t limit_of(const fs::path& root, const Hierarchy& hierarchy) {
  const auto group = own_group(root, hierarchy);
  const auto mount = mount_of(root, hierarchy);
  std::uint64_t least = no_limit;
  if (!group || !mount) return least;
  const auto take = [&](const fs::path& folder) {
    for (const char* name : hierarchy.limits) {
      std::uint64_t bytes = 0;  // stays where there is no such file, or it says "max"
      if (std::ifstream(folder / name) >> bytes) least = std::min(least, bytes);
    }
  };
  fs::path folder = root / mount->place.relative_path();
  take(folder);
  for (const fs::path& part : below(*group, *mount)) take(folder /= part);
  return least;
}

}  // namespace

std::optional<std::uint64_t> control_group_limit(const fs::path& root) {
  const std::uint64_t least =
      std::min(limit_of(root, first_version), limit_of(root, second_version));
  return least < no_limit ? std::optional(least) : std::nullopt;
}

}  // namespace fathom::memory

namespace fathom {
namespace {

void lower(MemoryAllowance& allowance, const MemoryAllowance& other) {
  if (other.bytes < allowance.bytes) allowance = other;
}

}  // namespace

MemoryAllowance available_memory() {
  MemoryAllowance allowance{static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
                                static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)),
                            "this machine has", ""};
  if (const auto group = control_group_allowance()) lower(allowance, *group);
  for (const auto& [resource, set_by] :
       {std::pair{RLIMIT_AS, "ulimit -v allows"}, std::pair{RLIMIT_DATA, "ulimit -d allows"}}) {
    rlimit limit{};
    if (::getrlimit(resource, &limit) == 0) lower(allowance, {limit.rlim_cur, set_by, ""});
  }
  return allowance;
}

std::optional<MemoryAllowance> control_group_allowance() {
  const auto bytes = memory::control_group_limit("/");
  if (!bytes) return std::nullopt;
  return MemoryAllowance{*bytes, "the control group allows", ""};
}

std::string size_in_words(double bytes) {
  char text[48];
  std::snprintf(text, sizeof text, "%.1f %s", bytes / (bytes < 1e9 ? 1e6 : 1e9),
                bytes < 1e9 ? "MB" : "GB");
  return text;
}

void require_memory(const std::string& what, double bytes, const MemoryAllowance& allowance) {
  if (bytes <= static_cast<double>(allowance.bytes)) return;
  throw InputError(what + " needs " + size_in_words(bytes) + "; " + allowance.set_by + " " +
                   size_in_words(static_cast<double>(allowance.bytes)) +
                   (allowance.remedy.empty() ? "" : "; " + allowance.remedy));
}

}  // namespace fathom
