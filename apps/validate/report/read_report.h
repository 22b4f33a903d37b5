#pragma once

#include <filesystem>

#include "apps/validate/report/reported_result.h"

namespace fathom::validation {

/// The report.json of an earlier run.
/// Fails    InputError where the file is none, is cut off, or has another layout: one line, with
///          what to do about it.
Report read_report(const std::filesystem::path& file);

}  // namespace fathom::validation
