#include "apps/jobs/job.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <mutex>
#include <string>
#include <system_error>
#include <unordered_set>
#include <utility>

#include "apps/jobs/manifest.h"
#include "apps/shell/console.h"
#include "apps/shell/last_resort.h"
#include "apps/shell/output_file.h"
#include "apps/shell/standard_streams.h"
#include "apps/shell/values.h"
#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/files/sha256.h"
#include "fathom/text/counted.h"
#include "fathom/text/printable.h"

namespace fathom::app {
namespace {

/// Progress of a job: on a terminal a line, "maps: 73/500, 41 maps/s, 0:10 left", wiped at the end;
/// and the message that the program prints when it is interrupted. Several threads may report
/// progress.
class JobProgress {
 public:
  /// `noun` has a plural with an s.
  JobProgress(const Console& console, std::string noun, std::size_t total);
  JobProgress(const JobProgress&) = delete;
  JobProgress& operator=(const JobProgress&) = delete;
  ~JobProgress();

  void add_made(std::size_t count);
  /// Counts a task that an earlier run finished.
  void add_found();
  /// " (73 of 500 maps are finished; the same command goes on from there)"
  [[nodiscard]] std::string so_far() const;

 private:
  void tell();

  std::string noun_;
  std::size_t total_;
  bool shows_;
  mutable std::mutex mutex_;
  std::size_t made_ = 0, found_ = 0;
  bool shown_ = false;
  std::chrono::steady_clock::time_point start_, next_;
};

using std::chrono::steady_clock;

JobProgress::JobProgress(const Console& console, std::string noun, std::size_t total)
    : noun_(std::move(noun)),
      total_(total),
      shows_(console.shows_progress()),
      start_(steady_clock::now()),
      next_(start_ + std::chrono::seconds(1)) {
  tell();
}

JobProgress::~JobProgress() {
  say_when_interrupted("");
  if (shown_) fmt::print(stderr, "\r\033[K");
}

void JobProgress::add_made(std::size_t count) {
  const std::lock_guard lock(mutex_);
  made_ += count;
  tell();
}

void JobProgress::add_found() {
  const std::lock_guard lock(mutex_);
  ++found_;
  tell();
}

std::string JobProgress::so_far() const {
  const std::lock_guard lock(mutex_);
  return fmt::format(" ({} of {} {}s are finished; the same command goes on from there)",
                     made_ + found_, total_, noun_);
}

void JobProgress::tell() {
  say_when_interrupted(fmt::format(
      "{}fathom: interrupted: {} of {} {}s are finished; the same command goes on from there\n",
      shown_ ? "\r\033[K" : "", made_ + found_, total_, noun_));
  const auto now = steady_clock::now();
  if (!shows_ || now < next_) return;
  next_ = now + std::chrono::milliseconds(100);
  shown_ = true;
  fmt::print(stderr, "\r\033[Kfathom: {}s: {}/{}", noun_, made_ + found_, total_);
  if (made_ != 0) {
    const double rate =
        static_cast<double>(made_) / std::chrono::duration<double>(now - start_).count();
    const long left = std::lround(static_cast<double>(total_ - made_ - found_) / rate);
    fmt::print(stderr, ", {:.3g} {}s/s, {}:{:02}:{:02} left", rate, noun_, left / 3600,
               left / 60 % 60, left % 60);
  }
  std::fflush(stderr);
}

namespace fs = std::filesystem;

/// Whether the file is there as it was published.
bool is_intact(const fs::path& folder, const PublishedFile& file) {
  const fs::path path = folder / file.path;
  std::error_code error;
  if (!fs::is_regular_file(path, error) || fs::file_size(path, error) != file.bytes || error) {
    return false;
  }
  try {
    const files::InputFile input(path, files::InputFile::Reading::copied);
    return crc32_of(input.bytes()) == file.crc32;
  } catch (const InputError&) {
    return false;
  }
}

/// The record of a task whose files are there, unharmed, and made of the same inputs.
const Record* record_of(const ManifestContent& content, const Job& job, const Task& task) {
  const Record* const record = content.find(task.files.front(), task.key);
  if (record == nullptr) return nullptr;
  if (!std::ranges::equal(record->files, task.files, {}, &PublishedFile::path)) return nullptr;
  const auto intact = [&](const PublishedFile& file) { return is_intact(job.folder, file); };
  return std::ranges::all_of(record->files, intact) ? record : nullptr;
}

/// The work on one part of a job.
class Work {
 public:
  Work(const Job& job, const Console& console)
      : job_(job), console_(console), manifest_(job.folder, job.shard) {}

