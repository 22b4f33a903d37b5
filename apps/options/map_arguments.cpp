#include "apps/options/map_arguments.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "apps/shell/known_files.h"
#include "apps/shell/max_memory.h"
#include "apps/shell/values.h"
#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/image/channel_names.h"
#include "fathom/image/cryptomatte.h"
#include "fathom/image/deep_map.h"
#include "fathom/image/map_files.h"

namespace fathom::app {
namespace {

MapMemory allowed_memory() {
  MapMemory memory{.allowance = memory_allowance()};
  if (max_memory()) {
    memory.of_small_file.reset();
  } else {
    memory.of_small_file->remedy = "--max-memory SIZE allows more";
  }
  return memory;
}

}  // namespace

std::vector<Channel> parse_channels(const std::string& list) {
  return parse_distinct(list, [](const std::string& name) {
    if (const std::optional<Channel> channel = channel_named(name)) return *channel;
    throw unknown_channel(name);
  });
}

std::string text_of(const std::vector<Channel>& channels) {
  std::string text;
  for (const Channel channel : channels) {
    if (!text.empty()) text += ',';
    text += description_of(channel).name;
  }
  return text;
}

std::size_t count_parts(const std::vector<Channel>& channels) {
  std::size_t count = 0;
  for (const Channel channel : channels) {
    count += std::max<std::size_t>(1, description_of(channel).parts.size());
  }
  return count;
}

DepthMap read_map_argument(const std::string& file) {
  note_input(file);
  return read_map(file, allowed_memory());
}

DepthMap read_map_argument(std::span<const std::byte> bytes, const std::string& file) {
  note_input(file);
  return read_map(bytes, file, allowed_memory());
}

DeepMap read_deep_map_argument(std::span<const std::byte> bytes, const std::string& file) {
  note_input(file);
  return read_deep_map(bytes, file, allowed_memory());
}

DepthMap read_map_or_flat_map(const std::string& file) {
  const files::InputFile input(file, files::InputFile::Reading::mapped_where_large);
  DepthMap map = is_deep_map(input.bytes()) ? flat_map(read_deep_map_argument(input.bytes(), file))
                                            : read_map_argument(input.bytes(), file);
  input.expect_unchanged();
  return with_matte_names(std::move(map));
}

}  // namespace fathom::app
