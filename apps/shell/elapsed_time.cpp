#include "apps/shell/elapsed_time.h"

#include <fmt/core.h>

#include <chrono>
#include <cstdio>
#include <system_error>

#include "fathom/text/printable.h"

namespace fathom::app {

ElapsedTime::ElapsedTime(const Console& console, const std::string& work) {
  if (!console.shows_progress()) return;
  try {
    thread_ = std::thread([this, work = text::printable(work)] { show_until_ended(work); });
  } catch (const std::system_error&) {
    // The work matters more than its progress: it goes on without a thread to spare.
  }
}

ElapsedTime::~ElapsedTime() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    is_ended_ = true;
  }
  ended_.notify_one();
  thread_.join();
}

void ElapsedTime::show_until_ended(const std::string& work) {
  bool is_shown = false;
  std::unique_lock lock(mutex_);
  for (int seconds = 1;; ++seconds) {
    if (ended_.wait_for(lock, std::chrono::seconds(1), [this] { return is_ended_; })) break;
    fmt::print(stderr, "\r\033[Kfathom: {}: {} s", work, seconds);
    std::fflush(stderr);
    is_shown = true;
  }
  if (is_shown) fmt::print(stderr, "\r\033[K");
}

}  // namespace fathom::app
