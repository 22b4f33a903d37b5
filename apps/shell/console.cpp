#include "apps/shell/console.h"

#include <unistd.h>

#include <cstdio>
#include <utility>

#include "fathom/failures/warnings.h"
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

}  // namespace fathom::app
