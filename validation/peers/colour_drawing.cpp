#include "validation/peers/colour_drawing.h"

#include "validation/child/in_child.h"
#include "validation/peers/built_in_peers.h"

namespace fathom::validation {

template <>
struct Fields<GreyPicture> {
  template <class Visit, class S>
  static void each(Visit&& visit, S& s) {
    auto& [width, height, codes, version] = s;
    visit("width", width);
    visit("height", height);
    visit("codes", codes);
    visit("version", version);
  }
};

GreyPicture draw_colours_in_child(const std::function<LitScene()>& make, VtkShading shading,
                                  int seconds) {
  return in_child([&] { return draw_built_in_colours(make(), shading); },
                  {.name = "vtk", .seconds = seconds});
}

}  // namespace fathom::validation
