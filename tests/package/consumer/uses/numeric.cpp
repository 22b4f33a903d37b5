#include <fathom/numeric/rounding.h>

bool use_numeric() {
  return fathom::round_to_binary64(fathom::Ratio(1.0, 3.0)) == 1.0 / 3;
}
