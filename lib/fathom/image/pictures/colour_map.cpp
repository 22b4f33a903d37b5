#include <algorithm>
#include <array>
#include <cmath>

#include "fathom/failures/unknown_name.h"
#include "fathom/image/preview.h"

namespace fathom {
namespace {

using Colour = std::array<double, 3>;

constexpr std::array<Colour, 7> viridis{
    {{0.2777273272234177, 0.005407344544966578, 0.3340998053353061},
     {0.1050930431085774, 1.404613529898575, 1.384590162594685},
     {-0.3308618287255563, 0.214847559468213, 0.09509516302823659},
     {-4.634230498983486, -5.799100973351585, -19.33244095627987},
     {6.228269936347081, 14.17993336680509, 56.69055260068105},
     {4.776384997670288, -13.74514537774601, -65.35303263337234},
     {-5.435455855934631, 4.645852612178535, 26.3124352495832}}};

constexpr std::array<Colour, 7> magma{
    {{-0.002136485053939582, -0.000749655052795221, -0.005386127855323933},
     {0.2516605407371642, 0.6775232436837668, 2.494026599312351},
     {8.353717279216625, -3.577719514958484, 0.3144679030132573},
     {-27.66873308576866, 14.26473078096533, -13.64921318813922},
     {52.17613981234068, -27.94360607168351, 12.94416944238394},
     {-50.76852536473588, 29.04658282127291, 4.23415299384598},
     {18.65570506591883, -11.48977351997711, -5.601961508734096}}};

constexpr std::array<Colour, 6> turbo{{{0.13572138, 0.09140261, 0.10667330},
                                       {4.61539260, 2.19418839, 12.64194608},
                                       {-42.66032258, 4.84296658, -60.58204836},
                                       {132.13108234, -14.18503333, 110.36276771},
                                       {-152.94239396, 4.27729857, -89.90310912},
                                       {59.28637943, 2.82956604, 27.34824973}}};

std::uint8_t to_byte(double x) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(x, 0.0, 1.0)));
}

/// Horner's scheme from the highest coefficient.
template <std::size_t count>
Rgb evaluate(const std::array<Colour, count>& coefficients, double t) {
  Rgb result{};
  for (std::size_t c = 0; c < 3; ++c) {
    double value = 0;
    for (std::size_t k = count; k-- > 0;) value = value * t + coefficients[k][c];
    result[c] = to_byte(value);
  }
  return result;
}

/// From −1, blue, by white to 1, orange.
Rgb diverging(double t) {
  const Colour end = t < 0 ? Colour{35, 105, 215} : Colour{215, 75, 40};
  Rgb result{};
  for (std::size_t c = 0; c < 3; ++c)
    result[c] = static_cast<std::uint8_t>(std::lround(255 + std::abs(t) * (end[c] - 255)));
  return result;
}

}  // namespace

std::string_view name_of(ColourMap map) {
  switch (map) {
    case ColourMap::viridis:
      return "viridis";
    case ColourMap::magma:
      return "magma";
    case ColourMap::turbo:
      return "turbo";
    case ColourMap::grey:
      return "grey";
    case ColourMap::diverging:
      break;
  }
  return "diverging";
}

std::optional<ColourMap> colour_map_named(const std::string& name) {
  return value_named(all_colour_maps, name == "gray" ? "grey" : name);
}

Rgb colour_at(ColourMap map, double t) {
  t = std::clamp(t, 0.0, 1.0);
  switch (map) {
    case ColourMap::viridis:
      return evaluate(viridis, t);
    case ColourMap::magma:
      return evaluate(magma, t);
    case ColourMap::turbo:
      return evaluate(turbo, t);
    case ColourMap::grey:
      return {to_byte(t), to_byte(t), to_byte(t)};
    case ColourMap::diverging:
      return diverging(2 * t - 1);
  }
  return {};
}

/// Hue by the golden ratio, so that neighbours are far apart; saturation and value by further bits
/// of a multiplicative hash ([Knu98] 6.4).
Rgb colour_of_identifier(std::uint32_t id) {
  const std::uint32_t hash = id * 2654435769u;
  const double hue = hash / 4294967296.0 * 6;
  const double saturation = 0.45 + 0.15 * ((hash >> 7) % 4);
  const double value = 0.65 + 0.1 * ((hash >> 11) % 4);
  const auto part = [&](double offset) {
    const double k = std::fmod(offset + hue, 6);
    return to_byte(value - value * saturation * std::clamp(std::min(k, 4 - k), 0.0, 1.0));
  };
  return {part(5), part(3), part(1)};
}

}  // namespace fathom
