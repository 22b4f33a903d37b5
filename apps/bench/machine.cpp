#include "apps/bench/machine.h"

#include <fmt/format.h>
#include <sched.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

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

std::vector<int> allowed_processors() {
  cpu_set_t set;
  CPU_ZERO(&set);
  std::vector<int> processors;
  if (::sched_getaffinity(0, sizeof set, &set) != 0) return {0};
  for (int i = 0; i < CPU_SETSIZE; ++i) {
    if (CPU_ISSET(i, &set)) processors.push_back(i);
  }
  return processors;
}

/// Whether it is the first of the hardware threads of its core.
bool leads_its_core(int processor) {
  std::ifstream siblings("/sys/devices/system/cpu/cpu" + std::to_string(processor) +
                         "/topology/thread_siblings_list");
  int first = processor;
  return !(siblings >> first) || first == processor;
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

nlohmann::ordered_json to_json(const Machine& machine) {
  return {{"processor", machine.processor},
          {"processors", machine.processors},
          {"memory_bytes", machine.memory_bytes},
          {"system", machine.system},
          {"compiler", machine.compiler}};
}

int processor_count() {
  return static_cast<int>(allowed_processors().size());
}

void keep_to_processors(int count) {
  std::vector<int> processors = allowed_processors();
  std::stable_partition(processors.begin(), processors.end(), leads_its_core);
  processors.resize(std::min(processors.size(), static_cast<std::size_t>(std::max(1, count))));
  cpu_set_t set;
  CPU_ZERO(&set);
  for (const int processor : processors) CPU_SET(processor, &set);
  ::sched_setaffinity(0, sizeof set, &set);
}

}  // namespace fathom::bench
