#pragma once

#include <memory>

namespace fathom::app {

/// While it is there, TBB uses no more threads than this (0: no limit). Where more threads are
/// asked for than there are processors, its pool would keep to these and say so on standard error.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;
  ~ThreadLimit();

 private:
  struct Control;
  std::unique_ptr<Control> control_;
};

}  // namespace fathom::app
