#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "apps/mpi/rank_plan.h"
#include "apps/render/render_arguments.h"

namespace fathom::app {

/// The arguments of `fathom-mpi render`: the arguments of `fathom render`, and more.
struct MpiArguments {
  RenderArguments render;
  Partition partition = Partition::load;
  std::string traffic;
  /// In bytes, for each rank.
  std::optional<std::uint64_t> memory;

  void add_to(Command& command);
};

/// Refuses arguments that several ranks do not support yet, before any work.
/// Fails    UsageError.
void refuse_what_is_missing(const RenderArguments& arguments);

}  // namespace fathom::app
