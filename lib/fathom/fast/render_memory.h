#pragma once

#include <memory>

namespace fathom {

/// Memory that the fast engine keeps from one frame to the next (RenderContext::kept), so that the
/// system provides its pages only once. It has the size of the last frame's memory, and is released
/// with the object. One frame at a time.
class RenderMemory {
 public:
  struct Parts;

  RenderMemory();
  RenderMemory(RenderMemory&& other) noexcept;
  RenderMemory& operator=(RenderMemory&& other) noexcept;
  ~RenderMemory();

  [[nodiscard]] Parts& parts() { return *parts_; }

 private:
  std::unique_ptr<Parts> parts_;
};

}  // namespace fathom
