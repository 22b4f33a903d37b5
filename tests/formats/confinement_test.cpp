// What others' libraries do stays in fathom-formats: it sees one file, and its end, whichever it
// is, is one line and exit status 3.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <assimp/IOStream.hpp>
#include <memory>

#include "apps/formats/one_file.h"
#include "fathom/mesh_files/formats_program/messages.h"
#include "foreign_scene.h"
#include "tests/apps/run_program.h"
#include "tests/apps/test_folder.h"

namespace fathom::test {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string square_dae =
    "<COLLADA version='1.4.1'><library_geometries><geometry id='g'><mesh><source id='p'>"
    "<float_array id='a' count='12'>0 0 0 1 0 0 1 1 0 0 1 0</float_array><technique_common>"
    "<accessor source='#a' count='4' stride='3'><param name='X' type='float'/>"
    "<param name='Y' type='float'/><param name='Z' type='float'/></accessor></technique_common>"
    "</source><vertices id='v'><input semantic='POSITION' source='#p'/></vertices>"
    "<polylist count='1'><input semantic='VERTEX' source='#v' offset='0'/><vcount>4</vcount>"
    "<p>0 1 2 3</p></polylist></mesh></geometry></library_geometries><library_visual_scenes>"
    "<visual_scene id='s'><node id='n'><instance_geometry url='#g'/></node></visual_scene>"
    "</library_visual_scenes><scene><instance_visual_scene url='#s'/></scene></COLLADA>";

/// A folder with `fathom` and a mesh, and what stands in for fathom-formats.
class FormatsProgram : public ::testing::Test {
 protected:
  FormatsProgram() {
    std::filesystem::copy_file(program_path(), folder_ / "fathom");
    folder_.write("a.dae", square_dae);
  }

  void put(const std::string& script) const { put(script, "fathom-formats"); }
  void put(const std::string& script, const std::string& name) const {
    folder_.write(name, script);
    std::filesystem::permissions(folder_ / name, std::filesystem::perms::owner_all);
  }

  [[nodiscard]] Outcome info(const std::string& provider = "") const {
    return run(
        {"/usr/bin/env", "FATHOM_PROVIDE_FORMATS=" + provider, folder_ / "fathom", "info", "a.dae"},
        {.folder = folder_.path()});
  }

  void expect_failure(const std::string& script, const std::string& message) const {
    put(script);
    const Outcome outcome = info();
    EXPECT_EQ(outcome.status, 3);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "fathom: error: a.dae: " + message + "\n");
  }

  /// A program that talks over the socket on its standard input.
  static std::string python_script(const std::string& body) {
    return "#!" + python + "\nimport os, socket, struct, sys\ns = socket.socket(fileno=0)\n" + body;
  }

  TestFolder folder_;
};

TEST_F(FormatsProgram, ThatIsNotThereIsNamed) {
  const Outcome outcome = info();
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(
      outcome.err,
      "fathom: error: a.dae: is read by a separate program, fathom-formats, that is not "
      "installed: "
      "the package fathom contains it; 'scripts/fathom formats' in a clone of Fathom builds it\n");
}

TEST_F(FormatsProgram, IsProvidedWhenItIsFirstNeeded) {
  put("#!/bin/sh\ntouch called\necho building\nln -s " + program("fathom-formats").string() +
          " fathom-formats\n",
      "provider");
  const Outcome first = info(folder_ / "provider");
  EXPECT_EQ(first.status, 0) << first.err;
  EXPECT_EQ(first.err, "building\n");
  EXPECT_THAT(first.out, AllOf(StartsWith("a.dae: a mesh\n"), HasSubstr("triangles  2\n")));
  std::filesystem::remove(folder_ / "called");
  EXPECT_EQ(info(folder_ / "provider").out, first.out);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "called"));
}

TEST_F(FormatsProgram, ThatCannotBeProvidedIsNamed) {
  put("#!/bin/sh\necho no network\nexit 1\n", "provider");
  const Outcome outcome = info(folder_ / "provider");
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, AllOf(StartsWith("no network\n"), HasSubstr("that is not installed")));
  EXPECT_THAT(info(folder_ / "nowhere").err, HasSubstr("that is not installed"));
}

