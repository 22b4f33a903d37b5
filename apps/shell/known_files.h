#pragma once

#include <filesystem>

namespace fathom::app {

/// Notes that this run reads `file`, so that no output may replace it. Ignores names that are not
/// files ("-", or names that cannot be opened).
void note_input(const std::filesystem::path& file);

/// Notes that this run writes the file at `place`; `target` is the user's name for it.
/// Fails    UsageError if it is an input or another output of this run.
void claim_output(const std::filesystem::path& target, const std::filesystem::path& place);

}  // namespace fathom::app
