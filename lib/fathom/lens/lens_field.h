#pragma once

#include <optional>

#include "fathom/lens/exact_direction.h"
#include "fathom/camera/lens.h"
#include "fathom/lens/sample_plane.h"

namespace fathom {

/// A lens in front of a camera: which direction each sample of its image sees (specification,
/// section 2).
///
/// Threads  immutable; any number of threads may ask at once.
class LensField {
 public:
  /// Of a valid perspective projection and a valid lens. Finds the disc on which the lens is used.
  LensField(const Projection& projection, const Lens& lens);

  /// The direction that the sample (u, v) sees; nullopt if it sees none. u and v in pixels from
  /// the top left corner of the image, the centre of the top left pixel is (½, ½).
  [[nodiscard]] std::optional<ExactDirection> preimage(const Dyadic& u, const Dyadic& v) const;

 private:
  SamplePlane plane_;
  Lens lens_;
};

}  // namespace fathom
