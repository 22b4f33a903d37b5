// What the program needs of the system and may not get: streams, folders, threads. It works on, or
// says in one line what is missing.

#include <fcntl.h>
#include <gmock/gmock.h>
#include <grp.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <thread>

#include "faults.h"
#include "run_program.h"
#include "sample_files.h"
#include "test_folder.h"

namespace fathom::test {
namespace {

namespace fs = std::filesystem;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class Manners : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.write("square.obj", square_obj);
    folder_.write("camera.json", square_camera);
    ASSERT_EQ(render({}, "truth.exr").status, 0);
  }

  Outcome render(const std::function<void()>& prepare, const std::string& output,
                 const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"render",      "square.obj", "--camera",
                                       "camera.json", "-o",         output};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_fathom(arguments, {.folder = folder_.path(), .prepare = prepare});
  }
  void expect_truth(const std::string& name) const {
    EXPECT_TRUE(folder_.read(name) == folder_.read("truth.exr")) << name;
  }
  static void expect_one_line(const Outcome& outcome, int status, const std::string& said) {
    EXPECT_EQ(outcome.status, status);
    EXPECT_EQ(lines_of(outcome.err), 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(said));
  }

  TestFolder folder_;
};

// --- standard streams ---

/// A file that is opened does not become the standard error, which then writes into it.
TEST_F(Manners, NoFileTakesThePlaceOfAStreamThatIsClosed) {
  for (int closed = 1; closed < 8; ++closed) {
    std::vector<int> streams;
    for (const int stream : {0, 1, 2}) {
      if ((closed >> stream & 1) != 0) streams.push_back(stream);
    }
    const Outcome outcome = render(without_streams(streams), "map.exr");
    EXPECT_EQ(outcome.status, 0) << closed;
    expect_truth("map.exr");
    // A warning goes nowhere, rather than into the map.
    folder_.write("empty.obj", "v 0 0 0\n");
    const Outcome warned =
        run_fathom({"render", "empty.obj", "--camera", "camera.json", "-o", "warned.exr"},
                   {.folder = folder_.path(), .prepare = without_streams(streams)});
    EXPECT_EQ(warned.status, 0) << closed;
    EXPECT_EQ(run_fathom({"info", "warned.exr"}, {.folder = folder_.path()}).status, 0) << closed;
  }
}

/// Told before the work: no map is there.
TEST_F(Manners, AClosedStandardOutputIsToldBeforeTheWork) {
  const auto before = folder_.names();
  const auto closed = without_streams({STDOUT_FILENO});
  const std::vector<std::vector<std::string>> more{{"--stats", "-"}, {"--save-camera", "-"}};
  for (const auto& option : more) {
    expect_one_line(render(closed, "map.exr", option), 4,
                    "fathom: error: standard output: Bad file descriptor");
  }
  for (const char* const name : {"/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"}) {
    expect_one_line(render(closed, name), 4, std::string(name) + ": Bad file descriptor");
  }
  const std::vector<std::vector<std::string>> commands{
      {"info", "square.obj"},
      {"probe", "square.obj", "--pixel", "1,1"},
      {"visible", "square.obj"},
      {"coplanar", "square.obj"},
      {"compare", "truth.exr", "truth.exr"},
      {"depth", "encode", "--storage", "unorm16", "--near", "1", "--far", "2", "1"},
      {"camera", "look-at", "--eye", "0,0,1"},
      {"--help"}};
  for (const auto& command : commands) {
    const Outcome outcome = run_fathom(command, {.folder = folder_.path(), .prepare = closed});
    expect_one_line(outcome, 4, "standard output: Bad file descriptor");
  }
  EXPECT_EQ(folder_.names(), before);
}

