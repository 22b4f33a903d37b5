#pragma once

#include <string>
#include <vector>

#include "fathom/camera/data_set_cameras.h"

namespace fathom::app {

/// Whether a text names a file of NumPy's arrays: FILE.npy, FILE.npz or FILE.npz:ARRAY.
bool names_array(const std::string& file);

/// Matrices of such an array of floating point numbers: N×4×4 or N×3×4, or one of them. They are
/// called "0", "1", ….
/// Fails    InputError, naming the file.
std::vector<NamedPose> poses_of_array(const std::string& file);

/// The same of N×3×3 or 3×3.
std::vector<IntrinsicMatrix> intrinsics_of_array(const std::string& file);

}  // namespace fathom::app
