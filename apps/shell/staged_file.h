#pragma once

#include <sys/types.h>

#include <atomic>
#include <climits>
#include <filesystem>
#include <string>
#include <string_view>

#include "fathom/files/descriptor.h"

namespace fathom::app {

/// A temporary name for an output: ".fathom-", 16 hexadecimal digits that no other process uses,
/// ".part".
std::string new_part_name();

/// Whether a file has such a name.
bool is_part_name(std::string_view name);

/// A temporary file that is removed when the program is interrupted. It is kept in a list that a
/// signal handler can walk: nodes are never freed and names do not move.
struct PendingFile {
  std::atomic<bool> active{false};
  char path[PATH_MAX] = {};
  /// The process that owns the file; forked processes do not touch it.
  pid_t owner = 0;
  PendingFile* next = nullptr;
};

/// Notes a path; called before the file is created. Fails with OutputError if it is too long.
PendingFile* note_pending(const std::filesystem::path& path);
/// Called when the file has been renamed or removed.
void forget_pending(PendingFile* file);
/// Removes the file and forgets it.
void remove_pending(PendingFile* file);

/// Removes every noted file of this process. Async-signal-safe.
void remove_all_pending();

/// Removes partial outputs of killed programs from a folder: regular files of this user that have
/// the name of a part and that no living process has locked. Does so once for each folder. Files
/// that cannot be removed stay.
void remove_stale_parts(const std::filesystem::path& folder);

/// A file that is being written and has not been put in its place yet. Until then only its owner
/// can read it, and it disappears however the program ends:
///
///   if the system can   it has no name at all (O_TMPFILE)
///   elsewhere           its name is .fathom-XXXXXXXXXXXXXXXX.part. The next program that writes to
///                       the folder removes parts of killed programs: parts of running programs are
///                       locked, and a lock ends with its process.
///
/// Fails    std::system_error with the reason.
class StagedFile {
 public:
  /// A file that will be put into this folder.
  static StagedFile in_folder(const std::filesystem::path& folder);
  /// A file whose content will be copied elsewhere: in the folder for temporary files or, without
  /// such a folder, in memory.
  static StagedFile nowhere();
  StagedFile(StagedFile&& other) noexcept;
  StagedFile& operator=(StagedFile&&) = delete;
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;
  ~StagedFile();

  [[nodiscard]] int descriptor() const { return file_.get(); }
  /// A path under which it can be opened again until it is put in its place or removed.
  [[nodiscard]] std::string path() const;
  /// The permissions that an ordinary new file would have in its folder.
  [[nodiscard]] mode_t ordinary_mode() const { return ordinary_mode_; }

  /// Allocates the memory that putting it at `place` needs.
  void prepare_for(const std::filesystem::path& place);
  /// Puts it at `place` in its folder and replaces an existing file, which is untouched until then.
  void put_at(const std::filesystem::path& place);
  /// The same, but an existing file is kept until this object ends, so that take_back_from() can
  /// restore it (unless the file system cannot exchange two files).
  void put_for_now_at(const std::filesystem::path& place);
  /// Restores the state of `place` before put_for_now_at(), an earlier file or no file, if
  /// possible.
  void take_back_from(const std::filesystem::path& place) noexcept;

 private:
  /// The fate of the file that was at the place before this file.
  enum class Earlier { nothing, kept, lost };

  StagedFile() = default;
  bool open_without_name(const std::filesystem::path& folder);
  void open_with_name(const std::filesystem::path& folder);
  bool link_to(const char* place) const;
  void have_name(const std::filesystem::path& place);
  void rename_to(const std::filesystem::path& place);
  void copy_to(const StagedFile& other) const;

  files::Descriptor file_;
  mode_t ordinary_mode_ = 0;
  /// Its name, if it has one; after a provisional exchange, the name of the earlier file.
  PendingFile* name_ = nullptr;
  /// A name next to its place, and the path of the nameless file.
  PendingFile* spare_name_ = nullptr;
  std::string self_;
  Earlier earlier_ = Earlier::lost;
};

}  // namespace fathom::app
