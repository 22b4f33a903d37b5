#pragma once

#include <exception>

/// The rule by which programs and the C interface report an exception as a status.
namespace fathom {

enum class FailureKind {
  usage,    ///< UsageError
  input,    ///< InputError, or the system refuses something (std::system_error)
  output,   ///< OutputError, or the system refuses something that only outputs need: a full disk
  memory,   ///< out of memory, or a container larger than any memory (std::length_error)
  threads,  ///< the system starts no more threads
  internal  ///< any other exception: an error in Fathom
};

FailureKind kind_of(const std::exception& failure);

}  // namespace fathom
