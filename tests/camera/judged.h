#pragma once

#include <vector>

#include "fathom/camera/camera_import.h"
#include "fathom/failures/errors.h"

namespace fathom::test {

/// Imported cameras all of which are asked for, whatever their lenses.
/// Fails    InputError with the first fault.
inline std::vector<ImportedCamera> judged(std::vector<ImportedCamera> imported) {
  for (const ImportedCamera& one : imported)
    if (!one.fault.empty()) throw InputError(one.fault);
  return imported;
}

}  // namespace fathom::test
