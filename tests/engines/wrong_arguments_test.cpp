// What users can hand to the library's functions and should not: each answers with an Error that
// says what is wrong, not with a crash.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "fathom/area/areas.h"
#include "fathom/area/coplanar.h"
#include "fathom/area/coverage.h"
#include "fathom/area/visible_areas.h"
#include "fathom/depth_buffer/depth_buffer.h"
#include "fathom/failures/errors.h"
#include "fathom/fast/render_fast.h"
#include "fathom/image/compare.h"
#include "fathom/image/convert.h"
#include "fathom/image/cryptomatte.h"
#include "fathom/image/point_cloud.h"
#include "fathom/image/preview.h"
#include "fathom/image/surface.h"
#include "fathom/pipeline/render_pipeline.h"
#include "fathom/pipeline/trace.h"
#include "fathom/reference/probe.h"
#include "fathom/reference/reference.h"
#include "fathom/reference/verify.h"
#include "fathom/render.h"
#include "fathom/render_by_pipeline.h"
#include "fathom/scene/framing.h"
#include "fathom/scene/read_scene.h"
#include "tests/scratch_folder.h"
#include "tests/special_values.h"

namespace fathom {
namespace {

using ::testing::HasSubstr;

const double nan = std::nan("");

Scene triangle() {
  Scene scene;
  Mesh& mesh = scene.meshes.emplace_back();
  mesh.vertices = {{-1, -1, 2}, {1, -1, 2}, {0, 1, 3}};
  mesh.triangles = {{0, 1, 2}};
  mesh.face_count = 1;
  scene.objects.emplace_back();
  return scene;
}

Camera small_camera() {
  Camera camera;
  camera.width = camera.height = 4;
  camera.projection.fx = camera.projection.fy = 4;
  camera.projection.cx = camera.projection.cy = 2;
  return camera;
}

DepthMap map_of_triangle(const RenderOptions& options = {.channels = {Channel::Z, Channel::id}}) {
  return render(triangle(), small_camera(), options).map;
}

/// What takes a scene and a camera; a map, where one is needed, is that of triangle().
using Door = std::function<void(const Scene&, const Camera&)>;

std::map<std::string, Door> doors_of_scenes() {
  std::map<std::string, Door> doors;
  doors["render, fast"] = [](const Scene& s, const Camera& c) { render(s, c); };
  doors["render, reference"] = [](const Scene& s, const Camera& c) {
    render(s, c, {.engine = Engine::reference});
  };
  doors["render_fast"] = [](const Scene& s, const Camera& c) { render_fast(s, c, {}); };
  doors["render_reference"] = [](const Scene& s, const Camera& c) { render_reference(s, c, {}); };
  doors["render_deep"] = [](const Scene& s, const Camera& c) { render_deep(s, c); };
  doors["add_cryptomatte"] = [](const Scene& s, const Camera& c) {
    DepthMap map = map_of_triangle();
    add_cryptomatte(map, s, c);
  };
  doors["probe"] = [](const Scene& s, const Camera& c) { probe(s, c, 2, 2); };
  doors["verify"] = [](const Scene& s, const Camera& c) {
    verify(map_of_triangle(), s, c, {}, PixelChoice(16, true));
  };
  doors["visible_areas"] = [](const Scene& s, const Camera& c) { visible_areas(s, c, {}); };
  doors["areas_from_camera"] = [](const Scene& s, const Camera& c) { areas_from_camera(s, c); };
  doors["background_from_camera"] = [](const Scene& s, const Camera& c) {
    background_from_camera(s, c);
  };
  doors["coplanar_pairs"] = [](const Scene& s, const Camera& c) { coplanar_pairs(s, c, 1, {}); };
  doors["pixel_coverage"] = [](const Scene& s, const Camera& c) {
    pixel_coverage({s, c}, std::vector<std::uint32_t>{0}, 2, 2);
  };
  doors["rounded_pixel_coverage"] = [](const Scene& s, const Camera& c) {
    rounded_pixel_coverage({s, c}, std::vector<std::uint32_t>{0}, 2, 2);
  };
  doors["add_sampled_coverage"] = [](const Scene& s, const Camera& c) {
    DepthMap map = map_of_triangle();
    add_sampled_coverage(map, s, c, sample_pattern("4"), {});
  };
  doors["add_depth_buffer"] = [](const Scene& s, const Camera& c) {
    DepthMap map = map_of_triangle();
    add_depth_buffer(map, s, c, {.format = {Mapping::standard, Storage::float32, 1, 100, 1}});
  };
  doors["render_by_pipeline"] = [](const Scene& s, const Camera& c) {
    render_by_pipeline(s, c, {}, {Channel::Z}, true);
  };
  doors["render_frame"] = [](const Scene& s, const Camera& c) {
    pipeline::render_frame(s, c, {}, true);
  };
  doors["trace_triangle"] = [](const Scene& s, const Camera& c) {
    pipeline::trace_triangle(s, c, {}, 0, pipeline::Pixel{2, 2});
  };
  return doors;
}

/// Those that take only a scene.
std::map<std::string, Door> all_doors_of_scenes() {
  std::map<std::string, Door> doors = doors_of_scenes();
  doors["world_bounds"] = [](const Scene& s, const Camera&) { world_bounds(s); };
  doors["areas_in_direction"] = [](const Scene& s, const Camera&) {
    areas_in_direction(s, {1, 2, 3});
  };
  doors["areas_from_point"] = [](const Scene& s, const Camera&) { areas_from_point(s, {1, 2, 3}); };
  doors["frame_scene"] = [](const Scene& s, const Camera&) { frame_scene(s); };
  return doors;
}

std::map<std::string, std::function<void(Scene&)>> bad_scenes() {
  return {{"a corner beyond", [](Scene& s) { s.meshes[0].triangles[0][1] = 1'000'000'000; }},
          {"no vertices", [](Scene& s) { s.meshes[0].vertices.clear(); }},
          {"NaN", [](Scene& s) { s.meshes[0].vertices[0].x = nan; }},
          {"infinite", [](Scene& s) { s.meshes[0].vertices[2].z = infinity; }},
          {"no such mesh", [](Scene& s) { s.objects[0].mesh = 1'000'000'000; }}};
}

TEST(WrongArguments, ScenesWithAFaultAreRefusedAtEveryDoor) {
  for (const auto& [name, door] : all_doors_of_scenes()) {
    EXPECT_NO_THROW(door(triangle(), small_camera())) << name;
    for (const auto& [fault, spoil] : bad_scenes()) {
      Scene scene = triangle();
      spoil(scene);
      EXPECT_THAT(message_of<InputError>([&, &door = door] { door(scene, small_camera()); }),
                  HasSubstr("scene: "))
          << name << ", " << fault;
    }
  }
}

TEST(WrongArguments, CamerasWithAFaultAreRefusedAtEveryDoor) {
  const std::map<std::string, std::function<void(Camera&)>> bad{
      {"fx NaN", [](Camera& c) { c.projection.fx = nan; }},
      {"singular", [](Camera& c) { c.world_to_camera[2] = {}; }},
      {"far is not greater", [](Camera& c) { c.far = 0; }}};
  for (const auto& [name, door] : doors_of_scenes()) {
    for (const auto& [fault, spoil] : bad) {
      Camera camera = small_camera();
      spoil(camera);
      EXPECT_THAT(message_of<InputError>([&, &door = door] { door(triangle(), camera); }),
                  HasSubstr("camera: "))
          << name << ", " << fault;
    }
    Camera camera = small_camera();
    camera.height = 0;
    if (name.find("pixel_coverage") == name.npos) {
      EXPECT_THROW(door(triangle(), camera), InputError) << name;
    }
  }
}

/// 2⁶⁴ pixels, of which no byte is ever asked for.
TEST(WrongArguments, ImagesTooLargeToCountAreRefused) {
  Camera camera = small_camera();
  camera.width = camera.height = 0xFFFFFFFF;
  for (const auto& [name, door] : doors_of_scenes()) {
    if (name.find("pixel_coverage") != name.npos) continue;  // which has but one pixel
    EXPECT_THROW(door(triangle(), camera), InputError) << name;
  }
  EXPECT_THROW(Samples<float>(std::size_t{1} << 62), std::bad_alloc);
  EXPECT_THROW(Samples<double>(SIZE_MAX), std::bad_alloc);
}

std::string setting_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const UsageError& error) {
    return error.setting();
  }
  return "no failure";
}

TEST(WrongArguments, RenderOptionsThatMeanNothing) {
  for (const Engine engine : {Engine::fast, Engine::reference}) {
    const auto setting = [&](const std::function<void(RenderOptions&)>& spoil) {
      RenderOptions options{.engine = engine};
      spoil(options);
      return setting_of([&] { render(triangle(), small_camera(), options); });
    };
    EXPECT_EQ(setting([](RenderOptions& o) { o.channels.clear(); }), "channels");
    EXPECT_EQ(setting([](RenderOptions& o) { o.threads = -1; }), "threads");
    EXPECT_EQ(setting([](RenderOptions& o) { o.threads = std::numeric_limits<int>::max(); }),
              "threads");
    for (const double scale : {nan, infinity, 0.0, -1.0}) {
      EXPECT_EQ(setting([&](RenderOptions& o) {
                  o.depth_encoding = {StoredType::scaled_unorm16, scale};
                }),
                "depth_encoding.scale");
      EXPECT_EQ(setting([&](RenderOptions& o) {
                  o.depth_encoding = {StoredType::scaled_unorm16, 1, false, scale};
                }),
                "depth_encoding.scale");
    }
    for (const double widening : {nan, infinity, 0.5, -1.0}) {
      EXPECT_EQ(setting([&](RenderOptions& o) { o.fast.widening = widening; }), "fast.widening");
    }
  }
  EXPECT_EQ(setting_of([] { render_deep(triangle(), small_camera(), {.threads = -1}); }),
            "threads");
  EXPECT_EQ(
      setting_of([] { render(StreamedScene(), small_camera(), {}, {.triangles_at_once = 0}); }),
      "triangles_at_once");
  for (const double within : {nan, infinity, -1.0}) {
    EXPECT_EQ(setting_of([&] { coplanar_pairs(triangle(), small_camera(), within, {}); }),
              "within");
  }
  Warnings warnings;
  EXPECT_EQ(setting_of([&] { read_scene({}, {.threads = -5}, warnings); }), "threads");
}

TEST(WrongArguments, PipelineOptionsThatMeanNothing) {
  const auto setting = [](const std::function<void(pipeline::PipelineOptions&)>& spoil) {
    pipeline::PipelineOptions options;
    spoil(options);
    return setting_of([&] { pipeline::render_frame(triangle(), small_camera(), options, true); });
  };
  using Options = pipeline::PipelineOptions;
  constexpr std::int64_t least = std::numeric_limits<std::int64_t>::min();
  EXPECT_EQ(setting([](Options& o) { o.viewport = {least, 0, 1, 1}; }), "viewport");
  EXPECT_EQ(setting([](Options& o) { o.scissor = {0, least, 1, 1}; }), "scissor");
  EXPECT_EQ(setting([](Options& o) { o.background = {nan, 0, 0}; }), "background");
  EXPECT_EQ(setting([](Options& o) { o.polygon_offset.slope_factor = nan; }), "polygon_offset");
  EXPECT_EQ(setting([](Options& o) { o.polygon_offset.constant_factor = infinity; }),
            "polygon_offset");
  EXPECT_EQ(setting([](Options& o) { o.blend_alpha = nan; }), "blend_alpha");
  EXPECT_EQ(setting([](Options& o) { o.depth_range = {nan, 1}; }), "depth_range");
  EXPECT_EQ(setting([](Options& o) {
              o.antialias = {pipeline::AntialiasMethod::taa, -3};
            }),
            "antialias");
}

/// What the maker of a scene may put into its attributes without a fault.
TEST(WrongArguments, ThePipelineDrawsAttributesOfAnySize) {
  for (const double large : {1e300, -1e300, 5e-324}) {
    Scene scene = triangle();
    Mesh& mesh = scene.meshes[0];
    mesh.colours.resize(3, {1e30F, -1e30F, 3e38F, 1});
    mesh.normals.resize(3, {large, 0, large});
    mesh.texture_coordinates.resize(3, {large, -large});
    for (const auto shading : {pipeline::Shading::none, pipeline::Shading::flat,
                               pipeline::Shading::gouraud, pipeline::Shading::phong}) {
      for (const auto filter :
           {pipeline::TextureFilter::nearest, pipeline::TextureFilter::bilinear,
            pipeline::TextureFilter::trilinear, pipeline::TextureFilter::anisotropic}) {
        EXPECT_NO_THROW(pipeline::render_frame(
            scene, small_camera(), {.shading = shading, .texture = "checker", .filter = filter},
            true));
      }
    }
  }
}

/// What takes a map.
std::map<std::string, std::function<void(DepthMap&)>> doors_of_maps(const ScratchFolder& folder) {
  std::map<std::string, std::function<void(DepthMap&)>> doors;
  doors["compare_maps, truth"] = [](DepthMap& m) { compare_maps(m, map_of_triangle()); };
  doors["compare_maps, other"] = [](DepthMap& m) { compare_maps(map_of_triangle(), m); };
  doors["draw_differences"] = [](DepthMap& m) { draw_differences(m, map_of_triangle()); };
  doors["convert_quantity"] = [](DepthMap& m) {
    convert_quantity(m, DepthQuantity::planar_depth, DepthQuantity::ray_distance, small_camera());
  };
  doors["with_storage"] = [](DepthMap& m) { with_storage(m, "Z", StoredType::binary64); };
  doors["write_point_cloud"] = [&](DepthMap& m) {
    write_point_cloud(m, small_camera(), folder.path() / "points.ply");
  };
  doors["draw_preview"] = [](DepthMap& m) { draw_preview(m); };
  doors["surface_mask"] = [](DepthMap& m) { surface_mask(m, ImageChannel{"A", {}}); };
  doors["add_mattes"] = [](DepthMap& m) {
    Mattes mattes;
    mattes.counts.resize(16);
    add_mattes(m, mattes);
  };
  doors["add_cryptomatte"] = [](DepthMap& m) { add_cryptomatte(m, triangle(), small_camera()); };
  doors["add_sampled_coverage"] = [](DepthMap& m) {
    add_sampled_coverage(m, triangle(), small_camera(), sample_pattern("1"), {});
  };
  doors["add_depth_buffer"] = [](DepthMap& m) {
    add_depth_buffer(m, triangle(), small_camera(),
                     {.format = {Mapping::standard, Storage::float32, 1, 100, 1}});
  };
  doors["verify"] = [](DepthMap& m) {
    verify(m, triangle(), small_camera(), {}, PixelChoice(16, true));
  };
  for (const auto& [name, format] : {std::pair("exr", MapFormat::exr),
                                     {"pfm", MapFormat::pfm},
                                     {"png", MapFormat::png},
                                     {"npy", MapFormat::npy}}) {
    doors[std::string("write_map, ") + name] = [&folder, format = format](DepthMap& m) {
      write_map(m, folder.path() / "map", format,
                {.channel = format == MapFormat::png ? "id" : "Z"});
    };
  }
  return doors;
}

TEST(WrongArguments, MapsWithAFaultAreRefusedAtEveryDoor) {
  const ScratchFolder folder;
  const std::map<std::string, std::function<void(DepthMap&)>> bad{
      {"too few values", [](DepthMap& m) { m.channels[0].values = Samples<float>(3); }},
      {"too many values", [](DepthMap& m) { m.channels[1].values = Samples<std::uint32_t>(17); }},
      {"no values", [](DepthMap& m) { m.channels[0].values = Samples<float>(); }},
      {"another width", [](DepthMap& m) { m.width = 0xFFFFFFFF; }},
      {"no pixels", [](DepthMap& m) { m.height = 0; }},
      {"no name",
       [](DepthMap& m) {
         m.channels.push_back({"", Samples<float>(16)});
       }},
      {"a NUL",
       [](DepthMap& m) {
         m.channels.push_back({std::string("a\0b", 3), Samples<float>(16)});
       }},
      {"twice", [](DepthMap& m) { m.channels.push_back(m.channels[0]); }},
      {"a scale of NaN", [](DepthMap& m) { m.png_scale = nan; }},
      {"a scale of 0", [](DepthMap& m) { m.png_scale = 0; }}};
  const auto doors = doors_of_maps(folder);
  for (const auto& [name, door] : doors) {
    DepthMap valid = map_of_triangle();
    ASSERT_NO_THROW(door(valid)) << name;
    for (const auto& [fault, spoil] : bad) {
      DepthMap map = map_of_triangle();
      spoil(map);
      EXPECT_THAT(message_of<InputError>([&, &door = door] { door(map); }), HasSubstr("map: "))
          << name << ", " << fault;
    }
  }
}

TEST(WrongArguments, MapsWithoutChannels) {
  const ScratchFolder folder;
  for (const auto& [name, door] : doors_of_maps(folder)) {
    DepthMap map = map_of_triangle();
    map.channels.clear();
    if (name == "add_mattes" || name == "add_cryptomatte") continue;  // which add the first ones
    EXPECT_THROW(door(map), Error) << name;
  }
}

TEST(WrongArguments, MapsOfAnotherSizeThanTheCamera) {
  Camera camera = small_camera();
  camera.width = 5;
  DepthMap map = map_of_triangle();
  EXPECT_THAT(message_of<InputError>([&] { add_cryptomatte(map, triangle(), camera); }),
              HasSubstr("map: its size is 4x4, expected the camera's, 5x4"));
  EXPECT_THROW(add_sampled_coverage(map, triangle(), camera, sample_pattern("1"), {}), InputError);
  EXPECT_THROW(verify(map, triangle(), camera, {}, PixelChoice(16, true)), InputError);
  EXPECT_THROW(add_depth_buffer(map, triangle(), camera,
                                {.format = {Mapping::standard, Storage::float32, 1, 100, 1}}),
               InputError);
}

TEST(WrongArguments, VerificationOfWhatIsNotThere) {
  const DepthMap map = map_of_triangle();
  const auto verify_with = [&](const RenderOptions& options, std::size_t choices) {
    verify(map, triangle(), small_camera(), options, PixelChoice(choices, true));
  };
  EXPECT_THROW(verify_with({}, 15), UsageError);
  EXPECT_THROW(verify_with({}, 0), UsageError);
  EXPECT_THROW(verify_with({.channels = {Channel::N}}, 16), UsageError);
  EXPECT_THROW(verify_with({.depth_encoding = {StoredType::binary64}}, 16), UsageError);
  EXPECT_THROW(verify_with({.channels = {}}, 16), UsageError);
}

TEST(WrongArguments, IdentifiersOfNoTriangle) {
  DepthMap map = map_of_triangle();
  map.values<std::uint32_t>("id")->data()[3] = 1;
  EXPECT_THAT(message_of<InputError>([&] {
                add_depth_buffer(map, triangle(), small_camera(),
                                 {.format = {Mapping::standard, Storage::float32, 1, 100, 1}});
              }),
              HasSubstr("channel 'id' holds 1, and the scene has 1 triangle"));
  EXPECT_THROW(pixel_coverage({triangle(), small_camera()}, std::vector<std::uint32_t>{1}, 0, 0),
               std::out_of_range);
}

TEST(WrongArguments, OptionsOfComparisonsAndConversions) {
  const DepthMap map = map_of_triangle();
  for (const double tolerance : {nan, -1.0}) {
    EXPECT_THROW(compare_maps(map, map, {.tolerance_ulp = tolerance}), UsageError);
    EXPECT_THROW(draw_differences(map, map, {.tolerance_ulp = tolerance}), UsageError);
  }
  using enum DepthQuantity;
  for (const double number : {nan, infinity}) {
    EXPECT_THROW(
        convert_quantity(map, planar_depth, disparity, small_camera(), StereoRig{number, 0}),
        UsageError);
    EXPECT_THROW(
        convert_quantity(map, planar_depth, disparity, small_camera(), StereoRig{1, number}),
        UsageError);
    EXPECT_THROW(with_storage(map, "Z", StoredType::scaled_unorm16, number), UsageError);
    EXPECT_THROW(draw_preview(map, {.low = number}), UsageError);
    Camera camera = small_camera();
    camera.projection.fx = number;
    EXPECT_THROW(convert_quantity(map, planar_depth, ray_distance, camera), InputError);
  }
  Camera flat = small_camera();
  flat.projection.fy = 0;
  EXPECT_THROW(convert_quantity(map, planar_depth, ray_distance, flat), InputError);
  const ScratchFolder folder;
  EXPECT_THROW(write_point_cloud(map, flat, folder.path() / "points.ply"), InputError);
  EXPECT_THROW(write_map(map, folder.path() / "map.exr", MapFormat::exr, {.threads = -1}),
               UsageError);
}

TEST(WrongArguments, PicturesDeepMapsAndMattesWhoseSizesDoNotMatch) {
  const ScratchFolder folder;
  RgbImage image(4, 4);
  image.pixels.pop_back();
  EXPECT_THROW(write_png(image, folder.path() / "picture.png"), InputError);
  EXPECT_THROW(write_png({}, folder.path() / "picture.png"), InputError);

  const auto refused = [&](const std::function<void(DeepMap&)>& spoil) {
    DeepMap deep = render_deep(triangle(), small_camera());
    EXPECT_NO_THROW(write_deep_map(deep, folder.path() / "deep.exr"));
    spoil(deep);
    EXPECT_THROW(write_deep_map(deep, folder.path() / "deep.exr"), InputError);
  };
  refused([](DeepMap& d) { d.counts.pop_back(); });
  refused([](DeepMap& d) { d.samples.pop_back(); });
  refused([](DeepMap& d) { d.counts[0] = 0xFFFFFFFF; });
  refused([](DeepMap& d) { d.description.width = 0; });

  Mattes mattes;
  mattes.counts.resize(16);
  mattes.counts[7] = 3;
  mattes.shares.resize(2);
  DepthMap map = map_of_triangle();
  EXPECT_THROW(add_mattes(map, mattes), InputError);
}

TEST(WrongArguments, PatternsThatNobodyMade) {
  DepthMap map = map_of_triangle();
  const auto add = [&](const SamplePattern& pattern) {
    add_sampled_coverage(map, triangle(), small_camera(), pattern, {});
  };
  EXPECT_THROW(add({}), UsageError);
  SamplePattern pattern = sample_pattern("1");
  pattern.offsets[0] = {nan, 0};
  EXPECT_THROW(add(pattern), UsageError);
  pattern.offsets.assign(257, {0, 0});
  EXPECT_THROW(add(pattern), UsageError);
}

}  // namespace
}  // namespace fathom
