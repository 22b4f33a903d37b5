#pragma once

#include <sys/types.h>

#include <string>

namespace fathom::validation {

/// A private X display that nobody looks at: an Xvfb started here. While this object lives, DISPLAY
/// names it. It ends with this object, and with the thread that made it, however that ends.
///
/// Needs  a process that has started no threads.
class VirtualDisplay {
 public:
  /// Fails    InputError if Xvfb is not installed or does not start.
  VirtualDisplay();
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

 private:
  pid_t server_ = -1;
  std::string before_;  ///< what DISPLAY was
};

}  // namespace fathom::validation
