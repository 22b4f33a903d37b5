// fathom-view: maps in a page for a browser, and a server that answers its questions.

#include "apps/shell/program.h"
#include "apps/view/view_command.h"

int main(int argc, char** argv) {
  return fathom::app::companion_main(argc, argv, "view", fathom::app::add_view);
}
