#pragma once

#include <future>
#include <utility>

#include "fathom/threads/interruption.h"

namespace fathom {

/// Starts work() in a new thread. If the system starts no more threads, work() runs when its result
/// is requested. It obeys the interruption of this thread.
template <class Work>
auto meanwhile(Work work) {
  return std::async(std::launch::async | std::launch::deferred,
                    [work = std::move(work), request = current_interruption()] {
                      const Interruptible here(request);
                      return work();
                    });
}

}  // namespace fathom
