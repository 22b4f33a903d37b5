#include "validation/embree/embree_tracer.h"

#include <embree3/rtcore.h>
#include <tbb/blocked_range2d.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <xmmintrin.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <thread>

#include "fathom/attribution/model/renderer_input.h"
#include "fathom/camera/camera.h"
#include "fathom/image/depth_map.h"
#include "validation/embree/embree_mesh.h"

namespace fathom::validation {
namespace {

/// The image and its viewing rays, each number rounded to binary32.
///
/// Frame    world; u, v in pixels from the top left corner of the image; near and far are depths.
struct Binary32View {
  std::uint32_t width, height;
  float near, far;
  /// f(u, v) = at_corner + u·per_u + v·per_v, evaluated in binary32.
  struct Affine {
    std::array<float, 3> at_corner, per_u, per_v;
    [[nodiscard]] float at(std::size_t k, float u, float v) const {
      return at_corner[k] + u * per_u[k] + v * per_v[k];
    }
  } origin, direction;
};

/// Images of width × height pixels, rows from the top: depths, infinite where nothing was hit, and,
/// unless null, the numbers of the triangles, no_surface there.
struct TracedImages {
  float* depths = nullptr;
  std::uint32_t* triangles = nullptr;
};

using attribution::CameraRays;

Binary32View::Affine narrowed(const CameraRays::Affine& f) {
  const auto narrow = [](const std::array<double, 3>& v) {
    return std::array<float, 3>{static_cast<float>(v[0]), static_cast<float>(v[1]),
                                static_cast<float>(v[2])};
  };
  return {narrow(f.at_corner), narrow(f.per_u), narrow(f.per_v)};
}

constexpr float infinity = std::numeric_limits<float>::infinity();

/// A square of the image, for one packet or stream.
struct Block {
  std::uint32_t column, row, side;
};

/// N rays in arrays, those of a block of N pixels, row by row.
template <class Packet>
void fill(Packet& packet, const Block& block, const Binary32View& view, int* valid) {
  std::uint32_t i = 0;
  for (std::uint32_t y = 0; y < block.side; ++y) {
    for (std::uint32_t x = 0; x < block.side; ++x, ++i) {
      const std::uint32_t column = block.column + x, row = block.row + y;
      const float u = static_cast<float>(column) + 0.5F, v = static_cast<float>(row) + 0.5F;
      valid[i] = column < view.width && row < view.height ? -1 : 0;
      packet.ray.org_x[i] = view.origin.at(0, u, v);
      packet.ray.org_y[i] = view.origin.at(1, u, v);
      packet.ray.org_z[i] = view.origin.at(2, u, v);
      packet.ray.dir_x[i] = view.direction.at(0, u, v);
      packet.ray.dir_y[i] = view.direction.at(1, u, v);
      packet.ray.dir_z[i] = view.direction.at(2, u, v);
      packet.ray.tnear[i] = view.near;
      packet.ray.tfar[i] = valid[i] != 0 ? view.far : -infinity;
      packet.ray.time[i] = 0;
      packet.ray.mask[i] = ~0U;
      packet.ray.flags[i] = 0;
      packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
  }
}

template <class Packet>
void store(const Packet& packet, const Block& block, const Binary32View& view,
           const TracedImages& images) {
  const std::uint32_t columns = std::min(block.side, view.width - block.column);
  const std::uint32_t rows = std::min(block.side, view.height - block.row);
  for (std::uint32_t y = 0; y < rows; ++y) {
    const std::size_t first = std::size_t{block.row + y} * view.width + block.column;
    for (std::uint32_t x = 0; x < columns; ++x) {
      const std::uint32_t i = y * block.side + x;
      const bool hit = packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
      images.depths[first + x] = hit ? packet.ray.tfar[i] : infinity;
      if (images.triangles != nullptr) {
        images.triangles[first + x] = hit ? packet.hit.primID[i] : no_surface;
      }
    }
  }
}

RTCIntersectContext coherent_context() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

void trace_block(RTCScene scene, const Block& block, const Binary32View& view,
                 const TracedImages& images, RTCRayHit16& packet) {
  alignas(64) int valid[16];
  fill(packet, block, view, valid);
  RTCIntersectContext context = coherent_context();
  rtcIntersect16(valid, scene, &context, &packet);
  store(packet, block, view, images);
}

constexpr std::uint32_t stream_side = 8;
constexpr std::uint32_t stream_length = stream_side * stream_side;

/// The rays of a stream as an array for each of their parts.
using Arrays = RTCRayHitNt<stream_length>;

void trace_block(RTCScene scene, const Block& block, const Binary32View& view,
                 const TracedImages& images, Arrays& rays) {
  int valid[stream_length];
  fill(rays, block, view, valid);
  RTCRayHitNp parts{};
  parts.ray = {rays.ray.org_x, rays.ray.org_y, rays.ray.org_z, rays.ray.tnear,
               rays.ray.dir_x, rays.ray.dir_y, rays.ray.dir_z, rays.ray.time,
               rays.ray.tfar,  rays.ray.mask,  rays.ray.id,    rays.ray.flags};
  parts.hit = {rays.hit.Ng_x, rays.hit.Ng_y,   rays.hit.Ng_z,   rays.hit.u,
               rays.hit.v,    rays.hit.primID, rays.hit.geomID, {rays.hit.instID[0]}};
  RTCIntersectContext context = coherent_context();
  rtcIntersectNp(scene, &context, &parts, stream_length);
  store(rays, block, view, images);
}

/// Numbers below 2⁻¹²⁶ count as zero while it lives, as Embree's manual recommends.
class FlushSubnormals {
 public:
  FlushSubnormals() : kept_(_mm_getcsr()) { _mm_setcsr(kept_ | 0x8040); }
  ~FlushSubnormals() { _mm_setcsr(kept_); }
  FlushSubnormals(const FlushSubnormals&) = delete;
  FlushSubnormals& operator=(const FlushSubnormals&) = delete;

 private:
  unsigned int kept_;
};

template <class Rays>
void trace_blocks(RTCScene scene, const Binary32View& view, std::uint32_t side,
                  const TracedImages& images) {
  const auto block_count = [&](std::uint32_t pixels) { return (pixels + side - 1) / side; };
  const std::uint32_t grain = 32 / side;  // a task has about 32 × 32 pixels
  const tbb::blocked_range2d<std::uint32_t> blocks(0, block_count(view.height), grain, 0,
                                                   block_count(view.width), grain);
  tbb::parallel_for(blocks, [&](const auto& range) {
    const FlushSubnormals flush;
    Rays rays;
    for (std::uint32_t y = range.rows().begin(); y < range.rows().end(); ++y) {
      for (std::uint32_t x = range.cols().begin(); x < range.cols().end(); ++x) {
        trace_block(scene, {x * side, y * side, side}, view, images, rays);
      }
    }
  });
}

Binary32View binary32_view(const Camera& camera) {
  const CameraRays rays = attribution::camera_rays(camera);
  return {camera.width,
          camera.height,
          static_cast<float>(camera.near),
          static_cast<float>(camera.far),
          narrowed(rays.origin),
          narrowed(rays.direction)};
}

/// Traces one ray through each pixel's centre, blocks of pixels in parallel.
void trace_image(RTCScene scene, const Binary32View& view, RayStream stream,
                 const TracedImages& images) {
  if (stream == RayStream::packets) {
    trace_blocks<RTCRayHit16>(scene, view, 4, images);
  } else {
    trace_blocks<Arrays>(scene, view, stream_side, images);
  }
}

}  // namespace

struct EmbreeTracer::Parts {
  bool robust;
  tbb::global_control threads;
  EmbreeMesh mesh;
  RTCScene scene = nullptr;

  Parts(const attribution::WorldMesh& given, const EmbreeOptions& options)
      : robust(options.robust),
        threads(tbb::global_control::max_allowed_parallelism,
                options.threads > 0 ? static_cast<std::size_t>(options.threads)
                                    : std::thread::hardware_concurrency()),
        mesh(given, options.threads) {}
};

EmbreeTracer::EmbreeTracer(const attribution::WorldMesh& mesh, const EmbreeOptions& options)
    : parts_(std::make_unique<Parts>(mesh, options)) {}

EmbreeTracer::~EmbreeTracer() = default;

void EmbreeTracer::build() {
  parts_->scene = parts_->mesh.build(parts_->robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
}

void EmbreeTracer::trace(const Camera& camera, RayStream stream, std::vector<float>& depths,
                         std::vector<std::uint32_t>* triangles) const {
  const Binary32View view = binary32_view(camera);
  depths.resize(std::size_t{view.width} * view.height);
  if (triangles != nullptr) triangles->resize(depths.size());
  trace_image(parts_->scene, view, stream,
              {depths.data(), triangles != nullptr ? triangles->data() : nullptr});
}

std::string EmbreeTracer::description() {
  return embree_version();
}

}  // namespace fathom::validation
