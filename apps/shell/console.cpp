#include "apps/shell/console.h"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdio>

#include "fathom/text/printable.h"

namespace fathom::app {
namespace {

/// One line whatever the text, which may hold a file's name.
void say(const std::string& text) {
  std::string line = "fathom: " + text;
  for (char& c : line) {
    if (c == '\n' || c == '\r' || c == '\t') c = ' ';
  }
  line = text::printable(line);
  while (line.ends_with(' ')) line.pop_back();
  line += '\n';
  std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace

void Console::warn(const std::string& text) const {
  if (!quiet) say("warning: " + text);
}

void Console::warn(const Warnings& warnings) const {
  for (const std::string& text : warnings) warn(text);
}

void Console::note(const std::string& text) const {
  if (!quiet) say(text);
}

void Console::error(const std::string& text) {
  say("error: " + text);
}

bool Console::shows_progress() const {
  return !quiet && ::isatty(STDERR_FILENO) == 1;
}

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
