#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace fathom::app {

/// Numbers on the command line. `option` is named in the message of a failure.
/// Exact    decimal text is rounded once, to binary64.
/// Fails    UsageError: "--option: 'text' is not …".

/// A finite number.
double parse_number(const std::string& option, std::string_view text);
/// An integer in [least, 2³² − 1].
std::uint32_t parse_count(const std::string& option, std::string_view text,
                          std::uint32_t least = 0);
/// "1280x720".
std::array<std::uint32_t, 2> parse_size(const std::string& option, std::string_view text);
/// "X,Y".
std::array<std::uint32_t, 2> parse_pixel(const std::string& option, std::string_view text);
/// "AZIMUTH,ELEVATION".
std::array<double, 2> parse_pair(const std::string& option, std::string_view text);
/// "X,Y,Z".
std::array<double, 3> parse_vector(const std::string& option, std::string_view text);

/// The parts of a text between commas.
std::vector<std::string> split_list(std::string_view text);

/// Refuses a picture's name that does not end in .png.
void expect_png(const std::string& option, const std::string& name);

}  // namespace fathom::app
