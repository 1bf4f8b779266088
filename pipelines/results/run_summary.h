#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cad_import/report/diagnostic.h"
#include "fem/motion/record/run_event.h"
#include "fem/motion/record/snapshot.h"
#include "pipelines/results/accuracy.h"
#include "pipelines/results/contact_statistics.h"
#include "pipelines/results/evidence.h"
#include "pipelines/results/mode_table.h"
#include "pipelines/results/run_extremes.h"
#include "pipelines/results/speed_table.h"

namespace nurbeam {

/// A file a run has read; `sha256` as sha256_of_file() gives it.
struct RunInput {
  std::filesystem::path file;
  std::string sha256;
};

/// Wall times [s].
struct PhaseTimes {
  double import = 0;  ///< reading the case and CAD files
  double model = 0;   ///< building the model and its initial state
  double motion = 0;  ///< integration or equilibrium
  double length_control = 0;
  double output = 0;
};

/// The largest axial mismatch (ElementRecord) of a run: where the mesh is coarsest for what it has to do.
struct Mismatch {
  double value = 0;
  std::string beam;
  double s = 0, time = 0;  ///< the element's middle [m], [s]

  void look_at(std::span<const ElementRecord> elements, const std::string& of_beam, double at_time);
};

/// The least axial strain that elements carry in a run.
struct LeastStrain {
  double value = 0;
  std::string beam;
  double s = 0, time = 0;  ///< [m], [s]

  void look_at(std::span<const ElementRecord> elements, const std::string& of_beam, double at_time);
};

/// The element that is nearest to folding back on itself in a run: its tangent turns round where it vanishes,
/// and the ends and the mean of its axial strain do not see that.
struct Fold {
  double value = 0;  ///< ElementRecord::folded
  std::string beam;
  double s = 0, time = 0;  ///< the element's middle [m], [s]

  void look_at(std::span<const ElementRecord> elements, const std::string& of_beam, double at_time);
};

/// What run.json says about a run.
struct RunSummary {
  std::string version;
  std::string case_name;
  std::vector<RunInput> inputs;
  std::string model;                 ///< JSON object, of model_summary()
  std::optional<double> resumed_at;  ///< simulated time of the restart point it went on from [s]
  std::string status;                ///< "done", or why the run ended before its end
  PhaseTimes wall_times;
  double end_time = 0;  ///< simulated time reached [s]
  long steps = 0, rejected_steps = 0, newton_iterations = 0;
  std::vector<RunEvent> events;
  std::vector<std::string> beams, bodies;  ///< names of the model's, for the events
  double energy_drift =
      0;  ///< largest departure of the total energy, with the dissipated, from its start [J]
  std::map<std::string, double> round_off;  ///< of values, by their unit
  Mismatch axial_mismatch;
  std::vector<RunExtreme> extremes;
  std::vector<CollectorOutcome> collectors = {};
  std::optional<ModeTable> modes = {};    ///< of an analysis of modes or buckling
  std::optional<SpeedTable> speeds = {};  ///< of modes over speeds of rotation
  std::optional<Accuracy> accuracy = {};
  std::vector<FeatureEvidence> evidence;
  std::vector<Diagnostic> diagnostics;
  std::vector<std::filesystem::path> files;  ///< written, relative to the results directory
};

/// Writes the summary as JSON, to a temporary name that is renamed. Numbers that are not finite become null.
/// Throws std::runtime_error (file and reason).
void write_run_summary(const std::filesystem::path& file, const RunSummary& summary);

/// The status in the run.json of a directory; empty where there is none that can be read.
std::string status_of_run(const std::filesystem::path& directory);

/// The array that run.json has under "collectors".
std::string collectors_as_json(const std::vector<CollectorOutcome>& collectors);

/// Of each beam of the run, as that says in a results directory, its name and that of its drawn curve; empty
/// where it says nothing, as of a run that was killed.
std::map<std::string, std::string> drawn_curve_names(const std::filesystem::path& directory);

}  // namespace nurbeam
