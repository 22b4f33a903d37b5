#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "fathom/mesh_files/formats_program/messages.h"

/// The tasks of fathom-formats. Each takes the parameters and the bytes of a request and returns
/// the bytes of the answer. If a task fails, the message of its std::exception is the reason.
namespace fathom::app {

/// Reads a file of any format of assimp; the parameters are its name.
/// lib/fathom/mesh_files/formats_program/read_by_assimp.cpp reads the answer and defines its
/// layout.
std::vector<std::byte> read_by_assimp(std::span<const std::byte> parameters,
                                      std::span<const std::byte> bytes);

/// Decodes a primitive of glTF; the parameters are a list of DracoAttribute. The answer: the
/// version, how many corners and vertices there are, then the bytes of the corners and of each
/// attribute.
std::vector<std::byte> decode_by_draco(std::span<const std::byte> parameters,
                                       std::span<const std::byte> bytes);

/// Decodes a buffer view of glTF; the parameters are a MeshoptView. The answer: the version and the
/// bytes.
std::vector<std::byte> decode_by_meshoptimizer(std::span<const std::byte> parameters,
                                               std::span<const std::byte> bytes);

/// "assimp 5.2.4"
std::string assimp_version();
std::string draco_version();
std::string meshoptimizer_version();

/// Answers requests from the socket on standard input, until it is closed. Each request names its
/// limits; the system ends this program if it exceeds one. Returns the exit status.
int serve_requests();

}  // namespace fathom::app
