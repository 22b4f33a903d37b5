#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "apps/jobs/job.h"
#include "fathom/failures/errors.h"
#include "fathom/files/descriptor.h"

namespace fathom::app {

/// A file as it was published.
struct PublishedFile {
  std::string path;
  std::uint64_t bytes = 0;
  /// Checksum of the content; detects damage, not forgery.
  std::uint32_t crc32 = 0;
};

/// The checksum of PublishedFile.
std::uint32_t crc32_of(files::ByteView bytes);

/// A finished task.
struct Record {
  /// SHA-256 of the inputs of its files.
  std::string key;
  /// In the order of the task's files.
  std::vector<PublishedFile> files;
  std::string facts;
};

/// The record of a finished task as one line of JSON, with the end of the line. A path is a string
/// or, where it is not UTF-8, the list of its bytes.
std::string line_of(const Record& record);

/// Content of all shards' manifests in a folder.
struct ManifestContent {
  /// By the first file of each task: the last record of each manifest. The order between manifests
  /// is unknown: one may belong to an earlier mesh.
  std::unordered_map<std::string, std::vector<Record>> records;
  /// Files that jobs have made or may have made.
  std::unordered_set<std::string> owned;

  /// The record of the task with this first file and this key; null if there is no record.
  [[nodiscard]] const Record* find(const std::string& file, const std::string& key) const;
  /// Adds the records of a manifest. Skips damaged lines, with a warning unless only the last line
  /// is damaged. `name` is the manifest's for messages.
  /// Fails    InputError if a later version of this program has written it.
  void add(const std::string& text, const std::string& name, Warnings& warnings);
  /// Adds the record of a task that was just published; it replaces all other records of this task.
  void add(Record record);
};

/// The content of all manifests in a folder; empty if the folder does not exist.
ManifestContent read_manifests(const std::filesystem::path& folder, Warnings& warnings);

/// Fails    UsageError, which offers --overwrite, if the file exists. Called for files that no
///          manifest has.
void require_absent(const std::filesystem::path& file);

/// The list of finished tasks, in a file next to the maps: fathom-manifest.jsonl, or one file for
/// each shard. A record is on the disk after its files and before the next record is made. A record
/// that a power cut left incomplete is removed.
/// One process at a time holds the file. Fails with OutputError, also if another process holds it.
class Manifest {
 public:
  Manifest(std::filesystem::path folder, const Shard& shard);

  /// Reads all manifests of the folder.
  [[nodiscard]] ManifestContent read(Warnings& warnings) const {
    return read_manifests(folder_, warnings);
  }
  /// Records which files will be made, before the first file is made.
  void announce(const std::vector<std::string>& files);
  void add(const std::vector<Record>& records);
  /// Called when all tasks are finished: replaces the manifests of the folder by one manifest with
  /// these records and the other `owned` files.
  void replace(const std::vector<Record>& records, std::unordered_set<std::string> owned);

 private:
  void open();
  void append(const std::string& lines);

  std::filesystem::path folder_, path_;
  files::Descriptor file_;
};

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
