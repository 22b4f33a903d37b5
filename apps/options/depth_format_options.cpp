#include "apps/options/depth_format_options.h"

#include <limits>

#include "apps/shell/numbers.h"
#include "fathom/numeric/errors.h"

namespace fathom::app {

void DepthFormatOptions::add_to(CLI::App& command) {
  command.add_option("--mapping", mapping,
                     "standard (default), reversed, infinite, reversed-infinite, opengl, linear, "
                     "w, log or log-ulrich");
  command.add_option("--storage", storage,
                     "unorm16, unorm24, unorm32, float16, float32 (default) or float64");
  command.add_option("--near", near, "Least depth")->required();
  command.add_option("--far", far,
                     "Greatest depth; inf, which infinite and reversed-infinite default to");
  command.add_option("--c", c, "The constant C of log (default 1)");
}

DepthFormat DepthFormatOptions::format() const {
  DepthFormat format{mapping_named(mapping), storage_named(storage)};
  format.near = parse_number("--near", near);
  if (!far.empty()) {
    format.far = parse_far("--far", far);
  } else if (takes_infinite_far(format.mapping)) {
    format.far = std::numeric_limits<double>::infinity();
  } else {
    throw UsageError("--far is needed by mapping " + mapping);
  }
  if (!c.empty()) {
    if (format.mapping != Mapping::log) {
      throw UsageError("--c: mapping " + mapping + " has no constant C; log alone has one");
    }
    format.c = parse_number("--c", c);
  }
  require_meaningful(format);
  return format;
}

double parse_far(const std::string& option, const std::string& text) {
  if (text == "inf" || text == "infinity" || text == "+inf") {
    return std::numeric_limits<double>::infinity();
  }
  return parse_number(option, text);
}

}  // namespace fathom::app
