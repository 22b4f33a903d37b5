#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <utility>

#include "apps/shell/console.h"

namespace fathom::app {

/// A line of progress on standard error for work that lasts more than a second, wiped at the end.
class Progress {
 public:
  Progress(const Console& console, const std::string& work);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// What reports the share done in [0, 1] of step `step` of `steps`; empty where nothing is shown.
  std::function<void(double)> reporter(std::size_t step = 0, std::size_t steps = 1);

 private:
  void show(double share);

  std::string work_;
  bool enabled_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point next_;
};

class Stopwatch {
 public:
  /// Seconds since the last lap, or since the beginning.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(start_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace fathom::app
