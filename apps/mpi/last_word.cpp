#include "apps/mpi/last_word.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <optional>

namespace fathom::app {
namespace {

std::atomic<Reports> reports_now{Reports::everything};
/// The file that the reporting process creates; "" if there is no such file.
std::array<char, 512> last_word_path{};
std::atomic<std::atomic<int>*> said_by_any{nullptr};

/// Whether this process is the first to create the file; nullopt if it cannot be created.
std::optional<bool> makes_last_word_file() noexcept {
  if (last_word_path[0] == '\0') return std::nullopt;
  const int file = ::open(last_word_path.data(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0600);
  if (file >= 0) {
    ::close(file);
    return true;
  }
  return errno == EEXIST ? std::optional(false) : std::nullopt;
}

/// Called in signal handlers: async-signal-safe.
bool is_ours_to_report(Ending ending) noexcept {
  const Reports needed =
      ending == Ending::interruption ? Reports::interruptions : Reports::everything;
  Reports now = reports_now;
  do {
    if (now < needed) return false;
  } while (!reports_now.compare_exchange_weak(now, Reports::nothing));
  if (const std::optional<bool> first = makes_last_word_file()) return *first;
  std::atomic<int>* const said = said_by_any;
  return said == nullptr || said->exchange(1) == 0;
}

}  // namespace

void report_only(Reports reports) noexcept {
  reports_now = reports;
  let_decide(is_ours_to_report);
}

void share_last_word(const std::string& path) {
  if (path.size() < last_word_path.size()) path.copy(last_word_path.data(), path.size());
  let_decide(is_ours_to_report);
}

void share_last_word(std::atomic<int>* said) noexcept {
  said_by_any = said;
  let_decide(is_ours_to_report);
}

}  // namespace fathom::app
