#pragma once

#include <optional>
#include <string>

#include "apps/shell/output_file.h"

namespace fathom::app {

/// A text for a file, for standard output ("-"), or for nothing (""). Opened before the work.
class TextOutput {
 public:
  /// Fails    OutputError, as OutputFile, or where standard output is closed.
  explicit TextOutput(const std::string& name);

  void write(const std::string& text);
  /// The file that has to be committed; nullptr where there is none.
  [[nodiscard]] OutputFile* file() { return file_ ? &*file_ : nullptr; }
  /// Prints what goes to standard output.
  void print() const;
  /// All of it, where this is the only output.
  void finish(const std::string& text);

 private:
  std::optional<OutputFile> file_;
  bool printed_ = false;
  std::string text_;
};

/// Writes a text as an output of its own.
inline void write_text(const std::string& name, const std::string& text) {
  TextOutput(name).finish(text);
}

}  // namespace fathom::app
