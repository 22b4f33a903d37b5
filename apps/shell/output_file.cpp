#include "apps/shell/output_file.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <set>
#include <system_error>
#include <utility>

#include "apps/shell/known_files.h"
#include "apps/shell/standard_streams.h"
#include "fathom/failures/errors.h"

namespace fathom::app {
namespace {

namespace fs = std::filesystem;

/// The folder of a file, with all links resolved; empty if it does not exist.
fs::path true_folder_of(const fs::path& file) {
  std::error_code error;
  const fs::path found = fs::canonical(folder_of(file), error);
  return error ? fs::path() : found;
}

std::optional<int> number_in(const std::string& text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

OutputPlace place_of(const fs::path& target) {
  const fs::path own_files = "/proc/" + std::to_string(::getpid()) + "/fd";
  OutputPlace place{.path = target};
  for (int links = 0;; ++links) {
    const fs::path folder = true_folder_of(place.path);
    if (folder == own_files) {
      place.open_file = number_in(place.path.filename().string());
    }
    place.is_foreign = place.open_file || folder.native().starts_with("/proc/");
    std::error_code error;
    const fs::path next = fs::read_symlink(place.path, error);
    if (error || place.is_foreign) return place;
    if (links == 40) fail_with_errno(target, ELOOP);
    place.path = next.is_absolute() ? next : place.path.parent_path() / next;
  }
}

bool is_written_through(const fs::path& target) {
  std::error_code error;
  return fs::is_other(fs::status(target, error)) || place_of(target).open_file.has_value();
}

std::string parse_png_name(const std::string& text) {
  const std::string suffix = fs::path(text).extension().string();
  if (suffix == ".png" || suffix == ".PNG" || is_written_through(text)) return text;
  throw UsageError("'" + text + "' does not end in .png");
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder, error)) {
    throw OutputError(fmt::format("{}: cannot make this folder: {}", folder.string(),
                                  error ? error.message() : "it is a file"));
  }
}

fs::path nearest_existing(const fs::path& folder) {
  fs::path nearest = folder;
  std::error_code error;
  // A link that leads nowhere exists too: no folder can be made in its place.
  while (fs::symlink_status(nearest, error).type() == fs::file_type::not_found) {
    const fs::path above = folder_of(nearest);
    if (above == nearest) break;
    nearest = above;
  }
  return nearest;
}

void NewFolders::make(const fs::path& folder) {
  std::error_code error;
  if (fs::is_directory(folder, error)) return;
  const fs::path above = folder_of(folder);
  if (above != folder) make(above);
  made_.reserve(made_.size() + 1);
  // "new/." and "new/.." are there once "new" is; another program may have been quicker.
  if (fs::create_directory(folder, error)) {
    made_.push_back(folder);
  } else if (error) {
    throw std::system_error(error);
  }
}

NewFolders::~NewFolders() {
  std::error_code error;
  while (!made_.empty()) {
    fs::remove(made_.back(), error);
    made_.pop_back();
  }
}

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& target, const std::string& why) {
  throw OutputError(target.string() + ": " + why);
}

/// `folder` is the folder in which it should have been staged.
[[noreturn]] void fail_to_stage(const fs::path& target, const fs::path& place,
                                const fs::path& folder, int error) {
  if (error == ENOENT && folder == ".") fail(target, "the working directory is gone");
  if (folder != folder_of(place)) {
    fail(target, "cannot make the folder " + folder_of(place).string() + " in " + folder.string() +
                     ": " + std::generic_category().message(error));
  }
  if (error == ENOENT) fail(target, "there is no directory " + folder.string());
  if (error == EMFILE) {
    fail(target, "too many outputs at once; 'ulimit -n' raises how many files may be open");
  }
  fail_with_errno(target, error);
}

std::string with_target_for(const std::string& staged, const fs::path& target,
                            std::string message) {
  for (std::size_t at = message.find(staged); at != std::string::npos;
       at = message.find(staged, at + target.native().size())) {
    message.replace(at, staged.size(), target.native());
  }
  return message;
}

