#include "apps/options/cull_option.h"

#include "apps/shell/values.h"

namespace fathom::app {
namespace {

Cull parse_cull(const std::string& text) {
  return parse_word<Cull>(text,
                          {{"back", Cull::back}, {"front", Cull::front}, {"none", Cull::none}});
}

}  // namespace

void add_cull_option(Command& command, Cull& cull) {
  command.option(
      "--cull", "NAME", into(cull, parse_cull),
      "Leave out triangles that show their back or front: back, front or none (default)");
}

}  // namespace fathom::app
