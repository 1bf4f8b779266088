#pragma once
#include <cstddef>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include "fem/motion/record/snapshot.h"
#include "pipelines/results/results.h"

namespace nurbeam {

/// The frames that a report shows.
struct ReportFrames {
  std::string title;
  SnapshotNames names;
  std::vector<double> times;  ///< at least one [s]
  std::function<std::vector<Snapshot>(std::size_t first, std::size_t count)> read;
  /// Of histories by their headings in histories.csv the errors, one for each frame; empty where they are not
  /// known.
  std::map<std::string, std::vector<double>> errors = {};
};

/// Writes the page (HTML) with the frames and run.json in it; it needs nothing else, no network either.
/// Histories are stored as they are (float64), control points as float32 relative to the middle of the model,
/// fields as one byte of their range in the beam and frame. Where shapes and histories would take more than
/// `most_bytes` it holds every second, third, ... frame and the last, and says so.
/// Throws std::invalid_argument unless `run_json` is a JSON object and there is a frame.
void write_report_page(std::ostream& stream, const ReportFrames& frames, const std::string& run_json,
                       std::size_t most_bytes = 100'000'000);

/// Writes report.html into a results directory, from its results.nc and run.json. Throws
/// std::invalid_argument (file and reason) when they are not there or cannot be read, and std::runtime_error
/// when the page cannot be written.
void write_report(const std::filesystem::path& directory);
/// The same of frames that are those of results.nc.
void write_report(const std::filesystem::path& directory, const StoredResults& results);

}  // namespace nurbeam
