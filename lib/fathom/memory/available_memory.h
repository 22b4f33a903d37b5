#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace fathom {

/// So many bytes and no more.
struct MemoryAllowance {
  std::uint64_t bytes = 0;
  /// Its origin, as in messages before the size: "this machine has".
  std::string set_by;
  /// Advice for the user: "--max-memory allows more". May be empty.
  std::string remedy;
};

/// The memory that this process may take in all: the least of the machine's memory, the limits of
/// its control groups, such as a container's (memory.max and memory.high, memory.limit_in_bytes),
/// and its own limits (ulimit -v, ulimit -d). Memory of other processes is not subtracted.
MemoryAllowance available_memory();
/// The limit of the control groups; nullopt if they set no limit.
std::optional<MemoryAllowance> control_group_allowance();

/// "2.1 GB", "34.5 MB": decimal units.
std::string size_in_words(double bytes);

/// Refuses what needs more memory than is allowed, before it is tried.
/// Fails    InputError "WHAT needs 4.3 GB; this machine has 2.1 GB".
void require_memory(const std::string& what, double bytes, const MemoryAllowance& allowance);

}  // namespace fathom

namespace fathom::memory {

/// The least limit in bytes among the control groups of this process; nullopt if they set no limit.
/// `root` is the folder that contains proc and the mount points: "/", or a folder of a test.
/// Source   cgroups(7), proc(5): /proc/self/cgroup names the group in each hierarchy, relative to
///          the root of the hierarchy; /proc/self/mountinfo lists which part of it is mounted, and
///          where.
std::optional<std::uint64_t> control_group_limit(const std::filesystem::path& root);

}  // namespace fathom::memory
