#include <algorithm>
#include <set>

#include "fathom/failures/errors.h"
#include "fathom/image/files/file_texts.h"
#include "fathom/image/files/map_codecs.h"
#include "fathom/image/files/npy_array.h"
#include "fathom/image/files/zip_archive.h"
#include "fathom/text/decimal.h"
#include "fathom/text/json_text.h"
#include "fathom/text/json_value.h"
#include "fathom/text/printable.h"
#include "fathom/text/version.h"

/// NPZ ([Ker07]): a ZIP archive with a file NAME.npy for each channel or, where channels are the
/// parts of one, for them together. The array `fathom` is a text, the JSON object of the map's
/// texts: json.loads(numpy.load("map.npz")["fathom"].item()).
namespace fathom::image {
using namespace files;
using namespace text;

namespace {

constexpr const char* texts_array = "fathom";
constexpr std::string_view suffix = ".npy";

std::string texts_as_json(const DepthMap& map) {
  std::map<std::string, std::string> texts = texts_of(map);
  for (auto& [key, text] : name_tables(map)) texts[key] = text;
  if (map.png_scale) texts[scale_text] = shortest_decimal(*map.png_scale);
  texts["software"] = software_in_outputs();
  std::vector<std::string> members;
  members.reserve(texts.size());
  for (const auto& [key, value] : texts)
    members.push_back(json_string(key) + ":" + json_string(value));
  return joined_in('{', members, '}');
}

void take_texts(const std::string& json, DepthMap& map, const std::string& name) {
  const JsonDocument document(json, name);
  for (const auto& [key, value] : document.root().members()) {
    if (is_name_table(key)) {
      take_name_table(key, value.string(), map);
    } else if (key == scale_text) {
      map.png_scale = read_scale(value.string(), name);
    } else {
      map.texts[key] = value.string();
    }
  }
}

/// The name that the parts of a channel share: "N" of N.X; empty if it has none.
std::string name_of_whole(const std::string& channel) {
  const std::size_t dot = channel.rfind('.');
  return dot == std::string::npos ? "" : channel.substr(0, dot);
}

void require_array_memory(const std::vector<ZipEntry>& entries, std::size_t file_bytes,
                          const MapMemory& memory, const std::string& name) {
  double needed = 0, unpacked = 0;
  for (const ZipEntry& entry : entries) {
    needed += static_cast<double>(entry.size);
    if (entry.deflated) unpacked = std::max(unpacked, static_cast<double>(entry.size));
  }
  needed += unpacked;
  const std::string what = name + ": its arrays, unpacked,";
  require_memory(what, needed, memory.allowance);
  if (memory.of_small_file && needed > MapMemory::usual_ratio * static_cast<double>(file_bytes))
    require_memory(what, needed, *memory.of_small_file);
}

/// Adds the channels of an array.
void add_channels(DepthMap& map, std::vector<ImageChannel> channels, const ImageSize& size,
                  const std::string& array, const std::string& name) {
  const ImageSize own{map.width, map.height};
  if (!map.channels.empty() && size != own)
    throw InputError(name + ": arrays of two sizes: '" + printable(array) + "' has " +
                     std::to_string(size.width) + "×" + std::to_string(size.height) +
                     " pixels, and another " + std::to_string(own.width) + "×" +
                     std::to_string(own.height) + "; expected one size");
  map.width = size.width;
  map.height = size.height;
  for (ImageChannel& channel : channels) map.channels.push_back(std::move(channel));
}

bool is_array(const ZipEntry& entry) {
  return entry.name.ends_with(suffix) && entry.size >= 12;
}
std::string array_name(const ZipEntry& entry) {
  return entry.name.substr(0, entry.name.size() - suffix.size());
}

}  // namespace

Bytes encode_npz(const DepthMap& map, const std::string& name) {
  ZipWriter archive(name);
  std::set<std::string> arrays{texts_array};
  std::set<const ImageChannel*> written;
  const auto add = [&](const std::string& array, const std::vector<const ImageChannel*>& channels) {
    if (!arrays.insert(array).second)
      throw OutputError(name + ": two arrays would be called '" + array + "'");
    archive.add(array + std::string(suffix), npy_of_channels({map.width, map.height}, channels));
    written.insert(channels.begin(), channels.end());
  };
  for (const ImageChannel& channel : map.channels) {
    if (written.contains(&channel)) continue;
    const std::string whole = name_of_whole(channel.name);
    const std::vector<const ImageChannel*> parts =
        whole.empty() ? std::vector<const ImageChannel*>() : parts_of(map, whole);
    const bool is_part = std::find(parts.begin(), parts.end(), &channel) != parts.end();
    if (is_part) {
      add(whole, parts);
    } else {
      add(channel.name, {&channel});
    }
  }
  archive.add(texts_array + std::string(suffix), npy_of_text(texts_as_json(map)));
  return archive.take();
}

DepthMap decode_npz(ByteView bytes, const std::string& name, const MapMemory& memory) {
  const std::vector<ZipEntry> entries = read_zip_directory(bytes, name);
  require_array_memory(entries, bytes.size(), memory, name);
  DepthMap map;
  std::set<std::string> names;
  Bytes room;
  for (const ZipEntry& entry : entries) {
    if (!is_array(entry)) continue;
    const std::string array = array_name(entry);
    const std::string place = name + ": '" + printable(array) + "'";
    const ByteView content = unpack(entry, room, name);
    if (array == texts_array) {
      take_texts(text_of_array(content, place), map, place);
    } else if (is_image_array(content, place)) {
      ImageSize size;
      std::vector<ImageChannel> channels = channels_of_npy(content, array, size, place);
      for (const ImageChannel& channel : channels)
        if (channel.name.empty() || channel.name.find('\0') != std::string::npos ||
            !names.insert(channel.name).second)
          throw InputError(name + ": an array without a unique name");
      add_channels(map, std::move(channels), size, array, name);
    }
  }
  if (map.channels.empty())
    throw InputError(name + ": not a map: expected arrays of two dimensions in this NPZ file");
  return map;
}

DepthMap decode_npz_array(ByteView bytes, const std::string& array, const std::string& name,
                          const MapMemory& memory) {
  std::vector<ZipEntry> entries = read_zip_directory(bytes, name);
  std::erase_if(entries, [](const ZipEntry& entry) { return !is_array(entry); });
  std::string names;
  for (const ZipEntry& entry : entries)
    names += (names.empty() ? "" : ", ") + printable(array_name(entry));
  std::erase_if(
      entries, [&](const ZipEntry& entry) { return !array.empty() && array_name(entry) != array; });
  if (entries.empty() && array.empty()) throw InputError(name + ": holds no array");
  if (entries.empty())
    throw InputError(name + ": has no array '" + printable(array) + "', but " +
                     (names.empty() ? "none at all" : names));
  if (entries.size() > 1)
    throw InputError(name + ": holds several arrays, " + names + ": say which, as in " + name +
                     ":" + printable(array_name(entries.front())));
  require_array_memory(entries, bytes.size(), memory, name);
  Bytes room;
  return decode_npy(unpack(entries.front(), room, name),
                    name + ": '" + printable(array_name(entries.front())) + "'");
}

}  // namespace fathom::image
