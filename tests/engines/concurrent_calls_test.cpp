// Several threads of one program use the library at the same time, each with parallel work of its
// own, and share what they only read: all get what one gets alone. Under the thread sanitizer
// (scripts/dev/check-threads) this is where a race shows.
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <map>
#include <thread>

#include "fathom/area/coplanar.h"
#include "fathom/area/coverage.h"
#include "fathom/area/visible_areas.h"
#include "fathom/camera/camera_files.h"
#include "fathom/depth_buffer/depth_buffer.h"
#include "fathom/image/compare.h"
#include "fathom/image/map_files.h"
#include "fathom/reference/probe.h"
#include "fathom/reference/verify.h"
#include "fathom/render.h"
#include "fathom/render_by_pipeline.h"
#include "fathom/scene/framing.h"
#include "fathom/scene/read_scene.h"
#include "tests/places.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

/// What a call gave, as text that can be compared.
using Call = std::function<std::string(int caller)>;

std::string text_of(const DepthMap& map) {
  std::string text;
  for (const ImageChannel& channel : map.channels) {
    text += channel.name;
    std::visit(
        [&](const auto& values) {
          text.append(reinterpret_cast<const char*>(values.data()),
                      values.size() * sizeof(values[0]));
        },
        channel.values);
  }
  for (const auto& [key, value] : texts_of(map)) text += key + value;
  return text;
}

/// What all callers share, and only read.
struct Shared {
  Scene scene;
  Camera camera;
  DepthMap map;
  StreamedScene streamed;

  Shared() {
    Warnings warnings;
    const auto file = test::source_dir() / "data/meshes/spot.obj";
    scene = read_scene({file}, {}, warnings);
    // A part of the mesh: enough for every way to take part.
    scene.meshes[0].triangles.resize(400);
    scene.meshes[0].face_of_triangle = {};
    camera = frame_scene(scene, {}, {.width = 90, .height = 70});
    camera.near = 0.1;
    camera.far = 100;
    map = render(scene, camera, {.channels = {Channel::Z, Channel::id}}).map;
    streamed = stream_scene({test::source_dir() / streamed_file}, {}, warnings);
  }
  static constexpr const char* streamed_file = "data/meshes/cube.stl";
};

std::map<std::string, Call> calls(const Shared& shared, const ScratchFolder& folder) {
  const Scene& scene = shared.scene;
  const Camera& camera = shared.camera;
  std::map<std::string, Call> calls;
  const auto render_with = [&](Engine engine, std::vector<Channel> channels) {
    return [&, engine, channels](int caller) {
      return text_of(
          render(scene, camera, {.engine = engine, .channels = channels, .threads = caller % 4})
              .map);
    };
  };
  const std::vector<Channel> all{Channel::Z,        Channel::A,  Channel::Zlow,
                                 Channel::distance, Channel::id, Channel::face,
                                 Channel::N,        Channel::P,  Channel::bary};
  calls["fast"] = render_with(Engine::fast, {Channel::Z});
  calls["fast, all channels"] = render_with(Engine::fast, all);
  calls["reference"] = render_with(Engine::reference, {Channel::Z, Channel::A});
  calls["deep"] = [&](int) {
    const DeepMap deep = render_deep(scene, camera);
    return std::string(reinterpret_cast<const char*>(deep.samples.data()),
                       deep.samples.size() * sizeof(DeepSample));
  };
  calls["streamed"] = [&](int caller) {
    return text_of(render(shared.streamed,
                          frame_scene(outline_of(shared.streamed), {}, {.width = 64, .height = 64}),
                          {.threads = caller % 3}, {.triangles_at_once = 200})
                       .map);
  };
  calls["cryptomatte"] = [&](int) {
    DepthMap map = shared.map;
    add_cryptomatte(map, scene, camera);
    return text_of(map);
  };
  calls["areas"] = [&](int caller) {
    std::string text;
    for (const VisibleArea& area :
         visible_areas(scene, camera, {.threads = caller % 3}).triangles) {
      text += std::to_string(area.visible) + " ";
    }
    return text;
  };
  calls["coplanar"] = [&](int) {
    return std::to_string(coplanar_pairs(scene, camera, 0.01, {}).size());
  };
  calls["sampled"] = [&](int) {
    DepthMap map = shared.map;
    add_sampled_coverage(map, scene, camera, sample_pattern("jittered:2"), {});
    return text_of(map);
  };
  calls["depth buffer"] = [&](int) {
    DepthMap map = shared.map;
    add_depth_buffer(map, scene, camera,
                     {.format = depth_format_of(camera, Mapping::standard, Storage::unorm24),
                      .against_exact = true});
    return text_of(map);
  };
  calls["pipeline"] = [&](int) {
    return text_of(render_by_pipeline(scene, camera, {}, {Channel::Z}, true).map);
  };
  calls["verify"] = [&](int caller) {
    const Verification verified = verify(
        shared.map, scene, camera, {.channels = {Channel::Z, Channel::id}, .threads = caller % 3},
        choose_pixels(camera.width, camera.height, 500));
    return std::to_string(verified.verified) + " " + std::to_string(verified.differing);
  };
  calls["probe"] = [&](int) { return std::to_string(probe(scene, camera, 45, 35).size()); };
  calls["read"] = [&](int caller) {
    Warnings warnings;
    const Scene read = read_scene({test::source_dir() / "data/meshes/spot.obj"},
                                  {.threads = caller % 4, .attributes = true}, warnings);
    return std::to_string(triangle_count(read)) + read.sources[0].sha256;
  };
  calls["write and read"] = [&](int caller) {
    const auto path = folder.path() / (std::to_string(caller) + ".exr");
    write_map(shared.map, path, MapFormat::exr, {.threads = caller % 3});
    return text_of(read_map(path));
  };
  calls["compare"] = [&](int) {
    return std::to_string(compare_maps(shared.map, shared.map).channels[0].bit_equal);
  };
  return calls;
}

TEST(ConcurrentCalls, GiveWhatEachGivesAlone) {
  const Shared shared;
  const ScratchFolder folder;
  const auto all = calls(shared, folder);
  std::map<std::string, std::string> expected;
  for (const auto& [name, call] : all) expected[name] = call(1);
  // Each caller makes all calls, and begins with another one.
  constexpr int callers = 6;
  std::vector<std::thread> threads;
  std::atomic<int> wrong = 0;
  for (int caller = 0; caller < callers; ++caller) {
    threads.emplace_back([&, caller] {
      auto next = std::next(all.begin(), caller * static_cast<int>(all.size()) / callers);
      for (std::size_t i = 0; i < all.size(); ++i) {
        const auto& [name, call] = *next;
        if (call(caller) != expected.at(name)) {
          ++wrong;
          ADD_FAILURE() << name << " gave something else to caller " << caller;
        }
        if (++next == all.end()) next = all.begin();
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace fathom
