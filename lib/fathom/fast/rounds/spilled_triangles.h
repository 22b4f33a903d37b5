#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fathom/fast/rounds/gathered_triangles.h"
#include "fathom/files/spill_file.h"

namespace fathom::fast {

/// Triangles that wait on a disk, in buckets of which each is read by itself. In memory remains a
/// place for each time that some are added to a bucket.
/// Fails    as SpillFile.
class SpilledTriangles {
 public:
  explicit SpilledTriangles(std::size_t buckets) : buckets_(buckets) {}
  /// Several threads may add to different buckets at the same time.
  void add(std::size_t bucket, std::span<const KeptTriangles> kept);
  [[nodiscard]] KeptSize size_of_bucket(std::size_t bucket) const;
  /// Everything in a bucket.
  void gather(std::size_t bucket, GatheredTriangles& to) const;
  /// Calls visit(triangles) for all in a bucket, as they were added.
  template <class Visit>
  void for_each(std::size_t bucket, const Visit& visit) const {
    for (const Block& block : buckets_[bucket]) visit(read(block));
  }

 private:
  struct Block {
    std::uint64_t offset;
    std::uint32_t object, vertices, triangles;
  };
  [[nodiscard]] KeptTriangles read(const Block& block) const;

  files::SpillFile file_;
  std::vector<std::vector<Block>> buckets_;
};

}  // namespace fathom::fast
