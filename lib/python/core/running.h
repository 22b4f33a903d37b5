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
/// In Python's main thread, which alone handles signals: another thread does the work, and the main
/// thread looks for signals twenty times a second. Where one raises an exception, as Ctrl-C does,
/// the work is asked to end (threads/interruption.h), and the exception leaves this call.
///
/// In another thread, when Python exits: the work is asked to end, and the thread stands still
/// until the process is gone, as Python's own daemon threads do.
void run_apart(const std::function<void()>& work);

/// Asks work in other threads to end when Python exits. To be called once by each extension module.
void end_work_at_exit(Module& module);

/// The result of work(progress) as run_apart() does it. Where the work reports progress it can end,
/// too.
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
