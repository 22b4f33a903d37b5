#include "fathom/fast/render_memory.h"

#include "fathom/fast/render_memory_parts.h"

namespace fathom {

RenderMemory::RenderMemory() : parts_(std::make_unique<Parts>()) {}
RenderMemory::RenderMemory(RenderMemory&& other) noexcept = default;
RenderMemory& RenderMemory::operator=(RenderMemory&& other) noexcept = default;
RenderMemory::~RenderMemory() = default;

}  // namespace fathom
