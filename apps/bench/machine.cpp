#include "apps/bench/machine.h"

#include <fmt/core.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <fstream>

#include "apps/bench/processors.h"
#include "fathom/text/counted.h"

namespace fathom::bench {
namespace {

/// What stands behind `key` and the separator that follows it, in the first line that begins with
/// it.
std::string value_in(const char* file, const std::string& key, char separator) {
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t cut = line.find(separator);
    if (!line.starts_with(key) || cut == std::string::npos) continue;
    std::string value = line.substr(cut + 1);
    while (!value.empty() && (value.front() == ' ' || value.front() == '"')) value.erase(0, 1);
    while (!value.empty() && value.back() == '"') value.pop_back();
    return value;
  }
  return "unknown";
}

std::string system_name() {
  utsname name{};
  std::string distribution = value_in("/etc/os-release", "PRETTY_NAME", '=');
  if (::uname(&name) != 0) return distribution;
  return distribution + ", " + name.sysname + " " + name.release + " " + name.machine;
}

}  // namespace

Machine this_machine() {
  Machine machine;
  machine.processor = value_in("/proc/cpuinfo", "model name", ':');
  machine.processors = processor_count();
  machine.memory_bytes = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
                         static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  machine.system = system_name();
#ifdef __clang__
  machine.compiler = "Clang " __clang_version__;
#else
  machine.compiler = "GCC " __VERSION__;
#endif
  return machine;
}

std::string machine_line(const Machine& machine) {
  return fmt::format("{}, {}, {:.1f} GiB; {}; {}\n\n", machine.processor,
                     text::counted(machine.processors, "processor"),
                     static_cast<double>(machine.memory_bytes) / (1 << 30), machine.system,
                     machine.compiler);
}

}  // namespace fathom::bench
