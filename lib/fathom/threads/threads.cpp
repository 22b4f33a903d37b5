#include "fathom/threads/threads.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <string_view>
#include <system_error>

#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {

void in_parallel(std::size_t count, const std::function<void(std::size_t)>& work) {
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    const StandardArithmetic standard;
    work(i);
  });
}

void run_with_threads(int threads, const std::function<void()>& work) {
  std::optional<tbb::global_control> limit;
  if (threads > 0) {
    limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  }
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] {
    const StandardArithmetic standard;
    work();
  });
}

bool is_lack_of_threads(const std::exception& failure) {
  if (const auto* error = dynamic_cast<const std::system_error*>(&failure)) {
    return error->code() == std::errc::resource_unavailable_try_again;
  }
  // TBB has no type for it.
  return std::string_view(failure.what()).starts_with("pthread_create has failed");
}

}  // namespace fathom
