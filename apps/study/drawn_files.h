#pragma once

#include <string>
#include <vector>

#include "apps/study/study.h"
#include "fathom/image/rgb_image.h"

/// Plots and pictures as files.
namespace fathom::studies {

/// Runs a script, which ends with a plot command and sets no terminal, twice: for NAME.png and for
/// NAME.svg, `height` pixels high and 1100 wide. The script itself, as it can be run again, is
/// NAME.gp.
/// Fails    OutputError if gnuplot is missing or fails, with what it said.
std::vector<StudyFile> run_gnuplot(const std::string& name, const std::string& script,
                                   int height = 650);

/// The picture as a PNG file's content.
std::string png_bytes(const RgbImage& image);

/// A picture as a PNG; each pixel becomes a square of `scale` pixels.
/// Fails    OutputError.
StudyFile picture_file(const std::string& name, const RgbImage& image, std::uint32_t scale = 1);

}  // namespace fathom::studies
