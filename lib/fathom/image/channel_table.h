#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// The channels of exact maps (specification, section 6), with their types and meanings, and the
/// channels that samples, depth buffers and conversions add.
namespace fathom {

enum class Channel {
  Z,
  A,
  Zlow,
  distance,
  id,
  face,
  object,
  material,
  group,
  part,
  label,
  N,
  P,
  bary,
  Nc,
  Ns,
  valid
};

/// Quantity of a channel, which decides its value for "no surface".
enum class ChannelKind {
  depth,       ///< Z, distance, disparity, Zdecoded: background +∞ (of codes and
               ///< disparities 0), or the declared background (surface.h)
  identifier,  ///< id, face, object, material and every other 32-bit integer: background no_surface
  direction,   ///< N.*, Nc.*, Ns.*: background 0 in all three
  position,    ///< P.*, bary.*: background NaN
  quantity     ///< everything else (A, Zlow, other programs' channels): 0, which is a value too
};

/// Stored type of a channel.
enum class ChannelType {
  encoded,    ///< binary32, binary64 or 16-bit codes, as asked for (DepthEncoding)
  binary32,   ///< binary32
  identifier  ///< a 32-bit integer, as `valid` is, too
};

/// How depths are stored. Identifiers keep their 32 bits.
enum class StoredType { binary32, binary64, scaled_unorm16 };

struct ChannelDescription {
  Channel channel;
  /// Its name in files and options, without a part.
  std::string_view name;
  /// A letter for each part: `N` has the channels N.X, N.Y and N.Z. Empty: a single channel.
  std::string_view parts;
  ChannelType type;
  ChannelKind kind;
  /// For people, in a few words.
  std::string_view meaning;
};

/// In the order of Channel.
inline constexpr auto channel_table = std::to_array<ChannelDescription>({
    {Channel::Z, "Z", "", ChannelType::encoded, ChannelKind::depth, "planar depth"},
    {Channel::A, "A", "", ChannelType::binary32, ChannelKind::quantity, "coverage"},
    {Channel::Zlow, "Zlow", "", ChannelType::binary32, ChannelKind::quantity,
     "exact depth minus Z"},
    {Channel::distance, "distance", "", ChannelType::encoded, ChannelKind::depth, "ray distance"},
    {Channel::id, "id", "", ChannelType::identifier, ChannelKind::identifier, "triangle"},
    {Channel::face, "face", "", ChannelType::identifier, ChannelKind::identifier, "face"},
    {Channel::object, "object", "", ChannelType::identifier, ChannelKind::identifier, "object"},
    {Channel::material, "material", "", ChannelType::identifier, ChannelKind::identifier,
     "material"},
    {Channel::group, "group", "", ChannelType::identifier, ChannelKind::identifier, "group"},
    {Channel::part, "part", "", ChannelType::identifier, ChannelKind::identifier, "part"},
    {Channel::label, "label", "", ChannelType::identifier, ChannelKind::identifier, "label"},
    {Channel::N, "N", "XYZ", ChannelType::binary32, ChannelKind::direction, "normal in the world"},
    {Channel::P, "P", "XYZ", ChannelType::binary32, ChannelKind::position, "position in the world"},
    {Channel::bary, "bary", "UV", ChannelType::binary32, ChannelKind::position,
     "barycentric weights of B and C"},
    {Channel::Nc, "Nc", "XYZ", ChannelType::binary32, ChannelKind::direction,
     "normal in the camera frame"},
    {Channel::Ns, "Ns", "XYZ", ChannelType::binary32, ChannelKind::direction,
     "interpolated normal in the world"},
    {Channel::valid, "valid", "", ChannelType::identifier, ChannelKind::quantity,
     "1 where the lens has a ray"},
});

inline const ChannelDescription& description_of(Channel channel) {
  return channel_table[static_cast<std::size_t>(channel)];
}

/// "Z" → Channel::Z, …; nullopt if there is no such channel.
std::optional<Channel> channel_named(std::string_view name);

/// The names of its parts, "N.X", "N.Y" and "N.Z"; for a single channel, its own name.
std::vector<std::string> part_names(Channel channel);

/// The channels of materials, groups, parts and labels, in the order of Segmentation (mesh/).
inline constexpr std::array segment_channels{Channel::material, Channel::group, Channel::part,
                                             Channel::label};

/// A channel beside those of exact maps: of samples, of depth and stencil buffers, of `convert`.
struct AddedChannel {
  std::string_view name;
  ChannelKind kind;
  /// For people, in a few words.
  std::string_view meaning;
};

inline constexpr auto added_channels = std::to_array<AddedChannel>({
    {"Asampled", ChannelKind::quantity, "share of samples that hit a surface"},
    {"Zwindow", ChannelKind::quantity, "stored depth"},
    {"Zwindow.high", ChannelKind::quantity, "upper half of the stored depth"},
    {"Zwindow.low", ChannelKind::quantity, "lower half of the stored depth"},
    {"Zdecoded", ChannelKind::depth, "depth decoded from the buffer"},
    {"Zerror", ChannelKind::quantity, "decoded minus exact depth"},
    {"Zwinner", ChannelKind::identifier, "triangle that wins in the buffer"},
    {"Zfight", ChannelKind::quantity, "where the wrong surface wins"},
    {"stencil", ChannelKind::quantity, "number in the stencil buffer"},
    {"disparity", ChannelKind::depth, "disparity of a stereo pair"},
});

/// "Zfight" → its row of added_channels; nullptr if there is no such channel.
const AddedChannel* added_channel_named(std::string_view name);

/// Whether a channel has no_segment where a surface without a segment is visible: one of
/// segment_channels.
bool shows_segments(std::string_view channel);

/// The names of all channels, in the order of channel_table.
std::vector<std::string> names_of_channels();

/// "Z, A, Zlow, … and valid"
std::string channel_names();

}  // namespace fathom