TEST_F(FormatsProgram, ThatCannotBeStartedIsNamed) {
  put("not a program");
  std::filesystem::permissions(folder_ / "fathom-formats", std::filesystem::perms::owner_read);
  const Outcome outcome = info();
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("which cannot be started: "));
}

TEST_F(FormatsProgram, OfAnotherVersionIsNamed) {
  expect_failure("#!/bin/sh\n[ \"$1\" = --serve ] && exit 64\nexit 1\n",
                 "assimp could not read it: " + (folder_ / "fathom-formats") +
                     " belongs to another version: install the package fathom of this version, or "
                     "build it again by 'scripts/fathom formats' in a clone of Fathom");
  const Outcome other = run({program("fathom-formats"), "--serve", "0"});
  EXPECT_EQ(other.status, mesh_files::formats_program::other_version);
}

TEST_F(FormatsProgram, ThatCrashesIsOneLine) {
  expect_failure("#!/bin/sh\necho noise; echo noise >&2; kill -SEGV $$\n",
                 "assimp could not read it: it crashed (Segmentation fault)");
  expect_failure("#!/bin/sh\nkill -ABRT $$\n", "assimp could not read it: it crashed (Aborted)");
}

TEST_F(FormatsProgram, ThatTakesTooLongIsOneLine) {
  expect_failure("#!/bin/sh\nkill -XCPU $$\n", "assimp could not read it: it takes more than 21 s");
  expect_failure("#!/bin/sh\nkill -ALRM $$\n", "assimp could not read it: it takes more than 21 s");
}

TEST_F(FormatsProgram, ThatIsKilledIsOneLine) {
  expect_failure("#!/bin/sh\nkill -KILL $$\n",
                 "assimp could not read it: it was killed, for want of memory or by a user");
}

TEST_F(FormatsProgram, ThatSaysNothingIsOneLine) {
  expect_failure("#!/bin/sh\nexit 0\n",
                 "assimp could not read it: " + (folder_ / "fathom-formats") + " does not answer");
  expect_failure(python_script("s.recv(1)\ns.send(struct.pack('QQ', 0, 100))\n"),
                 "assimp could not read it: " + (folder_ / "fathom-formats") + " does not answer");
}

TEST_F(FormatsProgram, WhoseAnswerMakesNoSenseIsOneLine) {
  for (const std::string answer :
       {"b''", "b'x' * 7", "b'\\xff' * 64",  // no text, no count
        "t(b'assimp') + n(2 ** 60)",         // meshes that are not there
        "t(b'assimp') + n(1) + n(2 ** 62) + b'0' * 64",
        "t(b'assimp') + n(0) + n(1) + b'\\x05\\0\\0\\0' + t(b'') + b'\\0' * 64 + n(0)",  // depth 5
        "t(b'assimp') + n(0) + n(1) + b'\\0\\0\\0\\0' + t(b'') + identity + n(1) + b'\\1\\0\\0\\0'",
        // A mesh of one vertex whose face has more corners than there are.
        "t(b'assimp') + n(1) + n(3) + b'\\0' * 12 + n(0) * 3 + n(1) + b'\\3\\0\\0\\0' + n(0) + n(1)"
        " + b'\\0\\0\\0\\0' + t(b'') + identity + n(1) + b'\\0\\0\\0\\0'"}) {
    SCOPED_TRACE(answer);
    expect_failure(python_script("n = lambda k: struct.pack('Q', k)\n"
                                 "t = lambda x: n(len(x)) + x\n"
                                 "identity = struct.pack('16f', *([1, 0, 0, 0, 0] * 3), 1)\n"
                                 "a = " +
                                 answer +
                                 "\n"
                                 "s.recv(1 << 20)\ns.sendall(struct.pack('QQ', 0, len(a)) + a)\n"
                                 "s.recv(1)\n"),
                   "assimp could not read it: the answer of fathom-formats makes no sense");
  }
}

TEST_F(FormatsProgram, WhoseFacesHaveNoVerticesIsOneLine) {
  expect_failure(
      python_script(
          "n = lambda k: struct.pack('Q', k)\n"
          "t = lambda x: n(len(x)) + x\n"
          "identity = struct.pack('16f', *([1, 0, 0, 0, 0] * 3), 1)\n"
          "a = t(b'assimp') + n(1) + n(3) + b'\\0' * 12 + n(0) * 3 + n(1) + b'\\3\\0\\0\\0'\n"
          "a += n(3) + struct.pack('3I', 0, 0, 1) + n(1) + b'\\0' * 4 + t(b'') + identity\n"
          "a += n(1) + b'\\0' * 4\n"
          "s.recv(1 << 20)\ns.sendall(struct.pack('QQ', 0, len(a)) + a)\ns.recv(1)\n"),
      "assimp gives a face the vertex 1, expected less than 1");
}

