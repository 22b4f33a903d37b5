#include "apps/view/browser.h"

#include <fcntl.h>
#include <spawn.h>
#include <stdlib.h>
#include <unistd.h>

#include <cerrno>
#include <string>

#include "apps/shell/standard_streams.h"
#include "fathom/failures/errors.h"

namespace fathom::app {

std::filesystem::path new_page_path() {
  std::error_code error;
  std::filesystem::path parent = std::filesystem::temp_directory_path(error);
  if (error) throw OutputError("TMPDIR: " + error.message());
  std::string folder = (parent / "fathom-view-XXXXXX").string();
  if (::mkdtemp(folder.data()) == nullptr) fail_with_errno(folder, errno);
  return std::filesystem::path(folder) / "map.html";
}

namespace {

bool is_set(const char* variable) {
  const char* const value = ::getenv(variable);
  return value != nullptr && *value != '\0';
}

}  // namespace

void open_in_browser(const std::string& page, const Console& console) {
  const bool is_chosen = is_set("BROWSER");
  if (!is_chosen && !is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY")) {
    console.warn("no display for a browser: open " + page +
                 " yourself, or name a browser in BROWSER");
    return;
  }
  std::string program = is_chosen ? ::getenv("BROWSER") : "xdg-open", argument = page;
  char* const arguments[] = {program.data(), argument.data(), nullptr};
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
  // xdg-open reports each browser that is not there.
  if (!is_chosen)
    ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = -1;
  const int error = ::posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments, environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (error != 0) {
    throw OutputError("no browser: '" + program + "' cannot be started; open " + page +
                      " yourself, or name a browser in BROWSER");
  }
}

}  // namespace fathom::app
