#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fathom/attribution/attribution.h"

namespace fathom::attribution {

/// What was found and in how many pixels: "the image is mirrored (1 pixel)".
std::string finding_text(const Finding& finding);

/// The same with its kind: "mirrored: the image is mirrored (1 pixel)".
std::string finding_line(const Finding& finding);

/// Why a map is not as it should be, in one line: the first finding, else how many pixels are
/// unexplained and the one to look at first. Empty where every pixel is explained and nothing was
/// found.
std::string cause_of(const Truth& truth, const OtherMap& other, const Attribution& found);

/// First line of a report: "failed: the image is mirrored (1 pixel)", or "every pixel is
/// explained".
std::string verdict_text(const Truth& truth, const OtherMap& other, const Attribution& found);

/// A pixel with its depths: "(12, 7): 3.25 instead of 3.21, allowed 3.2099 to 3.2101". Depths are
/// in scene units, to 9 digits.
std::string pixel_text(const Truth& truth, const OtherMap& other, const Attribution& found,
                       std::size_t pixel);

/// The pixels to look at first, at most `count`: unexplained pixels, then pixels of a convention,
/// then missed surfaces, then the greatest relative errors of depth. Equal pixels are left out.
std::vector<std::size_t> worst_pixels(const Truth& truth, const OtherMap& other,
                                      const Attribution& found, std::size_t count);

}  // namespace fathom::attribution
