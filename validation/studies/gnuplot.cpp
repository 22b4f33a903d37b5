#include "validation/studies/gnuplot.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "fathom/numeric/errors.h"
#include "validation/studies/plot.h"

extern char** environ;

namespace fathom::studies {
namespace {

namespace fs = std::filesystem;

/// A folder for the files of one run, removed at the end.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string pattern = fs::temp_directory_path() / "fathom-plot-XXXXXX";
    if (::mkdtemp(pattern.data()) == nullptr) {
      throw OutputError(pattern + ": cannot make a folder for plots");
    }
    path_ = pattern;
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Starts gnuplot on a script, its output into a file; its exit status, or nullopt where it cannot
/// be started.
std::optional<int> run(const fs::path& script, const fs::path& said) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, said.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  std::string program = "gnuplot", file = script;
  std::string option = "--version";
  char* arguments[] = {program.data(), script.empty() ? option.data() : file.data(), nullptr};
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
  const ScratchFolder folder;
  const std::optional<int> status = run({}, folder.path() / "said");
  // A process that could not be started ends with 127 where the system starts it first.
  if (!status || !WIFEXITED(*status) || WEXITSTATUS(*status) == 127) refuse_missing();
}

std::string png_bytes(const RgbImage& image) {
  const ScratchFolder folder;
  const fs::path path = folder.path() / "picture.png";
  write_png(image, path);
  return content_of(path);
}

std::vector<StudyFile> run_gnuplot(const std::string& name, const std::string& script) {
  const ScratchFolder folder;
  const std::string base = folder.path() / name;
  const auto terminal = [](const char* kind, const char* size, const std::string& file) {
    return std::string("set terminal ") + kind + " size " + size + "\nset output \"" + file +
           "\"\n";
  };
  const auto twice = [&](const std::string& place) {
    return terminal("pngcairo font \"DejaVu Sans,11\"", "1100,650", place + ".png") + script +
           terminal("svg font \"DejaVu Sans,11\"", "1100,650", place + ".svg") +
           "replot\nset output\n";
  };
  const fs::path file = folder.path() / "script.gp", said = folder.path() / "said";
  std::ofstream(file) << twice(base);
  const std::optional<int> status = run(file, said);
  if (!status) refuse_missing();
  std::vector<StudyFile> files{{name + ".gp", twice(name)},
                               {name + ".png", content_of(base + ".png")},
                               {name + ".svg", content_of(base + ".svg")}};
  if (!WIFEXITED(*status) || WEXITSTATUS(*status) != 0 || files[1].content.empty() ||
      files[2].content.empty()) {
    throw OutputError("gnuplot cannot draw " + name + ": " + first_line(content_of(said)));
  }
  return files;
}

}  // namespace fathom::studies
