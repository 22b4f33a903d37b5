#include "apps/view/page.h"

#include <fmt/core.h>
#include <libdeflate.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>

#include "apps/page_data.h"
#include "apps/view/map_data.h"
#include "apps/view/web.h"
#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"
#include "fathom/image/preview.h"
#include "fathom/text/base64.h"
#include "fathom/text/parse_json.h"
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

namespace {

/// Classes of pixels are numbered in the order of the report.
using OrderedJson = nlohmann::ordered_json;
using Bytes = std::vector<std::uint8_t>;
using Words = std::vector<std::uint32_t>;

constexpr std::string_view end_of_data = "</script>";

std::string beginning_of(const char* id) {
  return std::string("<script id=\"") + id + "\" type=\"application/json\">";
}

OrderedJson data_of(std::string_view page, const char* id) {
  const std::string beginning = beginning_of(id);
  const std::size_t at = page.find(beginning);
  if (at == std::string_view::npos) throw InputError(std::string("there is no ") + id);
  const std::string_view rest = page.substr(at + beginning.size());
  return text::parse_json<OrderedJson>(rest.substr(0, rest.find(end_of_data)));
}

struct FreeDecompressor {
  void operator()(libdeflate_decompressor* decompressor) const {
    libdeflate_free_decompressor(decompressor);
  }
};

/// What is neither more nor less than `size` bytes.
Bytes inflated(const OrderedJson& base64, std::size_t size) {
  const auto packed = text::decode_base64(base64.get_ref<const std::string&>());
  if (!packed) throw InputError("its values are no base64");
  const std::unique_ptr<libdeflate_decompressor, FreeDecompressor> decompressor(
      libdeflate_alloc_decompressor());
  if (!decompressor) throw std::bad_alloc();
  Bytes bytes(size);
  std::size_t found = 0;
  if (libdeflate_zlib_decompress(decompressor.get(), packed->data(), packed->size(), bytes.data(),
                                 bytes.size(), &found) != LIBDEFLATE_SUCCESS ||
      found != size) {
    throw InputError("a map in it is damaged");
  }
  return bytes;
}

/// As the report has them: first the lowest byte of all words.
Words words_of(const OrderedJson& base64, std::size_t count) {
  const Bytes bytes = inflated(base64, 4 * count);
  Words words(count);
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t byte = 0; byte < 4; ++byte) {
      words[k] |= static_cast<std::uint32_t>(bytes[byte * count + k]) << 8 * byte;
    }
  }
  return words;
}

Samples<float> numbers_of(const Words& words) {
  Samples<float> numbers(words.size());
  for (std::size_t k = 0; k < words.size(); ++k) numbers[k] = std::bit_cast<float>(words[k]);
  return numbers;
}

std::uint32_t size_of(const OrderedJson& told, const char* side) {
  const OrderedJson& pixels = told.at(side);
  constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
  if (!pixels.is_number_unsigned() || pixels.get<std::uint64_t>() > most) {
    throw InputError(std::string("its ") + side + " is no number of pixels");
  }
  return pixels.get<std::uint32_t>();
}

struct SceneMap {
  ViewedMap viewed;
  Words depths;
};

SceneMap exact_map(const std::string& scene, const OrderedJson& told, std::uint64_t& bytes_left) {
  SceneMap exact;
  DepthMap& map = exact.viewed.map;
  exact.viewed.name = scene + ": exact";
  map.width = size_of(told, "width");
  map.height = size_of(told, "height");
  constexpr std::uint64_t bytes_per_pixel = 24;  // words, then the channels made of them
  const std::uint64_t pixels = std::uint64_t{map.width} * map.height;
  if (pixels == 0 || pixels > bytes_left / bytes_per_pixel) {
    throw InputError("a map of " + std::to_string(map.width) + "×" + std::to_string(map.height) +
                     " pixels is more than there is memory for");
  }
  bytes_left -= pixels * bytes_per_pixel;
  exact.depths = words_of(told.at("depths"), pixels);
  map.channels.push_back({"Z", numbers_of(exact.depths)});
  map.channels.push_back({"id", Samples<std::uint32_t>(words_of(told.at("triangles"), pixels))});
  return exact;
}

/// Depths are stored as differences from the exact ones, bits by bits.
ViewedMap other_map(const OrderedJson& result, const OrderedJson& told, const SceneMap& exact) {
  ViewedMap viewed;
  viewed.name = result.at("scene").get<std::string>() + ": " +
                result.at("renderer").get<std::string>() + " " +
                result.at("variant").get<std::string>();
  viewed.map.width = exact.viewed.map.width;
  viewed.map.height = exact.viewed.map.height;
  const std::size_t pixels = exact.depths.size();
  Words depths = words_of(told.at("differences"), pixels);
  for (std::size_t k = 0; k < pixels; ++k) depths[k] += exact.depths[k];
  viewed.map.channels.push_back({"Z", numbers_of(depths)});
  const Bytes classes = inflated(told.at("classes"), pixels);
  viewed.map.channels.push_back({"class", Samples<std::uint32_t>(classes.begin(), classes.end())});
  for (const auto& [name, count] : result.at("pixels").items()) {
    viewed.map.tables["class"].push_back(name);
  }
  return viewed;
}

std::vector<ViewedMap> maps_of(std::string_view page, std::uint64_t bytes_left) {
  const OrderedJson report = data_of(page, "report"), maps = data_of(page, "maps");
  std::vector<ViewedMap> all;
  for (const auto& [scene, told] : maps.at("scenes").items()) {
    SceneMap exact = exact_map(scene, told, bytes_left);
    const std::size_t place = all.size();
    all.emplace_back();
    for (std::size_t k = 0; k < report.at("results").size(); ++k) {
      const OrderedJson &result = report.at("results").at(k), &other = maps.at("maps").at(k);
      if (other.is_null() || result.at("scene") != scene) continue;
      const std::uint64_t bytes = 12 * std::uint64_t{exact.depths.size()};
      if (bytes > bytes_left) throw InputError("its maps are more than there is memory for");
      bytes_left -= bytes;
      all.push_back(other_map(result, other, exact));
    }
    all[place] = std::move(exact.viewed);
  }
  if (all.empty()) throw InputError("it holds no map");
  return all;
}

}  // namespace

bool is_report(std::string_view text) {
  return text.starts_with("<!DOCTYPE html") &&
         text.find(beginning_of("maps")) != std::string_view::npos;
}

std::vector<ViewedMap> maps_of_report(std::string_view text, const std::string& name,
                                      std::uint64_t most_bytes) {
  try {
    return maps_of(text, most_bytes);
  } catch (const nlohmann::json::exception& fault) {
    throw InputError(name + ": is not a report of fathom validate: " + fault.what());
  } catch (const InputError& fault) {
    throw InputError(name + ": is not a report of fathom validate: " + fault.what());
  }
}

}  // namespace fathom::view
