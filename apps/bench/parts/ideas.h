#pragma once

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "apps/bench/parts/edge_setup.h"
#include "apps/bench/parts/exact_picture.h"
#include "fathom/pipeline/options.h"
#include "fathom/rendering/options.h"
#include "fathom/rendering/rendered.h"
#include "validation/scenes/scenes.h"

namespace fathom::bench {

/// Something counted while drawing, which says why a variant takes its time.
struct Count {
  std::string name;
  double value = 0;
};
using Counts = std::vector<Count>;

/// One way of drawing a scene.
struct Variant {
  std::string name;
  /// The variant that its time is compared with, by its place in the idea: its own for a plain one.
  std::size_t plain = 0;
  /// Not timed; comes before draw().
  std::function<void()> prepare = [] {};
  std::function<void()> draw;
  /// What was drawn last, and what was counted; and what has to be drawn.
  std::function<Picture()> picture;
  std::function<Counts()> counts = [] { return Counts(); };
  std::shared_ptr<const Picture> expected;
  /// Whether pixels that differ are counted instead of refused: of arithmetic that is not exact.
  bool may_differ = false;
};

/// One idea that makes drawing faster, switched on and off.
struct Idea {
  /// "lanes of binary32"
  std::string name;
  std::vector<Variant> variants;
  /// What a reader of the table has to know; a sentence or none.
  std::string note;
};

struct VariantTimes {
  std::string name, plain;
  /// In increasing order; not empty.
  std::vector<double> milliseconds;
  /// How many times as fast as the plain variant, by the least time of each: others that use the
  /// machine can only add to a time, and more to a long one.
  double speed_up = 1;
  Counts counts;

  [[nodiscard]] double median_ms() const;
};

struct IdeaTimes {
  std::string name, note;
  std::vector<VariantTimes> variants;
};

/// A variant drew something else than it has to: its time would mean nothing.
class WrongPicture : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// Draws with every variant once, untimed, and compares the pictures; then times all of them in
/// turn, `repeat` times, so that what else the machine does falls on all. A time is the least of
/// the draws of 30 milliseconds, or that of a single one that takes longer. Starts no round after
/// 20 seconds.
/// Fails    WrongPicture: the variant, and how many pixels differ.
IdeaTimes time_idea(const Idea& idea, int repeat);

// The ideas, one file each. What they draw is kept by their variants; the scene has to outlive
// them.

/// A scene to draw, as it is and as it reaches scan conversion.
struct PartsScene {
  explicit PartsScene(BenchScene its_scene)
      : bench(std::move(its_scene)), window(snapped(bench)), setups(set_up_edges(window)) {}
  BenchScene bench;
  SnappedScene window;
  std::vector<EdgeSetup> setups;
};

/// 1, 2, 4, 8 and 16 pixels of a row at once: in binary32, in binary64, and the fast engine with
/// each width of vectors that the processor has.
std::vector<Idea> lanes(const PartsScene& scene);
/// Blocks of pixels before pixels: in the textbook's loop, in the pipeline, in the fast engine.
std::vector<Idea> blocks(const PartsScene& scene);
/// The depth test before shading, and the fast engine's rejection of blocks, by the order in which
/// triangles are drawn.
std::vector<Idea> early_rejection(const PartsScene& scene);
/// Tiles with a z-buffer of their own, of several sizes, beside the whole image.
std::vector<Idea> tiles(const PartsScene& scene);
/// One thread and more.
std::vector<Idea> threads(const PartsScene& scene, const std::vector<int>& counts);
/// Back faces left out; no idea where that changes the picture, as it does if a mesh is not closed.
std::vector<Idea> culling(const PartsScene& scene);

/// "lanes", "blocks", "early-rejection", "tiles", "threads", "culling".
const std::vector<std::string>& idea_names();
/// The ideas of a name. Fails    UsageError if there is none.
std::vector<Idea> ideas_named(const std::string& name, const PartsScene& scene,
                              const std::vector<int>& thread_counts);

/// Variants that draw with the pipeline and the fast engine; the picture of the latter is channel
/// Z.

/// The options of the pipeline's variants: without shading, so that no picture is made.
pipeline::PipelineOptions plain_pipeline();
/// The pipeline by `options`; counts: what it counted. The picture is what the depth buffer holds
/// in the end and, with shading, the colours. (Surfaces that are equally near to the depth buffer
/// need not be so to channel Z, and then their order shows in it.)
Variant pipeline_variant(std::string name, const BenchScene& bench,
                         const pipeline::PipelineOptions& options,
                         std::function<Counts(const pipeline::PipelineStatistics&)> counts);
/// The fast engine, channel Z.
Variant fast_variant(std::string name, const BenchScene& bench, const RenderOptions& options,
                     std::function<Counts(const RenderStatistics&)> counts);

/// Draws once; what a variant draws is what those compared with it have to draw.
std::shared_ptr<const Picture> picture_of(const Variant& variant);

/// Appends a plain variant and those that are compared with it, all of which have to draw the same.
void add_group(std::vector<Variant>& variants, std::vector<Variant> group);

}  // namespace fathom::bench
