#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace fathom::test {

/// The results in report.json of a small `fathom validate --against`, which must succeed and say
/// nothing on standard error: 64×48 pixels, of each of the scenes, by each variant of the
/// renderers.
nlohmann::json results_of(const std::string& renderers, const std::string& scenes);

/// Whether the variant of a result asks for several samples per pixel, of which the driver says how
/// many it offers.
bool is_multisampled(const nlohmann::json& result);

/// Every pixel is explained, and by bounds that leave few of them open.
void expect_explained(const nlohmann::json& result);

}  // namespace fathom::test
