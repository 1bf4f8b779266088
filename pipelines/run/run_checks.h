#pragma once
#include <span>
#include <vector>

#include "cad_import/report/diagnostic.h"
#include "fem/motion/record/simulation_report.h"
#include "pipelines/model/build_model.h"
#include "pipelines/results/layer_checks.h"
#include "pipelines/results/run_summary.h"
#include "pipelines/results/shared_pull.h"
#include "pipelines/run/model_notes.h"

namespace nurbeam {

/// What a run is looked at for, frame by frame: what makes its answer doubtful.
class FrameChecks {
 public:
  /// `model` must outlive it.
  explicit FrameChecks(const BeamModel& model) : model_(model), pulls_(model) {}

  /// A frame in world coordinates.
  void look_at(const Snapshot& frame);
  /// Elements of a beam, of a frame that has none of them.
  void look_at(std::span<const ElementRecord> elements, int beam, double time);

  /// The largest over all frames.
  const Mismatch& axial_mismatch() const { return mismatch_; }
  const LeastStrain& least_strain() const { return least_strain_; }
  const Fold& fold() const { return fold_; }
  const SharedPulls& shared_pulls() const { return pulls_; }
  const BeamsInRun& beams() const { return beams_; }
  const HighStress& high_stress() const { return high_stress_; }
  /// The first.
  const SlackKink& slack_kink() const { return slack_kink_; }

 private:
  const BeamModel& model_;
  Mismatch mismatch_;
  LeastStrain least_strain_;
  Fold fold_;
  SharedPulls pulls_;
  BeamsInRun beams_;
  HighStress high_stress_;
  SlackKink slack_kink_;
};

/// All that is to be said of a run of motion or statics, of modes and buckling but for the table of these:
/// warnings and notes.
std::vector<Diagnostic> run_warnings(const CaseFile& case_file, const BuiltModel& built,
                                     const SimulationReport& run, const FrameChecks& frames);

}  // namespace nurbeam
