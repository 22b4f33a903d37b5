#include "apps/textbook/cases/steps_picture.h"

#include "apps/shell/output_place.h"
#include "fathom/failures/errors.h"

namespace fathom::app::cases {

std::string parse_svg_name(const std::string& text) {
  if (!text.ends_with(".svg") && !is_written_through(text))
    throw UsageError("'" + text + "' does not end in .svg");
  return text;
}

}  // namespace fathom::app::cases
