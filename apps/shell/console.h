#pragma once

#include <string>

#include "fathom/failures/warnings.h"

namespace fathom::app {

/// What the program says beside its answers, on standard error.
class Console {
 public:
  /// No warnings and no progress; errors are said all the same.
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

}  // namespace fathom::app
