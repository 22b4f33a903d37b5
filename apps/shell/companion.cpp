#include "apps/shell/companion.h"

#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "fathom/numeric/errors.h"

namespace fathom::app {

std::filesystem::path companion_path(const std::string& program) {
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  return error ? std::filesystem::path() : self.parent_path() / program;
}

void start_companion(const std::string& program, const std::vector<std::string>& arguments) {
  if (program.find('/') != std::string::npos) return;
  const std::string path = companion_path(program);
  std::error_code error;
  if (path.empty() || !std::filesystem::exists(path, error)) return;

  std::vector<char*> list{const_cast<char*>(path.c_str())};
  for (const std::string& argument : arguments) list.push_back(const_cast<char*>(argument.c_str()));
  list.push_back(nullptr);
  ::execv(path.c_str(), list.data());
  throw UsageError(fmt::format("{}: {}", path, std::strerror(errno)));
}

std::string not_built(const std::string& what, const std::string& program, const std::string& how) {
  return fmt::format(
      "{} is a program of its own, {}, that is not built: 'scripts/fathom {}' installs what it "
      "needs and builds it",
      what, program, how);
}

}  // namespace fathom::app
