#pragma once

#include "fathom/depth_format/encode.h"
#include "fathom/pipeline/fragments/interpolation.h"

/// The depth test: what a fragment's depth is stored as, and which of two is nearer.
namespace fathom::pipeline {

/// A window depth in [0, 1], rounded once to a storage: to nearest, ties to even.
StoredDepth store(Storage storage, double window_z);

class DepthTest {
 public:
  explicit DepthTest(const PipelineOptions& options);

  /// What the depth buffer keeps for a fragment. Mappings that are not projections are computed
  /// here, from the depth along the view, in the options' precision.
  [[nodiscard]] StoredDepth stored(const Fragment& fragment) const;

  /// Strictly nearer wins, so the first of equal ones stays.
  [[nodiscard]] bool is_nearer(StoredDepth a, StoredDepth b) const {
    return greater_is_nearer_ ? a > b : a < b;
  }

 private:
  DepthFormat format_;
  bool binary32_;
  bool greater_is_nearer_;
};

}  // namespace fathom::pipeline
