#pragma once

#include <string>

/// Small files whose maps are known on paper.
namespace fathom::test {

/// Two triangles that make the square [−1, 1]² at z = 2.
extern const std::string square_obj;

/// 8×6 pixels, fx = fy = 4, principal point in the middle, at the origin, looking along +z. The
/// square spans columns 2 to 5 and rows 1 to 4: u = 4·x/2 + 4, v = 4·y/2 + 3, so [2, 6] × [1, 5].
extern const std::string square_camera;

/// A camera like square_camera with one entry replaced, or one added: `"fx": 0`.
std::string camera_with(const std::string& key, const std::string& value);

}  // namespace fathom::test
