#include "apps/render/thread_limit.h"

#include <oneapi/tbb/global_control.h>

namespace fathom::app {

struct ThreadLimit::Control {
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads) {
  if (threads == 0) return;
  control_.reset(new Control{
      {tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)}});
}

ThreadLimit::~ThreadLimit() = default;

}  // namespace fathom::app
