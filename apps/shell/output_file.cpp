#include "apps/shell/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <optional>
#include <random>
#include <system_error>
#include <utility>

#include "apps/shell/known_files.h"
#include "apps/shell/pending_files.h"
#include "fathom/numeric/errors.h"

namespace fathom::app {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& target, const std::string& why) {
  throw OutputError(target.string() + ": " + why);
}

[[noreturn]] void fail_with_errno(const fs::path& target, int error) {
  fail(target, std::generic_category().message(error));
}

/// A descriptor that is closed at the end of its scope.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  [[nodiscard]] int get() const { return number_; }
  /// Closes now; false where data were lost.
  bool close() { return ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_;
};

/// Follows symbolic links to the file that is meant, which need not exist. nullopt where they lead
/// into /proc: /dev/stdout names an open file, which has no place of its own.
std::optional<fs::path> follow_links(const fs::path& target) {
  fs::path place = target;
  std::error_code ignored;
  for (int links = 0; fs::is_symlink(place, ignored); ++links) {
    if (links == 40) fail_with_errno(target, ELOOP);
    const fs::path next = fs::read_symlink(place, ignored);
    place = next.is_absolute() ? next : place.parent_path() / next;
    if (fs::absolute(place).native().starts_with("/proc/")) return std::nullopt;
  }
  return place;
}

fs::path folder_of(const fs::path& place) {
  return place.has_parent_path() ? place.parent_path() : fs::path(".");
}

/// ".fathom-" and 16 hexadecimal digits that no other process has drawn.
std::string temporary_name() {
  std::random_device device;
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), ".fathom-%08x%08x.part", device(), device());
  return text.data();
}

void write_all(int descriptor, const char* data, std::size_t size, const fs::path& target) {
  while (size > 0) {
    const ssize_t written = ::write(descriptor, data, size);
    if (written < 0) {
      if (errno == EINTR) continue;
      fail_with_errno(target, errno);
    }
    data += written;
    size -= static_cast<std::size_t>(written);
  }
}

void copy_through(const char* source, const fs::path& target) {
  Descriptor in(::open(source, O_RDONLY | O_CLOEXEC));
  if (in.get() < 0) fail_with_errno(target, errno);
  Descriptor out(::open(target.c_str(), O_WRONLY | O_CLOEXEC));
  if (out.get() < 0) fail_with_errno(target, errno);
  std::array<char, 65536> buffer{};
  while (true) {
    const ssize_t count = ::read(in.get(), buffer.data(), buffer.size());
    if (count < 0) fail_with_errno(target, errno);
    if (count == 0) break;
    write_all(out.get(), buffer.data(), static_cast<std::size_t>(count), target);
  }
  if (!out.close()) fail_with_errno(target, errno);
}

std::string with_target_for(const std::string& temporary, const fs::path& target,
                            std::string message) {
  for (std::size_t at = message.find(temporary); at != std::string::npos;
       at = message.find(temporary, at + target.native().size())) {
    message.replace(at, temporary.size(), target.native());
  }
  return message;
}

extern "C" void remove_and_end(int) {
  remove_all_pending();
  ::_exit(130);
}

}  // namespace

OutputFile::OutputFile(fs::path target) : target_(std::move(target)) {
  if (target_.empty()) fail("''", "an output needs a name");
  struct stat status {};
  const bool exists = ::stat(target_.c_str(), &status) == 0;
  if (!exists && errno != ENOENT) fail_with_errno(target_, errno);
  if (exists && S_ISDIR(status.st_mode)) fail(target_, "is a directory; the output is a file");
  if (!exists && !target_.has_filename()) fail(target_, "names a directory; the output is a file");

  const std::optional<fs::path> place = follow_links(target_);
  write_through_ = !place || (exists && !S_ISREG(status.st_mode));
  if (exists && ::faccessat(AT_FDCWD, target_.c_str(), W_OK, AT_EACCESS) != 0) {
    fail_with_errno(target_, errno);
  }
  place_ = write_through_ ? fs::temp_directory_path() / "output" : *place;
  if (!write_through_) claim_output(target_, place_);
  create_temporary();

  if (exists && !write_through_) {
    // The owner can be kept only by root; the permissions always.
    if (::chown(pending_->path, status.st_uid, status.st_gid) != 0) errno = 0;
    ::chmod(pending_->path, status.st_mode & 07777);
  }
}

void OutputFile::create_temporary() {
  const fs::path folder = folder_of(place_);
  while (true) {
    pending_ = note_pending(folder / temporary_name());
    const Descriptor file(::open(pending_->path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (file.get() >= 0) return;
    const int error = errno;
    forget_pending(std::exchange(pending_, nullptr));
    if (error == ENOENT) fail(target_, "there is no directory " + folder.string());
    if (error != EEXIST) fail_with_errno(target_, error);
  }
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : target_(std::move(other.target_)),
      place_(std::move(other.place_)),
      write_through_(other.write_through_),
      pending_(std::exchange(other.pending_, nullptr)) {}

OutputFile::~OutputFile() {
  if (pending_ != nullptr) remove_pending(pending_);
}

void OutputFile::write(const std::function<void(const fs::path&)>& writer) const {
  const std::string temporary = pending_->path;
  try {
    writer(temporary);
  } catch (const OutputError& error) {
    throw OutputError(with_target_for(temporary, target_, error.what()));
  } catch (const UsageError& error) {
    throw UsageError(with_target_for(temporary, target_, error.what()));
  }
}

void OutputFile::write(const std::string& text) const {
  Descriptor file(::open(pending_->path, O_WRONLY | O_TRUNC | O_CLOEXEC));
  if (file.get() < 0) fail_with_errno(target_, errno);
  write_all(file.get(), text.data(), text.size(), target_);
  if (!file.close()) fail_with_errno(target_, errno);
}

void OutputFile::commit() {
  if (write_through_) {
    copy_through(pending_->path, target_);
    remove_pending(std::exchange(pending_, nullptr));
    return;
  }
  if (::rename(pending_->path, place_.c_str()) != 0) fail_with_errno(target_, errno);
  forget_pending(std::exchange(pending_, nullptr));
}

void write_text(const fs::path& target, const std::string& text) {
  if (target == "-") return print(text);
  OutputFile output(target);
  output.write(text);
  output.commit();
}

void print(const std::string& text) {
  write_all(STDOUT_FILENO, text.data(), text.size(), "standard output");
}

void remove_outputs_when_interrupted() {
  struct sigaction action {};
  action.sa_handler = remove_and_end;
  sigfillset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    // A program that was started with nohup keeps ignoring SIGHUP.
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    if (signal != SIGHUP || before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace fathom::app
