#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "apps/mpi/image_rows.h"
#include "apps/mpi/mpi_arguments.h"
#include "apps/mpi/ranks.h"
#include "apps/mpi/shared_scene.h"
#include "apps/mpi/traffic.h"
#include "apps/mpi/triangle_mail.h"
#include "apps/render/render_outputs.h"
#include "apps/render/render_plan.h"
#include "apps/render/render_report.h"
#include "apps/shell/console.h"
#include "fathom/camera/camera.h"
#include "fathom/fast/some_tiles.h"
#include "fathom/files/file_bytes.h"

namespace fathom::app {

/// The request of a run, and the common input of all its maps.
struct JobTogether {
  const MpiArguments& arguments;
  const Ranks& ranks;
  const Console& console;
  const MapPlan& plan;
  const SharedScene& scene;
  const RankMemory& memory;
};

/// The tiles of an image, drawn by all ranks: each has some of them.
class TilesTogether {
 public:
  /// `traffic` counts sent bytes and the time in which this rank draws. All arguments outlive it.
  TilesTogether(const JobTogether& job, const Camera& camera, const RenderOptions& options,
                MapTraffic& traffic);

  /// Draws the scene. Called by all ranks.
  void draw(const std::function<void(double)>& progress);
  /// The rank of each tile.
  [[nodiscard]] const std::vector<int>& owners() const { return owners_; }
  /// The map of some rows of tiles, with values where this rank has drawn. Call once for each row.
  DepthMap rows(const TileRows& rows);
  /// What this rank has counted.
  [[nodiscard]] RenderStatistics statistics() const { return drawing_->statistics(); }

 private:
  SortedTriangles deal_out_by_all();
  void deal_out_by_sample();
  void deal_out_tiles(std::vector<std::uint64_t> triangles);
  void draw_in_rounds(TriangleMail& mail, const std::function<void(double)>& progress);

  [[nodiscard]] bool is_own(std::uint32_t tile) const;
  /// Triangles of a round: each view of a lens sorts them.
  [[nodiscard]] std::uint32_t triangles_at_once() const;
  void draw_read(const SortedTriangles& sorted, TriangleMail& mail);
  void draw(const SortedTriangles& sorted);

  const JobTogether& job_;
  const Ranks& ranks_;
  const Camera& camera_;
  const RenderOptions& options_;
  MapTraffic& traffic_;
  TriangleSource triangles_;
  /// What this rank reads.
  TriangleRange own_;
  std::optional<TilesInRounds> drawing_;
  std::vector<int> owners_;
};

/// `fathom-mpi render`, in every rank of a run. Returns the exit status, the same in all of them.
int render_together(const MpiArguments& arguments, const Console& console);

/// The same for a scene that is there, and cameras. All ranks have the same ones.
int render_scene_together(const MpiArguments& arguments, const SharedScene& scene,
                          const std::vector<Camera>& cameras, const Console& console);

/// How many rows a chunk has, of a map that is put together from bands of rows; nullopt where all
/// rows go to the first rank.
std::optional<std::uint32_t> rows_of_chunk(const MapPlan& plan);

/// Makes the map of a camera, from the triangles of all ranks to a file. Called by all ranks.
/// `outputs`  of the first rank;  `number`: of the camera
/// `traffic`  gets the costs
/// `report`   gets the statistics of the map, in every rank and summed over all ranks; everything
///            else only in the first rank
void make_map_together(const JobTogether& job, const Camera& camera, RenderOutputs* outputs,
                       std::size_t number, const std::function<void(double)>& progress,
                       MapTraffic& traffic, MapReport& report);

}  // namespace fathom::app
