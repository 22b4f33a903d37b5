#include "apps/study/depth_resolution/format_steps.h"

#include <algorithm>
#include <cmath>

#include "fathom/depth_format/resolution.h"

namespace fathom::studies {
namespace {

double step_at(const DepthFormat& format, double depth) {
  const Resolution r = resolution(format, Dyadic(depth));
  return std::max(r.to_nearer.value_or(0), r.to_farther.value_or(0));
}

/// The share of all codes between near and far that depths up to `times` near get.
double share_of_codes(const DepthFormat& format, double times) {
  const Ratio near = Dyadic(format.near), far = Dyadic(format.far);
  const double limit = std::min(times * format.near, format.far);
  return static_cast<double>(codes_between(format, near, Dyadic(limit))) /
         static_cast<double>(codes_between(format, near, far));
}

FormatSteps measure(const DepthFormat& format, const std::vector<double>& depths) {
  FormatSteps measured{.format = format,
                       .codes = codes_between(format, Dyadic(format.near), Dyadic(format.far)),
                       .share_below_2 = share_of_codes(format, 2),
                       .share_below_10 = share_of_codes(format, 10)};
  for (const double depth : depths) {
    measured.steps.push_back({depth, step_at(format, depth), bin_width(format, Dyadic(depth))});
  }
  const auto worst = std::max_element(
      measured.steps.begin(), measured.steps.end(),
      [](const Step& a, const Step& b) { return a.step / a.depth < b.step / b.depth; });
  measured.greatest_relative = worst->step / worst->depth;
  measured.greatest_at = worst->depth;
  return measured;
}

}  // namespace

std::vector<FormatSteps> measure_formats(double near, double far, const std::vector<double>& depths,
                                         const std::function<void(double)>& tick) {
  std::vector<FormatSteps> all;
  for (const Mapping mapping : all_mappings) {
    for (const Storage storage : all_storages) {
      all.push_back(measure({mapping, storage, near, far}, depths));
      tick(static_cast<double>(all.size()) /
           static_cast<double>(std::size(all_mappings) * std::size(all_storages)));
    }
  }
  return all;
}

std::vector<BestMapping> best_mappings(const std::vector<FormatSteps>& all) {
  std::vector<BestMapping> best;
  for (const Storage storage : all_storages) {
    for (std::size_t i = 0; i < all.front().steps.size(); ++i) {
      BestMapping least{storage, all.front().steps[i].depth, Mapping::standard, INFINITY};
      for (const FormatSteps& m : all) {
        if (m.format.storage != storage || m.format.mapping == Mapping::opengl) continue;
        if (m.steps[i].step < least.step) {
          least.mapping = m.format.mapping;
          least.step = m.steps[i].step;
        }
      }
      best.push_back(least);
    }
  }
  return best;
}

std::vector<BestRange> best_ranges(const std::vector<BestMapping>& best) {
  std::vector<BestRange> ranges;
  for (const BestMapping& b : best) {
    if (!ranges.empty() && ranges.back().storage == b.storage &&
        ranges.back().mapping == b.mapping) {
      ranges.back().to = b.depth;
    } else {
      ranges.push_back({b.storage, b.mapping, b.depth, b.depth});
    }
  }
  return ranges;
}

std::vector<MovedStep> move_near_and_far(double near, double far) {
  constexpr double factors[] = {0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100};
  std::vector<MovedStep> rows;
  const double depth = std::sqrt(near) * std::sqrt(far);
  const auto add = [&](Moved moved, const DepthFormat& format) {
    if (format.near <= depth && depth <= format.far) {
      rows.push_back({moved, format, depth, step_at(format, depth)});
    }
  };
  for (const Mapping mapping : all_mappings) {
    for (const Storage storage : {Storage::unorm16, Storage::unorm24, Storage::float32}) {
      for (const double factor : factors) {
        add(Moved::near, {mapping, storage, near * factor, far});
        add(Moved::far, {mapping, storage, near, far * factor});
      }
    }
  }
  return rows;
}

}  // namespace fathom::studies
