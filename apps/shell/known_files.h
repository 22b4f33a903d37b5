#pragma once

#include <filesystem>

namespace fathom::app {

/// This run reads `file`: no output of it may take its place. Names that are no file are passed
/// over ("-", or what cannot be opened anyhow).
void note_input(const std::filesystem::path& file);

/// This run writes the file at `place`, which the user calls `target`.
/// Fails    UsageError if it is an input or another output of this run.
void claim_output(const std::filesystem::path& target, const std::filesystem::path& place);

}  // namespace fathom::app
