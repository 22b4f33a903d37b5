#pragma once

namespace fathom::validation {

/// While it lives, what this process writes on standard error is lost. For libraries that talk
/// there and cannot be asked not to.
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
