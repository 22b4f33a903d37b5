#pragma once

#include <string>

#include "fathom/image/depth_map.h"

namespace fathom {

/// What the codes of a 16-bit PNG mean, for programs that read no text chunks: a JSON object on one
/// line, with a line end.
///   channel   the channel that is written: that of this name, or the map's only one
///   unit      what `scale` counts: "codes per scene unit"
///   scale     a depth is code / scale; none of identifiers
///   none      the code where no surface is: 0; 65535 of identifiers
///   beyond    how many pixels show a surface that lies too deep for the codes and has `none`
///   width, height   pixels
/// Fails    UsageError if there is no such channel, or several of which none is named; InputError
///          if the map has a fault.
std::string png_sidecar(const DepthMap& map, const std::string& channel = "");

}  // namespace fathom
