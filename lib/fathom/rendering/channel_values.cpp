#include "fathom/rendering/channel_values.h"

#include <string>

#include "fathom/rendering/segment_channels.h"

namespace fathom::rendering {
namespace {

/// The values of a channel if it exists and has this type.
template <class T>
T* values_of(DepthMap& map, const std::string& name) {
  Samples<T>* values = map.values<T>(name);
  return values ? values->data() : nullptr;
}

EncodedValues encoded_values_of(DepthMap& map, const std::string& name) {
  return {values_of<float>(map, name), values_of<double>(map, name),
          values_of<std::uint16_t>(map, name)};
}

std::array<std::uint32_t*, all_segmentations.size()> segment_values_of(DepthMap& map) {
  std::array<std::uint32_t*, all_segmentations.size()> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = values_of<std::uint32_t>(
        map, std::string(description_of(channel_of(all_segmentations[i])).name));
  }
  return values;
}

}  // namespace

ChannelValues::ChannelValues(DepthMap& map)
    : depth(encoded_values_of(map, "Z")),
      distance(encoded_values_of(map, "distance")),
      coverage(values_of<float>(map, "A")),
      low(values_of<float>(map, "Zlow")),
      valid(values_of<std::uint32_t>(map, "valid")),
      id(values_of<std::uint32_t>(map, "id")),
      face(values_of<std::uint32_t>(map, "face")),
      object(values_of<std::uint32_t>(map, "object")),
      segments(segment_values_of(map)),
      normal{values_of<float>(map, "N.X"), values_of<float>(map, "N.Y"),
             values_of<float>(map, "N.Z")},
      camera_normal{values_of<float>(map, "Nc.X"), values_of<float>(map, "Nc.Y"),
                    values_of<float>(map, "Nc.Z")},
      shading_normal{values_of<float>(map, "Ns.X"), values_of<float>(map, "Ns.Y"),
                     values_of<float>(map, "Ns.Z")},
      position{values_of<float>(map, "P.X"), values_of<float>(map, "P.Y"),
               values_of<float>(map, "P.Z")},
      barycentric{values_of<float>(map, "bary.U"), values_of<float>(map, "bary.V")} {}

bool ChannelValues::wants_origins() const {
  return face || object ||
         std::any_of(segments.begin(), segments.end(), [](const auto* values) { return values; });
}

void ChannelValues::write(std::size_t pixel, const OriginNumbers& numbers) const {
  const auto values = origins();
  const auto all = numbers.all();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i]) values[i][pixel] = all[i];
  }
}

}  // namespace fathom::rendering