/// Waits until the names in a folder are on the disk. Some file systems do not support this.
void sync_folder(const fs::path& folder) {
  const files::Descriptor open(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (open.is_open()) ::fsync(open.get());
}

}  // namespace

OutputFile::OutputFile(fs::path target) : target_(std::move(target)) {
  if (target_.empty()) fail("''", "an output needs a name");
  struct stat status {};
  const bool exists = ::stat(target_.c_str(), &status) == 0;
  if (!exists && errno != ENOENT) fail_with_errno(target_, errno);
  if (exists && S_ISDIR(status.st_mode)) fail(target_, "is a directory; the output is a file");
  if (!exists && !target_.has_filename()) fail(target_, "names a directory; the output is a file");

  find_place(exists, status.st_mode);
  if (exists && !through_.is_open() &&
      ::faccessat(AT_FDCWD, target_.c_str(), W_OK, AT_EACCESS) != 0) {
    fail_with_errno(target_, errno);
  }
  if (!place_.empty()) {
    claim_output(target_, place_);
    if (exists) existing_ = {status.st_mode, status.st_uid, status.st_gid};
  }
  stage();
}

/// Destination: an open file, a device or a pipe, or a place in a folder.
void OutputFile::find_place(bool exists, mode_t mode) {
  const OutputPlace place = place_of(target_);
  if (place.open_file) {
    expect_writable(*place.open_file, target_.string());
    through_ = files::Descriptor(::fcntl(*place.open_file, F_DUPFD_CLOEXEC, 0));
    if (!through_.is_open()) fail_with_errno(target_, errno);
  } else if (exists && S_ISCHR(mode)) {
    through_ = files::Descriptor(::open(target_.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC));
    if (!through_.is_open()) fail_with_errno(target_, errno);
    expect_writable(through_.get(), target_.string());
  } else if (!place.is_foreign && (!exists || S_ISREG(mode))) {
    place_ = place.path;
  }
}

/// A missing folder is made when the output takes its place. Until then the output is staged in an
/// existing folder above it.
void OutputFile::stage() {
  const fs::path folder = nearest_existing(folder_of(place_));
  try {
    staged_.emplace(place_.empty() ? StagedFile::nowhere() : StagedFile::in_folder(folder));
  } catch (const std::system_error& error) {
    fail_to_stage(target_, place_, folder, error.code().value());
  }
}

void OutputFile::write(const std::function<void(const fs::path&)>& writer) const {
  const std::string staged = staged_->path();
  try {
    writer(staged);
  } catch (const OutputError& error) {
    throw OutputError(with_target_for(staged, target_, error.what()));
  } catch (const UsageError& error) {
    if (!error.setting().empty()) throw;  // is about an option, not about the file
    throw UsageError(with_target_for(staged, target_, error.what()));
  }
}

void OutputFile::write_by_descriptor(const std::function<void(int)>& writer) const {
  const int file = staged_->descriptor();
  if (::ftruncate(file, 0) != 0 || ::lseek(file, 0, SEEK_SET) != 0) fail_with_errno(target_, errno);
  writer(file);
}

void OutputFile::write(files::ByteView bytes) const {
  write_by_descriptor([&](int file) {
    write_all(file, reinterpret_cast<const char*>(bytes.data()), bytes.size(), target_);
  });
}

/// Permissions of the replaced file, or of a new file.
void OutputFile::take_permissions() const {
  const int file = staged_->descriptor();
  mode_t mode = staged_->ordinary_mode();
  if (existing_) {
    // Only root can give a file away. A file with the set-user-ID or set-group-ID bit must not run
    // as another owner or group.
    const bool is_theirs = ::fchown(file, existing_->owner, existing_->group) == 0 ||
                           ::fchown(file, static_cast<uid_t>(-1), existing_->group) == 0;
    mode = existing_->mode & (is_theirs ? 07777 : 0777);
  }
  if (::fchmod(file, mode) != 0) fail_with_errno(target_, errno);
}

void OutputFile::sync(int (*sync_one)(int)) const {
  // Some file systems do not support this and report it.
  if (sync_one(staged_->descriptor()) != 0 && errno != EINVAL && errno != ENOSYS) {
    fail_with_errno(target_, errno);
  }
}

