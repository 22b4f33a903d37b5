#pragma once

#include <cstdint>
#include <vector>

#include "fathom/attribution/attribution.h"

namespace fathom::attribution {

/// Rows that are judged together.
inline constexpr std::uint32_t rows_per_band = 8;

/// attribute() of some bands, numbered from the top. All other pixels count as equal, and in no
/// further figure.
Attribution attribute_bands(const Truth& truth, const OtherMap& other, const RendererModel& model,
                            const std::vector<std::uint32_t>& bands);

}  // namespace fathom::attribution
