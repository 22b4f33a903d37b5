#pragma once

#include <ImfHeader.h>

#include "fathom/image/depth_map.h"
#include "fathom/image/map_files.h"

namespace fathom::image {

/// What the format calls it.
Imf::Compression compression_of(Compression compression);
/// How many rows of pixels are compressed together.
std::uint32_t rows_of_a_chunk(Compression compression);

/// Puts the map's texts, its camera and the names of its objects into an EXR header.
void set_attributes(Imf::Header& header, const DepthMap& map);

/// Reads them back; every string attribute becomes a text.
void get_attributes(const Imf::Header& header, DepthMap& map);

}  // namespace fathom::image
