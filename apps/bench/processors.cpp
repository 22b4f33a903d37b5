#include "apps/bench/processors.h"

#include <sched.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

namespace fathom::bench {
namespace {

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
