#include "fathom/fast/lenses/places.h"

#include <algorithm>
#include <array>
#include <vector>

#include "fathom/fast/lenses/direction_places.h"
#include "fathom/fast/lenses/plane_places.h"
#include "fathom/threads/threads.h"

namespace fathom::fast {
using namespace place_arithmetic;

namespace {

/// Places with an error or a coordinate of that size are in no image of the plane.
constexpr double beyond_planes = 0x1p500;

bool is_usable(const Places::View& view) {
  return std::ranges::all_of(view.errors, [](double error) { return error < beyond_planes; }) &&
         (view.box.is_empty() || view.box.size() < beyond_planes);
}

}  // namespace

Places::View::View(const ViewAxes& the_axes, std::size_t tiles)
    : axes(the_axes), errors(tiles), boxes(tiles) {}

Places::Places(const Projection& projection, std::uint32_t width, std::uint32_t height)
    : projection_(projection),
      grid_(width, height),
      preimages_(projection, *projection.lens),
      x_(std::make_unique_for_overwrite<double[]>(samples())),
      y_(std::make_unique_for_overwrite<double[]>(samples())) {
  preimages_.stage() != nullptr&& is_plane(projection.lens->model) ? find_in_plane()
                                                                   : find_in_views();
  for (View& view : views_)
    for (const PlaneBox& box : view.boxes) view.box.add(box);
  are_usable_ = std::ranges::all_of(views_, is_usable);
  std::erase_if(views_, [](const View& view) { return view.box.is_empty(); });
  if (!views_.empty()) return;
  // Of an image without any ray.
  views_.emplace_back(all_views.front(), grid_.count()).box = {0, 0, 0, 0};
}

FoundPlaces Places::room_of(std::uint32_t tile) {
  const std::size_t first = std::size_t{tile} * TileShape::samples;
  return {{x_.get() + first, TileShape::samples}, {y_.get() + first, TileShape::samples}};
}

void Places::find_in_plane() {
  View& front = views_.emplace_back(all_views.front(), grid_.count());
  const PlanePlaces plane(preimages_, projection_, grid_);
  parallel_for(std::uint32_t{0}, grid_.count(), [&](std::uint32_t tile) {
    const PlanePlaces::OfTile found = plane.find(tile, room_of(tile));
    front.errors[tile] = found.error;
    front.boxes[tile] = found.box;
  });
}

void Places::find_in_views() {
  view_of_sample_ = std::make_unique<std::uint8_t[]>(samples());
  for (const ViewAxes& axes : all_views) views_.emplace_back(axes, grid_.count());
  const DirectionModel model(preimages_, projection_, grid_);
  std::vector<std::array<std::uint32_t, all_views.size()>> counts(grid_.count());
  parallel_for(std::uint32_t{0}, grid_.count(), [&](std::uint32_t tile) {
    const auto found = find_places(
        model, grid_, tile, room_of(tile),
        {view_of_sample_.get() + std::size_t{tile} * TileShape::samples, TileShape::samples});
    for (std::size_t v = 0; v < all_views.size(); ++v) {
      views_[v].errors[tile] = found[v].error;
      views_[v].boxes[tile] = found[v].box;
      counts[tile][v] = found[v].count;
    }
  });
  for (const auto& of_tile : counts)
    for (std::size_t v = 0; v < all_views.size(); ++v) views_[v].count += of_tile[v];
}

bool Places::is_whole(const View& view, std::uint32_t tile) const {
  return std::ranges::all_of(
      views_, [&](const View& other) { return &other == &view || other.boxes[tile].is_empty(); });
}

Places::OfTile Places::of_tile(const View& view, std::uint32_t tile, Room& room) const {
  const std::size_t first = std::size_t{tile} * TileShape::samples;
  OfTile of_tile{{x_.get() + first, TileShape::samples},
                 {y_.get() + first, TileShape::samples},
                 view.errors[tile],
                 view.boxes[tile],
                 is_whole(view, tile)};
  if (of_tile.is_whole || of_tile.box.is_empty()) return of_tile;
  for (std::size_t i = 0; i < TileShape::samples; ++i) {
    const bool is_here = all_views[view_of_sample_[first + i]] == view.axes;
    room.x[i] = is_here ? of_tile.x[i] : no_number;
    room.y[i] = is_here ? of_tile.y[i] : no_number;
  }
  of_tile.x = room.x;
  of_tile.y = room.y;
  return of_tile;
}

}  // namespace fathom::fast
