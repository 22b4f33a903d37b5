#pragma once

#include <cstdint>
#include <optional>

#include "fathom/memory/available_memory.h"

namespace fathom::app {

/// --max-memory: from now on this process may take so much memory of its own (files that it maps
/// are not counted, but 8 MB for the stack of each thread are allowed on top). What is known to need
/// more is refused before it is tried; an allocation beyond it fails.
void set_max_memory(std::uint64_t bytes);

/// Where a control group allows less than the machine has: lets an allocation beyond that fail, as
/// any other failure, where the system would kill the program.
void stay_within_control_group();

/// What --max-memory allows; nullopt where it is not given.
std::optional<MemoryAllowance> max_memory();

/// What this run may take in memory: what --max-memory allows, or less if there is less.
MemoryAllowance memory_allowance();

}  // namespace fathom::app
