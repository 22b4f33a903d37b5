#include "apps/jobs/manifest.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <libdeflate.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <nlohmann/json.hpp>
#include <utility>

#include "apps/shell/output_file.h"
#include "apps/shell/standard_streams.h"
#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/text/parse_json.h"
#include "fathom/text/printable.h"

namespace fathom::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* prefix = "fathom-manifest";
constexpr int version = 1;

std::string first_line() {
  return Json{{"fathom-manifest", version}}.dump() + "\n";
}

std::string name_of(const Shard& shard) {
  return shard.is_all() ? fmt::format("{}.jsonl", prefix)
                        : fmt::format("{}-{}-of-{}.jsonl", prefix, shard.number, shard.of);
}

std::string dumped(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// A path as JSON: a string or, because strings of JSON are UTF-8, its bytes as a list of numbers.
Json json_of_path(const std::string& path) {
  if (text::as_utf8(path) == path) return path;
  return std::vector<std::uint8_t>(path.begin(), path.end());
}

std::string path_of_json(const Json& json) {
  if (!json.is_array()) return json.get<std::string>();
  const auto bytes = json.get<std::vector<std::uint8_t>>();
  return {bytes.begin(), bytes.end()};
}

std::string announcement_of(const std::vector<std::string>& files) {
  Json paths = Json::array();
  for (const std::string& file : files) paths.push_back(json_of_path(file));
  return dumped(Json{{"announced", paths}}) + "\n";
}

Record record_of(const Json& json) {
  Record record{json.at("key").get<std::string>(), {}, dumped(json.at("facts"))};
  for (const Json& file : json.at("files")) {
    record.files.push_back({path_of_json(file.at("path")), file.at("bytes").get<std::uint64_t>(),
                            file.at("crc32").get<std::uint32_t>()});
  }
  if (record.files.empty()) throw std::invalid_argument("no file");
  return record;
}

/// Adds a line of a manifest to the records of the tasks and to the files of the content.
void add_line(const std::string& line, const std::string& name,
              std::unordered_map<std::string, Record>& said, ManifestContent& content) {
  const Json json = text::parse_json<Json>(line);
  if (json.contains("fathom-manifest")) {
    if (json.at("fathom-manifest").get<int>() <= version) return;
    throw InputError(name + ": is of a later version of fathom; use that one, or another folder");
  }
  if (json.contains("announced")) {
    for (const Json& file : json.at("announced")) content.owned.insert(path_of_json(file));
    return;
  }
  Record record = record_of(json);
  for (const PublishedFile& file : record.files) content.owned.insert(file.path);
  std::string task = record.files.front().path;
  said.insert_or_assign(std::move(task), std::move(record));
}

/// The manifests of a folder, in the order of their names.
std::vector<fs::path> manifests_in(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  fs::directory_iterator next(folder, error);
  for (; !error && next != fs::directory_iterator(); next.increment(error)) {
    const std::string name = next->path().filename().string();
    if (name.starts_with(prefix) && name.ends_with(".jsonl")) found.push_back(next->path());
  }
  if (error) throw InputError(folder.string() + ": cannot be listed: " + error.message());
  std::ranges::sort(found);
  return found;
}

bool is_still_at(int file, const fs::path& path) {
  struct stat open {};
  struct stat there {};
  if (::fstat(file, &open) != 0) fail_with_errno(path, errno);
  const bool is_there = ::stat(path.c_str(), &there) == 0;
  if (!is_there && errno != ENOENT) fail_with_errno(path, errno);
  return is_there && open.st_dev == there.st_dev && open.st_ino == there.st_ino;
}

/// What follows the last complete line was being written when the power went.
void cut_torn_line(int file, const fs::path& path) {
  const off_t size = ::lseek(file, 0, SEEK_END);
  off_t end = size;
  for (char c = 0; end > 0; --end) {
    if (::pread(file, &c, 1, end - 1) != 1) fail_with_errno(path, errno);
    if (c == '\n') break;
  }
  if (end != size && ::ftruncate(file, end) != 0) fail_with_errno(path, errno);
}

}  // namespace

std::uint32_t crc32_of(files::ByteView bytes) {
  return libdeflate_crc32(0, bytes.data(), bytes.size());
}

std::string line_of(const Record& record) {
  Json files = Json::array();
  for (const PublishedFile& file : record.files) {
    files.push_back(
        {{"path", json_of_path(file.path)}, {"bytes", file.bytes}, {"crc32", file.crc32}});
  }
  const Json json{
      {"key", record.key}, {"files", files}, {"facts", text::parse_json<Json>(record.facts)}};
  return dumped(json) + "\n";
}

