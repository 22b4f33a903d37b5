#pragma once

/// The names of the texts that maps carry (DepthMap::texts): attributes of an EXR, text chunks of a
/// PNG, members of the JSON text of an NPZ. docs/reading-maps.md describes each of them.
namespace fathom {

/// The camera, as the JSON of camera files.
inline constexpr const char* camera_text = "fathom.camera";
/// The files of the scene with their SHA-256, as JSON.
inline constexpr const char* sources_text = "fathom.sources";
/// What computed the map: the name of an engine, or of another renderer.
inline constexpr const char* engine_text = "fathom.engine";
/// Which triangles were left out, unless none.
inline constexpr const char* cull_text = "fathom.cull";
/// Where the normals of channel Ns come from, unless from the file.
inline constexpr const char* normals_text = "fathom.normals";
/// The time at which the objects of a motion were placed.
inline constexpr const char* time_text = "fathom.time";
/// The pattern of the samples of channel Asampled.
inline constexpr const char* samples_text = "fathom.samples";
/// The depth format of channel Zwindow, as JSON, and the depth range of a pipeline, unless [0, 1].
inline constexpr const char* depth_format_text = "fathom.depth_format";
inline constexpr const char* depth_range_text = "fathom.depth_range";
/// The value of depth channels without a surface, unless +∞ (background.h).
inline constexpr const char* background_text = "fathom.background";
/// The channels that have another name in the file (channel_names.h).
inline constexpr const char* channel_names_text = "fathom.channel-names";

}  // namespace fathom
