#include "validation/blender/workplace.h"

#include <fcntl.h>
#include <stdlib.h>  // NOLINT(modernize-deprecated-headers): mkdtemp
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <fstream>

#include "fathom/failures/errors.h"

namespace fathom::validation {
namespace {

/// Waits until nobody has the other end of `pipe` any more, then removes the folder.
[[noreturn]] void wait_and_remove(int pipe, const std::filesystem::path& folder) {
  ::setpgid(0, 0);  // is not ended with the others
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_IGN);
  char byte = 0;
  while (::read(pipe, &byte, 1) < 0 && errno == EINTR) {
  }
  std::error_code error;
  std::filesystem::remove_all(folder, error);
  ::_exit(0);
}

}  // namespace

Workplace::Workplace() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (error) throw InputError("the folder for temporary files, TMPDIR: " + error.message());
  std::string name = (folder / "fathom-validate-XXXXXX").string();
  std::array<int, 2> ends{};
  if (::mkdtemp(name.data()) == nullptr || ::pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw InputError("cannot make a folder for a renderer's files in " + folder.string());
  }
  path_ = name;
  remover_ = ::fork();
  if (remover_ == 0) {
    ::close(ends[1]);
    wait_and_remove(ends[0], path_);
  }
  ::close(ends[0]);
  alive_ = ends[1];
}

Workplace::~Workplace() {
  ::close(alive_);
  if (remover_ > 0) ::waitpid(remover_, nullptr, 0);
  std::error_code error;
  std::filesystem::remove_all(path_, error);
}

void Workplace::write(const std::string& name, const std::string& bytes) const {
  std::ofstream file(path_ / name, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw InputError("cannot write a renderer's files in " + path_.string());
}

}  // namespace fathom::validation
