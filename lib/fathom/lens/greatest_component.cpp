#include "fathom/lens/greatest_component.h"

namespace fathom::lens {

ExactVector3 component(std::size_t k) {
  ExactVector3 form;
  form[k] = 1.0;
  return form;
}

ExactVector3 greatest_component(const ExactDirection& d) {
  std::array<double, 3> signs{};
  for (std::size_t k = 0; k < 3; ++k) {
    signs[k] = d.sign_of(component(k)) == Sign::negative ? -1 : 1;
  }
  std::size_t greatest = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    ExactVector3 difference;
    difference[k] = signs[k];
    difference[greatest] = -signs[greatest];
    if (d.sign_of(difference) == Sign::positive) greatest = k;
  }
  ExactVector3 form;
  form[greatest] = signs[greatest];
  return form;
}

}  // namespace fathom::lens
