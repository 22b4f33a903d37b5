#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fathom/image/channel_table.h"
#include "fathom/numeric/certified.h"

namespace fathom {

enum class Engine { reference, fast };
enum class Cull { none, back, front };

/// How Z and distance are rounded: once from the exact number, whatever the file.
struct DepthEncoding {
  enum class Type { binary32, binary64, scaled_unorm16 } type = Type::binary32;
  /// For scaled_unorm16: codes per unit; code = round-half-even(scale·D), 0 for no surface. A depth
  /// whose code would be 0 or above 65535 is an OutputError that names the pixel.
  double scale = 1000;
};

/// What was decided how. The fast engine asks fewer questions: it does not count as degenerate or
/// culled a triangle that reaches behind the camera and misses the image, and as covered only
/// samples where the triangle was not behind one drawn before.
struct RenderStatistics {
  std::uint64_t triangles = 0;
  std::uint64_t degenerate_triangles = 0;  // Δ = 0, seen edge on
  std::uint64_t culled_triangles = 0;
  std::uint64_t samples_tested = 0;
  std::uint64_t samples_covered = 0;
  std::uint64_t pixels_with_surface = 0;
  TierCounts facing, edges, visibility, range;
  /// Signs that channel A asked for.
  TierCounts coverage;

  // The fast engine alone:
  /// Pixels whose coverage is neither 0 nor 1 at sight: settled by a bound, and by exact numbers.
  TierCounts coverage_rounding;
  /// Values rounded from an interval, and values written from exact numbers.
  TierCounts rounding;
  /// Of rounding.interval: those that binary64 did not settle, but double-words did.
  std::uint64_t double_word_roundings = 0;
  /// How often a triangle was set up from exact numbers, once for each tile that it meets.
  std::uint64_t exact_setups = 0;
  /// Of visibility.exact: settled by the two triangles' lying in one plane.
  std::uint64_t same_plane = 0;
  /// Of edges.exact, visibility.exact and range.exact: settled by double-words.
  std::uint64_t double_words = 0;
  /// How often a triangle was set up with corners exactly on the grid on which edge functions have
  /// no error, once for each tile.
  std::uint64_t grid_setups = 0;
};

/// Adds the counts of a part of the work; not `triangles`, which is known beforehand.
void add(RenderStatistics& sum, const RenderStatistics& part);

/// What the fast engine may leave out or do more carefully: its time changes, never its map.
struct FastSwitches {
  /// Blocks of samples are tested before samples.
  bool hierarchy = true;
  /// Blocks behind what is drawn already are skipped.
  bool early_rejection = true;
  /// By how much bounds of edge functions, of q and of areas are widened; at least 1.
  double widening = 1;
  /// Where set, gets the pixels (row · width + column) at which such a bound did not settle a
  /// decision about an edge, the range, visibility, the rounding of Z or of A; some of them twice.
  std::vector<std::uint64_t>* doubtful = nullptr;
};

struct RenderOptions {
  Engine engine = Engine::fast;
  std::vector<Channel> channels{Channel::Z};
  Cull cull = Cull::none;
  DepthEncoding depth_encoding;
  FastSwitches fast;
  /// Threads to use; 0: all.
  int threads = 0;
  /// Called now and then, from any thread but never from two at once, with the share done in [0,
  /// 1].
  std::function<void(double)> progress;
  /// Where set, filled in.
  RenderStatistics* statistics = nullptr;
};

}  // namespace fathom
