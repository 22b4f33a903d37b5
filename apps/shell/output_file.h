#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace fathom::app {

struct PendingFile;

/// One output of a command. It is written under a temporary name and put in its place by commit();
/// until then an older file of that name is untouched, and what is not committed leaves nothing
/// behind, also when the program is interrupted (see remove_outputs_when_interrupted).
///
///   an ordinary or a new file   the temporary lies beside it and is renamed; an existing file's
///                               permissions are kept, a new one has those that open(2) gives
///   a symbolic link             is followed: the file it names is replaced, the link stays
///   anything else that exists   (a device, a pipe) is written through, never replaced; the
///                               temporary lies in the folder for temporary files
///
/// Fails    OutputError: "PATH: why"; from the constructor where that can be told before the work.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path target);
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&&) = delete;
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  /// Runs `writer` on the temporary, which exists and is empty. Where it fails with an Error, the
  /// message names the output as the user does.
  void write(const std::function<void(const std::filesystem::path&)>& writer) const;
  void write(const std::string& text) const;

  /// Puts the output in its place.
  void commit();

 private:
  void create_temporary();

  std::filesystem::path target_;
  /// `target_` with symbolic links followed.
  std::filesystem::path place_;
  bool write_through_ = false;
  PendingFile* pending_ = nullptr;
};

/// Writes a text as an output of its own; "-" is standard output.
void write_text(const std::filesystem::path& target, const std::string& text);

/// Writes to standard output. Fails with OutputError where that is closed or full.
void print(const std::string& text);

/// From now on SIGINT, SIGTERM and SIGHUP remove the temporaries and end the program with 130;
/// a closed pipe and a file that grows beyond the limit are errors of writing, not signals.
void remove_outputs_when_interrupted();

}  // namespace fathom::app
