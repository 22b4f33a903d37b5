#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/options/camera_options.h"
#include "apps/options/output_arguments.h"
#include "apps/options/pipeline_options.h"
#include "apps/options/scene_options.h"
#include "apps/options/storage_options.h"
#include "apps/shell/command.h"
#include "fathom/depth_format/depth_format.h"
#include "fathom/image/sample_pattern.h"

namespace fathom::app {

enum class EngineName { fast, reference, pipeline };

/// What Cryptomatte goes by: objects, or segments.
using MatteKind = std::optional<Segmentation>;

/// `--depth-format --mapping --c --against-exact` of `render`: the channels of a depth buffer, or
/// the z-buffer of the pipeline.
struct DepthBufferArguments {
  std::optional<Storage> storage;
  std::optional<Mapping> mapping;
  std::optional<double> c;
  bool against_exact = false;

  /// Declares the options (render_command.cpp).
  void add_to(Command& command);
};

/// The arguments of `fathom render`, each as it was given. Combinations are checked when a plan is
/// made from them.
struct RenderArguments {
  SceneOptions scene;
  MotionOptions motion;
  CameraOptions camera;
  StorageOptions storage;
  DepthBufferArguments depth_buffer;
  PipelineArguments pipeline;
  /// Times at which the shutter opens and closes.
  std::optional<std::array<double, 2>> shutter;
  EngineName engine = EngineName::fast;
  Cull cull = Cull::none;
  std::optional<std::vector<Channel>> channels;
  /// Whether the map is written as the mask of its one channel.
  bool is_mask = false;
  /// Whether --channels also names a mask, which is a separate output.
  bool mask_beside = false;
  /// The object whose mask it is, if it is the mask of one object.
  std::optional<std::uint32_t> object;
  std::optional<SamplePattern> samples;
  std::optional<std::uint64_t> verified_pixels;
  bool stream = false, deep = false, cryptomatte = false;
  std::vector<MatteKind> mattes_by;
  /// Each -o; empty where a command has only `output`.
  std::vector<OutputArgument> outputs;
  /// Names of files; empty: not asked for. "-" is standard output for the second line. `output` is
  /// the pattern of the first -o.
  std::string output, image;
  std::string save_camera, statistics;

  /// Declares all options of `render` (render_command.cpp).
  void add_to(Command& command);
  /// Takes the contents of a map in place of the previous ones.
  void take(Contents contents);
  /// For the exact engines. Fails with UsageError where an option of the pipeline is given.
  void refuse_pipeline_options() const;
  /// The requested layers of Cryptomatte.
  [[nodiscard]] std::vector<MatteKind> mattes() const;
  /// The patterns of all outputs.
  [[nodiscard]] std::vector<std::string> patterns() const;
  /// How this output is stored: with the options that its format and contents have, if it is one of
  /// several.
  [[nodiscard]] StorageOptions storage_of(std::size_t number) const;
  /// Fails with UsageError if --channels names contents that no output has. An output without names
  /// has the channels of the list; a mask is a separate output.
  void require_outputs_of_channels() const;
  /// The arguments as if this output were the only one, with the options that its format has.
  [[nodiscard]] RenderArguments of_output(std::size_t number) const;
  /// The same, for engines that write a single map. Fails with UsageError if there are several.
  [[nodiscard]] RenderArguments of_only_output(const std::string& writer) const;

 private:
  void add_output(Command& command);
  void add_background(Command& command);

  std::vector<Option> of_pipeline_;
  std::optional<pipeline::Colour> picture_background_;
};

}  // namespace fathom::app
