#pragma once

#include "apps/validate/report/validation_case.h"
#include "fathom/image/rgb_image.h"

/// The pictures of report.html as files, with legends. Small maps are enlarged by a whole factor,
/// of very large ones every k-th pixel is shown.
namespace fathom::validation {

/// What the pictures are called in the folder of a report.
inline constexpr const char *class_picture_name = "classes.png",
                            *difference_picture_name = "differences.png";

/// The class of each pixel, in the colours of the page, with how many there are.
/// Needs    a map.
/// Fails    OutputError if the font is missing.
RgbImage class_picture(const ValidationCase& validated);

/// Relative differences of depth, other minus exact: blue is nearer, orange farther. The scale ends
/// where 2 % of the differences lie beyond it. Needs and fails likewise.
RgbImage difference_picture(const ValidationCase& validated);

}  // namespace fathom::validation
