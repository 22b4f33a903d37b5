#include "fathom/depth_buffer/depth_buffer.h"

#include <algorithm>
#include <string>

#include "fathom/depth_buffer/buffer_work.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/rendering/map_background.h"
#include "fathom/scene/scene_fault.h"
#include "fathom/text/counted.h"
#include "fathom/threads/threads.h"

namespace fathom {
using namespace area;
using namespace depth_buffer;
using namespace rendering;

DepthFormat depth_format_of(const Camera& camera, Mapping mapping, Storage storage, double c) {
  const StandardArithmetic standard;
  const DepthFormat format{mapping, storage, camera.near, camera.far, c};
  try {
    require_meaningful(format);
  } catch (const UsageError& error) {
    throw UsageError("a depth format takes near and far from the camera (--near, --far): " +
                     std::string(error.what()));
  }
  return format;
}

BufferBands::BufferBands(const BufferWork& work) : height_(work.camera.height) {
  if (!work.options.against_exact) return;
  bands_.emplace(CoverageFrame{work.triangles, work.camera, work.options.render.cull});
}

std::uint32_t BufferBands::count() const {
  return (height_ - 1) / TriangleBands::rows_per_band + 1;
}

TriangleBands::Band BufferBands::operator[](std::uint32_t band) const {
  if (bands_) return (*bands_)[band];
  const std::uint32_t first = band * TriangleBands::rows_per_band;
  return {first, std::min(first + TriangleBands::rows_per_band, height_), {}};
}

DepthBufferStatistics depth_buffer::sum_of(const std::vector<DepthBufferStatistics>& parts) {
  DepthBufferStatistics sum;
  for (const DepthBufferStatistics& part : parts) {
    sum.by_binary64 += part.by_binary64;
    sum.by_double_words += part.by_double_words;
    sum.by_exact_numbers += part.by_exact_numbers;
    sum.fighting += part.fighting;
  }
  return sum;
}

namespace {

void require_known_triangles(const Samples<std::uint32_t>& ids, std::uint64_t count) {
  for (const std::uint32_t id : ids) {
    if (id != no_surface && id >= count) {
      throw InputError("map: channel 'id' holds " + std::to_string(id) + ", and the scene has " +
                       text::counted(count, "triangle"));
    }
  }
}

}  // namespace

DepthBufferStatistics add_depth_buffer(DepthMap& map, const TriangleSource& triangles,
                                       const Camera& camera, const DepthBufferOptions& options) {
  const StandardArithmetic standard;
  require_meaningful(options.format);
  if (!map.values<std::uint32_t>("id")) throw UsageError("a depth buffer needs the channel id");
  require_thread_count(options.render.threads);
  require_map_of(camera, map);
  require_renderable(triangles, camera);
  require_known_triangles(*map.values<std::uint32_t>("id"), triangles.count());
  BufferChannels channels(map, options.format, options.against_exact);
  return with_threads(options.render.threads, [&] {
    const BufferWork work{channels, triangles, camera, options};
    return options.render.engine == Engine::fast ? fill_certified(work) : fill_exactly(work);
  });
}

}  // namespace fathom
