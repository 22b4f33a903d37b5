#include "apps/study/effort.h"

#include "apps/bench/resident_memory.h"

namespace fathom::studies {

std::optional<std::uint64_t> peak_bytes(const std::function<void()>& run) {
  run();  // so that code and tables that stay are in RAM before
  bench::forget_peak();
  const std::uint64_t idle = bench::resident_bytes(), forgotten = bench::peak_resident_bytes();
  // Pages of the measuring itself.
  constexpr std::uint64_t some_pages = 1 << 18;
  if (idle == 0 || forgotten > idle + some_pages) return std::nullopt;
  run();
  const std::uint64_t peak = bench::peak_resident_bytes();
  return peak > idle ? peak - idle : 0;
}

}  // namespace fathom::studies
