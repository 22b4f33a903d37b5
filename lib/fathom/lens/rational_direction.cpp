#include "fathom/lens/rational_direction.h"

#include <utility>

namespace fathom {

RationalDirection::RationalDirection(ExactVector3 vector, Dyadic scale)
    : vector_(std::move(vector)), scale_(std::move(scale)) {}

std::array<Interval, 3> RationalDirection::box() const {
  const Interval scale = enclose(scale_);
  return {quotient(enclose(vector_[0]), scale), quotient(enclose(vector_[1]), scale),
          quotient(enclose(vector_[2]), scale)};
}

}  // namespace fathom
