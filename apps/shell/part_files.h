#pragma once

#include <sys/types.h>

#include <atomic>
#include <climits>
#include <filesystem>
#include <string>
#include <string_view>

namespace fathom::app {

/// The name of an output that has no other yet: ".fathom-", 16 hexadecimal digits that no other
/// process has drawn, ".part".
std::string new_part_name();

/// Whether a file's name is one of these.
bool is_part_name(std::string_view name);

/// A temporary file that has to go when the program is interrupted. Kept in a list that a signal
/// handler can walk: nodes are never freed, their names have a fixed place.
struct PendingFile {
  std::atomic<bool> active{false};
  char path[PATH_MAX] = {};
  /// The process that owns the file; forked processes do not touch it.
  pid_t owner = 0;
  PendingFile* next = nullptr;
};

/// Notes a path; called before the file is created. Fails with OutputError if it is too long.
PendingFile* note_pending(const std::filesystem::path& path);
/// The file has been renamed or is removed already.
void forget_pending(PendingFile* file);
/// Removes the file and forgets it.
void remove_pending(PendingFile* file);

/// Removes every noted file of this process. Async-signal-safe.
void remove_all_pending();

/// Removes from a folder what programs that were killed have left of their outputs: regular files
/// of this user that have the name of a part and that no living process holds a lock on. Once for
/// each folder; what cannot be removed stays.
void remove_stale_parts(const std::filesystem::path& folder);

}  // namespace fathom::app
