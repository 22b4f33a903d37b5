#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace fathom::memory {

/// The least limit in bytes that the control groups around this process set; nullopt if none does.
/// `root` is the folder in which proc and what is mounted lie: "/", or a test's.
/// Source   cgroups(7), proc(5): /proc/self/cgroup names the group in each hierarchy, as seen from
///          the root of the hierarchy; /proc/self/mountinfo says which part of it is mounted, and
///          where.
std::optional<std::uint64_t> control_group_limit(const std::filesystem::path& root);

}  // namespace fathom::memory
