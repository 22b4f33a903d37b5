#pragma once

#include <cstdint>
#include <ctime>
#include <string>

namespace fathom::files {

/// The size of an open file, and when it was last written to: two equal states mean that nobody has
/// written to the file or cut it short in between, as far as the clock of its file system tells.
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

}  // namespace fathom::files
