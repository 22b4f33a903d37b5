#include "fathom/threads/threads.h"

#include <string>
#include <string_view>
#include <system_error>

#include "fathom/failures/errors.h"

namespace fathom {

void require_thread_count(int threads) {
  if (threads < 0 || threads > most_threads) {
    throw UsageError(Setting{"threads"}, "expected 0 to " + std::to_string(most_threads));
  }
}

bool is_lack_of_threads(const std::exception& failure) {
  if (const auto* error = dynamic_cast<const std::system_error*>(&failure)) {
    return error->code() == std::errc::resource_unavailable_try_again;
  }
  // TBB has no type for it.
  return std::string_view(failure.what()).starts_with("pthread_create has failed");
}

}  // namespace fathom