void ManifestContent::add(Record record) {
  for (const PublishedFile& file : record.files) owned.insert(file.path);
  std::vector<Record>& all = records[record.files.front().path];
  all.clear();
  all.push_back(std::move(record));
}

const Record* ManifestContent::find(const std::string& file, const std::string& key) const {
  const auto found = records.find(file);
  if (found == records.end()) return nullptr;
  const auto record = std::ranges::find(found->second, key, &Record::key);
  return record == found->second.end() ? nullptr : &*record;
}

void ManifestContent::add(const std::string& text, const std::string& name, Warnings& warnings) {
  std::unordered_map<std::string, Record> said;
  std::size_t number = 0, bad = 0, first_bad = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    ++number;
    if (end == std::string::npos) break;
    try {
      add_line(text.substr(begin, end - begin), name, said, *this);
    } catch (const nlohmann::json::exception&) {
      if (bad++ == 0) first_bad = number;
    } catch (const text::JsonFault&) {
      if (bad++ == 0) first_bad = number;
    } catch (const std::invalid_argument&) {
      if (bad++ == 0) first_bad = number;
    }
    begin = end + 1;
  }
  for (auto& [task, record] : said) records[task].push_back(std::move(record));
  if (bad == 0) return;
  warnings.push_back(fmt::format(
      "{}: line {} is damaged ({} of {} lines are); the maps of these lines are rendered again",
      name, first_bad, bad, number));
}

Manifest::Manifest(fs::path folder, const Shard& shard)
    : folder_(std::move(folder)), path_(folder_ / name_of(shard)) {
  open();
  cut_torn_line(file_.get(), path_);
  struct stat status {};
  if (::fstat(file_.get(), &status) != 0) fail_with_errno(path_, errno);
  if (status.st_size == 0) append(first_line());
  const files::Descriptor in(::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (in.is_open()) ::fsync(in.get());
}

/// The lock ends with this process. Whoever had it before may have put another file in its place.
void Manifest::open() {
  do {
    file_ = files::Descriptor(::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
    if (!file_.is_open()) fail_with_errno(path_, errno);
    if (::flock(file_.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      throw OutputError(path_.string() +
                        ": another process is at this work; wait for it, or give each its --shard");
    }
  } while (!is_still_at(file_.get(), path_));
}

ManifestContent read_manifests(const fs::path& folder, Warnings& warnings) {
  ManifestContent content;
  std::error_code error;
  if (!fs::exists(folder, error)) return content;
  for (const fs::path& path : manifests_in(folder)) {
    const files::InputFile file(path, files::InputFile::Reading::copied);
    content.add(std::string(file.text()), path.string(), warnings);
  }
  return content;
}

void require_absent(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(file, error))) return;
  throw UsageError(
      file.string() +
      ": exists and was not made by this command; name another folder, or give --overwrite");
}

void Manifest::append(const std::string& lines) {
  write_all(file_.get(), lines.data(), lines.size(), path_);
  if (::fdatasync(file_.get()) != 0 && errno != EINVAL && errno != ENOSYS) {
    fail_with_errno(path_, errno);
  }
}

void Manifest::announce(const std::vector<std::string>& files) {
  if (!files.empty()) append(announcement_of(files));
}

void Manifest::add(const std::vector<Record>& records) {
  std::string lines;
  for (const Record& record : records) lines += line_of(record);
  append(lines);
}

void Manifest::replace(const std::vector<Record>& records, std::unordered_set<std::string> owned) {
  std::string text;
  for (const Record& record : records) {
    for (const PublishedFile& file : record.files) owned.erase(file.path);
    text += line_of(record);
  }
  std::vector<std::string> others(owned.begin(), owned.end());
  std::ranges::sort(others);
  text.insert(0, first_line() + (others.empty() ? "" : announcement_of(others)));
  OutputFile output(path_);
  output.write(text);
  output.commit();
  for (const fs::path& other : manifests_in(folder_)) {
    if (other == path_) continue;
    // NFS grants such a lock only on files that are open for writing.
    const files::Descriptor file(::open(other.c_str(), O_RDWR | O_CLOEXEC));
    const bool is_free = file.is_open() && ::flock(file.get(), LOCK_EX | LOCK_NB) == 0;
    if (is_free) ::unlink(other.c_str());
  }
}

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
