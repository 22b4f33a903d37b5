#pragma once

#include <string>
#include <vector>

#include "fathom/image/depth_map.h"

/// Channels under the names that other programs expect. OpenCV, for example, shows only the
/// channels R, G, B and Y of an EXR.
namespace fathom {

/// A channel of a map and its name in the file: {"Z", "Y"}.
struct ChannelName {
  std::string channel, in_file;
};

/// The map with these channels called otherwise, and the text channel_names_text (depth_map.h),
/// "Z=Y,distance=D", by which read_map() gives them their own names back. Files of PFM and NPY name
/// no channel.
/// Fails    UsageError if there is no such channel, it is named twice, a name is empty or holds one
///          of ",=" or NUL, or two channels would be called the same; InputError if the map has a
///          fault.
DepthMap with_channel_names(DepthMap map, const std::vector<ChannelName>& names);

/// The map with the names that its channels had before with_channel_names(), and without that text.
/// A text of another form is left unchanged: another program wrote it.
DepthMap with_own_channel_names(DepthMap map);

}  // namespace fathom
