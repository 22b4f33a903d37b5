// Outputs before they have a place: nobody else reads them, nothing is left of them however the
// program ends, and what others have left goes.

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstring>
#include <thread>

#include "faults.h"
#include "run_program.h"
#include "sample_files.h"
#include "test_folder.h"

namespace fathom::test {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const std::string exr_magic = "\x76\x2f\x31\x01";
const std::string stale = ".fathom-0123456789abcdef.part";

/// Systems on which outputs are staged: the test's own, one where every file has a name, one where
/// a file that has none gets none.
struct System {
  const char* name;
  std::function<void()> prepare;
};

void PrintTo(const System& system, std::ostream* to) {
  *to << system.name;
}

class Staged : public ::testing::TestWithParam<System> {
 protected:
  void SetUp() override {
    folder_.write("square.obj", square_obj);
    folder_.write("camera.json", square_camera);
    folder_.write("squares.obj", long_work());
  }

  [[nodiscard]] RunOptions options() const {
    RunOptions options{.folder = folder_.path()};
    options.prepare = [prepare = GetParam().prepare] {
      const rlimit no_core{0, 0};
      ::setrlimit(RLIMIT_CORE, &no_core);
      // The address sanitizer would answer these signals itself.
      ::setenv("ASAN_OPTIONS", "handle_segv=0:handle_sigbus=0:handle_sigfpe=0", 1);
      if (prepare) prepare();
    };
    return options;
  }
  [[nodiscard]] Outcome render_to(const std::string& output) const {
    return run_fathom({"render", "square.obj", "--camera", "camera.json", "-o", output}, options());
  }
  /// A render that takes far longer than the test, with its output staged.
  [[nodiscard]] pid_t start_long_render(const std::string& output) const {
    const pid_t process =
        start_fathom({"render", "squares.obj", "--size", "4000x3000", "-o", output}, options());
    EXPECT_TRUE(wait_until_staged(process, folder_));
    return process;
  }
  [[nodiscard]] mode_t mode_of(const std::string& path) const {
    struct stat status {};
    EXPECT_EQ(::stat(path.c_str(), &status), 0) << path;
    return status.st_mode & 07777;
  }