TEST_F(FormatsProgram, ReasonsOfSeveralLinesAreOne) {
  expect_failure(python_script("a = b'first\\nsecond\\x1b[31m\\n' + b'x' * 999\n"
                               "s.recv(1 << 20)\ns.sendall(struct.pack('QQ', 1, len(a)) + a)\n"),
                 "assimp could not read it: first?second?[31m?" + std::string(282, 'x') + "…");
}

// It is not told to end when this program is, and must not stay.
TEST_F(FormatsProgram, EndsWithTheProgramThatAsks) {
  put(
      python_script("import ctypes\nopen('started', 'w')\ns.recv(1 << 20)\n"
                    "while s.recv(1): pass\nopen('ended', 'w')\n"));
  const pid_t asking = ::fork();
  if (asking == 0) {
    if (::chdir(folder_.path().c_str()) == 0)
      ::execl((folder_ / "fathom").c_str(), "fathom", "info", "a.dae", nullptr);
    ::_exit(126);
  }
  const auto wait_until_there = [&](const char* name) {
    for (int i = 0; i < 3000 && !std::filesystem::exists(folder_ / name); ++i) ::usleep(10'000);
    return std::filesystem::exists(folder_ / name);
  };
  ASSERT_TRUE(wait_until_there("started"));
  ::kill(asking, SIGKILL);
  wait_for(asking);
  EXPECT_TRUE(wait_until_there("ended"));
}

class OneFileTest : public ::testing::Test {
 protected:
  const std::string text = "0123456789";
  app::OneFile files{"a.dae", std::as_bytes(std::span(text))};
};

TEST_F(OneFileTest, IsAllThereIs) {
  EXPECT_TRUE(files.Exists("a.dae"));
  for (const char* other : {"b.dae", "./a.dae", "/etc/passwd", "../a.dae", "", "a.dae/"}) {
    EXPECT_FALSE(files.Exists(other)) << other;
    EXPECT_EQ(files.Open(other, "rb"), nullptr) << other;
  }
  for (const char* mode : {"w", "wb", "a", "r+", "rb+", "ab"}) {
    EXPECT_EQ(files.Open("a.dae", mode), nullptr) << mode;
  }
  EXPECT_FALSE(files.DeleteFile("a.dae"));
  EXPECT_FALSE(files.CreateDirectory("d"));
}

TEST_F(OneFileTest, StreamsStayWithinIt) {
  const std::unique_ptr<Assimp::IOStream> stream(files.Open("a.dae", "rb"));
  ASSERT_NE(stream, nullptr);
  std::array<char, 16> buffer{};
  EXPECT_EQ(stream->FileSize(), 10U);
  EXPECT_EQ(stream->Read(buffer.data(), 4, 4), 2U);  // two whole items
  EXPECT_EQ(stream->Tell(), 8U);
  EXPECT_EQ(stream->Read(buffer.data(), 1, 16), 2U);
  EXPECT_EQ(stream->Read(buffer.data(), 1, 16), 0U);
  EXPECT_EQ(stream->Seek(11, aiOrigin_SET), aiReturn_FAILURE);
  EXPECT_EQ(stream->Seek(1, aiOrigin_CUR), aiReturn_FAILURE);
  EXPECT_EQ(stream->Seek(std::size_t{0} - 3, aiOrigin_CUR), aiReturn_SUCCESS);
  EXPECT_EQ(stream->Tell(), 7U);
  EXPECT_EQ(stream->Seek(std::size_t{0} - 8, aiOrigin_CUR), aiReturn_FAILURE);
  EXPECT_EQ(stream->Seek(11, aiOrigin_END), aiReturn_FAILURE);
  EXPECT_EQ(stream->Seek(4, aiOrigin_END), aiReturn_SUCCESS);
  EXPECT_EQ(stream->Tell(), 6U);
  EXPECT_EQ(stream->Write("x", 1, 1), 0U);
}

}  // namespace
}  // namespace fathom::test
