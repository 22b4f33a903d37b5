// Which triangles are hidden by the surfaces of a tile, several at once.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fathom/fast/tiles/visible_triangles.cpp"
#include "fathom/fast/tiles/visible_triangles.h"

#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "fathom/fast/tiles/farthest-inl.h"
#include "fathom/fast/tiles/tile.h"

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

std::size_t visible_triangles(Tile& tile, std::span<const TileEntry> entries,
                              std::uint32_t* numbers) {
  FarthestOfBlocks farthest;
  if (!find_farthest(tile, farthest)) {
    std::transform(entries.begin(), entries.end(), numbers,
                   [](const TileEntry& entry) { return entry.number; });
    return entries.size();
  }
  return leave_out_hidden(farthest, entries, numbers);
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fathom::fast {

HWY_EXPORT(visible_triangles);

std::span<const std::uint32_t> VisibleTriangles::numbers_of(std::span<const TileEntry> some) {
  std::transform(some.begin(), some.end(), numbers_.begin(),
                 [](const TileEntry& entry) { return entry.number; });
  return std::span(numbers_).first(some.size());
}

std::span<const std::uint32_t> VisibleTriangles::visible_of(std::span<const TileEntry> some,
                                                            Tile& tile) {
  const std::size_t count = HWY_DYNAMIC_DISPATCH(visible_triangles)(tile, some, numbers_.data());
  return std::span(numbers_).first(count);
}

}  // namespace fathom::fast
#endif
