#pragma once

#include <optional>
#include <string>

#include "apps/shell/output_file.h"

namespace fathom::app {

/// What --json FILE asks for: figures in a file beside the tables, or with - on standard output in
/// their place.
class JsonReport {
 public:
  /// Opens the file, before any work; "" is none.
  /// Fails    OutputError where it cannot be written.
  explicit JsonReport(const std::string& file);

  [[nodiscard]] bool leaves_tables() const { return !on_standard_output_; }
  void write(const std::string& report);

 private:
  bool on_standard_output_;
  std::optional<OutputFile> file_;
};

}  // namespace fathom::app
