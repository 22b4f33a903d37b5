#include "apps/render/depth_buffer_options.h"

#include "apps/shell/values.h"

namespace fathom::app {

void DepthBufferArguments::add_to(Command& command) {
  command.option("--depth-format", "NAME", into(storage, storage_named),
                 "Add what a depth buffer would hold, channel Zwindow, and the depth decoded from "
                 "it, Zdecoded; near and far are the camera's. unorm16, unorm24, unorm32: the code "
                 "(UINT); float16, float32: the value (FLOAT); float64: the halves of its bits, "
                 "Zwindow.high and Zwindow.low (UINT)");
  command.option("--mapping", "NAME", into(mapping, mapping_named),
                 "Of --depth-format: standard (default), reversed, infinite, reversed-infinite, "
                 "opengl, linear, w, log or log-ulrich");
  command.option("--c", "C", into(c, parse_number),
                 "With --mapping log: the constant C (default 1)");
  command.flag("--against-exact", against_exact,
               "With --depth-format: add Zerror, Zdecoded minus the exact depth; Zwinner, the "
               "triangle that the format lets win; Zfight, 1 where that is the wrong one");
}

}  // namespace fathom::app
