#pragma once

#include <memory>

namespace fathom {

/// Memory that the fast engine works with and keeps from one frame to the next
/// (RenderContext::kept): what the system has to provide, page by page, is provided once. It is
/// what the last frame took, and is given back with the object. One frame at a time.
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
