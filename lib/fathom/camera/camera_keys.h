#pragma once

#include <string_view>
#include <vector>

#include "fathom/camera/camera_files.h"
#include "fathom/camera/projection.h"
#include "fathom/text/json_value.h"

/// The keys of a camera file that say how a camera projects; shared by the files of this module.
namespace fathom::camera {

/// Refuses an object with both keys.
void expect_either(const text::JsonValue& value, std::string_view one, std::string_view other);

/// Sets a number where its key is there.
void read_number(const text::JsonValue& value, std::string_view key, double& number);

/// fx, fy, cx, cy and skew, or all of them as the matrix K.
void read_intrinsics(const text::JsonValue& value, Projection& projection);

/// The keys that the lens model of the key `model` may have, that key among them, without
/// pixel_centre.
/// Fails    InputError for a model that does not exist.
std::vector<std::string_view> keys_of_lens(const text::JsonValue& value);

/// Whether the key `model` is TABLE.
bool is_table(const text::JsonValue& value);

/// The lens of the model TABLE, for an image of this size; without a reader, a table that is not
/// read.
void read_table(const text::JsonValue& value, std::uint32_t width, std::uint32_t height,
                const DirectionReader& directions, Projection& projection);

/// Any other lens: the key `model`, and its parameters: each by its name (missing parameters of
/// distortion are 0), or all of them in the list `params`, or K with the list `distortion`.
void read_lens(const text::JsonValue& value, Projection& projection);

}  // namespace fathom::camera
