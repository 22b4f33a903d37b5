#include "fathom/files/spill_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fathom/failures/errors.h"
#include "fathom/threads/threads.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;
using namespace files;
using ::testing::HasSubstr;

ByteView view(const std::string& text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

std::string read(const SpillFile& file, std::uint64_t offset, std::size_t size) {
  std::string bytes(size, '?');
  file.read(offset, std::as_writable_bytes(std::span(bytes)));
  return bytes;
}

TEST(SpillFile, ReadsWhatWasWritten) {
  SpillFile file;
  EXPECT_EQ(file.size(), 0U);
  EXPECT_EQ(file.append(view("hidden ")), 0U);
  EXPECT_EQ(file.append(view("")), 7U);
  EXPECT_EQ(file.append(view("surface")), 7U);
  EXPECT_EQ(file.size(), 14U);
  EXPECT_EQ(read(file, 0, 14), "hidden surface");
  EXPECT_EQ(read(file, 9, 2), "rf");
  EXPECT_EQ(read(file, 14, 0), "");
  file.write(0, view("seen"));
  EXPECT_EQ(read(file, 0, 14), "seenen surface");
  EXPECT_EQ(file.size(), 14U);
}

TEST(SpillFile, HasNoName) {
  const ScratchFolder folder;
  {
    SpillFile file(folder.path());
    file.append(view("waits"));
    EXPECT_TRUE(fs::is_empty(folder.path()));
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(SpillFile, EndsWhereItEnds) {
  SpillFile file;
  file.append(view("short"));
  EXPECT_THAT(message_of<InputError>([&] { read(file, 3, 3); }), HasSubstr("Input/output error"));
}

TEST(SpillFile, NamesTheFolderThatThereIsNot) {
  const ScratchFolder folder;
  const fs::path missing = folder.path() / "missing";
  EXPECT_EQ(message_of<OutputError>([&] { SpillFile file(missing); }),
            missing.string() + ": No such file or directory");
}

/// The folder that TMPDIR names while the object exists.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(const fs::path& folder) {
    if (const char* before = std::getenv("TMPDIR")) before_ = before;
    ::setenv("TMPDIR", folder.c_str(), 1);
  }
  ~TemporaryFolder() {
    if (before_) {
      ::setenv("TMPDIR", before_->c_str(), 1);
    } else {
      ::unsetenv("TMPDIR");
    }
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

 private:
  std::optional<std::string> before_;
};

/// No file of this process may be larger while the object exists.
class LargestFile {
 public:
  explicit LargestFile(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &limit);
    old_ = std::signal(SIGXFSZ, SIG_IGN);
  }
  ~LargestFile() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    (void)std::signal(SIGXFSZ, old_);
  }
  LargestFile(const LargestFile&) = delete;
  LargestFile& operator=(const LargestFile&) = delete;

 private:
  rlimit before_{};
  void (*old_)(int) = SIG_DFL;
};

TEST(SpillFile, SaysWhereThereIsNoRoom) {
  const ScratchFolder folder;
  const TemporaryFolder temporary(folder.path());
  SpillFile file;
  const LargestFile limit(10);
  file.append(view("12345"));
  EXPECT_EQ(message_of<OutputError>([&] { file.append(view("67890!")); }),
            folder.path().string() + " (what does not fit into memory): File too large");
  EXPECT_EQ(read(file, 0, 5), "12345");
}

TEST(SpillFile, IsWrittenAndReadByManyThreads) {
  SpillFile file;
  constexpr std::size_t blocks = 200;
  std::vector<std::uint64_t> places(blocks);
  const auto block = [](std::size_t i) {
    return std::string(1 + i * 37 % 5000, static_cast<char>('a' + i % 26));
  };
  parallel_for(std::size_t{0}, blocks, [&](std::size_t i) {
    const std::string text = block(i);
    places[i] = file.append(view(text));
    EXPECT_EQ(read(file, places[i], text.size()), text);
  });
  for (std::size_t i = 0; i < blocks; ++i)
    EXPECT_EQ(read(file, places[i], block(i).size()), block(i));
}

}  // namespace
}  // namespace fathom
