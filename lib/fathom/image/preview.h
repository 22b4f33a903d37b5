#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "fathom/image/depth_map.h"
#include "fathom/image/rgb_image.h"
#include "fathom/image/surface.h"

/// Pictures of maps for people.
namespace fathom {

enum class ColourMap { viridis, magma, turbo, grey, diverging };
inline constexpr std::array all_colour_maps{ColourMap::viridis, ColourMap::magma, ColourMap::turbo,
                                            ColourMap::grey, ColourMap::diverging};
std::string_view name_of(ColourMap map);

/// The colour map of that name; also "gray"; nullopt for other names.
std::optional<ColourMap> colour_map_named(const std::string& name);

/// How a colour bar places the values between its ends: by their differences, ratios, inverses, or
/// so that every colour covers the same number of pixels.
enum class ColourScale { linear, log, inverse, equalised };
inline constexpr std::array all_colour_scales{ColourScale::linear, ColourScale::log,
                                              ColourScale::inverse, ColourScale::equalised};
std::string_view name_of(ColourScale scale);

/// The scale of that name; also "equalized"; nullopt for other names.
std::optional<ColourScale> colour_scale_named(const std::string& name);

/// The colour at t, which is clamped to [0, 1].
/// Source   viridis, magma: [VdWS15], as the degree-6 polynomials of [Zucker]; turbo: [Mik19], its
///          degree-5 polynomial; diverging: blue, white in the middle, orange.
Rgb colour_at(ColourMap map, double t);

/// The colour of an identifier: always the same, and neighbouring numbers far apart.
Rgb colour_of_identifier(std::uint32_t id);

/// The colours of a channel, unless the user chooses others.
ColourMap colours_for(ChannelDrawing drawing);

struct PreviewOptions {
  /// The channel to draw; empty: Z, or else the map's first. `N` draws N.X, N.Y, N.Z
  /// as RGB, `Nc` and `Ns` theirs.
  std::string channel;
  /// By default viridis; diverging for errors, whose range is then as far below 0 as above.
  std::optional<ColourMap> colours;
  ColourScale scale = ColourScale::linear;
  /// Ends of the colour bar; by default the least and the greatest finite value of a surface.
  /// Values beyond an end take the colour of that end.
  std::optional<double> low, high;
  /// Written after the channel's name, for instance "m"; empty: nothing is written.
  std::string unit;
};

/// A picture of one channel, pixel by pixel. (Zfight shows where the wrong surface wins; few such
/// pixels of a map that is not enlarged are drawn larger, with a note in the legend. Small maps are
/// enlarged by a whole factor; of very large maps every k-th pixel is shown, with a note.) Next to
/// it are a colour bar with the range in figures, the channel's name, and the colours of
/// background, infinities and NaNs.
/// Fails    InputError if the map has a fault (find_fault); UsageError if there is no such channel
///          or if low ≥ high, or if `scale` is log or inverse and low ≤ 0; OutputError if the font
///          is missing.
RgbImage draw_preview(const DepthMap& map, const PreviewOptions& options = {});

}  // namespace fathom
