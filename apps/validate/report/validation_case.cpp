#include "apps/validate/report/validation_case.h"

#include <fmt/format.h>

#include "apps/validate/report/reported_result.h"

namespace fathom::validation {

std::string pixel_text(const ValidationCase& c, std::size_t pixel) {
  return attribution::pixel_text(*c.truth, c.other, c.attribution, pixel);
}

std::string cause_of(const ValidationCase& c) {
  return c.is_done() ? attribution::cause_of(*c.truth, c.other, c.attribution) : c.failure;
}

std::string verdict_of(const ValidationCase& c) {
  return c.is_done() ? attribution::verdict_text(*c.truth, c.other, c.attribution)
                     : "not drawn: " + c.failure;
}

std::string verdict_of(const std::vector<ValidationCase>& cases) {
  if (cases.size() == 1) return verdict_of(cases.front());
  const ValidationCase* first = nullptr;
  std::size_t drawn = 0, failed = 0;
  for (const ValidationCase& c : cases) {
    if (!c.is_done()) continue;
    ++drawn;
    if (c.is_good()) continue;
    if (failed++ == 0) first = &c;
  }
  const std::string undrawn =
      drawn == cases.size() ? "" : fmt::format("; {} not drawn", cases.size() - drawn);
  if (drawn == 0) return "no map was drawn";
  if (first == nullptr) return fmt::format("every pixel of {} maps is explained{}", drawn, undrawn);
  return fmt::format("failed: {} of {} maps{}; the first is {}: {}", failed, drawn, undrawn,
                     title_of(*first), cause_of(*first));
}

}  // namespace fathom::validation
