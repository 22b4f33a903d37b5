#pragma once

#include <cstddef>
#include <filesystem>

namespace fathom::app {

/// Writes all of the bytes to an open file that the user calls `target`.
/// Fails    OutputError: "TARGET: why".
void write_all(int descriptor, const char* data, std::size_t size,
               const std::filesystem::path& target);

/// Fails    OutputError: "TARGET: " and what the system says about this errno.
[[noreturn]] void fail_with_errno(const std::filesystem::path& target, int error);

}  // namespace fathom::app
