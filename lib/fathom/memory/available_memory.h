#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace fathom {

/// So many bytes and no more.
struct MemoryAllowance {
  std::uint64_t bytes = 0;
  /// What sets it, as a message says before the size: "this machine has".
  std::string set_by;
  /// What the user can do about it; may be empty: "--max-memory allows more".
  std::string remedy;
};

/// The memory that this process may take in all: the least of the machine's, of what the control
/// groups around it allow (memory.max and memory.high, memory.limit_in_bytes; those of containers)
/// and of its own limits (ulimit -v, ulimit -d). What other processes take meanwhile is not
/// counted.
MemoryAllowance available_memory();
/// What the control groups alone allow; nullopt where they set no limit.
std::optional<MemoryAllowance> control_group_allowance();

/// "2.1 GB", "34.5 MB": decimal units.
std::string size_in_words(double bytes);

/// Refuses what needs more memory than is allowed, before it is tried.
/// Fails    InputError "WHAT needs 4.3 GB; this machine has 2.1 GB".
void require_memory(const std::string& what, double bytes, const MemoryAllowance& allowance);

}  // namespace fathom

namespace fathom::memory {

/// The least limit in bytes that the control groups around this process set; nullopt if none does.
/// `root` is the folder in which proc and what is mounted lie: "/", or a test's.
/// Source   cgroups(7), proc(5): /proc/self/cgroup names the group in each hierarchy, as seen from
///          the root of the hierarchy; /proc/self/mountinfo says which part of it is mounted, and
///          where.
std::optional<std::uint64_t> control_group_limit(const std::filesystem::path& root);

}  // namespace fathom::memory
