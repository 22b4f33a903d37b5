#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

namespace fathom {

/// A value for each thread, created by its first call of local(): for buffers that pieces of
/// parallel work reuse within their thread. local() takes a lock; it is meant for pieces that take
/// microseconds.
///
/// A piece must not start parallel work while it uses the value: its thread may begin another piece
/// meanwhile.
template <class T>
class PerThread {
 public:
  /// `make` may be called by several threads at the same time.
  explicit PerThread(std::function<T()> make = [] { return T(); }) : make_(std::move(make)) {}
  PerThread(const PerThread&) = delete;
  PerThread& operator=(const PerThread&) = delete;

  /// The value of the calling thread.
  T& local() {
    std::unique_ptr<T>& value = place();
    if (!value) value.reset(new T(make_()));  // where it stays: T need not be movable
    return *value;
  }

  /// visit(value) for the values of all threads, in no particular order. Not while threads ask.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const auto& [thread, value] : values_)
      if (value) visit(std::as_const(*value));
  }

 private:
  std::unique_ptr<T>& place() {
    const std::lock_guard lock(mutex_);
    return values_[std::this_thread::get_id()];  // a map's elements stay where they are
  }

  std::function<T()> make_;
  std::map<std::thread::id, std::unique_ptr<T>> values_;
  std::mutex mutex_;
};

}  // namespace fathom
