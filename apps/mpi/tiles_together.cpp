#include "apps/mpi/tiles_together.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "apps/mpi/together.h"
#include "apps/mpi/triangle_messages.h"
#include "apps/shell/stopwatch.h"

// How to read this file: draw() is the whole story. Each rank has a part of the triangles and takes it
// in rounds. It finds the tiles of the image that they may touch, draws its own tiles, and sends the
// triangles that touch others to the ranks that draw these (sort-middle [MCEF94]).
namespace fathom::app {

TilesTogether::TilesTogether(const JobTogether& job, const Camera& camera, MapTraffic& traffic)
    : job_(job),
      ranks_(job.ranks),
      camera_(camera),
      traffic_(traffic),
      triangles_(job.scene.triangles()),
      own_(job.scene.part_of(job.ranks)) {}

void TilesTogether::draw(const std::function<void(double)>& progress) {
  together(ranks_, [&] {
    drawing_.emplace(triangles_, camera_, job_.plan.rendering,
                     TilesInRounds::Limits{.tile_bytes = job_.memory.tile_bytes,
                                           .kept_bytes = job_.memory.kept_bytes});
  });
  if (ranks_.greatest(own_.count()) <= job_.memory.triangles_at_once) {
    draw_at_once();
  } else {
    deal_out_by_sample();
    draw_in_rounds(progress);
  }
  together(ranks_, [&] { draw_received(); });
}

void TilesTogether::draw_at_once() {
  std::vector<std::uint64_t> counts(tiles_of(camera_).count(), 0);
  SortedTriangles sorted;
  together(ranks_, [&] {
    sorted = drawing_->sort(job_.scene.read(own_));
    sorted.count(counts);
  });
  deal_out_tiles(std::move(counts));
  together(ranks_, [&] {
    draw_read(sorted);
    sorted = {};
  });
  exchange();
}

// By as many triangles as a round has, taken all over the part; each stands for those around it.
void TilesTogether::deal_out_by_sample() {
  constexpr std::uint64_t places = 64;
  std::vector<std::uint64_t> counts(tiles_of(camera_).count(), 0);
  const std::uint64_t length = std::max<std::uint64_t>(1, job_.memory.triangles_at_once / places);
  std::uint64_t taken = 0;
  together(ranks_, [&] {
    std::vector<SomeTriangles> sample;
    for (std::uint64_t place = 0; place < places; ++place) {
      const TriangleRange some = own_.part(own_.count() * place / places, length);
      std::ranges::move(job_.scene.read(some), std::back_inserter(sample));
      taken += some.count();
    }
    drawing_->sort_again(std::move(sample)).count(counts);
  });
  if (taken != 0)
    for (std::uint64_t& count : counts) count = count * own_.count() / taken;
  deal_out_tiles(std::move(counts));
}

void TilesTogether::deal_out_tiles(std::vector<std::uint64_t> triangles) {
  ranks_.add_up(triangles);
  const ImageTiles tiles = tiles_of(camera_);
  owners_ = owners_of_tiles(job_.arguments.partition, tiles.columns, tiles.rows, triangles,
                            ranks_.count());
  std::vector<std::uint32_t> own;
  for (std::uint32_t tile = 0; tile < owners_.size(); ++tile)
    if (is_own(tile)) own.push_back(tile);
  together(ranks_, [&] { drawing_->choose(std::move(own)); });
}

// Ranks wait for each other after several rounds of each, so that a round that takes long in one of
// them is made up for; after fewer where one of them has many triangles for others, so that none is far
// ahead in the end.
void TilesTogether::draw_in_rounds(const std::function<void(double)>& progress) {
  constexpr std::uint64_t most_rounds = 128;
  const std::uint64_t at_once = job_.memory.triangles_at_once;
  std::uint64_t next = 0, left = 0, rounds_until_exchange = 1;
  do {
    std::uint64_t rounds = 0;
    together(ranks_, [&] {
      draw_received();
      while (rounds < rounds_until_exchange && next < own_.count() && !has_much_to_send()) {
        draw_read(drawing_->sort(job_.scene.read(own_.part(next, at_once))));
        next = std::min(next + at_once, own_.count());
        ++rounds;
      }
    });
    exchange();
    left = ranks_.greatest(own_.count() - next);
    const std::uint64_t more = next < own_.count() ? 2 * rounds : most_rounds;
    rounds_until_exchange = std::clamp<std::uint64_t>(ranks_.least(more), 1, most_rounds);
    // Drawing takes most of the time, and writing the rest: a tenth, say.
    if (progress)
      progress(0.9 * (1 - static_cast<double>(left) / static_cast<double>(own_.count() + 1)));
  } while (left != 0);
}

// Each rank gets as much from all others together as one of them may send.
bool TilesTogether::has_much_to_send() const {
  const std::size_t most = job_.memory.message_bytes / static_cast<std::size_t>(ranks_.count());
  return std::ranges::any_of(messages_, [&](const auto& each) { return each.size() >= most; });
}

// What touches tiles of other ranks is for them.
void TilesTogether::draw_read(const SortedTriangles& sorted) {
  messages_.resize(static_cast<std::size_t>(ranks_.count()));
  if (ranks_.count() > 1) {
    const std::vector<text::Bytes> more = messages_of(
        sorted.triangles(), sorted.touches([&](std::uint32_t tile) { return !is_own(tile); }),
        owners_, ranks_.count());
    for (std::size_t i = 0; i < more.size(); ++i) text::append(messages_[i], more[i]);
  }
  draw(sorted);
}

void TilesTogether::exchange() {
  messages_.resize(static_cast<std::size_t>(ranks_.count()));
  traffic_.of_triangles.add(messages_, ranks_.self());
  messages_ = ranks_.exchange(std::move(messages_), job_.memory.message_bytes);
}

void TilesTogether::draw_received() {
  draw(drawing_->sort_again(received_triangles(std::exchange(messages_, {}))));
}

void TilesTogether::draw(const SortedTriangles& sorted) {
  Stopwatch stopwatch;
  drawing_->draw(sorted);
  traffic_.drawing += stopwatch.lap();
  if (!job_.arguments.traffic.empty())
    traffic_.drawn += sorted.count_triangles([&](std::uint32_t tile) { return is_own(tile); });
}

bool TilesTogether::is_own(std::uint32_t tile) const {
  return owners_[tile] == ranks_.self();
}

DepthMap TilesTogether::rows(const TileRows& rows) {
  Stopwatch stopwatch;
  DepthMap map = drawing_->rows(rows.first, rows.end);
  traffic_.drawing += stopwatch.lap();
  return map;
}

}  // namespace fathom::app
