// Whole files: mapped where they are large, read where they are small, with the same bytes; and
// written back.
#include "fathom/files/input_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "fathom/failures/errors.h"
#include "fathom/files/file_bytes.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using namespace files;
using ::testing::HasSubstr;

/// Bytes that tell their place.
std::string numbered(std::size_t size) {
  std::string text(size, '\0');
  for (std::size_t i = 0; i < size; ++i) text[i] = static_cast<char>((i * 2654435761U) >> 13);
  return text;
}

TEST(InputFile, SmallAndLargeFilesAreTheirBytes) {
  const ScratchFolder folder;
  for (const std::size_t size : {0U, 1U, 4095U, 65536U, 1U << 20, (5U << 20) + 7}) {
    const std::string text = numbered(size);
    const auto path = folder.write(std::to_string(size), text);
    EXPECT_TRUE(InputFile(path).text() == text) << size;
  }
}

/// Above 64 MiB, which are not written out: a file has a hole there.
TEST(InputFile, FilesThatAreMappedAreTheirBytesToo) {
  const ScratchFolder folder;
  const auto path = folder.write("large", "begin");
  constexpr std::uint64_t size = (std::uint64_t{64} << 20) + 3;
  std::filesystem::resize_file(path, size - 3);
  std::ofstream(path, std::ios::binary | std::ios::app) << "end";
  for (const auto reading : {InputFile::Reading::mapped_where_large, InputFile::Reading::copied}) {
    const InputFile file(path, reading);
    ASSERT_EQ(file.text().size(), size);
    EXPECT_TRUE(file.text().starts_with("begin"));
    EXPECT_EQ(file.text()[size / 2], '\0');
    EXPECT_TRUE(file.text().ends_with("end"));
    EXPECT_NO_THROW(file.expect_unchanged());
  }
}

/// Within its last page a mapped file ends in zeros then, and no signal says so.
TEST(InputFile, AMappedFileThatIsCutByAByteIsTold) {
  const ScratchFolder folder;
  const auto path = folder.write("large", "begin");
  std::filesystem::resize_file(path, (std::uint64_t{64} << 20) + 3);
  const InputFile file(path, InputFile::Reading::mapped_where_large);
  std::filesystem::resize_file(path, (std::uint64_t{64} << 20) + 2);
  EXPECT_THAT(message_of<InputError>([&] { file.expect_unchanged(); }),
              HasSubstr("large: has been cut short while it was read"));
}

/// Bytes that have been read stay as they are, whatever becomes of the file.
TEST(InputFile, OfAFileThatWasReadNothingIsTakenAway) {
  const ScratchFolder folder;
  const auto path = folder.write("file", "0123456789");
  const InputFile file(path);
  std::filesystem::resize_file(path, 3);
  EXPECT_EQ(file.text(), "0123456789");
  EXPECT_NO_THROW(file.expect_unchanged());
}

TEST(InputFile, NamesWhatCannotBeRead) {
  const ScratchFolder folder;
  EXPECT_THAT(message_of<InputError>([&] { InputFile file(folder.path() / "none"); }),
              HasSubstr("none: "));
  EXPECT_THAT(message_of<InputError>([&] { InputFile file(folder.path()); }),
              HasSubstr("is a directory"));
}

/// Lets standard input be another file as long as it lives.
class StandardInput {
 public:
  explicit StandardInput(const std::filesystem::path& path)
      : StandardInput(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY)) {}
  explicit StandardInput(int file) : before_(::dup(STDIN_FILENO)) {
    ::dup2(file, STDIN_FILENO);
    ::close(file);
  }
  StandardInput(const StandardInput&) = delete;
  StandardInput& operator=(const StandardInput&) = delete;
  ~StandardInput() {
    ::dup2(before_, STDIN_FILENO);
    ::close(before_);
  }

 private:
  int before_;
};

TEST(InputFile, AMinusIsStandardInput) {
  const ScratchFolder folder;
  const auto path = folder.write("file", "some text");
  {
    const StandardInput from_file(path);
    EXPECT_EQ(InputFile("-").text(), "some text");
  }
  const StandardInput from_folder(folder.path());
  EXPECT_EQ(message_of<InputError>([] { InputFile file("-"); }),
            "-: is a directory, expected a file");
}

/// More than a pipe holds, which comes in parts and says not how much it is.
TEST(InputFile, PipesAreReadToTheirEnd) {
  const std::string text = numbered(300'001);
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  std::signal(SIGPIPE, SIG_IGN);  // where nobody reads to the end
  const std::jthread writer([&] {
    EXPECT_EQ(::write(ends[1], text.data(), text.size()), std::ssize(text));
    ::close(ends[1]);
  });
  const StandardInput pipe(ends[0]);
  EXPECT_TRUE(InputFile("-").text() == text);
}

/// A terminal with one line and the end of its input.
struct Terminal {
  int controller = ::posix_openpt(O_RDWR | O_CLOEXEC | O_NOCTTY);
  std::filesystem::path path;

  Terminal() {
    if (controller < 0 || ::grantpt(controller) != 0 || ::unlockpt(controller) != 0) return;
    path = ::ptsname(controller);
    const std::string_view line = "a line\n\x04";
    if (::write(controller, line.data(), line.size()) < 0) path.clear();
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  ~Terminal() { ::close(controller); }
};

TEST(InputFile, OfDevicesOnlyTheOwnTerminalAndNothingAreRead) {
  const Terminal terminal, own;
  if (terminal.path.empty()) GTEST_SKIP() << "no terminals";
  {
    const ScratchFolder folder;
    const StandardInput no_device(folder.write("file", ""));
    EXPECT_EQ(message_of<InputError>([&] { InputFile file(terminal.path); }),
              terminal.path.string() + ": is a device, expected a file or a pipe");
    EXPECT_EQ(InputFile("/dev/null").text(), "");
  }
  const StandardInput from_own(own.path);
  EXPECT_EQ(InputFile(own.path).text(), "a line\n");
}

TEST(InputFile, WhatLiesInNoFolderNamesFilesOfTheWorkingDirectory) {
  const ScratchFolder folder;
  EXPECT_EQ(folder_of_input(folder.write("file", "")), folder.path());
  const auto pipe = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(folder_of_input(pipe), "");
  EXPECT_EQ(folder_of_input("/dev/null"), "");
  EXPECT_EQ(folder_of_input("-"), "");
}

TEST(FileBytes, WhatIsWrittenIsReadAgain) {
  const ScratchFolder folder;
  Bytes bytes;
  append(bytes, "ab");
  append(bytes, Bytes{std::byte{0}, std::byte{255}});
  write_file(folder.path() / "file", bytes);
  EXPECT_EQ(InputFile(folder.path() / "file").text(), std::string_view("ab\0\xFF", 4));
}

TEST(FileBytes, NamesWhatCannotBeWritten) {
  const ScratchFolder folder;
  EXPECT_THAT(message_of<OutputError>([&] { write_file(folder.path() / "no/file", {}); }),
              HasSubstr("no/file: "));
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const Bytes much(1U << 20);
  EXPECT_THAT(message_of<OutputError>([&] { write_file("/dev/full", much); }),
              HasSubstr("/dev/full: No space left"));
}

}  // namespace
}  // namespace fathom
