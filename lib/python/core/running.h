#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <optional>
#include <type_traits>
#include <utility>

#include "entry_points.h"
#include "fathom/threads/interruption.h"

namespace fathom::python {

/// Does work of the library with Python's other threads running meanwhile. The work must not touch
/// Python's objects.
///
/// In Python's main thread, the only thread that handles signals: another thread does the work, and
/// the main thread checks for signals twenty times a second. If a signal raises an exception, as
/// Ctrl-C does, the work is asked to end (threads/interruption.h), and this call throws the
/// exception.
///
/// In another thread, when Python exits: the work is asked to end, and the thread blocks until the
/// process ends, like Python's own daemon threads.
void run_apart(const std::function<void()>& work);

/// Asks work in other threads to end when Python exits. Each extension module calls it once.
void end_work_at_exit(Module& module);

/// Runs work(progress) by run_apart() and returns its result. The work can be interrupted when it
/// reports progress.
template <class Work>
auto run(const Work& work) {
  const std::function<void(double)> progress = [](double) { check_interruption(); };
  using Result = decltype(work(progress));
  if constexpr (std::is_void_v<Result>) {
    run_apart([&] { work(progress); });
  } else {
    std::optional<Result> result;
    run_apart([&] { result.emplace(work(progress)); });
    return *std::move(result);
  }
}

}  // namespace fathom::python
