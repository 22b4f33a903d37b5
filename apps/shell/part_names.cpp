#include "apps/shell/part_names.h"

#include <fmt/core.h>
#include <sys/random.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>

namespace fathom::app {
namespace {

constexpr std::string_view part_start = ".fathom-", part_end = ".part";

std::uint64_t drawn() {
  std::uint64_t number = 0;
  if (::getrandom(&number, sizeof number, GRND_NONBLOCK) == sizeof number) return number;
  // Names need to differ, not to be secret.
  static std::atomic<std::uint64_t> count{0};
  const auto now = std::chrono::steady_clock::now().time_since_epoch().count();
  return (static_cast<std::uint64_t>(::getpid()) << 40U) ^ static_cast<std::uint64_t>(now) ^
         (++count << 20U);
}

}  // namespace

std::string new_part_name() {
  return fmt::format("{}{:016x}{}", part_start, drawn(), part_end);
}

bool is_part_name(std::string_view name) {
  if (!name.starts_with(part_start) || !name.ends_with(part_end)) return false;
  name.remove_prefix(part_start.size());
  if (name.size() != 16 + part_end.size()) return false;
  return std::all_of(name.begin(), name.begin() + 16,
                     [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
}

}  // namespace fathom::app
