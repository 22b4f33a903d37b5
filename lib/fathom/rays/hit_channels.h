#pragma once

#include <array>
#include <cstddef>
#include <string_view>

/// The channels of a ray's hits (specification, section 11): the only place that defines their
/// names, types and meanings. The table of the specification, docstrings and types of Python are
/// compared with it by a test.
namespace fathom {

enum class HitChannel { t, id, distance, P, bary, N, object, face };

enum class HitChannelType {
  real,       ///< the exact number, rounded once
  identifier  ///< a 32-bit integer; without a hit no_triangle
};

struct HitChannelDescription {
  HitChannel channel;
  /// Its name in files and options.
  std::string_view name;
  /// A letter for each part: `P` has the columns P.X, P.Y and P.Z. Empty: a single number.
  std::string_view parts;
  HitChannelType type;
  /// For people, in a few words.
  std::string_view meaning;
};

/// In the order of HitChannel.
inline constexpr auto hit_channel_table = std::to_array<HitChannelDescription>({
    {HitChannel::t, "t", "", HitChannelType::real, "in lengths of the direction"},
    {HitChannel::id, "id", "", HitChannelType::identifier, "triangle"},
    {HitChannel::distance, "distance", "", HitChannelType::real, "in scene units"},
    {HitChannel::P, "P", "XYZ", HitChannelType::real, "point in the world"},
    {HitChannel::bary, "bary", "UV", HitChannelType::real, "barycentric weights of B and C"},
    {HitChannel::N, "N", "XYZ", HitChannelType::real, "normal against the ray"},
    {HitChannel::object, "object", "", HitChannelType::identifier, "object"},
    {HitChannel::face, "face", "", HitChannelType::identifier, "face"},
});

constexpr const HitChannelDescription& description_of(HitChannel channel) {
  return hit_channel_table[static_cast<std::size_t>(channel)];
}

/// For names_of() and value_named() (unknown_name.h).
constexpr std::string_view name_of(const HitChannelDescription& description) {
  return description.name;
}

}  // namespace fathom
