#include "fathom/failures/failure_kind.h"

#include <algorithm>
#include <array>
#include <new>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "fathom/failures/errors.h"

namespace fathom {
namespace {

template <class... Exceptions>
bool is_any_of(const std::exception& failure) {
  return (... || (dynamic_cast<const Exceptions*>(&failure) != nullptr));
}

/// Refusals of the system that only outputs encounter.
constexpr std::array refusals_of_outputs{std::errc::no_space_on_device,
                                         std::errc::read_only_file_system,
                                         std::errc::file_too_large, std::errc::broken_pipe};

FailureKind kind_of_refusal(const std::error_code& code) {
  const auto is_code = [&](std::errc refusal) { return code == refusal; };
  if (code == std::errc::resource_unavailable_try_again) return FailureKind::threads;
  if (code == std::errc::not_enough_memory) return FailureKind::memory;
  return std::ranges::any_of(refusals_of_outputs, is_code) ? FailureKind::output
                                                           : FailureKind::input;
}

/// TBB has no type for it.
bool is_lack_of_threads_of_tbb(const std::exception& failure) {
  return std::string_view(failure.what()).starts_with("pthread_create has failed");
}

}  // namespace

FailureKind kind_of(const std::exception& failure) {
  if (is_any_of<UsageError>(failure)) return FailureKind::usage;
  if (is_any_of<InputError>(failure)) return FailureKind::input;
  if (is_any_of<OutputError>(failure)) return FailureKind::output;
  if (is_any_of<std::bad_alloc, std::length_error>(failure)) return FailureKind::memory;
  if (const auto* refusal = dynamic_cast<const std::system_error*>(&failure))
    return kind_of_refusal(refusal->code());
  return is_lack_of_threads_of_tbb(failure) ? FailureKind::threads : FailureKind::internal;
}

}  // namespace fathom
