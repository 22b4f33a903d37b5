#pragma once

namespace fathom::validation {

/// Discards what this process writes to standard error while it lives. For libraries that write
/// there and cannot be told not to.
class QuietStderr {
 public:
  QuietStderr();
  ~QuietStderr();
  QuietStderr(const QuietStderr&) = delete;
  QuietStderr& operator=(const QuietStderr&) = delete;

 private:
  int kept_ = -1;
};

}  // namespace fathom::validation
