#include "validation/studies/antialiasing/nyquist.h"

#include <cmath>
#include <numbers>

namespace fathom::studies {
namespace {

/// The frequency of the strongest term of the samples' Fourier transform.
double apparent_frequency(double frequency) {
  constexpr int n = 512;
  std::vector<double> samples(n);
  for (int x = 0; x < n; ++x) {
    samples[static_cast<std::size_t>(x)] = std::cos(2 * std::numbers::pi * frequency * (x + 0.5));
  }
  double best = 0, strongest = -1;
  for (int bin = 0; bin <= n / 2; ++bin) {
    double c = 0, s = 0;
    for (int x = 0; x < n; ++x) {
      const double angle = 2 * std::numbers::pi * bin * x / n;
      c += samples[static_cast<std::size_t>(x)] * std::cos(angle);
      s += samples[static_cast<std::size_t>(x)] * std::sin(angle);
    }
    if (c * c + s * s <= strongest) continue;
    strongest = c * c + s * s;
    best = static_cast<double>(bin) / n;
  }
  return best;
}

}  // namespace

std::vector<GratingSeen> gratings_seen() {
  std::vector<GratingSeen> gratings;
  for (int i = 1; i <= 60; ++i) gratings.push_back({i / 40.0, apparent_frequency(i / 40.0)});
  return gratings;
}

}  // namespace fathom::studies
