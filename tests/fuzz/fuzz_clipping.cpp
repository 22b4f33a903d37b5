#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "fathom/clipping/boolean_by_cgal.h"
#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/rings.h"
#include "fathom/clipping/weiler_atherton.h"
#include "fathom/failures/errors.h"
#include "tests/clipping/cgal_judge.h"
#include "tests/clipping/pieces.h"

namespace {

using namespace fathom;
using namespace fathom::clipping;

constexpr std::size_t most_corners = 40;

/// A byte is a corner on a grid of 8×8; a byte above 63 begins a ring, one above 127 the clip side.
struct Sides {
  Rings<double> subject, clip;
};

Sides sides_of(const std::uint8_t* data, std::size_t size) {
  Sides sides;
  Rings<double>* side = &sides.subject;
  for (std::size_t i = 0; i < size && i < most_corners; ++i) {
    if (data[i] > 127) side = &sides.clip;
    if (data[i] > 63 || side->empty()) side->emplace_back();
    side->back().push_back(
        {static_cast<double>(data[i] % 8), static_cast<double>(data[i] / 8 % 8)});
  }
  return sides;
}

void expect_one_line(const InputError& error) {
  if (std::string(error.what()).find('\n') != std::string::npos) std::abort();
}

}  // namespace

/// Small-integer polygons, so ties everywhere: an InputError of one line, or what CGAL's Boolean
/// set operations say, as a point set and in area. Over binary64 it comes to an end.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto [subject, clip] = sides_of(data, size);
  for (const SetOperation operation :
       {SetOperation::intersection, SetOperation::difference, SetOperation::join}) {
    try {
      const auto answer = weiler_atherton(to_exact(subject), to_exact(clip), operation);
      // CGAL takes no corners that repeat the one before.
      const test::Judge judge(checked_rings(to_exact(subject), "subject"),
                              checked_rings(to_exact(clip), "clip"));
      if (area_of(answer) != judge.area(operation)) std::abort();
      if (judge.fault(operation, answer) || test::piece_fault(answer)) std::abort();
      const auto cgal = boolean_by_cgal(to_exact(subject), to_exact(clip), operation);
      if (!std::equal(answer.begin(), answer.end(), cgal.begin(), cgal.end(),
                      [](const auto& p, const auto& q) {
                        return p.outline == q.outline && p.holes == q.holes;
                      }))
        std::abort();
    } catch (const InputError& error) {
      expect_one_line(error);
    }
    try {
      weiler_atherton(subject, clip, operation);
    } catch (const InputError& error) {
      expect_one_line(error);
    }
  }
  return 0;
}