/// Waits until all outputs are on the disk. Syncing a file takes a turn of the disk. For many files
/// it takes less time to sync their file systems, including all data of other programs.
void OutputFile::sync_all(const std::vector<OutputFile*>& placed) {
  constexpr std::size_t many = 8;
  if (placed.size() < many) {
    for (const OutputFile* output : placed) output->sync(::fsync);
    return;
  }
  std::set<dev_t> file_systems;
  for (const OutputFile* output : placed) {
    struct stat status {};
    if (::fstat(output->staged_->descriptor(), &status) != 0)
      fail_with_errno(output->target_, errno);
    if (file_systems.insert(status.st_dev).second) output->sync(::syncfs);
  }
}

void OutputFile::write_through() {
  if (!through_.is_open()) {
    through_ = files::Descriptor(::open(target_.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC));
    if (!through_.is_open()) fail_with_errno(target_, errno);
  }
  std::array<char, 65536> buffer{};
  for (off_t at = 0;;) {
    const ssize_t count = ::pread(staged_->descriptor(), buffer.data(), buffer.size(), at);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail_with_errno(target_, errno);
    if (count == 0) break;
    write_all(through_.get(), buffer.data(), static_cast<std::size_t>(count), target_);
    at += count;
  }
  if (!through_.close()) fail_with_errno(target_, errno);
}

void OutputFile::take_place(bool is_last) {
  try {
    // After the last output is in its place nothing can fail any more.
    if (is_last) {
      staged_->put_at(place_);
    } else {
      staged_->put_for_now_at(place_);
    }
  } catch (const std::system_error& error) {
    fail_with_errno(target_, error.code().value());
  }
}

void OutputFile::make_folder_in(NewFolders& folders) const {
  try {
    folders.make(folder_of(place_));
  } catch (const std::system_error& error) {
    fail(target_,
         "cannot make the folder " + folder_of(place_).string() + ": " + error.code().message());
  }
}

/// Puts all outputs in their places, or none.
void OutputFile::take_places(const std::vector<OutputFile*>& outputs) {
  std::size_t placed = 0;
  try {
    for (; placed < outputs.size(); ++placed) {
      outputs[placed]->take_place(placed + 1 == outputs.size());
    }
  } catch (...) {
    while (placed-- > 0) outputs[placed]->staged_->take_back_from(outputs[placed]->place_);
    throw;
  }
  for (OutputFile* output : outputs) output->staged_.reset();
}

void OutputFile::commit_together(const std::vector<OutputFile*>& outputs) {
  std::vector<OutputFile*> to_place;
  std::set<fs::path> folders;
  for (OutputFile* output : outputs) {
    if (output->place_.empty()) continue;
    output->take_permissions();
    // If several outputs take their places, this must not need memory any more.
    output->staged_->prepare_for(output->place_);
    to_place.push_back(output);
    folders.insert(folder_of(output->place_));
  }
  sync_all(to_place);
  for (OutputFile* output : outputs) {
    if (output->place_.empty()) output->write_through();
  }
  // Folders are made at the end, so that an earlier failure leaves no folder behind.
  NewFolders new_folders;
  for (const OutputFile* output : to_place) output->make_folder_in(new_folders);
  for (const fs::path& folder : new_folders.made()) folders.insert(folder_of(folder));
  take_places(to_place);
  new_folders.keep();
  for (const fs::path& folder : folders) sync_folder(folder);
}

TextOutput::TextOutput(const std::string& name) : printed_(name == "-") {
  if (printed_) {
    expect_standard_output();
  } else if (!name.empty()) {
    file_.emplace(name);
  }
}

void TextOutput::write(const std::string& text) {
  if (file_) file_->write(text);
  if (printed_) text_ = text;
}

void TextOutput::print() const {
  if (printed_) app::print(text_);
}

void TextOutput::finish(const std::string& text) {
  write(text);
  if (file_) file_->commit();
  print();
}

}  // namespace fathom::app
