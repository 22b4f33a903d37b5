#include "apps/mpi/together.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <exception>
#include <filesystem>
#include <new>
#include <optional>
#include <system_error>

#include "fathom/failures/errors.h"
#include "fathom/failures/failure_kind.h"
#include "fathom/files/sha256.h"

namespace fathom::app {
namespace {

/// What all ranks can be told of a failure, so that each of them fails as the first did.
enum class Kind : char { none = '0', usage, input, output, other };

struct Fault {
  Kind kind = Kind::none;
  std::string message;
};

/// The message of an error, with the setting at its beginning written as an option.
std::string message_of(const Error& error) {
  return (error.setting().empty() ? "" : "--") + std::string(error.what());
}

Fault fault_of(const std::function<void()>& work) {
  try {
    work();
    return {};
  } catch (const UsageError& error) {
    return {Kind::usage, message_of(error)};
  } catch (const InputError& error) {
    return {Kind::input, message_of(error)};
  } catch (const OutputError& error) {
    return {Kind::output, message_of(error)};
  } catch (const std::bad_alloc&) {
    return {Kind::input, "out of memory: the input or the image is too large"};
  } catch (const std::filesystem::filesystem_error& error) {
    return {Kind::input, error.path1().string() + ": " + error.code().message()};
  } catch (const std::exception& error) {
    if (kind_of(error) == FailureKind::threads)
      return {Kind::input, "the system starts no more threads; --threads N asks for fewer"};
    return {Kind::other, error.what()};
  }
}

std::atomic<bool> all_fail{false};

[[noreturn]] void fail_as(const Fault& fault) {
  switch (fault.kind) {
    case Kind::usage:
      throw UsageError(fault.message);
    case Kind::input:
      throw InputError(fault.message);
    case Kind::output:
      throw OutputError(fault.message);
    default:
      throw std::runtime_error(fault.message);
  }
}

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

void together(const Ranks& ranks, const std::function<void()>& work) {
  Fault fault = fault_of(work);
  const auto count = static_cast<std::uint64_t>(ranks.count());
  const bool failed = fault.kind != Kind::none;
  const auto first = ranks.least(failed ? static_cast<std::uint64_t>(ranks.self()) : count);
  if (first == count) return;
  const bool all_failed = ranks.sum(failed ? 1 : 0) == count;
  const int speaker = static_cast<int>(first);
  std::string said = ranks.broadcast(static_cast<char>(fault.kind) + fault.message, speaker);
  fault = {static_cast<Kind>(said.front()), said.substr(1)};
  if (!all_failed && speaker != 0)
    fault.message += fmt::format(" (rank {} of {})", speaker, ranks.count());
  report_only(ranks.self() == speaker ? Reports::everything : Reports::nothing);
  all_fail = true;
  fail_as(fault);
}

bool failed_together() noexcept {
  return all_fail;
}

int first_that_differs(const Ranks& ranks, const std::string& text) {
  const std::string own = files::sha256(std::as_bytes(std::span(text)));
  const bool differs = ranks.broadcast(own, 0) != own;
  const auto first = static_cast<int>(
      ranks.least(static_cast<std::uint64_t>(differs ? ranks.self() : ranks.count())));
  if (first < ranks.count()) {
    report_only(ranks.is_first() ? Reports::everything : Reports::nothing);
    all_fail = true;
  }
  return first;
}

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