TEST_F(Manners, AFullOrBrokenStandardOutputIsToldBeforeTheWork) {
  const auto before = folder_.names();
  const auto full = [] { ::dup2(::open("/dev/full", O_WRONLY), STDOUT_FILENO); };
  expect_one_line(render(full, "map.exr", {"--stats", "-"}), 4, "No space left on device");
  expect_one_line(render(full, "/dev/stdout"), 4, "No space left on device");
  const auto broken = [] {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0) ::_exit(125);
    ::close(ends[0]);
    ::dup2(ends[1], STDOUT_FILENO);
  };
  expect_one_line(render(broken, "map.exr", {"--stats", "-"}), 4, "Broken pipe");
  expect_one_line(render(broken, "/dev/stdout"), 4, "Broken pipe");
  EXPECT_EQ(folder_.names(), before);
}

/// What the shell opened is written to where it stands, not from its beginning.
TEST_F(Manners, AnOpenFileIsWrittenWhereItStands) {
  folder_.write("log", "before\n");
  const auto append = [path = folder_ / "log"] {
    ::dup2(::open(path.c_str(), O_WRONLY | O_APPEND), STDOUT_FILENO);
  };
  for (const char* const name : {"/dev/stdout", "/dev/fd/1"}) {
    ASSERT_EQ(render(append, name).status, 0);
  }
  const std::string map = folder_.read("truth.exr");
  EXPECT_TRUE(folder_.read("log") == "before\n" + map + map);
}

// --- folders ---

TEST_F(Manners, AFolderForTemporaryFilesThatIsNotThereIsNotNeeded) {
  const auto nowhere = [] { ::setenv("TMPDIR", "/nowhere/at/all", 1); };
  EXPECT_EQ(render(nowhere, "map.exr").status, 0);
  const Outcome through = render(nowhere, "/dev/stdout");
  EXPECT_EQ(through.status, 0) << through.err;
  EXPECT_TRUE(through.out == folder_.read("truth.exr"));
}

TEST_F(Manners, AWorkingFolderThatIsGone) {
  const auto gone = [] {
    if (::mkdir("gone", 0700) != 0 || ::chdir("gone") != 0 || ::rmdir("../gone") != 0) {
      ::_exit(125);
    }
  };
  const std::string mesh = folder_ / "square.obj", camera = folder_ / "camera.json";
  const auto run_there = [&](const std::string& output) {
    return run_fathom({"render", mesh, "--camera", camera, "-o", output},
                      {.folder = folder_.path(), .prepare = gone});
  };
  expect_one_line(run_there("map.exr"), 4, "map.exr: the working directory is gone");
  const Outcome outcome = run_there(folder_ / "map.exr");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(run_fathom({"compare", "map.exr", "truth.exr"}, {.folder = folder_.path()}).status, 0);
  expect_one_line(run_fathom({"info", "square.obj"}, {.folder = folder_.path(), .prepare = gone}),
                  3, "square.obj: cannot be opened");
}

// --- threads ---

