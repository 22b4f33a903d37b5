// A line of `fathom clip`: the first byte says by which algorithm, the second in what form, the
// rest is the case. It has an answer, which is JSON, or an InputError of one line.
#include <cstdint>

#include "apps/textbook/clip/clip_algorithms.h"
#include "fathom/failures/errors.h"
#include "tests/fuzz/one_line.h"

namespace fathom::fuzz {
namespace {

using namespace app;
using Json = cases::Json;
using Algorithm = Json (*)(const Json&, cases::Form);

/// Cases are answered in times that grow with the square of their corners, or faster.
constexpr std::size_t longest_case = 2048;

template <class Number>
constexpr Algorithm algorithms[] = {
    clip::weiler_atherton<Number>, clip::sutherland_hodgman<Number>, clip::cohen_sutherland<Number>,
    clip::liang_barsky<Number>,    clip::homogeneous<Number>,        clip::plane<Number>};

}  // namespace
}  // namespace fathom::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fathom;
  using namespace fathom::fuzz;
  if (size < 2 || size > longest_case) return 0;
  const std::size_t chosen = data[0] % 6;
  const Algorithm algorithm =
      data[1] & 4 ? algorithms<double>[chosen] : algorithms<clipping::Rational>[chosen];
  try {
    Json name;
    const Json object =
        cases::parse_case({reinterpret_cast<const char*>(data + 2), size - 2}, name);
    const Json answer = algorithm(object, {(data[1] & 1) != 0, (data[1] & 2) != 0});
    if (answer.dump(-1, ' ', false, Json::error_handler_t::replace).empty()) std::abort();
  } catch (const InputError& error) {
    expect_one_line(error.what());
  }
  return 0;
}
