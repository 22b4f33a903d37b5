#pragma once

#include <cstdint>
#include <optional>

#include "fathom/memory/available_memory.h"

namespace fathom::app {

/// --max-memory: limits the memory of this process, not counting mapped files. Work that is known
/// to need more is refused before it starts; an allocation beyond the limit fails. The system
/// counts whole stacks, although threads touch little of them, so the limit is raised by the size
/// of the stacks (docs/limits.md); other allocations may use the unused part.
void set_max_memory(std::uint64_t bytes);

/// Where a control group allows less than the machine has: lets an allocation beyond that fail, as
/// any other failure, where the system would kill the program.
void stay_within_control_group();

/// What --max-memory allows; nullopt where it is not given.
std::optional<MemoryAllowance> max_memory();

/// What this run may take in memory: what --max-memory allows, or less if there is less.
MemoryAllowance memory_allowance();

}  // namespace fathom::app
