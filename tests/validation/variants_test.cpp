#include "validation/variants/variants.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "fathom/failures/errors.h"
#include "validation/variants/peer.h"

namespace fathom::validation {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Encoding = VtkVariant::Encoding;

template <class Call>
std::string usage_error_of(const Call& call) {
  try {
    call();
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

TEST(VariantWords, AreSeparatedByOneBlank) {
  EXPECT_THAT(words_of("float32 reversed"), ElementsAre("float32", "reversed"));
  EXPECT_THAT(words_of("a  b "), ElementsAre("a", "", "b", ""));
  EXPECT_THAT(words_of(""), ElementsAre(""));
}

TEST(VariantWords, CountsAreWholeWords) {
  EXPECT_EQ(count_named("4", 2), 4);
  for (const char* word : {"", "4x", "x4", " 4", "-4", "+4", "0x4", "4.0", "1", "99999999999"}) {
    EXPECT_EQ(count_named(word, 2), std::nullopt) << word;
  }
}

/// A peer and the name under which reports show it.
struct Named {
  Peer peer;
  DrivenRenderer renderer;
  std::string name;
};

void PrintTo(const Named& named, std::ostream* stream) {
  *stream << named.name;
}

class NamedPeers : public testing::TestWithParam<Named> {};

TEST_P(NamedPeers, NamesAreReadAndWritten) {
  const Named& named = GetParam();
  EXPECT_EQ(renderer_of(named.peer), named.renderer);
  EXPECT_EQ(variant_name(named.peer), named.name);
  EXPECT_TRUE(peer_named(named.renderer, named.name) == named.peer);
}

INSTANTIATE_TEST_SUITE_P(
    All, NamedPeers,
    testing::Values(
        Named{VtkVariant{}, Renderer::vtk, "own"},
        Named{VtkVariant{.samples = 8}, Renderer::vtk, "own 8 samples"},
        Named{VtkVariant{.attachment = Storage::unorm16}, Renderer::vtk, "unorm16"},
        Named{VtkVariant{.attachment = Storage::float32, .encoding = Encoding::reversed},
              Renderer::vtk, "float32 reversed"},
        Named{VtkVariant{.attachment = Storage::float32, .encoding = Encoding::reversed_by_shader},
              Renderer::vtk, "float32 reversed by shader"},
        Named{VtkVariant{.attachment = Storage::unorm24, .encoding = Encoding::logarithmic},
              Renderer::vtk, "unorm24 logarithmic"},
        Named{VtkVariant{.mesh = VtkVariant::Mesh::peeled}, Renderer::vtk, "own peeled"},
        Named{VtkVariant{.mesh = VtkVariant::Mesh::behind_peeled}, Renderer::vtk,
              "own behind peeled"},
        Named{VtkVariant{.driver = Driver::llvmpipe}, {Renderer::vtk, Driver::llvmpipe}, "own"},
        Named{VtkVariant{.mesh = VtkVariant::Mesh::peeled, .driver = Driver::softpipe},
              {Renderer::vtk, Driver::softpipe},
              "own peeled"},
        Named{OpenGlVariant{.samples = 4, .driver = Driver::softpipe},
              {Renderer::opengl, Driver::softpipe},
              "unorm24 4 samples"},
        Named{OpenGlVariant{.storage = Storage::unorm32}, Renderer::opengl, "unorm32"},
        Named{OpenGlVariant{.storage = Storage::float32, .reversed = true}, Renderer::opengl,
              "float32 reversed"},
        Named{OpenGlVariant{.offset_units = 16}, Renderer::opengl, "unorm24 offset 16"},
        Named{OpenGlVariant{.samples = 4}, Renderer::opengl, "unorm24 4 samples"},
        Named{OpenGlVariant{.reversed = true, .offset_units = 3, .samples = 2}, Renderer::opengl,
              "unorm24 reversed offset 3 2 samples"},
        Named{EmbreeVariant{}, Renderer::embree, "default"},
        Named{EmbreeVariant{.robust = true}, Renderer::embree, "robust"},
        Named{BlenderVariant{}, Renderer::blender, "cycles"}));

TEST(Peers, NamesThatAreNotUnderstoodAreRefused) {
  const auto message = [](Renderer renderer, const std::string& name) {
    return usage_error_of([&] { peer_named(renderer, name); });
  };
  for (const char* name : {"",
                           "unorm8",
                           "float16",
                           "unorm24 ",
                           "unorm24 offset",
                           "unorm24 offset x",
                           "unorm24 offset 4x",
                           "unorm24 offset -4",
                           "unorm24 offset 0",
                           "unorm24 samples",
                           "unorm24 4x samples",
                           "unorm24 -4 samples",
                           "unorm24 1 samples",
                           "unorm24 4 sample",
                           "unorm24 reversed reversed",
                           "unorm24 offset 4 offset 4",
                           "unorm24 4 samples 4 samples",
                           "unorm24 unorm16",
                           "reversed",
                           "unorm24 offset samples"}) {
    EXPECT_EQ(message(Renderer::opengl, name),
              "opengl has no variant '" + std::string(name) +
                  "', only unorm16, unorm24, unorm32 and float32, each also with 'reversed', "
                  "'offset UNITS' and 'N samples'");
  }
  for (const char* name :
       {"", "mine", "float16", "own ", "own x samples", "own 0 samples", "own -8 samples",
        "own 8 samples 8 samples", "unorm24 by shader", "float32 reversed by", "own samples",
        "float32 reversed by shader by shader", "unorm24 offset 4", "peeled", "own behind",
        "unorm24 peeled", "own peeled 8 samples"}) {
    EXPECT_EQ(message(Renderer::vtk, name),
              "vtk has no variant '" + std::string(name) +
                  "', only own, unorm16, unorm24, unorm32 and float32, each also with 'reversed', "
                  "'reversed by shader', 'logarithmic' or 'N samples'; and own peeled and own "
                  "behind peeled");
  }
  EXPECT_EQ(message(Renderer::embree, "robbust"),
            "embree has no variant 'robbust', only default and robust");
  EXPECT_EQ(message(Renderer::blender, "eevee"), "blender has no variant 'eevee', only cycles");
}

TEST(Peers, RenderersHaveNames) {
  for (const Renderer renderer :
       {Renderer::vtk, Renderer::opengl, Renderer::embree, Renderer::blender}) {
    EXPECT_EQ(renderer_named(name_of(renderer)), renderer);
  }
  EXPECT_EQ(usage_error_of([] { renderer_named("pbrt"); }),
            "'pbrt' is not one of vtk, opengl, embree and blender");
}

TEST(Peers, RenderersOfOpenGlHaveDrivers) {
  for (const char* name : {"vtk@llvmpipe", "vtk@softpipe", "opengl@llvmpipe", "opengl@softpipe"}) {
    EXPECT_EQ(name_of(renderer_named(name)), name);
  }
  EXPECT_EQ(renderer_named("opengl").driver, Driver::usual);
  for (const std::string name : {"opengl@", "opengl@zink"}) {
    EXPECT_EQ(usage_error_of([&] { renderer_named(name); }),
              "'" + name + "': the driver is not one of llvmpipe and softpipe");
  }
  EXPECT_EQ(usage_error_of([] { renderer_named("vtk@softpipe "); }),
            "'vtk@softpipe ': the driver is not one of llvmpipe and softpipe; did you mean "
            "'softpipe'?");
  EXPECT_EQ(usage_error_of([] { renderer_named("embree@softpipe"); }),
            "'embree@softpipe': embree draws without OpenGL, only vtk and opengl take a driver");
}

TEST(Peers, AreChosenByVariantInTheirOwnOrder) {
  const std::vector<Peer> peers{OpenGlVariant{.storage = Storage::unorm16}, OpenGlVariant{},
                                VtkVariant{.attachment = Storage::unorm16},
                                EmbreeVariant{.robust = true}};
  const std::vector<std::string> some{"robust", "unorm16", "robust"};
  EXPECT_THAT(with_variants(peers, some), ElementsAre(peers[0], peers[2], peers[3]));
  const std::vector<std::string> misspelt{"unorm24", "robbust"};
  EXPECT_EQ(
      usage_error_of([&] { with_variants(peers, misspelt); }),
      "none of the renderers has a variant 'robbust'; there are unorm16, unorm24, robust; did you "
      "mean 'robust'?");
}

}  // namespace
}  // namespace fathom::validation
