#include "apps/shell/progress.h"

#include <fmt/core.h>

#include <cstdio>

#include "fathom/text/printable.h"

namespace fathom::app {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

Progress::Progress(const Console& console, const std::string& work)
    : work_(text::printable(work)),
      enabled_(console.shows_progress()),
      next_(steady_clock::now() + milliseconds(1000)) {}

Progress::~Progress() {
  if (shown_) fmt::print(stderr, "\r\033[K");
}

std::function<void(double)> Progress::reporter(std::size_t step, std::size_t steps) {
  if (!enabled_) return {};
  return [this, step, steps](double share) {
    show((static_cast<double>(step) + share) / static_cast<double>(steps));
  };
}

void Progress::show(double share) {
  const auto now = steady_clock::now();
  if (now < next_) return;
  next_ = now + milliseconds(100);
  shown_ = true;
  fmt::print(stderr, "\r\033[Kfathom: {}: {:.0f} %", work_, 100 * share);
  std::fflush(stderr);
}

}  // namespace fathom::app
