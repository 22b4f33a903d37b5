#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <utility>

#include "fathom/failures/errors.h"

namespace fathom::app {

/// Messages on standard error: warnings, notes, errors and progress.
class Console {
 public:
  /// Suppresses warnings and progress, but not errors.
  bool quiet = false;

  void warn(const std::string& text) const;
  void warn(const Warnings& warnings) const;
  /// The result of a check that the user asked for: "fathom: TEXT".
  void note(const std::string& text) const;
  /// The one line of a failure.
  static void error(const std::string& text);
  /// Whether progress is shown: standard error is a terminal, and not quiet.
  [[nodiscard]] bool shows_progress() const;
};

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
