#pragma once

#include <future>
#include <utility>

#include "fathom/threads/interruption.h"

namespace fathom {

/// Starts work() in a thread of its own or, where the system gives none, leaves it until its result
/// is asked for. It obeys the interruption of this thread.
template <class Work>
auto meanwhile(Work work) {
  return std::async(std::launch::async | std::launch::deferred,
                    [work = std::move(work), request = current_interruption()] {
                      const Interruptible here(request);
                      return work();
                    });
}

}  // namespace fathom