  void run() {
    Warnings warnings;
    content_ = manifest_.read(warnings);
    console_.warn(warnings);
    announce();
    const std::size_t made = make_tasks();
    const bool has_lists = write_lists();
    tell(made, has_lists);
  }

 private:
  std::vector<std::string> files() const {
    std::vector<std::string> all;
    for (std::size_t i = 0; i < job_.tasks.size(); ++i) {
      if (!job_.shard.has(i)) continue;
      all.insert(all.end(), job_.tasks[i].files.begin(), job_.tasks[i].files.end());
    }
    for (const JobList& list : job_.lists) all.push_back(list.file);
    return all;
  }

  /// Called before the first file is made. Existing files must be the job's own.
  void announce() {
    std::vector<std::string> unannounced;
    std::unordered_set<std::string> known;
    for (const std::string& file : files()) {
      if (!known.insert(file).second) {
        throw UsageError((job_.folder / file).string() +
                         ": would be written twice; every output needs its own name");
      }
      if (content_.owned.contains(file)) continue;
      if (!job_.overwrites) require_absent(job_.folder / file);
      unannounced.push_back(file);
      content_.owned.insert(file);
    }
    manifest_.announce(unannounced);
  }

  std::size_t make_tasks() {
    std::size_t made = 0;
    JobProgress progress(console_, job_.noun, job_.shard.count_of(job_.tasks.size()));
    std::vector<Record> published;
    Publisher publisher(job_.folder, manifest_, [&](const std::vector<Record>& records) {
      published.insert(published.end(), records.begin(), records.end());
      progress.add_made(records.size());
    });
    try {
      for (std::size_t i = 0; i < job_.tasks.size(); ++i) {
        if (!job_.shard.has(i)) continue;
        const Task& task = job_.tasks[i];
        if (record_of(content_, job_, task) != nullptr) {
          progress.add_found();
          continue;
        }
        publisher.add(task, job_.make(i));
        ++made;
      }
      publisher.finish();
    } catch (const OutputError& error) {
      throw OutputError(error.what() + progress.so_far());
    } catch (const InputError& error) {
      throw InputError(error.what() + progress.so_far());
    }
    for (Record& record : published) content_.add(std::move(record));
    return made;
  }

  /// If all tasks of all shards are finished, writes the lists, and rewrites the manifest unless
  /// shards have their own. Returns whether all tasks are finished.
  bool write_lists() {
    Warnings told_before;
    if (!job_.shard.is_all()) content_ = manifest_.read(told_before);
    std::vector<Record> records;
    std::vector<std::string> facts;
    for (const Task& task : job_.tasks) {
      const Record* const found = content_.find(task.files.front(), task.key);
      if (found == nullptr) return false;
      records.push_back(*found);
      facts.push_back(found->facts);
    }
    for (const JobList& list : job_.lists) write_list(list, facts);
    if (job_.shard.is_all()) manifest_.replace(records, content_.owned);
    return true;
  }

  void write_list(const JobList& list, const std::vector<std::string>& facts) {
    OutputFile output(job_.folder / list.file);
    output.write(list.text(facts));
    output.commit();
  }

  void tell(std::size_t made, bool has_lists) const {
    std::string line =
        fmt::format("{}: {}, {} made now", text::printable(job_.folder.string()),
                    text::counted(job_.shard.count_of(job_.tasks.size()), job_.noun), made);
    if (!job_.shard.is_all()) {
      line += fmt::format(", of {} in {} shards", job_.tasks.size(), job_.shard.of);
    }
    if (!has_lists) {
      line += job_.lists.empty()
                  ? "; other shards are not finished"
                  : fmt::format(
                        "; {} is written when the other shards are finished, by the last "
                        "of them",
                        job_.lists.front().file);
    }
    print(line + "\n");
  }

  const Job& job_;
  const Console& console_;
  Manifest manifest_;
  ManifestContent content_;
};

}  // namespace

Shard parse_shard(const std::string& text) {
  const std::size_t slash = text.find('/');
  Shard shard;
  if (slash != std::string::npos) {
    shard.number = parse_positive(text.substr(0, slash));
    shard.of = parse_positive(text.substr(slash + 1));
  }
  if (slash == std::string::npos || shard.number > shard.of) {
    throw UsageError("'" + text + "' is no part of a whole; the second of five is 2/5");
  }
  return shard;
}

std::string key_of(const std::string& inputs) {
  return files::sha256(std::as_bytes(std::span(inputs)));
}

void run_job(const Job& job, const Console& console) {
  expect_standard_output();
  make_folder(job.folder);
  Work(job, console).run();
}

}  // namespace fathom::app
