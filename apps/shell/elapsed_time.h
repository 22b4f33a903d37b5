#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "apps/shell/console.h"

namespace fathom::app {

/// A line of progress on standard error for work that cannot report how much of it is done: after
/// a second it shows how long the work has taken, "fathom: judging: 12 s". It is wiped at the end.
class ElapsedTime {
 public:
  ElapsedTime(const Console& console, const std::string& work);
  ElapsedTime(const ElapsedTime&) = delete;
  ElapsedTime& operator=(const ElapsedTime&) = delete;
  ~ElapsedTime();

 private:
  void show_until_ended(const std::string& work);

  std::mutex mutex_;
  std::condition_variable ended_;
  bool is_ended_ = false;
  std::thread thread_;
};

}  // namespace fathom::app
