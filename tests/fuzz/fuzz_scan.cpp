// A line of `fathom scan`: the first byte says by which algorithm, the second in which arithmetic
// and form, the rest is the case. It has an answer, which is JSON, or an InputError of one line.
#include <cstdint>

#include "apps/textbook/scan/scan_algorithms.h"
#include "fathom/failures/errors.h"
#include "tests/fuzz/one_line.h"

namespace fathom::fuzz {
namespace {

using namespace app;
using scan::Json;
using Algorithm = Json (*)(const Json&, const scan::Form&);

constexpr std::size_t longest_case = 2048;
/// What a case may ask for: as many pixels as its window has, or its coordinates span.
constexpr double greatest = 64;

template <class Number>
constexpr Algorithm algorithms[] = {scan::explicit_line<Number>,
                                    scan::dda<Number>,
                                    scan::bresenham<Number>,
                                    scan::midpoint<Number>,
                                    scan::diamond_exit<Number>,
                                    scan::even_odd<Number>,
                                    scan::non_zero<Number>,
                                    scan::flood,
                                    scan::edge_function<Number>,
                                    scan::scan_line<Number>,
                                    scan::inside<Number>,
                                    scan::convexity<Number>,
                                    scan::tessellate,
                                    scan::convex_hull<Number>};

/// Whether all numbers are small, or are those of attributes.
bool is_small(const Json& value) {
  if (value.is_number()) return std::abs(value.get<double>()) <= greatest;
  if (!value.is_structured()) return true;
  for (const auto& [key, member] : value.items()) {
    if (value.is_object() && (key == "attributes" || key == "w")) continue;
    if (!is_small(member)) return false;
  }
  return true;
}

Algorithm algorithm_from(std::uint8_t choice, std::uint8_t form) {
  const std::size_t i = choice % 14;
  switch (form % 3) {
    case 0:
      return algorithms<pipeline::Exact>[i];
    case 1:
      return algorithms<double>[i];
    default:
      return algorithms<float>[i];
  }
}

}  // namespace
}  // namespace fathom::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fathom;
  using namespace fathom::fuzz;
  if (size < 2 || size > longest_case) return 0;
  scan::Form form;
  form.numbers = {(data[1] & 8) != 0, (data[1] & 16) != 0};
  form.runs = (data[1] & 32) != 0;
  if (data[1] & 64) form.subpixel_bits = data[1] % 17;
  try {
    Json name;
    const Json object =
        app::cases::parse_case({reinterpret_cast<const char*>(data + 2), size - 2}, name);
    if (!is_small(object)) return 0;
    const Json answer = algorithm_from(data[0], data[1])(object, form);
    if (answer.dump(-1, ' ', false, Json::error_handler_t::replace).empty()) std::abort();
  } catch (const InputError& error) {
    expect_one_line(error.what());
  }
  return 0;
}
