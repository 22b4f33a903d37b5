#pragma once

#include "fathom/geometry/frames.h"
#include "fathom/lens/exact_direction.h"
#include "fathom/numeric/certified.h"

namespace fathom::triangle {

/// Where a triangle is looked at: a sample of an image of straight edges, or the ray of a sample
/// where a camera bends rays. The linear forms of a triangle are functions of (u, v) there, or of
/// the direction of the ray (specification, sections 2 and 4).
class Sample {
 public:
  Sample(const ImagePoint& point) : point_(point) {}
  /// `direction` must outlive the sample.
  explicit Sample(const lens::ExactDirection& direction) : direction_(&direction) {}

  [[nodiscard]] const ImagePoint& point() const { return point_; }
  /// nullptr: the image has straight edges.
  [[nodiscard]] const lens::ExactDirection* direction() const { return direction_; }

  /// An interval that contains the value of a form.
  [[nodiscard]] Interval enclose(const LinearForm& form) const {
    return direction_ ? form.enclose_at(direction_->box()) : form.enclose_at(point_.u, point_.v);
  }
  /// The sign of a form.
  [[nodiscard]] Sign sign_of(const LinearForm& form, TierCounts& counts) const {
    return direction_ ? sign_at_ray(form, counts) : form.sign_at(point_.u, point_.v, counts);
  }

 private:
  [[nodiscard]] Sign sign_at_ray(const LinearForm& form, TierCounts& counts) const {
    const Interval value = enclose(form);
    if (value.lower > 0 || value.upper < 0) {
      ++counts.interval;
      return value.lower > 0 ? Sign::positive : Sign::negative;
    }
    ++counts.exact;
    return direction_->sign_of(form.coefficients());
  }

  ImagePoint point_;
  const lens::ExactDirection* direction_ = nullptr;
};

}  // namespace fathom::triangle
