#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "fathom/fast/tiles/tile.h"
#include "fathom/files/file_bytes.h"

// A packed tile as bytes, for a file.
namespace fathom::fast {

/// Adds what the tile is to `bytes`, Tile::most_packed_bytes at most.
void save(const Tile& tile, files::Bytes& bytes);

/// Makes a tile that was started where the saved one was the same as that: read(offset, to) reads
/// from its bytes.
using ReadSaved = std::function<void(std::uint64_t offset, std::span<std::byte> to)>;
void restore(const ReadSaved& read, Tile& tile);

}  // namespace fathom::fast
