#include "fathom/rendering/channel_values.h"

#include <string>
#include <vector>

#include "fathom/image/channel_table.h"
#include "fathom/rendering/segment_channels.h"

namespace fathom::rendering {
namespace {

std::string own_name(Channel channel) {
  return std::string(description_of(channel).name);
}

/// The values of a channel if it exists and has this type.
template <class T>
T* values_of(DepthMap& map, const std::string& name) {
  Samples<T>* values = map.values<T>(name);
  return values ? values->data() : nullptr;
}

float* numbers_of(DepthMap& map, Channel channel) {
  return values_of<float>(map, own_name(channel));
}

std::uint32_t* identifiers_of(DepthMap& map, Channel channel) {
  return values_of<std::uint32_t>(map, own_name(channel));
}

EncodedValues encoded_values_of(DepthMap& map, Channel channel) {
  const std::string name = own_name(channel);
  return {values_of<float>(map, name), values_of<double>(map, name),
          values_of<std::uint16_t>(map, name)};
}

template <std::size_t count>
std::array<float*, count> parts_of(DepthMap& map, Channel channel) {
  const std::vector<std::string> names = part_names(channel);
  std::array<float*, count> parts{};
  for (std::size_t i = 0; i < count; ++i) parts[i] = values_of<float>(map, names.at(i));
  return parts;
}

std::array<std::uint32_t*, all_segmentations.size()> segment_values_of(DepthMap& map) {
  std::array<std::uint32_t*, all_segmentations.size()> values{};
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = identifiers_of(map, channel_of(all_segmentations[i]));
  return values;
}

}  // namespace

ChannelValues::ChannelValues(DepthMap& map)
    : depth(encoded_values_of(map, Channel::Z)),
      distance(encoded_values_of(map, Channel::distance)),
      coverage(numbers_of(map, Channel::A)),
      low(numbers_of(map, Channel::Zlow)),
      valid(identifiers_of(map, Channel::valid)),
      id(identifiers_of(map, Channel::id)),
      face(identifiers_of(map, Channel::face)),
      object(identifiers_of(map, Channel::object)),
      segments(segment_values_of(map)),
      normal(parts_of<3>(map, Channel::N)),
      camera_normal(parts_of<3>(map, Channel::Nc)),
      shading_normal(parts_of<3>(map, Channel::Ns)),
      position(parts_of<3>(map, Channel::P)),
      barycentric(parts_of<2>(map, Channel::bary)) {}

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
