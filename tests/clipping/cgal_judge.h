#pragma once

#include <memory>
#include <optional>
#include <string>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/points.h"
#include "fathom/clipping/weiler_atherton.h"

/// CGAL's Boolean_set_operations_2 as the independent answer. Only cgal_judge.cpp includes it.
namespace fathom::clipping::test {

/// What subject ∩ clip, subject − clip and subject ∪ clip are. A side is the exclusive or of its
/// rings, which is the even-odd rule; nothing of ours orients or nests them.
class Judge {
 public:
  Judge(const Rings<Rational>& subject, const Rings<Rational>& clip);
  ~Judge();
  Judge(const Judge&) = delete;
  Judge& operator=(const Judge&) = delete;

  [[nodiscard]] Rational area(SetOperation operation) const;
  /// What is wrong with our answer: a ring that is not simple or runs the wrong way, a hole that
  /// is not in its outline, polygons that overlap, another point set. nullopt if nothing is.
  [[nodiscard]] std::optional<std::string> fault(
      SetOperation operation, const std::vector<Polygon<Rational>>& answer) const;

 private:
  struct Regions;
  std::unique_ptr<Regions> regions_;
};

}  // namespace fathom::clipping::test
