#include "fathom/memory/available_memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <utility>

#include "fathom/failures/errors.h"
#include "fathom/memory/control_groups.h"

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
