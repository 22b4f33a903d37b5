#include "apps/shell/program_main.h"

int main(int argc, char** argv) {
  using namespace fathom::app;
  return program_main(
      argc, argv,
      {add_render, add_probe, add_info, add_preview, add_compare, add_convert, add_camera, add_clip,
       add_scan, add_pipeline, add_visible, add_coplanar, add_depth, add_study});
}
