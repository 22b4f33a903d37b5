// Programs around us flush subnormal numbers to zero, or round upwards: no door for users may
// compute anything else because of that, and the mode is the caller's again when it returns.
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <type_traits>

#include "fathom/area/coplanar.h"
#include "fathom/area/visible_areas.h"
#include "fathom/camera/camera_files.h"
#include "fathom/depth_buffer/depth_buffer.h"
#include "fathom/evaluate.h"
#include "fathom/image/compare.h"
#include "fathom/image/convert.h"
#include "fathom/image/map_files.h"
#include "fathom/map_description.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/reference/probe.h"
#include "fathom/reference/verify.h"
#include "fathom/render.h"
#include "fathom/render_by_pipeline.h"
#include "fathom/scene/framing.h"
#include "fathom/scene/read_scene.h"
#include "tests/engines/expect_same_map.h"
#include "tests/inputs/floating_point_modes.h"
#include "tests/inputs/random_scenes.h"
#include "tests/places.h"

namespace fathom {
namespace {

/// What a door has computed, as bytes: nothing of it is rounded again.
class Bytes {
 public:
  template <class T>
  void add(const T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      text_.append(reinterpret_cast<const char*>(&value), sizeof value);
    } else if constexpr (requires { value.begin(); }) {
      add(value.size());
      for (const auto& each : value) add(each);
    } else if constexpr (requires { value.has_value(); }) {
      add(value.has_value());
      if (value) add(*value);
    } else {
      static_assert(std::is_same_v<T, Binary16>);
      add(value.bits);
    }
  }
  void add(const Camera& c) {
    for (const double x : {c.projection.fx, c.projection.fy, c.projection.cx, c.projection.cy,
                           c.projection.skew, c.near, c.far})
      add(x);
    add(c.world_to_camera);
  }
  void add(const DepthMap& map) {
    for (const ImageChannel& channel : map.channels) {
      add(channel.name);
      std::visit([&](const auto& values) { add(values); }, channel.values);
    }
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

using Door = std::function<void(Bytes&)>;

/// Doors into a scene with a camera; each adds what it computes.
std::map<std::string, Door> doors_of(const Scene& scene, const Camera& camera) {
  std::map<std::string, Door> doors;
  for (const Engine engine : {Engine::fast, Engine::reference}) {
    doors["render, " + std::string(name_of(engine))] = [&scene, &camera, engine](Bytes& bytes) {
      RenderOptions options;
      options.engine = engine;
      options.channels = checks::every_channel;
      options.threads = 2;
      bytes.add(render(scene, camera, options).map);
    };
  }
  doors["verify"] = [&](Bytes& bytes) {
    RenderOptions options;
    options.channels = checks::quick_channels;
    DepthMap map;
    {
      const StandardArithmetic standard;
      map = render(scene, camera, options).map;
    }
    const Verification result =
        verify(map, scene, camera, options, choose_pixels(camera.width, camera.height, 20));
    bytes.add(result.verified);
    bytes.add(result.differing);
  };
  doors["probe"] = [&](Bytes& bytes) {
    for (const CoveringTriangle& t : probe(scene, camera, 3, 2)) {
      bytes.add(t.number);
      bytes.add(to_fraction(t.depth));
      bytes.add(t.counts);
    }
  };
  doors["visible areas"] = [&](Bytes& bytes) {
    for (const VisibleArea& area : visible_areas(scene, camera, {}).triangles) {
      bytes.add(area.visible);
      bytes.add(area.unoccluded);
      bytes.add(area.ratio);
    }
  };
  doors["coplanar pairs"] = [&](Bytes& bytes) {
    for (const CoplanarPair& pair : coplanar_pairs(scene, camera, 0.5, {})) {
      bytes.add(pair.visible);
      bytes.add(pair.behind);
      bytes.add(pair.separation);
      bytes.add(pair.pixels);
    }
  };
  doors["render_deep"] = [&](Bytes& bytes) {
    const DeepMap map = render_deep(scene, camera);
    bytes.add(map.counts);
    for (const DeepSample& sample : map.samples) {
      for (const float x : {sample.Z, sample.ZBack, sample.area, sample.A}) bytes.add(x);
      bytes.add(sample.id);
    }
  };
  doors["add_cryptomatte"] = [&](Bytes& bytes) {
    DepthMap map;
    map.width = camera.width;
    map.height = camera.height;
    add_cryptomatte(map, scene, camera);
    bytes.add(map);
  };
  doors["find_fault"] = [&](Bytes& bytes) {
    Camera flat = camera;
    flat.world_to_camera = {{{0x1p-1074, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    bytes.add(find_fault(flat).has_value());
  };
  doors["to_json"] = [&](Bytes& bytes) {
    Camera skewed = camera;
    skewed.projection.skew = 0x1p-1074;
    skewed.projection.cx = 0.1;
    bytes.add(to_json(skewed));
  };
  doors["principal_point"] = [&](Bytes& bytes) {
    Camera moved = camera;
    moved.projection.cx = 0.1;
    moved.projection.pixel_centre = 0.3;
    bytes.add(principal_point(moved.projection).x);
  };
  doors["frame_scene"] = [&](Bytes& bytes) {
    bytes.add(frame_scene(scene, {.azimuth = 35, .elevation = 20}));
  };
  doors["look_at"] = [&](Bytes& bytes) {
    bytes.add(look_at({1, 0.2, 0.3}, {0.1, 0.7, 9}, {0, 1, 0.1}));
  };
  return doors;
}

void expect_same_in_all_modes(const std::string& name, const Door& door) {
  SCOPED_TRACE(name);
  checks::expect_same_in_all_modes([&] {
    Bytes bytes;
    door(bytes);
    return bytes.text();
  });
}

TEST(FloatingPointMode, ChangesNothingInRandomScenes) {
  for (const auto kind : {checks::Kind::few_bits, checks::Kind::neighbours, checks::Kind::tiny}) {
    checks::CaseMaker maker(404, kind);
    for (int i = 0; i < 40; ++i) {
      SCOPED_TRACE(i);
      const checks::Case c = maker.make();
      if (!world_bounds(c.scene)) continue;
      for (const auto& [name, door] : doors_of(c.scene, c.camera)) {
        expect_same_in_all_modes(name, door);
        if (HasFailure()) return;
      }
    }
  }
}

/// Numbers of files are rounded, and those below 2⁻¹⁰²² are kept.
TEST(FloatingPointMode, ChangesNothingOfWhatIsRead) {
  const std::filesystem::path hard = test::source_dir() / "data/scenes/hard";
  expect_same_in_all_modes("read_scene", [&](Bytes& bytes) {
    Warnings warnings;
    const Scene scene =
        read_scene({hard / "huge-and-tiny.obj", hard / "slivers.obj"}, {}, warnings);
    for (const Mesh& mesh : scene.meshes) {
      for (const MeshPoint& X : mesh.vertices) {
        for (const double x : {X.x, X.y, X.z}) bytes.add(x);
      }
    }
  });
  expect_same_in_all_modes("read_cameras", [&](Bytes& bytes) {
    for (const char* name : {"look-at.json", "calibrated.json", "orbit.json"}) {
      for (const Camera& camera : read_cameras(test::source_dir() / "data/cameras" / name)) {
        bytes.add(camera);
      }
    }
  });
}

TEST(FloatingPointMode, ChangesNothingOfEvaluations) {
  checks::CaseMaker maker(406, checks::Kind::few_bits);
  const checks::Case c = maker.make();
  Scene moved = c.scene;
  for (MeshPoint& X : moved.meshes[0].vertices) X.x += 0.013;
  expect_same_in_all_modes("evaluate", [&](Bytes& bytes) {
    SurfaceComparisonOptions options;
    options.points = 500;
    options.within = {0.1};
    const Evaluation found = evaluate(moved, c.scene, {}, options);
    for (const auto* distances : {&found.surfaces.accuracy, &found.surfaces.completeness}) {
      bytes.add(distances->mean);
      bytes.add(distances->rms);
      bytes.add(distances->shares);
    }
  });
}

/// What a file says of its camera is computed, and rounded.
TEST(FloatingPointMode, ChangesNothingOfWhatIsWritten) {
  checks::CaseMaker maker(407, checks::Kind::neighbours);
  checks::Case c = maker.make();
  c.camera.projection.fx = 7.3;
  c.camera.world_to_camera[0][0] = 0.1;
  const DepthMap map = render(c.scene, c.camera, {.channels = checks::every_channel}).map;
  RenderOptions in_codes;
  in_codes.depth_encoding = {DepthEncoding::Type::scaled_unorm16, 10.1};
  const DepthMap codes = render(c.scene, c.camera, in_codes).map;
  expect_same_in_all_modes("describe_map and encode_map", [&](Bytes& bytes) {
    DepthMap described = map;
    describe_map(c.scene, c.camera, "fast", described);
    bytes.add(encode_map(described, "a.exr", MapFormat::exr));
    bytes.add(encode_map(codes, "a.png", MapFormat::png));
  });
}

TEST(FloatingPointMode, ChangesNothingOfMapsAndDepthBuffers) {
  checks::CaseMaker maker(405, checks::Kind::neighbours);
  checks::Case c = maker.make();
  c.camera.near = 0.1;
  c.camera.far = 20.3;
  const DepthMap map = render(c.scene, c.camera, {.channels = checks::every_channel}).map;
  expect_same_in_all_modes("depth buffer", [&](Bytes& bytes) {
    DepthMap with_buffer = map;
    add_depth_buffer(with_buffer, c.scene, c.camera,
                     {depth_format_of(c.camera, Mapping::standard, Storage::unorm24), true, {}});
    bytes.add(with_buffer);
  });
  expect_same_in_all_modes("pipeline", [&](Bytes& bytes) {
    bytes.add(render_by_pipeline(c.scene, c.camera, {}, {Channel::Z, Channel::id}, false).map);
  });
}

}  // namespace
}  // namespace fathom
