#include <algorithm>
#include <utility>

#include "fathom/fast/channels/resolve.h"

namespace fathom::fast {
using namespace rendering;
using namespace triangle;

namespace {

/// The channels whose background tiles that show surfaces do not write anyway.
MapBackground beside_surfaces(MapBackground background, bool writes_depths) {
  background.leave_out("A");
  if (writes_depths) background.leave_out("Z");
  return background;
}

}  // namespace

FastOutput::FastOutput(DepthMap& map, ChannelWriter& writer, const SceneRays& rays,
                       MapBackground unfilled, MapRows rows)
    : rows_(rows),
      certified_([&, rows] { return CertifiedWriter(writer, rays, rows); }),
      depths_(writer.values().depth.binary32),
      others_(std::any_of(map.channels.begin(), map.channels.end(),
                          [&](const ImageChannel& channel) {
                            return channel.name != "A" && !(depths_ && channel.name == "Z");
                          })),
      all_(unfilled, rows),
      beside_surfaces_(beside_surfaces(std::move(unfilled), depths_ != nullptr), rows) {}

void FastOutput::write_background(const PixelBox& area, const MapLayout& layout) const {
  all_.write(area, layout);
  rows_.finish();
}

}  // namespace fathom::fast
