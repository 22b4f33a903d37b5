#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/shell/console.h"
#include "fathom/files/file_bytes.h"

/// Work of many files that survives interruption. Each task's files are published as soon as they
/// are on the disk. A manifest next to the files lists the finished tasks, so that the same
/// command, run again, makes only the missing files.
namespace fathom::app {

/// Part `number` (from 1) of `of` equal parts: every of-th task.
struct Shard {
  std::size_t number = 1, of = 1;

  [[nodiscard]] bool has(std::size_t task) const { return task % of == number - 1; }
  [[nodiscard]] bool is_all() const { return of == 1; }
  /// How many of so many tasks it has.
  [[nodiscard]] std::size_t count_of(std::size_t tasks) const { return (tasks + of - number) / of; }
};
/// "2/5". Fails with UsageError.
Shard parse_shard(const std::string& text);

/// Files that are computed and published together.
struct Task {
  /// Hash of everything that the files depend on. If the key changes, the files are made again.
  std::string key;
  /// The files that it makes, below the folder of the job; at least one.
  std::vector<std::string> files;
};

/// The key of a task whose files depend on this text and on nothing else.
std::string key_of(const std::string& inputs);

/// The result of a task.
struct Result {
  /// The bytes of each of its files. Called from another thread, while the next task is computed.
  std::vector<std::function<files::Bytes()>> files;
  /// The task's entry for lists, as JSON; not null.
  std::string facts = "{}";
  /// About as many bytes of memory does the result hold.
  std::size_t memory = 0;
};

/// A file about all tasks, written when the last of them is finished.
struct JobList {
  std::string file;
  /// Its text from the facts of each task.
  std::function<std::string(const std::vector<std::string>& facts)> text;
};

struct Job {
  /// Name of a task in messages, e.g. "map"; the plural adds an s.
  std::string noun = "map";
  std::filesystem::path folder;
  std::vector<Task> tasks;
  /// Computes a task. Tasks are computed one after the other, in their order.
  std::function<Result(std::size_t task)> make;
  std::vector<JobList> lists;
  Shard shard;
  /// Overwrites existing files, even those that no job wrote.
  bool overwrites = false;
};

/// Does the unfinished tasks of the job, or of its shard, and prints their number to standard
/// output.
/// Fails    UsageError if a file exists that the job has not made; OutputError; InputError, and any
///          exception of `make`. Finished files stay, and every message except a UsageError reports
///          their number.
void run_job(const Job& job, const Console& console);

}  // namespace fathom::app
