#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

/// Studies of depth precision: each computes figures, draws them, and explains what is seen.
namespace fathom::studies {

/// A file that a study makes: CSV, JSON, HTML, PNG or SVG.
struct StudyFile {
  std::string name;
  std::string content;
};

/// What can be asked of a study; each has its own defaults, which show the effect.
struct StudyOptions {
  std::optional<double> near, far;
  /// Of two surfaces, along the view.
  std::optional<double> separation;
  std::optional<std::uint32_t> samples;
};

/// A study. `run` calls `tick` with the share of the work that is done, from 0 to 1.
/// Fails    UsageError for options that mean nothing; OutputError where plots cannot be drawn.
struct Study {
  const char* name;
  const char* description;
  std::vector<StudyFile> (*run)(const StudyOptions&, const std::function<void(double)>& tick);
};

const std::vector<Study>& all_studies();

/// Fails    UsageError, naming those that exist.
const Study& study_named(const std::string& name);

}  // namespace fathom::studies
