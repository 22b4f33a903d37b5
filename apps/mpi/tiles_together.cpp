#include "apps/mpi/tiles_together.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "apps/mpi/together.h"
#include "apps/mpi/triangle_mail.h"
#include "apps/shell/console.h"

// How to read this file: draw() is the whole story. Each rank has a part of the triangles and takes
// it in rounds. It finds the tiles of the image that they may touch, draws its own tiles, and sends
// the triangles that touch others to the ranks that draw these (sort-middle [MCEF94]).

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
  const bool is_one_round = ranks_.greatest(own_.count()) <= job_.memory.triangles_at_once;
  std::optional<SortedTriangles> all;
  if (is_one_round) {
    all = deal_out_by_all();
  } else {
    deal_out_by_sample();
  }
  together(ranks_, [&] {
    TriangleMail mail(ranks_, job_.memory.waiting_bytes, traffic_.of_triangles,
                      [&](std::vector<SomeTriangles> received) {
                        draw(drawing_->sort_again(std::move(received)));
                      });
    if (all) {
      draw_read(*all, mail);
    } else {
      draw_in_rounds(mail, progress);
    }
    all.reset();
    mail.end();
  });
}

SortedTriangles TilesTogether::deal_out_by_all() {
  std::vector<std::uint64_t> counts(tiles_of(camera_).count(), 0);
  SortedTriangles all;
  together(ranks_, [&] {
    all = drawing_->sort(job_.scene.read(own_));
    all.count(counts);
  });
  deal_out_tiles(std::move(counts));
  return all;
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

// Each rank at its own pace: what others send is drawn between rounds.
void TilesTogether::draw_in_rounds(TriangleMail& mail,
                                   const std::function<void(double)>& progress) {
  const std::uint64_t at_once = job_.memory.triangles_at_once;
  for (std::uint64_t next = 0; next < own_.count() && !mail.is_given_up(); next += at_once) {
    draw_read(drawing_->sort(job_.scene.read(own_.part(next, at_once))), mail);
    // Drawing takes most of the time, and writing the rest: a tenth, say.
    if (progress) progress(0.9 * static_cast<double>(next) / static_cast<double>(own_.count()));
  }
}

// What touches tiles of other ranks is sent there, some triangles at a time: copies of all would
// take nearly as much memory as the round.
void TilesTogether::draw_read(const SortedTriangles& sorted, TriangleMail& mail) {
  draw(sorted);
  if (ranks_.count() == 1) return;
  std::vector<TileTouch> touches =
      sorted.touches([&](std::uint32_t tile) { return !is_own(tile); });
  std::ranges::sort(touches, {}, &TileTouch::triangle);
  const std::size_t at_once = job_.memory.sent_at_once;
  for (auto first = touches.begin(); first != touches.end();) {
    auto end = first + static_cast<std::ptrdiff_t>(std::min<std::size_t>(
                           at_once, static_cast<std::size_t>(touches.end() - first)));
    // A triangle goes to each rank once.
    while (end != touches.end() && end->triangle == (end - 1)->triangle) ++end;
    mail.send(messages_of(sorted.triangles(), {first, end}, owners_, ranks_.count()));
    first = end;
  }
  mail.receive();
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
