#include "apps/jobs/job_progress.h"

#include <fmt/core.h>

#include <cmath>
#include <cstdio>
#include <utility>

#include "apps/shell/last_resort.h"

namespace fathom::app {

using std::chrono::steady_clock;

JobProgress::JobProgress(const Console& console, std::string noun, std::size_t total)
    : noun_(std::move(noun)),
      total_(total),
      shows_(console.shows_progress()),
      start_(steady_clock::now()),
      next_(start_ + std::chrono::seconds(1)) {
  tell();
}

JobProgress::~JobProgress() {
  say_when_interrupted("");
  if (shown_) fmt::print(stderr, "\r\033[K");
}

void JobProgress::add_made(std::size_t count) {
  const std::lock_guard lock(mutex_);
  made_ += count;
  tell();
}

void JobProgress::add_found() {
  const std::lock_guard lock(mutex_);
  ++found_;
  tell();
}

std::string JobProgress::so_far() const {
  const std::lock_guard lock(mutex_);
  return fmt::format(" ({} of {} {}s are finished; the same command goes on from there)",
                     made_ + found_, total_, noun_);
}

void JobProgress::tell() {
  say_when_interrupted(fmt::format(
      "{}fathom: interrupted: {} of {} {}s are finished; the same command goes on from there\n",
      shown_ ? "\r\033[K" : "", made_ + found_, total_, noun_));
  const auto now = steady_clock::now();
  if (!shows_ || now < next_) return;
  next_ = now + std::chrono::milliseconds(100);
  shown_ = true;
  fmt::print(stderr, "\r\033[Kfathom: {}s: {}/{}", noun_, made_ + found_, total_);
  if (made_ != 0) {
    const double rate =
        static_cast<double>(made_) / std::chrono::duration<double>(now - start_).count();
    const long left = std::lround(static_cast<double>(total_ - made_ - found_) / rate);
    fmt::print(stderr, ", {:.3g} {}s/s, {}:{:02}:{:02} left", rate, noun_, left / 3600,
               left / 60 % 60, left % 60);
  }
  std::fflush(stderr);
}

}  // namespace fathom::app
