#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

#include "apps/shell/console.h"

namespace fathom::app {

/// Progress of a job: on a terminal a line, "maps: 73/500, 41 maps/s, 0:10 left", wiped at the end;
/// and the message that the program prints when it is interrupted. Several threads may report
/// progress.
class JobProgress {
 public:
  /// `noun` has a plural with an s.
  JobProgress(const Console& console, std::string noun, std::size_t total);
  JobProgress(const JobProgress&) = delete;
  JobProgress& operator=(const JobProgress&) = delete;
  ~JobProgress();

  void add_made(std::size_t count);
  /// Counts a task that an earlier run finished.
  void add_found();
  /// " (73 of 500 maps are finished; the same command goes on from there)"
  [[nodiscard]] std::string so_far() const;

 private:
  void tell();

  std::string noun_;
  std::size_t total_;
  bool shows_;
  mutable std::mutex mutex_;
  std::size_t made_ = 0, found_ = 0;
  bool shown_ = false;
  std::chrono::steady_clock::time_point start_, next_;
};

}  // namespace fathom::app
