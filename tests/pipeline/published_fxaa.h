#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "fathom/pipeline/output/output_merger.h"

/// FXAA 3.11 "quality", preset 39, statement by statement as [Lot09]'s successor publishes it,
/// pixel positions in place of texture coordinates: what fxaa() is held to. Nothing is shared with
/// it.
namespace fathom::pipeline::published {

struct Picture {
  const ColourImage& image;

  /// A bilinear fetch, clamped to the edge; the first pixel's centre is (0, 0).
  [[nodiscard]] Colour fetch(double x, double y) const {
    const auto right = static_cast<double>(image.width - 1);
    const auto bottom = static_cast<double>(image.height - 1);
    x = std::clamp(x, 0.0, right), y = std::clamp(y, 0.0, bottom);
    const double i = std::floor(x), j = std::floor(y), u = x - i, v = y - j;
    const auto texel = [&](double column, double row) {
      return image.at(static_cast<std::uint32_t>(std::min(column, right)),
                      static_cast<std::uint32_t>(std::min(row, bottom)));
    };
    const Colour a = texel(i, j), b = texel(i + 1, j), c = texel(i, j + 1), d = texel(i + 1, j + 1);
    Colour mixed{};
    for (std::size_t k = 0; k < 3; ++k)
      mixed[k] = (1 - v) * ((1 - u) * a[k] + u * b[k]) + v * ((1 - u) * c[k] + u * d[k]);
    return mixed;
  }
  [[nodiscard]] double luma(double x, double y) const {
    const Colour c = fetch(x, y);
    return 0.299 * c[0] + 0.587 * c[1] + 0.114 * c[2];
  }
};

struct Result {
  Colour colour;
  /// How much more luma changes from row to row than from column to column, which decides that an
  /// edge is horizontal. Where this is 0 but for rounding, either direction is right.
  double more_horizontal = 0;
};

/// `forced`: whether the edge is horizontal; as published where it is not said.
inline Result fxaa_pixel(const Picture& tex, double posMx, double posMy, double edgeThreshold,
                         double edgeThresholdMin, double subpix, std::optional<bool> forced = {}) {
  constexpr std::array<double, 12> P{1, 1, 1, 1, 1, 1.5, 2, 2, 2, 2, 4, 8};
  const double lumaM = tex.luma(posMx, posMy);
  double lumaS = tex.luma(posMx, posMy + 1);
  const double lumaE = tex.luma(posMx + 1, posMy);
  double lumaN = tex.luma(posMx, posMy - 1);
  const double lumaW = tex.luma(posMx - 1, posMy);
  const double rangeMax = std::max({lumaM, lumaS, lumaE, lumaN, lumaW});
  const double rangeMin = std::min({lumaM, lumaS, lumaE, lumaN, lumaW});
  const double range = rangeMax - rangeMin;
  if (range == 0 || range < std::max(edgeThresholdMin, rangeMax * edgeThreshold))
    return {tex.fetch(posMx, posMy), 1};

  const double lumaNW = tex.luma(posMx - 1, posMy - 1), lumaSE = tex.luma(posMx + 1, posMy + 1);
  const double lumaNE = tex.luma(posMx + 1, posMy - 1), lumaSW = tex.luma(posMx - 1, posMy + 1);
  const double lumaNS = lumaN + lumaS, lumaWE = lumaW + lumaE;
  const double edgeHorz =
      std::abs(-2 * lumaW + (lumaNW + lumaSW)) +
      (std::abs(-2 * lumaM + lumaNS) * 2 + std::abs(-2 * lumaE + (lumaNE + lumaSE)));
  const double edgeVert =
      std::abs(-2 * lumaS + (lumaSW + lumaSE)) +
      (std::abs(-2 * lumaM + lumaWE) * 2 + std::abs(-2 * lumaN + (lumaNW + lumaNE)));
  const bool horzSpan = forced.value_or(edgeHorz >= edgeVert);
  const double subpixA = (lumaNS + lumaWE) * 2 + ((lumaNW + lumaSW) + (lumaNE + lumaSE));
  const double subpixB = subpixA / 12 - lumaM;
  if (!horzSpan) lumaN = lumaW, lumaS = lumaE;
  const double gradientN = lumaN - lumaM, gradientS = lumaS - lumaM;
  double lumaNN = lumaN + lumaM;
  const double lumaSS = lumaS + lumaM;
  const bool pairN = std::abs(gradientN) >= std::abs(gradientS);
  const double gradient = std::max(std::abs(gradientN), std::abs(gradientS));
  const double lengthSign = pairN ? -1 : 1;
  const double subpixC = std::clamp(std::abs(subpixB) / range, 0.0, 1.0);

  const double posBx = horzSpan ? posMx : posMx + lengthSign * 0.5;
  const double posBy = horzSpan ? posMy + lengthSign * 0.5 : posMy;
  const double offX = horzSpan ? 1 : 0, offY = horzSpan ? 0 : 1;
  if (!pairN) lumaNN = lumaSS;
  const double gradientScaled = gradient / 4;
  const bool lumaMLTZero = lumaM - lumaNN * 0.5 < 0;

  double posNx = posBx - offX * P[0], posNy = posBy - offY * P[0];
  double posPx = posBx + offX * P[0], posPy = posBy + offY * P[0];
  double lumaEndN = tex.luma(posNx, posNy) - lumaNN * 0.5;
  double lumaEndP = tex.luma(posPx, posPy) - lumaNN * 0.5;
  bool doneN = std::abs(lumaEndN) >= gradientScaled, doneP = std::abs(lumaEndP) >= gradientScaled;
  for (std::size_t step = 1; step < P.size(); ++step) {
    if (!doneN) posNx -= offX * P[step], posNy -= offY * P[step];
    if (!doneP) posPx += offX * P[step], posPy += offY * P[step];
    if ((doneN && doneP) || step + 1 == P.size()) break;
    if (!doneN) lumaEndN = tex.luma(posNx, posNy) - lumaNN * 0.5;
    if (!doneP) lumaEndP = tex.luma(posPx, posPy) - lumaNN * 0.5;
    doneN = std::abs(lumaEndN) >= gradientScaled;
    doneP = std::abs(lumaEndP) >= gradientScaled;
  }

  const double dstN = horzSpan ? posMx - posNx : posMy - posNy;
  const double dstP = horzSpan ? posPx - posMx : posPy - posMy;
  const bool goodSpanN = (lumaEndN < 0) != lumaMLTZero, goodSpanP = (lumaEndP < 0) != lumaMLTZero;
  const bool goodSpan = dstN < dstP ? goodSpanN : goodSpanP;
  const double pixelOffset = std::min(dstN, dstP) * (-1 / (dstP + dstN)) + 0.5;
  const double subpixF = (-2 * subpixC + 3) * (subpixC * subpixC);
  const double subpixH = subpixF * subpixF * subpix;
  const double pixelOffsetSubpix = std::max(goodSpan ? pixelOffset : 0, subpixH);
  return {horzSpan ? tex.fetch(posMx, posMy + pixelOffsetSubpix * lengthSign)
                   : tex.fetch(posMx + pixelOffsetSubpix * lengthSign, posMy),
          edgeHorz - edgeVert};
}

}  // namespace fathom::pipeline::published
