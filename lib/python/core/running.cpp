#include "running.h"

#include <cxxabi.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

namespace py = pybind11;

namespace fathom::python {
namespace {

using namespace std::chrono_literals;

/// Blocks the thread until the process ends. Ending the thread would unwind its stack, which
/// contains Python objects, while Python shuts down.
[[noreturn]] void stand_still() {
  while (true) ::pause();
}

/// Releases the GIL until take() is called. A destructor cannot take it: when Python exits, a
/// thread that wants the GIL is unwound (before Python 3.14), which ends the program in a noexcept
/// function.
class WithoutGil {
 public:
  WithoutGil() : state_(PyEval_SaveThread()) {}
  WithoutGil(const WithoutGil&) = delete;
  WithoutGil& operator=(const WithoutGil&) = delete;

  void take() {
    try {
      PyEval_RestoreThread(state_);
    } catch (const abi::__forced_unwind&) {
      stand_still();
    }
  }
  void leave() { state_ = PyEval_SaveThread(); }

 private:
  PyThreadState* state_;
};

/// Work in other threads than the main one.
struct OtherThreads {
  std::atomic<bool> end_is_near{false};
  std::atomic<int> working{0};
  /// The process to which `working` belongs: a forked process does not have these threads.
  std::atomic<pid_t> process{0};
};

/// Never freed: threads may ask until the process is gone.
OtherThreads& other_threads() {
  static auto* const all = new OtherThreads;
  if (all->process.exchange(::getpid()) != ::getpid()) all->working = 0;
  return *all;
}

bool is_main_thread() {
  return ::syscall(SYS_gettid) == ::getpid();
}

/// Does the work in the calling thread, which is not the main thread.
void run_here(const std::function<void()>& work) {
  OtherThreads& threads = other_threads();
  WithoutGil gil;
  ++threads.working;
  if (threads.end_is_near) {
    --threads.working;
    stand_still();
  }
  std::exception_ptr failure;
  try {
    const Interruptible here(&threads.end_is_near);
    work();
  } catch (...) {
    failure = std::current_exception();
  }
  --threads.working;
  if (threads.end_is_near) stand_still();
  gil.take();
  if (failure) std::rethrow_exception(failure);
}

/// A thread that does work for the main thread. Starting a thread for each call takes longer than
/// rendering a small map.
class Worker {
 public:
  Worker() : thread_([this] { work_on(); }) {}
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  ~Worker() {
    {
      const std::lock_guard lock(mutex_);
      leaves_ = true;
    }
    changed_.notify_one();
    thread_.join();
  }

  /// Begins a piece of work. The caller keeps it alive until it has ended.
  void begin(const std::function<void()>& work) {
    {
      const std::lock_guard lock(mutex_);
      is_to_end_ = false;
      failure_ = nullptr;
      work_ = &work;
    }
    changed_.notify_one();
  }
  [[nodiscard]] bool ends_within(std::chrono::milliseconds time) {
    std::unique_lock lock(mutex_);
    return ended_.wait_for(lock, time, [this] { return work_ == nullptr; });
  }
  void ask_to_end() { is_to_end_ = true; }
  /// The exception of the work, after it has ended.
  [[nodiscard]] std::exception_ptr take_failure() { return std::exchange(failure_, nullptr); }

 private:
  void work_on() {
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, [this] { return work_ != nullptr || leaves_; });
      if (leaves_) return;
      lock.unlock();
      try {
        const Interruptible here(&is_to_end_);
        (*work_)();
      } catch (...) {
        failure_ = std::current_exception();
      }
      lock.lock();
      work_ = nullptr;
      ended_.notify_one();
    }
  }

  std::atomic<bool> is_to_end_{false};
  const std::function<void()>* work_ = nullptr;
  bool leaves_ = false;
  std::exception_ptr failure_;
  std::mutex mutex_;
  std::condition_variable changed_, ended_;
  std::thread thread_;  // the last member, because it uses the others
};

/// The idle worker of the main thread. Only the main thread accesses it, with the GIL. It is never
/// freed, because nothing joins it at exit.
struct IdleWorker {
  Worker* worker = nullptr;
  /// A forked process does not have the thread.
  pid_t process = 0;
};
IdleWorker idle_worker;

/// Fails    std::system_error where the system gives no thread.
std::unique_ptr<Worker> take_worker() {
  std::unique_ptr<Worker> idle(std::exchange(idle_worker.worker, nullptr));
  if (idle && idle_worker.process == ::getpid()) return idle;
  static_cast<void>(idle.release());
  return std::make_unique<Worker>();
}

/// A signal handler may have made a call within a call; then there are two workers.
void put_back(std::unique_ptr<Worker> worker) {
  if (idle_worker.worker != nullptr) return;
  idle_worker = {worker.release(), ::getpid()};
}

/// Waits for the worker in the main thread. Returns whether a signal has raised an exception
/// meanwhile.
bool wait_for(Worker& worker) {
  WithoutGil gil;
  bool raised = false;
  while (!worker.ends_within(50ms)) {
    if (raised) continue;
    gil.take();
    raised = PyErr_CheckSignals() != 0;
    gil.leave();
    if (raised) worker.ask_to_end();
  }
  gil.take();
  return raised;
}

void run_in_main_thread(const std::function<void()>& work) {
  std::unique_ptr<Worker> worker;
  try {
    worker = take_worker();
  } catch (const std::system_error&) {
    // The system gives no thread: signals are handled when the work has ended.
    const py::gil_scoped_release others_run;
    return work();
  }
  worker->begin(work);
  const bool raised = wait_for(*worker);
  const std::exception_ptr failure = worker->take_failure();
  put_back(std::move(worker));
  if (raised) throw py::error_already_set();
  if (failure) std::rethrow_exception(failure);
}

/// Work usually notices within a second that it must end. Work that does not notice is not awaited
/// much longer.
void end_work() {
  OtherThreads& threads = other_threads();
  threads.end_is_near = true;
  const py::gil_scoped_release others_run;
  const auto latest = std::chrono::steady_clock::now() + 5s;
  while (threads.working > 0 && std::chrono::steady_clock::now() < latest)
    std::this_thread::sleep_for(1ms);
}

}  // namespace

void run_apart(const std::function<void()>& work) {
  if (is_main_thread()) {
    run_in_main_thread(work);
  } else {
    run_here(work);
  }
}

void end_work_at_exit(Module& module) {
  module.def("_end_work", &end_work);
  py::module_::import("atexit").attr("register")(module.attr("_end_work"));
}

}  // namespace fathom::python
