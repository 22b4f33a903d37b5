#include "apps/bench/measurement.h"

#include <algorithm>
#include <chrono>

namespace fathom::bench {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds time_there_is{20};

}  // namespace

double Measurement::median_ms() const {
  const std::size_t half = milliseconds.size() / 2;
  return milliseconds.size() % 2 == 1 ? milliseconds[half]
                                      : (milliseconds[half - 1] + milliseconds[half]) / 2;
}

Frames time_frames(int repeat, const std::function<void()>& draw,
                   const std::function<void()>& clear, std::chrono::milliseconds warm_up) {
  const auto timed = [&] {
    clear();
    const Clock::time_point start = Clock::now();
    draw();
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  };
  const Clock::time_point start = Clock::now();
  Frames frames{.first_ms = timed()};
  while (Clock::now() - start < warm_up) timed();
  for (int i = 0; i < repeat && Clock::now() - start < time_there_is; ++i) {
    frames.milliseconds.push_back(timed());
  }
  if (frames.milliseconds.empty()) frames.milliseconds.push_back(frames.first_ms);
  std::sort(frames.milliseconds.begin(), frames.milliseconds.end());
  return frames;
}

}  // namespace fathom::bench
