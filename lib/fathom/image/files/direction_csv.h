#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace fathom::image {

/// The numbers of a CSV file with a line `x,y,z` for each of `pixels` pixels, the first of which
/// may be a heading. Numbers are decimals, rounded once, or "nan". `name` is the file's for
/// messages.
/// Fails    InputError "NAME: line N: …".
std::vector<double> numbers_of_csv(std::string_view text, std::uint64_t pixels,
                                   const std::string& name);

}  // namespace fathom::image
