#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "apps/mpi/ranks.h"
#include "apps/mpi/waiting_chunks.h"
#include "fathom/files/file_bytes.h"
#include "fathom/image/depth_map.h"
#include "fathom/image/map_files.h"

namespace fathom::app {

/// An EXR that the first rank writes, chunk by chunk, as they come from the ranks that have the rows
/// (image/exr_bands.h): it never holds more of the image than its own chunks and one other. Called by
/// all ranks, with the chunks of their bands, which are used up.
/// `path`       in the first rank, where the file is; `beginning`: what it begins with
/// `of_chunks`  the rank of each chunk
/// Fails    after all has been sent: in the first rank OutputError; InputError where own chunks cannot be taken.
void write_banded_exr(const Ranks& ranks, const std::filesystem::path& path,
                      const files::Bytes& beginning, std::span<const int> of_chunks,
                      std::uint32_t rows_of_chunk, WaitingChunks& own_chunks);

}  // namespace fathom::app
