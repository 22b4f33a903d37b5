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

/// If a control group allows less memory than the machine has, makes allocations beyond its limit
/// fail. Otherwise the system would kill the program.
void stay_within_control_group();

/// The limit of --max-memory; nullopt if it is not given.
std::optional<MemoryAllowance> max_memory();

/// The memory that this run may use: the limit of --max-memory, or the available memory if that is
/// less.
MemoryAllowance memory_allowance();

}  // namespace fathom::app
