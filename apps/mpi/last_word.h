#pragma once

#include <atomic>
#include <string>

#include "apps/shell/last_resort.h"

namespace fathom::app {

/// Processes that work together end together, and only one of them reports the reason. By default
/// this process reports everything.
enum class Reports { nothing, interruptions, everything };
void report_only(Reports reports) noexcept;

/// The processes of a run on one machine share the name of a file. The first process that reports
/// creates the file; then the other processes report nothing. A name that is too long is not
/// shared.
void share_last_word(const std::string& path);
/// Used if there is no such name or the file cannot be created: a number in shared memory, which is
/// 0 and becomes 1. nullptr ends the sharing.
void share_last_word(std::atomic<int>* said) noexcept;

}  // namespace fathom::app
