// Files that were damaged, or made to do harm: a mesh or one line, within the limits.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/wait.h>

#include <random>

#include "assimp_files.h"
#include "foreign_scene.h"
#include "tests/apps/run_program.h"
#include "tests/apps/test_folder.h"
#include "tests/effort.h"

namespace fathom::test {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

struct Kind {
  std::string exporter, suffix;
};

void PrintTo(const Kind& kind, std::ostream* out) {
  *out << kind.exporter;
}

/// Cut short, bytes changed, a piece taken out or repeated.
std::string damaged(std::string bytes, std::mt19937_64& random) {
  const auto place = [&] { return random() % bytes.size(); };
  switch (random() % 4) {
    case 0:
      return bytes.substr(0, place());
    case 1:
      for (int i = 0; i < 8; ++i) bytes[place()] = static_cast<char>(random());
      return bytes;
    case 2:
      return bytes.erase(place(), random() % 64);
    default:
      return bytes.insert(place(), bytes.substr(place(), random() % 256));
  }
}

class DamagedFiles : public ::testing::TestWithParam<Kind> {};

TEST_P(DamagedFiles, AreMeshesOrOneLine) {
  const auto& [exporter, suffix] = GetParam();
  const std::string good =
      exported(read_polygons(source_dir() / "data/meshes/l-shape.obj"), exporter);
  std::mt19937_64 random(14);
  int refused = 0;
  // A kind of which nothing is refused was not damaged, or not read.
  constexpr int cases = checks::effort == 1 ? 60 : 30;
  for (int i = 0; i < cases; ++i) {
    const std::string bytes = damaged(good, random);
    if (bytes.empty()) continue;
    try {
      read_bytes("bad." + suffix, bytes);
    } catch (const InputError& error) {
      ++refused;
      EXPECT_THAT(error.what(),
                  AllOf(HasSubstr("bad." + suffix + ": "), ::testing::Not(HasSubstr("\n"))));
    }
  }
  EXPECT_GT(refused, 0);
}

INSTANTIATE_TEST_SUITE_P(All, DamagedFiles,
                         ::testing::Values(Kind{"collada", "dae"}, Kind{"fbx", "fbx"},
                                           Kind{"fbxa", "fbx"}, Kind{"3ds", "3ds"},
                                           Kind{"3mf", "3mf"}, Kind{"x", "x"}, Kind{"x3d", "x3d"}),
                         [](const auto& tested) { return "As_" + tested.param.exporter; });

/// Whether a child of this process is left: one that runs, or one whose end nobody has asked for.
bool has_children() {
  return ::waitpid(-1, nullptr, WNOHANG) >= 0;
}

// assimp never comes to the end of these nodes.
TEST(HostileFiles, LoopsWithoutEndAreEnded) {
  const TestFolder folder;
  folder.write("loop.smd", "version 1\n\nnodes\n  0 \"TriangleTest0\"");
  ASSERT_EQ(::prctl(PR_SET_CHILD_SUBREAPER, 1), 0);  // what fathom leaves behind becomes ours
  ASSERT_FALSE(has_children());
  // The library allows 5 s. The test's own limit, which its children have too, ends as SIGKILL.
  const Outcome outcome =
      run_fathom({"info", folder / "loop.smd", "--max-expansion", "1"}, {.seconds = 20});
  EXPECT_FALSE(has_children());
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "fathom: error: " + (folder / "loop.smd") +
                             ": assimp could not read it: it takes more than 5 s\n");
}

#ifndef FATHOM_SANITIZED  // without a limit on addresses there
// A megabyte that would be a gigabyte.
TEST(HostileFiles, ArchivesThatGrowAreRefused) {
  const TestFolder folder;
  const Outcome made = run({python, "-c", R"(
import zipfile
with zipfile.ZipFile('bomb.3mf', 'w', zipfile.ZIP_DEFLATED) as z:
    z.writestr('[Content_Types].xml', '<?xml version="1.0"?><Types/>')
    z.writestr('_rels/.rels', '<?xml version="1.0"?><Relationships xmlns='
               '"http://schemas.openxmlformats.org/package/2006/relationships"><Relationship '
               'Target="/3D/3dmodel.model" Id="r" '
               'Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>'
               '</Relationships>')
    with z.open('3D/3dmodel.model', 'w', force_zip64=True) as f:
        f.write(b'<?xml version="1.0"?><model>')
        for _ in range(1024): f.write(b' ' * (1 << 20))
)"},
                           {.folder = folder.path()});
  ASSERT_EQ(made.status, 0) << made.err;
  const Outcome outcome = run_fathom({"info", folder / "bomb.3mf"});
  EXPECT_EQ(outcome.status, 3) << outcome.out;
  EXPECT_THAT(outcome.err, StartsWith("fathom: error: " + (folder / "bomb.3mf") +
                                      ": assimp could not read it: it takes more than "));
}
#endif

// The suffix says what it is meant to be.
TEST(HostileFiles, WhatIsNotOfItsSuffixIsRefused) {
  const std::string fbx = exported(read_polygons(source_dir() / "data/meshes/cube.obj"), "fbxa");
  for (const std::string suffix :
       {"3ds", "3mf", "lwo", "ms3d", "blend", "b3d", "md2", "iqm", "ac"}) {
    EXPECT_THAT(refusal_of("cube." + suffix, fbx),
                StartsWith("cube." + suffix + ": assimp could not read it: "));
  }
}

}  // namespace
}  // namespace fathom::test
