#include "apps/jobs/publisher.h"

#include <utility>

#include "apps/shell/output_file.h"

namespace fathom::app {
namespace {

/// Waiting results take less memory than this, unless a single result is larger.
constexpr std::size_t most_memory = std::size_t{256} << 20U;
/// At most this many files are open and written at once, unless a single task has more.
constexpr std::size_t most_files = 128;

}  // namespace

Publisher::Publisher(std::filesystem::path folder, Manifest& manifest,
                     std::function<void(const std::vector<Record>&)> published)
    : folder_(std::move(folder)),
      manifest_(manifest),
      published_(std::move(published)),
      thread_([this] { run(); }) {}

Publisher::~Publisher() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    waiting_.clear();
  }
  changed_.notify_all();
  thread_.join();
}

void Publisher::rethrow_failure(std::unique_lock<std::mutex>& lock) {
  if (!failure_) return;
  const std::exception_ptr failure = failure_;
  lock.unlock();
  std::rethrow_exception(failure);
}

void Publisher::add(const Task& task, Result result) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock,
                [&] { return failure_ || memory_ == 0 || memory_ + result.memory <= most_memory; });
  rethrow_failure(lock);
  memory_ += result.memory;
  waiting_.push_back({task, std::move(result)});
  changed_.notify_all();
}

void Publisher::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return failure_ || (waiting_.empty() && !busy_); });
  rethrow_failure(lock);
}

std::vector<Publisher::Waiting> Publisher::next_batch() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return ended_ || !waiting_.empty(); });
  std::vector<Waiting> batch;
  for (std::size_t files = 0; !waiting_.empty(); waiting_.pop_front()) {
    files += waiting_.front().task.files.size();
    if (!batch.empty() && files > most_files) break;
    batch.push_back(std::move(waiting_.front()));
  }
  busy_ = !batch.empty();
  return batch;
}

void Publisher::run() {
  for (std::vector<Waiting> batch = next_batch(); !batch.empty(); batch = next_batch()) {
    std::size_t memory = 0;
    for (const Waiting& one : batch) memory += one.result.memory;
    std::exception_ptr failure;
    try {
      publish(std::move(batch));
    } catch (...) {
      failure = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    busy_ = false;
    memory_ -= memory;
    failure_ = failure;
    changed_.notify_all();
    if (failure) return;
  }
}

void Publisher::publish(std::vector<Waiting> batch) {
  std::deque<OutputFile> outputs;
  std::vector<Record> records;
  for (Waiting& one : batch) {
    Record record{one.task.key, {}, one.result.facts};
    for (std::size_t k = 0; k < one.task.files.size(); ++k) {
      const std::string& path = one.task.files[k];
      OutputFile& output = outputs.emplace_back(folder_ / path);
      const files::Bytes bytes = one.result.files[k]();
      output.write(bytes);
      record.files.push_back({path, bytes.size(), crc32_of(bytes)});
    }
    records.push_back(std::move(record));
    one.result = {};
  }
  std::vector<OutputFile*> together;
  together.reserve(outputs.size());
  for (OutputFile& output : outputs) together.push_back(&output);
  OutputFile::commit_together(together);
  manifest_.add(records);
  published_(records);
}

}  // namespace fathom::app
