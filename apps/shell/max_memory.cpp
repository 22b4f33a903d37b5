#include "apps/shell/max_memory.h"

#include <sys/resource.h>

#include <algorithm>
#include <thread>

#include "apps/shell/last_resort.h"

namespace fathom::app {
namespace {

/// The shadow memory of the sanitizers takes more than anyone allows.
#ifdef FATHOM_SANITIZED
constexpr bool is_sanitized = true;
#else
constexpr bool is_sanitized = false;
#endif

std::optional<MemoryAllowance> given;

/// The stacks of the pools of TBB and of OpenEXR: little of them is ever touched, but all is
/// counted.
std::uint64_t bytes_of_stacks() {
  rlimit stack{};
  const bool is_known = ::getrlimit(RLIMIT_STACK, &stack) == 0 && stack.rlim_cur != RLIM_INFINITY;
  const std::uint64_t each = is_known ? stack.rlim_cur : std::uint64_t{8} << 20;
  return each * (2 * std::uint64_t{std::thread::hardware_concurrency()} + 2);
}

/// Lets allocations fail beyond so many bytes. Since Linux 4.7, RLIMIT_DATA counts all memory that
/// only this process writes to.
void limit_data(std::uint64_t bytes) {
  if (is_sanitized) return;
  rlimit limit{};
  if (::getrlimit(RLIMIT_DATA, &limit) != 0) return;
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_cur, bytes + bytes_of_stacks());
  ::setrlimit(RLIMIT_DATA, &limit);
}

}  // namespace

void set_max_memory(std::uint64_t bytes) {
  given = MemoryAllowance{bytes, "--max-memory allows", ""};
  limit_data(bytes);
  name_memory_limit((given->set_by + " " + size_in_words(static_cast<double>(bytes))).c_str());
}

void stay_within_control_group() {
  if (const auto limit = control_group_allowance()) limit_data(limit->bytes);
}

std::optional<MemoryAllowance> max_memory() {
  return given;
}

MemoryAllowance memory_allowance() {
  MemoryAllowance allowance = available_memory();
  return given && given->bytes < allowance.bytes ? *given : allowance;
}

}  // namespace fathom::app
