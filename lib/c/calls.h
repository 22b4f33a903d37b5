#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <new>
#include <string>

#include "fathom/failures/errors.h"
#include "fathom/failures/failure_kind.h"
#include "fathom/mesh/mesh_faces.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/rendering/options.h"
#include "fathom/scene/scene.h"
#include "lib/c/fathom.h"

struct fathom_scene {
  fathom::Scene scene;
};

/// How the functions of fathom.h do their work: every exported function consists of one call of
/// answer_of() or status_of().
namespace fathom::c {

/// Thrown through the library when the caller's progress function requests a stop.
struct Stopped {};

inline std::string& error_of_thread() {
  thread_local std::string error;
  return error;
}

inline fathom_status failed(fathom_status status, const char* why) {
  try {
    error_of_thread() = why;
  } catch (const std::bad_alloc&) {
    error_of_thread().clear();
  }
  return status;
}

inline fathom_status code_of(FailureKind kind) {
  switch (kind) {
    case FailureKind::usage:
      return FATHOM_USAGE;
    case FailureKind::output:
      return FATHOM_OUTPUT;
    case FailureKind::memory:
      return FATHOM_MEMORY;
    case FailureKind::internal:
      return FATHOM_INTERNAL;
    case FailureKind::input:
    case FailureKind::threads:
      break;
  }
  return FATHOM_INPUT;
}

/// Does the work of a function that the library exports, in StandardArithmetic, whatever mode the
/// caller computes in. Every exported function consists of one call of this or of status_of().
template <class Work>
auto answer_of(const Work& work) noexcept {
  const StandardArithmetic standard;
  return work();
}

/// The same where the work may throw: a failure becomes the function's status.
template <class Work>
fathom_status status_of(const Work& work) noexcept {
  const StandardArithmetic standard;
  try {
    work();
    return FATHOM_OK;
  } catch (const Stopped&) {
    return failed(FATHOM_STOPPED, "stopped");
  } catch (const std::exception& failure) {
    const fathom_status status = code_of(kind_of(failure));
    return failed(status, status == FATHOM_MEMORY ? "there is not enough memory" : failure.what());
  }
}

inline void require(bool holds, const char* message) {
  if (!holds) throw UsageError(message);
}

/// Refuses a count that no mesh can have, such as a negative number converted to unsigned, before
/// its bytes are computed or an element is read.
inline void require_count(const char* what, std::size_t count, std::size_t bytes_of_element) {
  const std::uint64_t most =
      std::min<std::uint64_t>(mesh::most_elements, SIZE_MAX / bytes_of_element);
  if (count <= most) return;
  throw UsageError(std::string(what) + ": expected at most " + std::to_string(most) + ", found " +
                   std::to_string(count));
}

inline Cull cull_of(fathom_cull given) {
  switch (given) {
    case FATHOM_CULL_NONE:
      return Cull::none;
    case FATHOM_CULL_BACK:
      return Cull::back;
    case FATHOM_CULL_FRONT:
      return Cull::front;
  }
  throw UsageError("options: cull: expected one of fathom_cull");
}

}  // namespace fathom::c
