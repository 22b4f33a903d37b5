#include "apps/render/render_arguments.h"

#include <algorithm>
#include <string>
#include <utility>

#include "fathom/failures/errors.h"
#include "fathom/image/channel_table.h"

namespace fathom::app {

void RenderArguments::take(Contents contents) {
  channels = std::move(contents.channels);
  is_mask = contents.is_mask;
  mask_beside = contents.mask_beside;
  object = contents.object;
}

void RenderArguments::refuse_pipeline_options() const {
  if (picture_background_) {
    throw UsageError(
        "--background R,G,B is for --engine pipeline; 0, nan, inf or a number is for "
        "depths");
  }
  for (const Option& option : of_pipeline_) {
    if (!option.is_given()) continue;
    if (option.name() != "--normals") {
      throw UsageError(option.name() + " is for --engine pipeline");
    }
    const auto names_ns = [](const OutputArgument& each) {
      return each.contents && std::ranges::count(each.contents->channels, Channel::Ns) > 0;
    };
    const bool has_ns = channels && std::ranges::count(*channels, Channel::Ns) > 0;
    if (!has_ns && std::ranges::none_of(outputs, names_ns)) {
      throw UsageError("--normals is for channel Ns and for --engine pipeline");
    }
  }
}

std::vector<MatteKind> RenderArguments::mattes() const {
  if (!mattes_by.empty() || !cryptomatte) return mattes_by;
  return {std::nullopt};
}

std::vector<std::string> RenderArguments::patterns() const {
  if (outputs.empty()) return {output};
  std::vector<std::string> all;
  for (const OutputArgument& each : outputs) all.push_back(each.pattern);
  return all;
}

StorageOptions RenderArguments::storage_of(std::size_t number) const {
  if (outputs.size() < 2) return storage;
  const OutputArgument& chosen = outputs[number];
  // The default channels depend on the format and the camera.
  StoredContents contents = contents_of(
      channels.value_or(std::vector{Channel::Z, Channel::A, Channel::distance}), is_mask);
  if (chosen.contents) contents = contents_of(chosen.contents->channels, chosen.contents->is_mask);
  return storage.fitting(chosen.pattern, contents);
}

void RenderArguments::require_outputs_of_channels() const {
  if (!channels) return;
  const auto is_unnamed = [](const OutputArgument& each) { return !each.contents; };
  const auto is_of_mask = [](const OutputArgument& each) {
    return each.contents && each.contents->is_mask;
  };
  const bool any_unnamed = outputs.empty() || std::ranges::any_of(outputs, is_unnamed);
  const bool needs_mask = mask_beside || (is_mask && !any_unnamed);
  if (needs_mask && std::ranges::none_of(outputs, is_of_mask))
    throw UsageError(std::string("--channels: ") + mask_needs_file);
  if (any_unnamed || is_mask) return;
  for (const Channel channel : *channels) {
    const auto has_it = [&](const OutputArgument& each) {
      return !each.contents->is_mask && std::ranges::count(each.contents->channels, channel) > 0;
    };
    if (std::ranges::any_of(outputs, has_it)) continue;
    const std::string name(description_of(channel).name);
    throw UsageError("--channels: '" + name + "' is in no output: add -o " + name + "=FILE");
  }
}

RenderArguments RenderArguments::of_output(std::size_t number) const {
  RenderArguments only = *this;
  if (outputs.empty()) return only;
  const OutputArgument& chosen = outputs[number];
  only.outputs = {{std::nullopt, chosen.pattern}};
  only.output = chosen.pattern;
  only.storage = storage_of(number);
  if (chosen.contents) only.take(*chosen.contents);
  return only;
}

RenderArguments RenderArguments::of_only_output(const std::string& writer) const {
  if (outputs.size() > 1) {
    throw UsageError("-o: " + writer + " writes a single map, without NAME=");
  }
  require_outputs_of_channels();
  RenderArguments only = of_output(0);
  if (only.is_mask) throw UsageError("mask is for the exact engines of fathom, not for " + writer);
  return only;
}

}  // namespace fathom::app
