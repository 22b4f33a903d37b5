#include "fathom/rendering/rendered.h"

namespace fathom {
namespace {

constexpr std::size_t count_numbers() {
  RenderStatistics statistics;
  std::size_t count = 0;
  for_each_number(statistics, [&](std::uint64_t&) { ++count; });
  return count;
}

static_assert(count_numbers() * sizeof(std::uint64_t) == sizeof(RenderStatistics),
              "for_each_count() visits all");

}  // namespace

void add(RenderStatistics& sum, const RenderStatistics& part) {
  for_each_count([&](const char*, auto count) { sum.*count += part.*count; });
}

}  // namespace fathom
