#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/shell/console.h"
#include "fathom/files/file_bytes.h"

/// Work of many files that survives being interrupted. Each task's files are published as soon as
/// they are on the disk; a manifest beside them says which are finished, so that the same command,
/// given again, makes what is missing and no more.
namespace fathom::app {

/// Part `number` of `of` equal ones, from 1 on: every of-th task.
struct Shard {
  std::size_t number = 1, of = 1;

  [[nodiscard]] bool has(std::size_t task) const { return task % of == number - 1; }
  [[nodiscard]] bool is_all() const { return of == 1; }
  /// How many of so many tasks it has.
  [[nodiscard]] std::size_t count_of(std::size_t tasks) const { return (tasks + of - number) / of; }
};
/// "2/5". Fails with UsageError.
Shard parse_shard(const std::string& text);

/// What is computed in one go and published together.
struct Task {
  /// Of all that its files depend on; another key has the files made anew.
  std::string key;
  /// The files that it makes, below the folder of the job; at least one.
  std::vector<std::string> files;
};

/// The key of a task whose files depend on this text and on nothing else.
std::string key_of(const std::string& inputs);

/// What a task has computed.
struct Result {
  /// The bytes of each of its files. Called from another thread, while the next task is computed.
  std::vector<std::function<files::Bytes()>> files;
  /// What a list needs to know of the task: JSON. Not null.
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
  /// What a task is called in messages: "map", whose plural has an s.
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

/// Does what is not done yet of the job, or of a part of it, and says on standard output how much
/// that was.
/// Fails    UsageError where a file is there that the job has not made; OutputError; InputError,
///          and whatever `make` fails with. What is finished by then stays, and is told by all but
///          the first.
void run_job(const Job& job, const Console& console);

}  // namespace fathom::app
