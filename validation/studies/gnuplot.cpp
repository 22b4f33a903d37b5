#include "validation/studies/gnuplot.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <optional>
#include <span>
#include <string>

#include "fathom/numeric/errors.h"
#include "fathom/text/file_bytes.h"
#include "fathom/text/input_file.h"
#include "validation/studies/plot.h"

extern char** environ;

namespace fathom::studies {
namespace {

/// A file in memory that programs started from here can open by its path. It has no name in any
/// folder, so that nothing is left behind, however this program ends.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(::memfd_create("fathom-plot", 0)) {
    if (descriptor_ < 0) throw OutputError("plots: cannot make a file in memory");
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { ::close(descriptor_); }

  [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }
  [[nodiscard]] std::string content() const {
    return std::string(text::InputFile(path(), text::InputFile::Reading::copied).text());
  }

 private:
  int descriptor_;
};

/// Starts gnuplot on an argument, its output into a file; its exit status, or nullopt where it
/// cannot be started.
std::optional<int> run(std::string argument, const MemoryFile& said) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, said.path().c_str(), O_WRONLY | O_TRUNC,
                                   0);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  std::string program = "gnuplot";
  char* arguments[] = {program.data(), argument.data(), nullptr};
  pid_t process = 0;
  const int error = ::posix_spawnp(&process, "gnuplot", &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return std::nullopt;
  int status = 0;
  if (::waitpid(process, &status, 0) < 0) return std::nullopt;
  return status;
}

[[noreturn]] void refuse_missing() {
  throw OutputError("gnuplot, which draws the plots, is not there: install gnuplot-nox");
}

std::string first_line(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \n");
  return begin == std::string::npos ? "" : text.substr(begin, text.find('\n', begin) - begin);
}

}  // namespace

void require_gnuplot() {
  const MemoryFile said;
  const std::optional<int> status = run("--version", said);
  // A process that could not be started ends with 127 where the system starts it first.
  if (!status || !WIFEXITED(*status) || WEXITSTATUS(*status) == 127) refuse_missing();
}

std::string png_bytes(const RgbImage& image) {
  const MemoryFile file;
  write_png(image, file.path());
  return file.content();
}

std::vector<StudyFile> run_gnuplot(const std::string& name, const std::string& script) {
  const auto terminal = [](const char* kind, const std::string& place) {
    return std::string("set terminal ") + kind +
           " font \"DejaVu Sans,11\" size 1100,650\nset output \"" + place + "\"\n";
  };
  const auto twice = [&](const std::string& png, const std::string& svg) {
    return terminal("pngcairo", png) + script + terminal("svg", svg) + "replot\nset output\n";
  };
  const MemoryFile input, said, png, svg;
  const std::string commands = twice(png.path(), svg.path());
  text::write_file(input.path(), std::as_bytes(std::span(commands)));
  const std::optional<int> status = run(input.path(), said);
  if (!status) refuse_missing();
  std::vector<StudyFile> files{{name + ".gp", twice(name + ".png", name + ".svg")},
                               {name + ".png", png.content()},
                               {name + ".svg", svg.content()}};
  if (!WIFEXITED(*status) || WEXITSTATUS(*status) != 0 || files[1].content.empty() ||
      files[2].content.empty()) {
    throw OutputError("gnuplot cannot draw " + name + ": " + first_line(said.content()));
  }
  return files;
}

}  // namespace fathom::studies
