#pragma once

#include <string>

#include "apps/doctor/diagnosis.h"

namespace fathom::doctor {

/// The diagnosis for people. `cure` is the command that writes corrected files.
std::string to_text(const Diagnosis& found, const std::string& cure);
/// The same as JSON.
std::string to_json(const Diagnosis& found, const std::string& cure);

}  // namespace fathom::doctor
