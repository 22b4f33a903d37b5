#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace fathom::testing {

/// Expects that every picture of a study's page is a file, and that its caption has the command
/// that makes it. Gives the number of pictures.
std::size_t expect_pictures(const std::string& page,
                            const std::function<bool(const std::string& name)>& is_file);

}  // namespace fathom::testing
