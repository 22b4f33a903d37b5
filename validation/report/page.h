#pragma once

/// The parts of report.html that are the same in every report.
namespace fathom::validation {

extern const char* const page_head;
extern const char* const page_script;

}  // namespace fathom::validation
