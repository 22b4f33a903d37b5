#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "fathom/rendering/options.h"
#include "validation/child/fields.h"
#include "validation/scenes/scenes.h"

namespace fathom::bench {

/// What to time, and how often.
struct Plan {
  /// A name of scenes.h.
  std::string scene;
  std::uint32_t width = 1920, height = 1080;
  int threads = 1;
  int repeat = 9;
  /// The channels that our engines write. Other renderers always write depths.
  std::vector<Channel> channels{Channel::Z};
};

/// One renderer on one scene.
struct Measurement {
  /// fast, fast-kept, reference, vtk, embree, embree-robust, masked-occlusion-culling, or
  /// embree-build: building the hierarchy that embree then traces.
  std::string renderer;
  /// Its version and what it runs on; "" for our engines.
  std::string description;
  /// Time of the first frame, which also fills caches and compiles shaders.
  double first_ms = 0;
  /// Times of the frames after it, in increasing order; not empty.
  std::vector<double> milliseconds;
  /// The peak memory of its process in RAM while it rendered, minus the memory before it made the
  /// scene: the renderer's copy of the scene, its acceleration structures, the image.
  std::uint64_t peak_bytes = 0;
  /// Pixels that show a surface; 0 for embree-build.
  std::uint64_t covered_pixels = 0;

  [[nodiscard]] double median_ms() const;
};

/// No frame starts after this time.
inline constexpr std::chrono::seconds time_there_is{20};

/// Of numbers in increasing order; there must be some.
double median_of(const std::vector<double>& sorted);

struct Frames {
  double first_ms = 0;
  /// In increasing order; only the time of the first frame if it took all the available time.
  std::vector<double> milliseconds;
};

/// Times `draw` once, keeps drawing until `warm_up` has passed, so that threads settle on
/// processors and allocators on sizes, and then times `repeat` more frames. Starts no frame after
/// time_there_is. `clear` is called before each frame and not timed.
Frames time_frames(
    int repeat, const std::function<void()>& draw, const std::function<void()>& clear = [] {},
    std::chrono::milliseconds warm_up = std::chrono::milliseconds(300));

}  // namespace fathom::bench

namespace fathom::validation {

/// The names of the fields in the message from the measuring process.
template <>
struct Fields<bench::Measurement> {
  template <class Visit, class S>
  static void each(Visit&& visit, S& s) {
    auto& [renderer, description, first_ms, milliseconds, peak_bytes, covered_pixels] = s;
    visit("renderer", renderer);
    visit("description", description);
    visit("first_ms", first_ms);
    visit("milliseconds", milliseconds);
    visit("peak_bytes", peak_bytes);
    visit("covered_pixels", covered_pixels);
  }
};

}  // namespace fathom::validation

namespace fathom::bench {

/// Times one renderer: fast, fast-kept, reference and, if they are built in, vtk, embree,
/// embree-robust or masked-occlusion-culling.
///
///   fast, reference        from mesh and camera in memory to the complete map in memory; nothing
///                          is kept from an earlier frame
///   fast-kept              the same, but into the map of the frame before and with the memory that
///                          it worked with (render_into(), RenderMemory): what a frame of a path
///                          costs, as vtk and embree keep their buffers
///   vtk                    drawing and waiting until it is done; depths are not read back, and the
///                          mesh was passed to OpenGL with the first frame
///   embree, embree-robust  making rays, tracing them, storing depths; the hierarchy has already
///                          been built. embree-build, returned with embree, is building it
///   masked-occlusion-culling
///                          from vertices in the world, in binary32, and a cleared buffer to all
///                          triangles drawn into it; one thread, whatever the plan says. Depths of
///                          pixels, which are not read, would be bounds: two for each 8×4 pixels.
///                          Nothing is returned for an orthographic camera, which it does not know
///
/// Does     make the scene and restrict this process to the processors of the plan.
/// Fails    InputError as make_scene(), or if the renderer does not start; UsageError if there is
///          no such renderer.
std::vector<Measurement> measure(const std::string& renderer, const Plan& plan);

/// measure() in a separate process, so that its peak memory and its threads are separate too.
/// Needs    a process that has started no threads.
std::vector<Measurement> measure_in_child(const std::string& renderer, const Plan& plan);

/// The number of triangles of a plan's scene, which is made in a separate process.
/// Needs    a process that has started no threads.
/// Fails    as make_scene().
std::uint64_t count_triangles_in_child(const Plan& plan);

/// Whether VTK and Embree are built in.
bool peers_are_built();

/// Whether Masked Occlusion Culling is built in.
bool masked_occlusion_culling_is_built();

// VTK, Embree and Masked Occlusion Culling on a bench scene. `idle_bytes` is the memory that the
// process used before it made the scene.

std::vector<Measurement> measure_vtk(BenchScene bench, const Plan& plan, std::uint64_t idle_bytes);
std::vector<Measurement> measure_embree(BenchScene bench, const Plan& plan, bool robust,
                                        std::uint64_t idle_bytes);
/// Empty for an orthographic camera.
std::vector<Measurement> measure_masked_occlusion_culling(BenchScene&& bench, const Plan& plan,
                                                          std::uint64_t idle_bytes);

}  // namespace fathom::bench
