#include "fathom/pipeline/scan/flood_fill.h"

#include "fathom/threads/interruption.h"

namespace fathom::pipeline {
namespace {

class Flood {
 public:
  Flood(const CharacterGrid& grid, char colour, Connectivity connectivity)
      : grid_(grid),
        colour_(colour),
        reach_(connectivity == Connectivity::eight ? 1 : 0),
        filled_(grid.size()) {
    for (std::size_t y = 0; y < grid.size(); ++y) filled_[y].resize(grid[y].size(), false);
  }

  void run(const Pixel& seed) {
    waiting_.push_back(seed);
    while (!waiting_.empty()) {
      check_interruption();
      const Pixel p = waiting_.back();
      waiting_.pop_back();
      if (is_open(p)) fill_span(p);
    }
  }

  [[nodiscard]] std::vector<Pixel> pixels() const {
    std::vector<Pixel> result;
    for (std::int64_t y = 0; y < height(); ++y)
      for (std::int64_t x = 0; x < width(); ++x)
        if (filled_[y][x]) result.push_back({x, y});
    return result;
  }

 private:
  [[nodiscard]] std::int64_t height() const { return static_cast<std::int64_t>(grid_.size()); }
  [[nodiscard]] std::int64_t width() const {
    return static_cast<std::int64_t>(grid_.front().size());
  }
  [[nodiscard]] bool is_open(const Pixel& p) const {
    return p.x >= 0 && p.y >= 0 && p.x < width() && p.y < height() && grid_[p.y][p.x] == colour_ &&
           !filled_[p.y][p.x];
  }

  void fill_span(const Pixel& p) {
    std::int64_t left = p.x, right = p.x;
    while (is_open({left - 1, p.y})) --left;
    while (is_open({right + 1, p.y})) ++right;
    for (std::int64_t x = left; x <= right; ++x) filled_[p.y][x] = true;
    for (const std::int64_t y : {p.y - 1, p.y + 1}) {
      bool in_run = false;  // one seed for each run of open pixels is enough
      for (std::int64_t x = left - reach_; x <= right + reach_; ++x) {
        const bool open = is_open({x, y});
        if (open && !in_run) waiting_.push_back({x, y});
        in_run = open;
      }
    }
  }

  const CharacterGrid& grid_;
  char colour_;
  std::int64_t reach_;
  std::vector<std::vector<bool>> filled_;
  std::vector<Pixel> waiting_;
};

}  // namespace

std::vector<Pixel> flood_fill(const CharacterGrid& grid, const Pixel& seed,
                              Connectivity connectivity) {
  const auto height = static_cast<std::int64_t>(grid.size());
  if (seed.y < 0 || seed.y >= height) return {};
  if (seed.x < 0 || seed.x >= static_cast<std::int64_t>(grid[seed.y].size())) return {};
  Flood flood(grid, grid[seed.y][seed.x], connectivity);
  flood.run(seed);
  return flood.pixels();
}

}  // namespace fathom::pipeline
