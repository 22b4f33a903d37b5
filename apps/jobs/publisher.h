#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "apps/jobs/job.h"
#include "apps/jobs/manifest.h"

namespace fathom::app {

/// Writes the results of tasks in a separate thread while the next tasks are computed. Waiting
/// results are written together and synced to disk once.
class Publisher {
 public:
  /// `published` is called with the records of the tasks that have been published just now, from
  /// the publisher's thread.
  Publisher(std::filesystem::path folder, Manifest& manifest,
            std::function<void(const std::vector<Record>&)> published);
  Publisher(const Publisher&) = delete;
  Publisher& operator=(const Publisher&) = delete;
  /// Results that still wait are given up.
  ~Publisher();

  /// Waits where too much waits already.
  /// Fails    as writing has failed since; nothing is published after that.
  void add(const Task& task, Result result);
  /// Waits until all is published. Fails as add().
  void finish();

 private:
  struct Waiting {
    Task task;
    Result result;
  };

  void run();
  void publish(std::vector<Waiting> batch);
  std::vector<Waiting> next_batch();
  void rethrow_failure(std::unique_lock<std::mutex>& lock);

  std::filesystem::path folder_;
  Manifest& manifest_;
  std::function<void(const std::vector<Record>&)> published_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Waiting> waiting_;
  std::size_t memory_ = 0;
  bool busy_ = false, ended_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace fathom::app
