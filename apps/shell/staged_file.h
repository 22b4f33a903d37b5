#pragma once

#include <sys/types.h>

#include <atomic>
#include <climits>
#include <filesystem>
#include <string>
#include <string_view>

#include "fathom/files/descriptor.h"

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

/// A file that is being written and has no place yet. Until it gets its place, only its owner can
/// read it, and it disappears however the program ends:
///
///   where the system can    it has no name at all (O_TMPFILE)
///   elsewhere               its name is .fathom-XXXXXXXXXXXXXXXX.part. The next program that
///                           writes to the folder removes parts of killed programs: parts of
///                           running programs are locked, and a lock ends with its process.
///
/// Fails    std::system_error with the reason.
class StagedFile {
 public:
  /// A file that is to be put into this folder.
  static StagedFile in_folder(const std::filesystem::path& folder);
  /// A file whose content goes elsewhere, in the folder for temporary files or, without one, in
  /// memory.
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

  /// Takes the memory that putting it at `place` needs.
  void prepare_for(const std::filesystem::path& place);
  /// Puts it at `place` in its folder, instead of what may be there; until then that is untouched.
  void put_at(const std::filesystem::path& place);
  /// The same, but what was there is kept until this object ends, so that take_back_from() can
  /// restore it (unless the file system cannot let two files change places).
  void put_for_now_at(const std::filesystem::path& place);
  /// Restores what was at `place` before put_for_now_at(), or that nothing was, if it can.
  void take_back_from(const std::filesystem::path& place) noexcept;

 private:
  /// What stood at the place before this file did.
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