TEST_F(Manners, WithoutThreadsItWorksAlone) {
  folder_.write("two.json", R"({"meshes": [{"file": "square.obj"}, {"file": "square.obj"}]})");
  for (const std::vector<std::string>& more : {std::vector<std::string>{},
                                               {"--threads", "8"},
                                               {"--engine", "reference"},
                                               {"--verify", "5"},
                                               {"--size", "500x400"}}) {
    std::vector<std::string> arguments{"render", "two.json", "--quiet", "-o", "map.exr"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome =
        run_fathom(arguments, {.folder = folder_.path(), .prepare = without_threads()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }
  expect_truth([&] {
    EXPECT_EQ(render(without_threads(), "alone.exr").status, 0);
    return "alone.exr";
  }());
  for (const std::vector<std::string>& command : {std::vector<std::string>{"info", "square.obj"},
                                                  {"info", "map.exr"},
                                                  {"visible", "two.json"},
                                                  {"coplanar", "two.json"},
                                                  {"preview", "map.exr", "-o", "map.png"},
                                                  {"convert", "map.exr", "-o", "other.exr"}}) {
    const Outcome outcome =
        run_fathom(command, {.folder = folder_.path(), .prepare = without_threads()});
    EXPECT_EQ(outcome.status, 0) << command[0] << " " << outcome.err;
  }
}

#ifndef FATHOM_SANITIZED  // sanitizers have threads of their own
/// Some threads, but not all that are wanted.
TEST_F(Manners, WithFewThreadsItWorksWithThese) {
  if (::geteuid() != 0) GTEST_SKIP() << "needs a user of its own, to count its processes";
  ::chmod(folder_.path().c_str(), 0777);
  constexpr uid_t user = 54321;
  for (rlim_t threads = 1; threads < 8; ++threads) {
    const auto few = [threads] {
      const rlimit limit{threads, threads};
      if (::setgroups(0, nullptr) != 0 || ::setgid(user) != 0 || ::setuid(user) != 0) ::_exit(125);
      ::setrlimit(RLIMIT_NPROC, &limit);
    };
    const std::string name = std::to_string(threads) + ".exr";
    const Outcome outcome = render(few, name, {"--threads", "6", "--quiet"});
    EXPECT_EQ(outcome.status, 0) << threads << " " << outcome.err;
    expect_truth(name);
  }
}
#endif

// --- files that change while they are read ---

/// Renders or describes a file that is cut short as soon as it is mapped.
Outcome run_cutting(const std::vector<std::string>& arguments, const std::string& file,
                    const TestFolder& folder) {
  const std::string err = folder / "err";
  const pid_t process =
      start_fathom(arguments, {.folder = folder.path(), .prepare = [&err] {
                                 const int to = ::open(err.c_str(), O_WRONLY | O_CREAT, 0600);
                                 ::dup2(to, STDERR_FILENO);
                               }});
  const std::string maps = "/proc/" + std::to_string(process) + "/maps";
  for (bool is_mapped = false; !is_mapped;) {
    ::kill(process, SIGSTOP);
    std::ifstream lines(maps);
    if (!lines) break;
    std::string line;
    bool has_any = false;
    while (std::getline(lines, line)) {
      has_any = true;
      is_mapped = is_mapped || line.ends_with(file);
    }
    if (is_mapped) fs::resize_file(file, 4096);
    ::kill(process, SIGCONT);
    if (!has_any) break;
    std::this_thread::sleep_for(std::chrono::microseconds(300));
  }
  Outcome outcome;
  outcome.status = wait_for(process);
  outcome.err = folder.read("err");
  return outcome;
}

TEST_F(Manners, AMappedFileThatIsCutShortIsNamed) {
  std::string camera = square_camera;
  camera.insert(1, std::string(200U << 20U, ' '));
  folder_.write("large.json", camera);
  const std::string file = folder_ / "large.json";
  const Outcome outcome = run_cutting({"info", file}, file, folder_);
  expect_one_line(outcome, 3, "fathom: error: " + file + ": has been cut short");
}

TEST_F(Manners, AStreamedFileThatIsCutShortIsNamed) {
  std::string ply =
      "ply\nformat binary_little_endian 1.0\nelement vertex 300000\nproperty float x\n"
      "property float y\nproperty float z\nelement face 600000\nproperty list uchar uint "
      "vertex_indices\nend_header\n" +
      std::string(300000 * 12, '\0');
  for (int i = 0; i < 600000; ++i) {
    const std::array<std::uint32_t, 3> corners{0, 1, static_cast<std::uint32_t>(i % 300000)};
    ply += '\3' + std::string(reinterpret_cast<const char*>(corners.data()), 12);
  }
  folder_.write("large.ply", ply);
  const std::string file = folder_ / "large.ply";
  const auto before = folder_.names().size();
  const Outcome outcome = run_cutting({"render", file, "--stream", "--quiet", "--camera",
                                       "camera.json", "--verify", "100", "-o", "map.exr"},
                                      file, folder_);
  expect_one_line(outcome, 3, "fathom: error: " + file + ": ");
  EXPECT_EQ(folder_.names().size(), before + 1);  // "err"
}

}  // namespace
}  // namespace fathom::test
