#pragma once

#include <sys/types.h>

#include <atomic>
#include <climits>
#include <filesystem>

namespace fathom::app {

/// A temporary file that has to go when the program is interrupted. Kept in a list that a signal
/// handler can walk: nodes are never freed, their names have a fixed place.
struct PendingFile {
  std::atomic<bool> active{false};
  char path[PATH_MAX] = {};
  /// The process that the file belongs to: one that forked off it leaves the file alone.
  pid_t owner = 0;
  PendingFile* next = nullptr;
};

/// Notes a path; called before the file is created. Fails with OutputError if it is too long.
PendingFile* note_pending(const std::filesystem::path& path);
/// The file has been renamed or is removed already.
void forget_pending(PendingFile* file);
/// Removes the file and forgets it.
void remove_pending(PendingFile* file);

/// Removes every noted file of this process. Calls only what is safe in a signal handler.
void remove_all_pending();

}  // namespace fathom::app
