#pragma once

#include <cstdint>
#include <optional>

#include "fathom/memory/available_memory.h"

namespace fathom::app {

/// --max-memory: from now on this process may take so much memory of its own (files that it maps
/// are not counted). What is known to need more is refused before it is tried; an allocation beyond
/// it fails. The system counts whole stacks, of which threads touch little: room for them is
/// allowed on top (docs/limits.md), and an allocation may take what of it no stack has.
void set_max_memory(std::uint64_t bytes);

/// Where a control group allows less than the machine has: lets an allocation beyond that fail, as
/// any other failure, where the system would kill the program.
void stay_within_control_group();

/// What --max-memory allows; nullopt where it is not given.
std::optional<MemoryAllowance> max_memory();

/// What this run may take in memory: what --max-memory allows, or less if there is less.
MemoryAllowance memory_allowance();

}  // namespace fathom::app
