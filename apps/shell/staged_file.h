#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

#include "fathom/files/descriptor.h"

namespace fathom::app {

struct PendingFile;

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
