#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "apps/jobs/job.h"
#include "fathom/failures/warnings.h"
#include "fathom/files/descriptor.h"

namespace fathom::app {

/// A file as it was published.
struct PublishedFile {
  std::string path;
  std::uint64_t bytes = 0;
  /// Of its content; tells damage, not forgery.
  std::uint32_t crc32 = 0;
};

/// As PublishedFile has it.
std::uint32_t crc32_of(files::ByteView bytes);

/// A finished task.
struct Record {
  /// SHA-256 of what its files depend on.
  std::string key;
  /// In the order of the task's files.
  std::vector<PublishedFile> files;
  std::string facts;
};

/// The record of a finished task as one line of JSON, with the end of the line. A path is a string
/// or, where it is not UTF-8, the list of its bytes.
std::string line_of(const Record& record);

/// What the manifests in a folder say, of all shards.
struct ManifestContent {
  /// By the first file of each task: of each manifest what it says last. Which of the manifests has
  /// said it last is not known: one may be of an earlier mesh.
  std::unordered_map<std::string, std::vector<Record>> records;
  /// Files that jobs have made or may have made.
  std::unordered_set<std::string> owned;

  /// What is said of the task of this first file with this key; null where nothing is.
  [[nodiscard]] const Record* find(const std::string& file, const std::string& key) const;
  /// A manifest. A line that is no record is passed over, with a warning where it is not the last.
  /// `name` is the manifest's for messages.
  /// Fails    InputError where a later version of this program has written it.
  void add(const std::string& text, const std::string& name, Warnings& warnings);
  /// What has been published just now: no other record of its task counts.
  void add(Record record);
};

/// The list of what is finished, in a file beside it: fathom-manifest.jsonl, or one for each shard.
/// A record is on the disk before the next one is made, and after the files that it is about; what
/// a power cut leaves of one that was not is removed.
/// One process at a time has it. Fails with OutputError, also where another process has it.
class Manifest {
 public:
  Manifest(std::filesystem::path folder, const Shard& shard);

  /// Reads all manifests of the folder.
  [[nodiscard]] ManifestContent read(Warnings& warnings) const;
  /// Says which files will be made, before the first one is.
  void announce(const std::vector<std::string>& files);
  void add(const std::vector<Record>& records);
  /// Where all is finished: replaces the manifests of the folder by one of these records, with what
  /// else is `owned`.
  void replace(const std::vector<Record>& records, std::unordered_set<std::string> owned);

 private:
  void open();
  void append(const std::string& lines);

  std::filesystem::path folder_, path_;
  files::Descriptor file_;
};

}  // namespace fathom::app
