#pragma once
#include <limits>
#include <span>
#include <vector>

#include "cad_import/report/diagnostic.h"
#include "fem/motion/record/simulation_report.h"
#include "fem/motion/record/snapshot.h"
#include "pipelines/case/case_file.h"

namespace nurbeam {

/// Strains and forces along beams in a run that tell whether its model says enough.
class BeamsInRun {
 public:
  struct OfBeam {
    double stretch = 0;      ///< the engineering strain of the largest magnitude [-]
    double s = 0, time = 0;  ///< its place and time [m], [s]
    /// Time of the first frame [s], and the least axial force in it [N].
    double start = std::numeric_limits<double>::infinity();
    double least_force = std::numeric_limits<double>::infinity();
  };
  void look_at(std::span<const ElementRecord> elements, int beam, double time);
  /// By the number of the beam.
  OfBeam of(int beam) const {
    return beam < static_cast<int>(beams_.size()) ? beams_[static_cast<std::size_t>(beam)] : OfBeam();
  }

 private:
  std::vector<OfBeam> beams_;
};

/// A note for each beam with a strain of 2 % or more whose case does not say the axial law: by how much the
/// laws differ.
std::vector<Diagnostic> law_notes(const CaseFile& case_file, const BeamModel& model, const BeamsInRun& beams);

/// A note for each beam that is taut at the start of a motion and has no damping.
std::vector<Diagnostic> undamped_notes(const CaseFile& case_file, const BeamModel& model,
                                       const BeamsInRun& beams);

/// A note for each body that friction cannot hold where the start equilibrium has held it.
std::vector<Diagnostic> loose_body_notes(const CaseFile& case_file, const BeamModel& model,
                                         const SimulationReport& run);

}  // namespace nurbeam
