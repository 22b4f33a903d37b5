#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/failures/errors.h"

namespace fathom {

/// Reads the table of directions that a camera file names, for an image of this size. `file` is as
/// the camera file has it, usually relative to the folder of the camera file (image/directions.h).
using DirectionReader = std::function<std::shared_ptr<const DirectionTable>(
    const std::string& file, std::uint32_t width, std::uint32_t height)>;

/// Reads a camera file: one camera, or a list of them (a camera path). docs/camera-files.md has the
/// keys. Warns, once, of a file that leaves pixel_centre to be guessed.
/// Exact    numbers are rounded once. `camera_to_world` is inverted exactly; each entry of
///          world_to_camera is then rounded once.
/// Fails    InputError, naming the key; unknown keys are errors.
/// Without a reader, tables of directions are named and not read: such cameras are not valid.
std::vector<Camera> read_cameras(const std::filesystem::path& file, Warnings& warnings);
/// The same of a file's text; `name` is the file's name for messages.
std::vector<Camera> read_cameras(std::string_view text, const std::string& name, Warnings& warnings,
                                 const DirectionReader& directions = {});
/// The same without warnings, for files that a program wrote.
std::vector<Camera> read_cameras(const std::filesystem::path& file);
std::vector<Camera> read_cameras(std::string_view text, const std::string& name);

/// The digits of a number in JSON: the fewest that read back as the same number (camera files), or
/// 17 significant ones (headers of maps, whose bytes do not change between versions).
enum class Digits { fewest, seventeen };

/// The JSON of camera files; reading it back gives the same camera bit for bit. Of the model TABLE,
/// it has the name and the SHA-256 of the file of directions, and null instead of the name if there
/// is no file. Ends without a newline.
std::string to_json(const Camera& camera, Digits digits = Digits::fewest);
/// A list of cameras; a single one is written as an object.
std::string to_json(const std::vector<Camera>& cameras);

}  // namespace fathom
