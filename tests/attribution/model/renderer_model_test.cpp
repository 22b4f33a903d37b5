#include "fathom/attribution/model/renderer_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fathom/attribution/model/named_models.h"
#include "fathom/failures/errors.h"

namespace fathom::attribution {
namespace {

template <class Model>
concept StoresWindowDepths = requires(Model model) {
  model.storage;
};
template <class Model>
concept HasMatrix = requires(Model model) {
  model.matrix;
};
template <class Model>
concept CountsRoundings = requires(Model model) {
  model.roundings;
};

// What only one kind has can be asked of neither the other nor of what they have in common.
static_assert(StoresWindowDepths<RasterModel> && !StoresWindowDepths<RayModel> &&
              !StoresWindowDepths<RendererModel>);
static_assert(HasMatrix<RasterModel> && !HasMatrix<RayModel> && !HasMatrix<RendererModel>);
static_assert(CountsRoundings<RayModel> && !CountsRoundings<RasterModel>);

TEST(NamedModels, AreOfTheirKind) {
  const RendererModel raster = model_named("gl-float32-reversed");
  EXPECT_EQ(raster.name, "gl-float32-reversed");
  EXPECT_TRUE(raster.watertight);
  EXPECT_EQ(std::get<RasterModel>(raster.kind).storage, Storage::float32);
  EXPECT_EQ(std::get<RasterModel>(raster.kind).stored_mapping(), Mapping::reversed);
  const RendererModel rays = model_named("cycles");
  EXPECT_FALSE(rays.watertight);
  EXPECT_GT(rays.sample.error, 0);
  EXPECT_GT(std::get<RayModel>(rays.kind).rotation_error, 0);
}

TEST(NamedModels, OthersAreRefusedWithTheNamesThatThereAre) {
  try {
    model_named("voxel");
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_EQ(error.what(), "there is no model 'voxel'; there are " + model_names());
  }
  EXPECT_THAT(model_names(), testing::HasSubstr("gl-unorm24, gl-unorm32"));
}

TEST(NamedModels, AreSuggestedForStoragesAndRenderers) {
  const auto expect_suggested = [](const std::string& name, const std::string& end) {
    EXPECT_THAT(unknown_model(name).what(), testing::EndsWith(end)) << name;
  };
  expect_suggested("d24", "cycles; did you mean 'gl-unorm24' or 'vtk-unorm24'?");
  expect_suggested("D24S8", "did you mean 'gl-unorm24' or 'vtk-unorm24'?");
  expect_suggested("float32", "did you mean 'gl-float32' or 'vtk-float32'?");
  expect_suggested("OpenGL", "did you mean 'gl-unorm24' or 'gl-float32'?");
  expect_suggested("Blender", "cycles; did you mean 'cycles'?");
  expect_suggested("gl-unorm23", "did you mean 'gl-unorm24' or 'gl-unorm32'?");
  // No model stores it, and nobody means a model by it.
  expect_suggested("float16", ", cycles");
  EXPECT_THAT(unknown_model("mathcing", {"auto", "matching"}).what(),
              testing::EndsWith("cycles; auto; matching; did you mean 'matching'?"));
}

TEST(RasterModels, StoreWhatAShaderWrites) {
  RasterModel model{.mapping = Mapping::opengl};
  EXPECT_EQ(model.stored_mapping(), Mapping::opengl);
  model.written = WrittenDepth{.mapping = Mapping::log_ulrich};
  EXPECT_EQ(model.stored_mapping(), Mapping::log_ulrich);
}

}  // namespace
}  // namespace fathom::attribution
