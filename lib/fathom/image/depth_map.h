#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/image/samples.h"

/// Maps: their channels, names, camera and texts.
namespace fathom {

/// Background of `id`, `face`, `object` and all other identifiers.
inline constexpr std::uint32_t no_surface = 0xFFFFFFFF;
/// What `material`, `group`, `part` and `label` have where a surface is visible that has none.
inline constexpr std::uint32_t no_segment = 0xFFFFFFFE;

/// One channel: width × height values, row by row from the top, each row from the left.
/// binary32 is what EXR and PFM hold; binary64 is only for `Z` and `distance` in NPY; 16 bits only
/// for PNG codes (see DepthMap::png_scale); 32-bit integers are identifiers.
struct ImageChannel {
  std::string name;
  std::variant<Samples<float>, Samples<double>, Samples<std::uint16_t>, Samples<std::uint32_t>>
      values;
};

/// A rendered map: named channels of one size, and the data for computing it again. Values and
/// units are defined in the specification, section 6, and already rounded. A map does not access
/// the scene.
struct DepthMap {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<ImageChannel> channels;

  /// For 16-bit codes: code = round-half-even(scale·D), 0 where there is no surface.
  std::optional<double> png_scale;
  /// How many pixels show a surface whose code would be above 65535 and that has 0 instead, as if
  /// it showed none; nullopt if such a depth is refused.
  std::optional<std::uint64_t> codes_beyond;

  /// Names of the objects that channel `object` numbers.
  std::vector<std::string> object_names;
  /// Names for the numbers in other channels: tables["material"][n] is the name of material n.
  std::map<std::string, std::vector<std::string>> tables;
  /// Attributes as they are in the file: `fathom.sources`, `fathom.engine`, … (`fathom.camera` is
  /// made from camera, `fathom.objects` from object_names, `fathom.materials` and the like from
  /// tables).
  std::map<std::string, std::string> texts;
  /// The camera of a rendered map, which files store as they need it, e.g. as text `fathom.camera`.
  /// Empty in a map that was read: camera_of() finds the camera in the texts.
  std::optional<Camera> camera;
  /// Attributes of an EXR that was read, as they are in it: `worldToCamera` and `worldToNDC`, row
  /// by row, `pixelAspectRatio`, `screenWindowCenter` and `screenWindowWidth`. An EXR of a map
  /// without `camera` has them again.
  std::map<std::string, std::vector<double>> numbers;

  /// nullptr if there is no such channel.
  [[nodiscard]] const ImageChannel* find(const std::string& name) const;
  [[nodiscard]] ImageChannel* find(const std::string& name);
  /// The values of a channel; nullptr unless it exists and has this type.
  template <class T>
  [[nodiscard]] const Samples<T>* values(const std::string& name) const {
    const ImageChannel* channel = find(name);
    return channel ? std::get_if<Samples<T>>(&channel->values) : nullptr;
  }
  template <class T>
  [[nodiscard]] Samples<T>* values(const std::string& name) {
    ImageChannel* channel = find(name);
    return channel ? std::get_if<Samples<T>>(&channel->values) : nullptr;
  }
};

/// The fault of a map, in one line. Nothing if the map has pixels and channels, the channels have
/// different names without NUL and a value for each pixel, and the scale of codes is a positive
/// number.
std::optional<std::string> find_fault(const DepthMap& map);

/// Refuses a map that is not valid.
/// Fails    InputError: "map: " and the fault from find_fault().
void require_valid(const DepthMap& map);

/// The camera that a map carries: its own, or the one in its text `fathom.camera`; nullopt if it
/// carries none. `name` is the map's for messages.
/// Fails    InputError if the text is not one camera.
std::optional<Camera> camera_of(const DepthMap& map, const std::string& name);

/// The texts that a file of the map has, its camera among them.
std::map<std::string, std::string> texts_of(const DepthMap& map);

// The names of the texts that maps carry (DepthMap::texts): attributes of an EXR, text chunks of a
// PNG, members of the JSON text of an NPZ. docs/reading-maps.md describes each of them.

/// The camera, as the JSON of camera files.
inline constexpr const char* camera_text = "fathom.camera";
/// The files of the scene with their SHA-256, as JSON.
inline constexpr const char* sources_text = "fathom.sources";
/// What computed the map: the name of an engine, or of another renderer.
inline constexpr const char* engine_text = "fathom.engine";
/// Which triangles were left out, unless none.
inline constexpr const char* cull_text = "fathom.cull";
/// Where the normals of channel Ns come from, unless from the file.
inline constexpr const char* normals_text = "fathom.normals";
/// The time at which the objects of a motion were placed.
inline constexpr const char* time_text = "fathom.time";
/// The pattern of the samples of channel Asampled.
inline constexpr const char* samples_text = "fathom.samples";
/// The depth format of channel Zwindow, as JSON, and the depth range of a pipeline, unless [0, 1].
inline constexpr const char* depth_format_text = "fathom.depth_format";
inline constexpr const char* depth_range_text = "fathom.depth_range";
/// The value of depth channels without a surface, unless +∞ (surface.h).
inline constexpr const char* background_text = "fathom.background";
/// The channels that have another name in the file (renamed_channels.h).
inline constexpr const char* channel_names_text = "fathom.channel-names";

}  // namespace fathom

namespace fathom::image {

/// The beginning of messages about value `k` of a channel: "pixel (3, 5): ", column and row from 0.
inline std::string place_of_pixel(std::size_t k, std::uint32_t width) {
  return "pixel (" + std::to_string(k % width) + ", " + std::to_string(k / width) + "): ";
}

}  // namespace fathom::image
