#pragma once

#include <string>

#include "fathom/depth_format/depth_format.h"

/// Depth formats as studies go through them.
namespace fathom::studies {

/// far is +∞ where the mapping takes that.
DepthFormat format_between(double near, double far, Mapping mapping, Storage storage);

/// Whether a pipeline's matrices can compute the mapping.
bool is_projection(Mapping mapping);

/// "standard unorm24"
std::string label_of(const DepthFormat& format);
/// "standard-unorm24", for names of files
std::string file_name_of(const DepthFormat& format);

/// Names in a row with the member `format`.
inline constexpr auto mapping_of = [](const auto& row) { return name_of(row.format.mapping); };
inline constexpr auto storage_of = [](const auto& row) { return name_of(row.format.storage); };

}  // namespace fathom::studies
