#include "fathom/image/depth_map.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <utility>

#include "fathom/camera/camera_files.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/counted.h"

namespace fathom {

const ImageChannel* DepthMap::find(const std::string& name) const {
  const auto found = std::find_if(channels.begin(), channels.end(),
                                  [&](const ImageChannel& c) { return c.name == name; });
  return found == channels.end() ? nullptr : &*found;
}

ImageChannel* DepthMap::find(const std::string& name) {
  return const_cast<ImageChannel*>(std::as_const(*this).find(name));
}

namespace {

std::optional<std::string> find_fault_of_channels(const DepthMap& map) {
  const std::size_t pixels = std::size_t{map.width} * map.height;
  std::set<std::string_view> names;
  for (const ImageChannel& channel : map.channels) {
    if (channel.name.empty()) return "a channel has no name";
    if (channel.name.find('\0') != std::string::npos) return "the name of a channel holds a NUL";
    if (!names.insert(channel.name).second) return "it has two channels '" + channel.name + "'";
    const std::size_t size = std::visit([](const auto& v) { return v.size(); }, channel.values);
    if (size != pixels) {
      return "channel '" + channel.name + "' has " + text::counted(size, "value") +
             ", expected one for each of " + text::counted(pixels, "pixel");
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> find_fault(const DepthMap& map) {
  if (map.width == 0 || map.height == 0) return "it has no pixels";
  if (map.channels.empty()) return "it has no channels";
  if (auto fault = find_fault_of_channels(map)) return fault;
  if (map.png_scale && !(*map.png_scale > 0 && std::isfinite(*map.png_scale))) {
    return "png_scale is not a positive number";
  }
  return std::nullopt;
}

void require_valid(const DepthMap& map) {
  if (const auto fault = find_fault(map)) throw InputError("map: " + *fault);
}

std::optional<Camera> camera_of(const DepthMap& map, const std::string& name) {
  const StandardArithmetic standard;
  if (map.camera) return map.camera;
  const auto text = map.texts.find(camera_text);
  if (text == map.texts.end()) return std::nullopt;
  const std::string place = name + ": " + camera_text;
  std::vector<Camera> cameras = read_cameras(text->second, place);
  if (cameras.size() != 1) throw InputError(place + " does not hold one camera");
  return std::move(cameras[0]);
}

std::map<std::string, std::string> texts_of(const DepthMap& map) {
  const StandardArithmetic standard;
  std::map<std::string, std::string> texts = map.texts;
  if (map.camera) texts[camera_text] = to_json(*map.camera, Digits::seventeen);
  return texts;
}

}  // namespace fathom
