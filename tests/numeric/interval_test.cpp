#include "fathom/numeric/interval.h"

namespace fathom {
namespace {

static_assert(-Sign::negative == Sign::positive && -Sign::zero == Sign::zero);
static_assert(Sign::negative * Sign::negative == Sign::positive);
static_assert(Sign::negative * Sign::positive == Sign::negative);
static_assert(Sign::positive * Sign::zero == Sign::zero);
static_assert(sign_of(-17) == Sign::negative && sign_of(0) == Sign::zero);
static_assert(sign_of(1 << 30) == Sign::positive);

}  // namespace
}  // namespace fathom
