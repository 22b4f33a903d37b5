#pragma once

#include <unistd.h>

#include <utility>

namespace fathom::text {

/// A file descriptor that closes itself; standard input stays open.
struct Descriptor {
  int number = -1;

  explicit Descriptor(int descriptor) : number(descriptor) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number > STDIN_FILENO) ::close(number);
  }
  /// The number, which is the caller's to close from now on.
  [[nodiscard]] int release() { return std::exchange(number, -1); }
};

}  // namespace fathom::text
