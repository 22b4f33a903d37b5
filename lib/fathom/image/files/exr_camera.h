#pragma once

#include <ImfHeader.h>

#include <map>
#include <string>
#include <vector>

#include "fathom/camera/camera.h"

/// A camera in OpenEXR's words: the attributes that are numbers, under their names there.
namespace fathom::image {

using ExrNumbers = std::map<std::string, std::vector<double>>;

/// The attributes of an EXR that describe a camera to other programs; `fathom.camera` has the exact
/// numbers.
///   worldToCamera       x right, y up, z forward; for row vectors, row by row
///   worldToNDC          (0, 0) is the top left, (1, 1) the bottom right corner; likewise
///   pixelAspectRatio, screenWindowCenter (x right, y up), screenWindowWidth
/// Rounded in binary64.
ExrNumbers exr_numbers(const Camera& camera);

/// Puts them into a header, in binary32. What a header cannot hold (a mirrored screen window, a
/// matrix beyond binary32) is left out or neutral.
void set_numbers(Imf::Header& header, const ExrNumbers& numbers);

/// Reads them back.
ExrNumbers get_numbers(const Imf::Header& header);

}  // namespace fathom::image