  /// Whether what a process has staged has these permissions. Before it there may be an empty file
  /// for a moment, which shows what permissions a new one has here.
  [[nodiscard]] bool staged_with(mode_t mode, pid_t process) const {
    for (int tries = 0; tries < 1000; ++tries) {
      struct stat status {};
      const std::string staged = staged_by(process, folder_);
      if (::stat(staged.c_str(), &status) == 0 && (status.st_mode & 07777) == mode) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return false;
  }

  TestFolder folder_;
};

TEST_P(Staged, AreReplacedAndMadeAsEver) {
  ASSERT_EQ(render_to("new.exr").status, 0);
  folder_.write("old.exr", "older");
  ::chmod((folder_ / "old.exr").c_str(), 0604);
  ASSERT_EQ(render_to("old.exr").status, 0);
  EXPECT_THAT(folder_.read("new.exr"), StartsWith(exr_magic));
  EXPECT_EQ(folder_.read("new.exr"), folder_.read("old.exr"));
  EXPECT_EQ(mode_of(folder_ / "old.exr"), 0604U);
  EXPECT_EQ(folder_.names().size(), 5U);
}

TEST_P(Staged, HaveThePermissionsOfTheUmaskOnlyAtTheEnd) {
  const mode_t before = ::umask(0);
  const pid_t process = start_long_render("map.exr");
  EXPECT_TRUE(staged_with(0600, process));
  ::kill(process, SIGTERM);
  EXPECT_EQ(wait_for(process), 130);
  EXPECT_EQ(render_to("map.exr").status, 0);
  ::umask(before);
  EXPECT_EQ(mode_of(folder_ / "map.exr"), 0666U);
}

/// A folder that says what new files in it may be: nothing for others.
TEST_P(Staged, HaveThePermissionsThatTheFolderGives) {
  struct Entry {
    std::uint16_t tag, permissions;
    std::uint32_t id;
  };
  struct {
    std::uint32_t version = 2;
    std::array<Entry, 3> entries{{{1, 6, ~0U}, {4, 4, ~0U}, {0x20, 0, ~0U}}};
  } list;
  if (::setxattr(folder_.path().c_str(), "system.posix_acl_default", &list, sizeof list, 0) != 0) {
    GTEST_SKIP() << "no access control lists here";
  }
  ASSERT_EQ(render_to("map.exr").status, 0);
  EXPECT_EQ(mode_of(folder_ / "map.exr"), 0640U);
}

TEST_P(Staged, LeaveNothingWhateverSignalEndsTheProgram) {
  folder_.write("map.exr", "older");
  const auto before = folder_.names();
  for (const int signal : {SIGINT,  SIGTERM, SIGHUP,  SIGQUIT, SIGALRM, SIGVTALRM, SIGPROF,
                           SIGUSR1, SIGUSR2, SIGXCPU, SIGIO,   SIGPWR,  SIGSTKFLT, SIGSEGV,
                           SIGABRT, SIGFPE,  SIGILL,  SIGBUS,  SIGSYS,  SIGTRAP,   SIGRTMIN + 3}) {
    const pid_t process = start_long_render("map.exr");
    ::kill(process, signal);
    const bool interrupts = signal == SIGINT || signal == SIGTERM || signal == SIGHUP;
    EXPECT_EQ(wait_for(process), interrupts ? 130 : 128 + signal) << ::strsignal(signal);
    EXPECT_EQ(folder_.names(), before) << ::strsignal(signal);
  }
  EXPECT_EQ(folder_.read("map.exr"), "older");
}

/// What is killed can tidy nothing up. Without a name there is nothing to; what has one is removed
/// by the next to write there.
TEST_P(Staged, LeaveNothingAfterTheNextRunWhereTheProgramIsKilled) {
  const auto before = folder_.names();
  const pid_t process = start_long_render("map.exr");
  ::kill(process, SIGKILL);
  EXPECT_EQ(wait_for(process), 128 + SIGKILL);
  const bool has_names = std::string(GetParam().name) == "EveryFileHasAName";
  EXPECT_EQ(folder_.names().size(), before.size() + (has_names ? 1 : 0));
  ASSERT_EQ(render_to("other.exr").status, 0);
  EXPECT_EQ(folder_.names().size(), before.size() + 1);
}

TEST_P(Staged, AreSafeFromOtherRuns) {
  const pid_t process = start_long_render("map.exr");
  const auto during = folder_.names();
  ASSERT_EQ(render_to("other.exr").status, 0);
  EXPECT_EQ(folder_.names().size(), during.size() + 1);
  for (const std::string& name : during) EXPECT_THAT(folder_.names(), Contains(name));
  EXPECT_NE(staged_by(process, folder_), "");
  ::kill(process, SIGKILL);
  wait_for(process);
}

TEST_P(Staged, TakeThePlaceOfWhatOthersHaveLeft) {
  folder_.write(stale, "left behind");
  ASSERT_EQ(render_to("map.exr").status, 0);
  EXPECT_THAT(folder_.names(), Not(Contains(stale)));
}

/// Only what is certainly a part that nobody writes any more.
TEST_P(Staged, LeaveAloneWhatIsNoStalePart) {
  const std::vector<std::string> others{".fathom-0123456789abcdeg.part", ".fathom-.part",
                                        ".fathom-0123456789abcdef.part2", ".fathom-old.part"};
  for (const std::string& name : others) folder_.write(name, "mine");
  const std::string locked = ".fathom-00000000000000aa.part";
  const std::string link = ".fathom-00000000000000bb.part";
  const std::string directory = ".fathom-00000000000000cc.part";
  const std::string pipe = ".fathom-00000000000000dd.part";
  const std::string foreign = ".fathom-00000000000000ee.part";
  folder_.write(locked, "being written");
  fs::create_symlink("square.obj", folder_ / link);
  fs::create_directory(folder_ / directory);
  ASSERT_EQ(::mkfifo((folder_ / pipe).c_str(), 0600), 0);
  folder_.write(foreign, "of another user");
  const bool is_foreign = ::chown((folder_ / foreign).c_str(), 65534, 65534) == 0;
  const int held = ::open((folder_ / locked).c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_EQ(::flock(held, LOCK_EX), 0);
  ASSERT_EQ(render_to("map.exr").status, 0);
  ::close(held);
  const auto names = folder_.names();
  for (const std::string& name : others) EXPECT_THAT(names, Contains(name));
  for (const std::string& name : {locked, link, directory, pipe}) {
    EXPECT_THAT(names, Contains(name));
  }
  EXPECT_TRUE(!is_foreign || fs::exists(folder_ / foreign));
}

INSTANTIATE_TEST_SUITE_P(Systems, Staged,
                         ::testing::Values(System{"ThisOne", {}},
                                           System{"EveryFileHasAName", without_nameless_files()},
                                           System{"NoNameForWhatHasNone", without_links()}),
                         [](const auto& system) { return std::string(system.param.name); });

class ManyOutputs : public ::testing::Test {
 protected:
  /// Maps of a camera path.
  Outcome render_path(int views, const std::function<void()>& prepare) const {
    const Outcome made =
        run_fathom({"camera", "orbit", "--views", std::to_string(views), "--centre", "0,0,2",
                    "--distance", "4", "--size", "8x6", "-o", "path.json"},
                   {.folder = folder_.path()});
    EXPECT_EQ(made.status, 0) << made.err;
    folder_.write("square.obj", square_obj);
    return run_fathom({"render", "square.obj", "--camera", "path.json", "-o", "{index:04}.pfm"},
                      {.folder = folder_.path(), .prepare = prepare});
  }
  /// With a limit on how many files may be open.
  static std::function<void()> files(rlim_t soft, rlim_t hard) {
    return [soft, hard] {
      const rlimit limit{soft, hard};
      ::setrlimit(RLIMIT_NOFILE, &limit);
    };
  }
  TestFolder folder_;
};

TEST_F(ManyOutputs, TakeAsManyOpenFilesAsTheSystemAllows) {
  const Outcome outcome = render_path(300, files(128, 1024));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(folder_.names().size(), 302U);
}

#ifndef FATHOM_SANITIZED  // each of their looks at a type takes a pipe
TEST_F(ManyOutputs, BeyondThatAreToldBeforeTheWork) {
  const Outcome outcome = render_path(300, files(128, 128));
  EXPECT_EQ(outcome.status, 4);
  EXPECT_EQ(lines_of(outcome.err), 1) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("ulimit -n"));
  EXPECT_EQ(folder_.names().size(), 2U);
}
#endif

/// Bytes that do not reach the disk take no place there.
TEST(StagedFiles, ReachTheDiskBeforeTheirNamesDo) {
  const TestFolder folder;
  folder.write("square.obj", square_obj);
  folder.write("map.exr", "older");
  const auto before = folder.names();
  const Outcome outcome = run_fathom({"render", "square.obj", "--size", "8x6", "-o", "map.exr"},
                                     {.folder = folder.path(), .prepare = without_sync()});
  EXPECT_EQ(outcome.status, 4);
  EXPECT_EQ(outcome.err, "fathom: error: map.exr: Input/output error\n");
  EXPECT_EQ(folder.read("map.exr"), "older");
  EXPECT_EQ(folder.names(), before);
}

TEST_F(ManyOutputs, ReachTheDiskBeforeTheirNamesDo) {
  const Outcome outcome = render_path(20, without_sync());
  EXPECT_EQ(outcome.status, 4);
  EXPECT_EQ(outcome.err, "fathom: error: 0000.pfm: Input/output error\n");
  EXPECT_EQ(folder_.names().size(), 2U);
}

/// All of several outputs, or none.
TEST(StagedFiles, APipeThatNobodyReadsTakesTheOthersAlong) {
  const TestFolder folder;
  folder.write("square.obj", square_obj);
  folder.write("map.exr", "older");
  const Outcome outcome = run_fathom(
      {"render", "square.obj", "--size", "8x6", "-o", "map.exr", "--stats", "/dev/stdout"},
      {.folder = folder.path(), .prepare = [] {
         std::array<int, 2> ends{};
         if (::pipe(ends.data()) != 0) ::_exit(125);
         ::close(ends[0]);
         ::dup2(ends[1], STDOUT_FILENO);
       }});
  EXPECT_EQ(outcome.status, 4);
  EXPECT_EQ(outcome.err, "fathom: error: /dev/stdout: Broken pipe\n");
  EXPECT_EQ(folder.read("map.exr"), "older");
}

/// Standard output is a file that is as large as files may be: told only when it is written.
void answer_into_a_full_file() {
  const rlimit most{65536, 65536};
  ::setrlimit(RLIMIT_FSIZE, &most);
  const int file = ::open("answer.txt", O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  ::lseek(file, 65536, SEEK_SET);
  ::dup2(file, STDOUT_FILENO);
}

/// The answer on standard output is one of them.
TEST(StagedFiles, AnAnswerThatFindsNoRoomTakesTheOthersAlong) {
  const TestFolder folder;
  folder.write("square.obj", square_obj);
  const Outcome rendered = run_fathom({"render", "square.obj", "--size", "8x6", "-o", "map.pfm"},
                                      {.folder = folder.path()});
  ASSERT_EQ(rendered.status, 0) << rendered.err;
  folder.write("older.json", "older");
  for (const char* output : {"older.json", "new.json"}) {
    const Outcome outcome =
        run_fathom({"compare", "map.pfm", "map.pfm", "--json", output},
                   {.folder = folder.path(), .prepare = answer_into_a_full_file});
    EXPECT_EQ(outcome.status, 4);
    EXPECT_EQ(outcome.err, "fathom: error: standard output: File too large\n");
  }
  EXPECT_EQ(folder.read("older.json"), "older");
  EXPECT_EQ(folder.read("answer.txt"), "");
  EXPECT_EQ(folder.names().size(), 4U);
}

TEST_F(ManyOutputs, GiveTheirPlacesBackWhereOneCannotTakeItsOwn) {
  for (const char* name : {"0000.pfm", "0002.pfm", "0003.pfm"}) folder_.write(name, "older");
  const Outcome outcome = render_path(4, without_renames());
  EXPECT_EQ(outcome.status, 4);
  EXPECT_EQ(outcome.err, "fathom: error: 0003.pfm: Input/output error\n");
  for (const char* name : {"0000.pfm", "0002.pfm", "0003.pfm"}) {
    EXPECT_EQ(folder_.read(name), "older") << name;
  }
  EXPECT_EQ(folder_.names().size(), 5U);
}

}  // namespace
}  // namespace fathom::test
