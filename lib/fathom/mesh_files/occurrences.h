#pragma once

#include <cstdint>
#include <string>

#include "fathom/failures/errors.h"
#include "fathom/text/counted.h"

namespace fathom::mesh_files {

/// How often something was noticed in a text, and on which line first.
class Occurrences {
 public:
  void note(std::uint64_t line) {
    if (count_ == 0) line_ = line;
    ++count_;
  }
  /// Adds those of a later part of the text.
  void add(const Occurrences& later) {
    if (count_ == 0) line_ = later.line_;
    count_ += later.count_;
  }

  /// One warning, if there is anything to say: "FILE: 3 MANY, the first on line 7: DONE".
  void warn(const std::string& file, const char* one, const char* many, const char* done,
            Warnings& warnings) const {
    if (count_ == 0) return;
    warnings.push_back(file + ": " + text::counted(count_, one, many) +
                       (count_ == 1 ? ", on line " : ", the first on line ") +
                       std::to_string(line_) + ": " + done);
  }

 private:
  std::uint64_t count_ = 0, line_ = 0;
};

}  // namespace fathom::mesh_files
