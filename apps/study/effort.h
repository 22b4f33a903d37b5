#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

/// What work takes, measured here.
namespace fathom::studies {

/// The least time of five runs in milliseconds, and the result of the last one. Of fewer, at least
/// two, once they have taken three seconds together.
template <class Run>
auto least_time(const Run& run) {
  using Clock = std::chrono::steady_clock;
  std::pair<double, decltype(run())> result{std::numeric_limits<double>::infinity(), {}};
  std::chrono::duration<double, std::milli> all{};
  for (int i = 0; i < 5 && (i < 2 || all.count() < 3000); ++i) {
    const Clock::time_point start = Clock::now();
    result.second = run();
    const std::chrono::duration<double, std::milli> time = Clock::now() - start;
    result.first = std::min(result.first, time.count());
    all += time;
  }
  return result;
}

/// How far the memory of this process that is in RAM grows at most during a run, in bytes, by the
/// page: the second of two runs. Memory that other threads take meanwhile counts too.
/// Fails    nullopt where the system does not measure a peak anew.
std::optional<std::uint64_t> peak_bytes(const std::function<void()>& run);

}  // namespace fathom::studies
