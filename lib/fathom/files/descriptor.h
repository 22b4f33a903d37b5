#pragma once

#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <ctime>
#include <string>
#include <system_error>
#include <utility>

#include "fathom/failures/errors.h"

namespace fathom::files {

/// An open file by its number, closed at the end of its scope; −1 means no file.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }

  [[nodiscard]] int get() const { return number_; }
  [[nodiscard]] bool is_open() const { return number_ >= 0; }
  /// Closes the file now; false if data were lost.
  bool close() { return number_ < 0 || ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_;
};

/// The size of an open file, and the time of the last write. If two states are equal, nobody has
/// written to the file or truncated it in between, up to the resolution of its file system's clock.
struct FileState {
  std::uint64_t size = 0;
  timespec written{};
};

/// Fails    InputError "NAME: cannot be examined: …".
FileState state_of(int descriptor, const std::string& name);

/// Fails    InputError "NAME: has been cut short …" where the file is smaller than when it was
///          opened.
void expect_whole(const FileState& opened, const FileState& now, const std::string& name);
/// Fails    also InputError "NAME: has been written to …" where the states differ otherwise.
void expect_unchanged(const FileState& opened, const FileState& now, const std::string& name);

/// Throws an InputError with the failed operation on the file and the reason (errno).
[[noreturn]] inline void fail_with_errno(const std::string& name, const char* what) {
  throw InputError(name + ": " + what + ": " + std::generic_category().message(errno));
}

}  // namespace fathom::files
