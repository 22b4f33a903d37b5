#include "fathom/lens/rational_direction.h"

#include <utility>

namespace fathom {

RationalDirection::RationalDirection(ExactVector3 vector, Dyadic scale)
    : vector_(std::move(vector)), scale_(std::move(scale)) {}

Sign RationalDirection::sign(const QuadraticForm& form) const {
  const auto& [x, y, z] = vector_;
  return (x * (form.xx * x + form.xy * y + form.xz * z) + y * (form.yy * y + form.yz * z) +
          form.zz * z * z)
      .sign();
}

std::array<Enclosure, 3> RationalDirection::enclosure(long /*bits*/) const {
  const auto component = [this](std::size_t i) {
    const Ratio value(vector_[i], scale_);
    return Enclosure{value, value};
  };
  return {component(0), component(1), component(2)};
}

std::array<Interval, 3> RationalDirection::box() const {
  const Interval scale = enclose(scale_);
  return {quotient(enclose(vector_[0]), scale), quotient(enclose(vector_[1]), scale),
          quotient(enclose(vector_[2]), scale)};
}

}  // namespace fathom
