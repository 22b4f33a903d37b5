#include "apps/render/depth_buffer_options.h"

#include "apps/shell/values.h"

namespace fathom::app {

void DepthBufferArguments::add_to(Command& command) {
  command.option("--depth-format", "NAME", into(storage, storage_named),
                 "Add channel Zwindow, the value in a depth buffer of this format, and Zdecoded, "
                 "the depth decoded from it; near and far are the camera's. unorm16, unorm24, "
                 "unorm32: code (UINT); float16, float32: value (FLOAT); float64: halves of its "
                 "bits, Zwindow.high and Zwindow.low (UINT)");
  command.option("--mapping", "NAME", into(mapping, mapping_named),
                 "Mapping of --depth-format: standard (default), reversed, infinite, "
                 "reversed-infinite, opengl, linear, w, log or log-ulrich");
  command.option("--c", "C", into(c, parse_number), "Constant C of --mapping log (default 1)");
  command.flag("--against-exact", against_exact,
               "Add Zerror (Zdecoded minus the exact depth), Zwinner (the triangle that wins in "
               "this format) and Zfight (1 where the wrong triangle wins); needs --depth-format");
}

}  // namespace fathom::app
