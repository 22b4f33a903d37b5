#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace fathom::checks {

/// All that stands between two marks.
std::vector<std::string> texts_between(const std::string& page, const std::string& begin,
                                       const std::string& end);

/// Expects that every picture of a study's page is a file, and that its caption has the command
/// that makes it. Gives the number of pictures.
std::size_t expect_pictures(const std::string& page,
                            const std::function<bool(const std::string& name)>& is_file);

}  // namespace fathom::checks
