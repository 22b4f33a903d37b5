#pragma once

#include <ImfHeader.h>

#include <map>
#include <string>
#include <vector>

#include "fathom/camera/camera.h"

/// A camera in OpenEXR's words: the attributes that are numbers, under their names there.
namespace fathom::image {

using ExrNumbers = std::map<std::string, std::vector<double>>;

/// What an EXR says of a camera: `worldToCamera`, x right, y up, z forward; `worldToNDC`, with (0,
/// 0) the top left and (1, 1) the bottom right corner; both for row vectors, row by row;
///    `pixelAspectRatio`,
/// `screenWindowCenter` (x right, y up) and `screenWindowWidth`. Rounded, for other programs' eyes
/// only: `fathom.camera` has the camera.
ExrNumbers exr_numbers(const Camera& camera);

/// Puts them into a header, in binary32. What a header cannot hold (a mirrored screen window, a
/// matrix beyond binary32) is left out or neutral.
void set_numbers(Imf::Header& header, const ExrNumbers& numbers);

/// Reads them back.
ExrNumbers get_numbers(const Imf::Header& header);

}  // namespace fathom::image
