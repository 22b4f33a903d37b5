#include "apps/render/thread_limit.h"

#include <oneapi/tbb/global_control.h>

#include <exception>

namespace fathom::app {

struct ThreadLimit::Control {
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads) {
  if (threads == 0) return;
  control_.reset(new Control{
      {tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)}});
}

ThreadLimit::~ThreadLimit() {
  // A failure ends the program, and where TBB had no memory to set itself up, lifting the limit would
  // wait for ever.
  if (std::uncaught_exceptions() > 0) (void)control_.release();
}

}  // namespace fathom::app
