#include "apps/view/page.h"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/page_data.h"
#include "apps/view/map_data.h"
#include "apps/view/web.h"
#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"
#include "fathom/image/preview.h"
#include "fathom/threads/threads.h"

namespace fathom::view {
namespace {

using Json = nlohmann::json;

/// 256 colours from the low end to the high one, as digits: "440154…".
std::string colour_digits(ColourMap colours) {
  constexpr int count = 256;
  constexpr char digits[] = "0123456789abcdef";
  std::string text;
  for (int k = 0; k < count; ++k) {
    for (const std::uint8_t part : colour_at(colours, static_cast<double>(k) / (count - 1))) {
      text += digits[part >> 4];
      text += digits[part & 15];
    }
  }
  return text;
}

Json colour_maps() {
  Json maps = Json::object();
  for (const ColourMap map : all_colour_maps) maps[std::string(name_of(map))] = colour_digits(map);
  return maps;
}

/// A module as it stands within one script with those that it imports.
void write_module(std::string_view text, const Sink& sink) {
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
    std::string_view line = text.substr(begin, end - begin);
    begin = end;
    if (line.starts_with("import ")) continue;
    if (line.starts_with("export ")) line.remove_prefix(std::string_view("export ").size());
    sink(line);
  }
}

/// The sink, up to so many bytes.
Sink limited(const Sink& sink, std::uint64_t most_bytes) {
  return [&sink, most_bytes, bytes = std::uint64_t{0}](std::string_view part) mutable {
    bytes += part.size();
    if (bytes > most_bytes) {
      throw OutputError(fmt::format(
          "the maps need a page of more than {:.1f} GiB, too large for a browser: show fewer maps, "
          "or one channel of a map ('fathom convert --channel')",
          std::ldexp(static_cast<double>(most_bytes), -30)));
    }
    sink(part);
  };
}

}  // namespace

void write_page(const std::vector<ViewedMap>& maps, Questions questions, const Sink& whole_sink,
                const std::function<void(double)>& progress, std::uint64_t most_bytes) {
  const Sink sink = limited(whole_sink, most_bytes);
  for (const std::string_view part : {web::head, web::style, web::body}) sink(part);
  Json data{{"maps", Json::array()},
            {"tile", tile_size},
            {"colours", colour_maps()},
            {"scales", names_of(all_colour_scales)},
            {"probes", questions == Questions::probes}};
  std::uint64_t tiles = 0;
  for (const ViewedMap& viewed : maps) tiles += count_tiles(viewed);
  Progress tiles_done(progress, tiles);
  for (std::size_t k = 0; k < maps.size(); ++k) {
    data["maps"].push_back(write_planes(maps[k], "m" + std::to_string(k), sink, tiles_done));
  }
  sink(app::script_data("view",
                        data.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)));
  sink("<script type=\"module\">\n");
  for (const std::string_view module :
       {web::numbers, web::planes, web::channels, web::colours, web::statistics, web::difference,
        web::state, web::painting, web::picture, web::reading, web::deep, web::probe,
        web::histogram, web::profile, web::comparison, web::controls, web::start}) {
    write_module(module, sink);
  }
  sink("</script>\n</body></html>\n");
}

}  // namespace fathom::view
