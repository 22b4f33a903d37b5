#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <functional>
#include <thread>

namespace fathom::python {

/// Thrown through the library where Python's signal handlers have raised an exception.
struct Interrupted {};

/// Lets Python handle its signals while the library works, so that Ctrl-C ends a long call.
///
/// Progress is reported from any thread, but Python handles signals in its main thread alone: only
/// reports from the thread that called look, at most twenty times a second. Elsewhere than in the
/// main thread Python has no signals to handle, and the look costs nothing.
class SignalWatch {
 public:
  [[nodiscard]] std::function<void(double)> progress() {
    return [this](double) {
      if (std::this_thread::get_id() == caller_) look();
    };
  }

 private:
  using Clock = std::chrono::steady_clock;

  void look() {
    const auto now = Clock::now();
    if (now < next_) return;
    next_ = now + std::chrono::milliseconds(50);
    const PyGILState_STATE state = PyGILState_Ensure();
    const bool raised = PyErr_CheckSignals() != 0;
    PyGILState_Release(state);
    if (raised) throw Interrupted();
  }

  std::thread::id caller_ = std::this_thread::get_id();
  Clock::time_point next_ = Clock::now() + std::chrono::milliseconds(50);
};

/// work(progress) with Python's other threads running meanwhile, and Ctrl-C noticed wherever the
/// work reports progress. The work must not touch Python's objects.
template <class Work>
auto run(const Work& work) {
  SignalWatch watch;
  try {
    const pybind11::gil_scoped_release others_run;
    return work(watch.progress());
  } catch (const Interrupted&) {
    throw pybind11::error_already_set();
  }
}

}  // namespace fathom::python
