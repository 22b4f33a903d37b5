#include "fathom/threads/interruption.h"

#include <utility>

namespace fathom {
namespace {

thread_local InterruptionRequest request_here = nullptr;

}  // namespace

InterruptionRequest current_interruption() {
  return request_here;
}

Interruptible::Interruptible(InterruptionRequest request)
    : before_(std::exchange(request_here, request)) {}

Interruptible::~Interruptible() {
  request_here = before_;
}

void check_interruption() {
  if (request_here != nullptr && request_here->load(std::memory_order_relaxed)) throw Interrupted();
}

}  // namespace fathom
