#pragma once

#include <atomic>
#include <cstdint>

/// Ends long work early, from another thread.
namespace fathom {

/// Thrown when work ends on request. Not an Error (errors.h): nothing is wrong.
struct Interrupted {};

/// Points to a flag that is true as soon as the end of a thread's work is requested; nullptr if no
/// request is possible.
using InterruptionRequest = const std::atomic<bool>*;

/// The request that the work of this thread obeys.
InterruptionRequest current_interruption();

/// During its lifetime, work of this thread obeys `request`, and so do all threads of parallel work
/// that it starts (threads.h). Code that starts its own thread passes current_interruption() to it.
class Interruptible {
 public:
  explicit Interruptible(InterruptionRequest request);
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;
  ~Interruptible();

 private:
  InterruptionRequest before_;
};

/// Throws Interrupted where the end of this thread's work has been requested. Takes nanoseconds.
/// Parallel work asks before each piece; longer pieces, and loops that are not parallel, ask at
/// least every tenth of a second.
void check_interruption();

/// check_interruption() at every 256th call, for work of nanoseconds such as a comparison in a
/// sort.
class OccasionalInterruption {
 public:
  void operator()() {
    if (++calls_ % 256 == 0) check_interruption();
  }

 private:
  std::uint32_t calls_ = 0;
};

}  // namespace fathom
