#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/fragment.h"
#include "fathom/attribution/pixels/stored_values.h"
#include "fathom/mesh/mesh.h"

namespace fathom::attribution {

/// The allowed values of a sample with these fragments.
struct PixelVerdict {
  /// The greatest value that can be stored; infinite if no surface need be drawn.
  double cap = std::numeric_limits<double>::infinity();
  /// Some surface is certainly visible.
  bool must = false;
  /// Some surface would be visible if no sample between two triangles were missed.
  bool must_if_watertight = false;
};

/// `triangles` and `numbers` of the mesh. If a renderer is watertight, fragments that share all
/// edges that the model leaves open together count as certain (docs/validation.md, "Together").
PixelVerdict verdict_of(std::span<const Fragment> fragments, bool watertight,
                        std::span<const CornerIndices> triangles,
                        const std::vector<std::uint32_t>& numbers);

/// Verdict on one pixel.
struct PixelResult {
  PixelClass pixel_class = PixelClass::equal;
  /// may: a triangle may or may not be visible here. touched: some triangle is or may be drawn
  /// here.
  bool may = false, touched = false;
  /// The truth shows a surface. loose: besides, a triangle may be visible at depths that span more
  /// than the exact depth and half of the codes of 16 bits.
  bool shows_surface = false, loose = false;
  /// The visible triangle is certainly drawn, and no other triangle is near it in depth.
  bool alone = false;
  /// The pixel is unexplained and shows, of several equal triangles, a different one than the
  /// model's rule selects.
  bool wrong_tie = false;
  /// The triangle whose absence would explain it, if it is unexplained.
  std::uint32_t absent = no_surface;

  /// For the visible triangle: the depths that the model allows, in scene units, and their width in
  /// steps of the storage.
  struct Visible {
    Interval depths;
    double relative_width = 0, steps_width = 0;
  };
  std::optional<Visible> visible;
  /// The error of the depth, in scene units and relative, if both maps show the same surface.
  struct Error {
    double absolute = 0, relative = 0;
  };
  std::optional<Error> error;
  /// Stored minus expected window depth, if no other surface is near.
  std::optional<BiasSteps> bias;
};

/// Computes the allowed values of a pixel and the class of its stored value. Thread-safe. Truth and
/// map outlive it.
class PixelJudge {
 public:
  PixelJudge(const Truth& truth, const OtherMap& other, const RendererModel& model);

  /// `fragments`: all of the model's at the pixel.
  [[nodiscard]] PixelResult judge(std::size_t pixel, const std::vector<Fragment>& fragments) const;

 private:
  /// The query at one pixel.
  struct Pixel {
    std::size_t index = 0;
    const std::vector<Fragment>& fragments;
    PixelVerdict verdict;
    const Fragment* visible = nullptr;  ///< the fragment of the visible triangle
  };

  [[nodiscard]] Pixel pixel(std::size_t index, const std::vector<Fragment>& fragments) const;
  [[nodiscard]] const Fragment* explaining(const Pixel& p, double stored) const;
  [[nodiscard]] bool loses_to_an_equal(const Pixel& p, const Fragment& f) const;
  [[nodiscard]] bool shows_loser_of_equals(const Pixel& p) const;
  [[nodiscard]] bool is_explained_without(std::uint32_t triangle, const Pixel& p) const;
  [[nodiscard]] PixelClass classify(const Pixel& p) const;
  [[nodiscard]] PixelClass class_of_none(const Pixel& p) const;
  [[nodiscard]] PixelClass class_of_visible(const Pixel& p) const;
  [[nodiscard]] PixelClass class_of_another(const Pixel& p, const Fragment& seen) const;
  [[nodiscard]] bool is_loose(const Pixel& p) const;
  void measure(const Pixel& p, PixelResult& result) const;

  const Truth& truth_;
  const OtherMap& other_;
  bool watertight_;
  /// nullopt if the rule is unknown, or if the map has no numbers of triangles.
  std::optional<EqualDepths> equal_depths_;
  std::unique_ptr<const StoredValues> values_;
};

}  // namespace fathom::attribution
