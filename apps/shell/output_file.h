#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/shell/staged_file.h"
#include "fathom/files/descriptor.h"
#include "fathom/files/file_bytes.h"

namespace fathom::app {

/// The folder in the name of a file; "." if the name has no folder.
std::filesystem::path folder_of(const std::filesystem::path& file);

/// The destination that the name of an output leads to.
struct OutputPlace {
  /// The named file after following symbolic links; it need not exist.
  std::filesystem::path path;
  /// The number of this process's open file that it names: 1 for /dev/stdout.
  std::optional<int> open_file;
  /// Whether it lies in /proc, where no file can be put.
  bool is_foreign = false;
};

/// Fails    OutputError if links form a circle.
OutputPlace place_of(const std::filesystem::path& target);

/// Whether writes to this name go directly into a device, a pipe or an open file, whose name needs
/// no suffix.
bool is_written_through(const std::filesystem::path& target);

/// The name of a picture as an argument: it ends in .png, or is a device, a pipe or an open file.
/// Fails    UsageError: "'text' does not end in .png".
std::string parse_png_name(const std::string& text);

/// Makes a folder unless it exists. Fails with OutputError.
void make_folder(const std::filesystem::path& folder);

/// The folder itself, or the nearest existing folder above it. Files can be moved between the two,
/// because a folder that is made later lies in the same file system.
std::filesystem::path nearest_existing(const std::filesystem::path& folder);

/// Folders that are made for outputs. Unless they are kept, this object removes them at its end,
/// except folders that other programs have put files into meanwhile.
class NewFolders {
 public:
  NewFolders() = default;
  NewFolders(const NewFolders&) = delete;
  NewFolders& operator=(const NewFolders&) = delete;
  ~NewFolders();

  /// Makes the folder and its parents, if they do not exist.
  /// Fails    std::system_error.
  void make(const std::filesystem::path& folder);
  void keep() { made_.clear(); }
  /// The folders that were made, outer ones first.
  [[nodiscard]] const std::vector<std::filesystem::path>& made() const { return made_; }

 private:
  std::vector<std::filesystem::path> made_;
};

/// One output of a command. It is written next to its place, without a name or under a temporary
/// name (staged_file.h), and commit() moves it there. Until then an older file of that name is
/// untouched. An output that is not committed leaves nothing behind, however the program ends.
///
///   an ordinary or a new file   is replaced at once; an existing file's permissions are kept, a
///                               new file gets the permissions of open(2). Its bytes are synced
///                               to disk before it gets its name
///   a folder that is missing    is made when the outputs take their places, with those above it; a
///                               command that fails leaves none
///   a symbolic link             is followed: the file it names is replaced, the link stays
///   anything else that exists   (a device, a pipe, /dev/stdout) is written through, never replaced
///
/// Fails    OutputError: "PATH: why"; the constructor fails if the fault shows before the work.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path target);
  OutputFile(OutputFile&&) noexcept = default;
  OutputFile& operator=(OutputFile&&) = delete;
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile() = default;

  /// Runs `writer` on the staged file, which exists and is empty. If it fails with an Error, the
  /// message has the user's name for the output.
  void write(const std::function<void(const std::filesystem::path&)>& writer) const;
  /// The same with its descriptor.
  void write_by_descriptor(const std::function<void(int descriptor)>& writer) const;
  void write(files::ByteView bytes) const;
  void write(const std::string& text) const { write(std::as_bytes(std::span(text))); }

  /// Puts the output in its place.
  void commit() { commit_together({this}); }
  /// Puts outputs in their places. The first output appears only when all of them are on the disk
  /// or written through. If an output cannot take its place, the previous outputs are undone.
  static void commit_together(const std::vector<OutputFile*>& outputs);

 private:
  /// The existing file at the place of an output.
  struct Existing {
    mode_t mode;
    uid_t owner;
    gid_t group;
  };

  void find_place(bool exists, mode_t mode);
  void stage();
  void take_permissions() const;
  void sync(int (*sync_one)(int)) const;
  static void sync_all(const std::vector<OutputFile*>& placed);
  void write_through();
  void make_folder_in(NewFolders& folders) const;
  void take_place(bool is_last);
  static void take_places(const std::vector<OutputFile*>& outputs);

  std::filesystem::path target_;
  /// `target_` after following symbolic links; empty if it is written through.
  std::filesystem::path place_;
  std::optional<Existing> existing_;
  /// The device, pipe or file that is already open for writing.
  files::Descriptor through_;
  std::optional<StagedFile> staged_;
};

/// A text for a file, for standard output ("-"), or for nothing (""). Opened before the work.
class TextOutput {
 public:
  /// Fails    OutputError, as OutputFile, or if standard output is closed.
  explicit TextOutput(const std::string& name);

  void write(const std::string& text);
  /// The file to commit; nullptr if the output is written through.
  [[nodiscard]] OutputFile* file() { return file_ ? &*file_ : nullptr; }
  /// Prints the text if it is for standard output.
  void print() const;
  /// Writes and commits the text, if this is the only output.
  void finish(const std::string& text);

 private:
  std::optional<OutputFile> file_;
  bool printed_ = false;
  std::string text_;
};

/// Writes a text as a complete output.
inline void write_text(const std::string& name, const std::string& text) {
  TextOutput(name).finish(text);
}

}  // namespace fathom::app
