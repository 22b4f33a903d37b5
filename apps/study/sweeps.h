#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fathom/depth_format/depth_format.h"

/// Depth formats and depths as studies go through them.
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

/// `count` depths from near to far, both included, evenly spaced; the ends are exact.
/// Fails    UsageError for fewer than two, or more than 10 million.
std::vector<double> linear_samples(double near, double far, std::uint32_t count);

/// The same, evenly spaced in the logarithm.
std::vector<double> logarithmic_samples(double near, double far, std::uint32_t count);

}  // namespace fathom::studies
