#pragma once
#include <filesystem>
#include <functional>
#include <optional>

#include "fem/motion/record/simulation_report.h"
#include "fem/motion/rest/modes.h"
#include "pipelines/model/build_model.h"
#include "pipelines/results/mode_table.h"

namespace nurbeam {

/// What takes the frames of modes, in the model's own coordinates.
struct ModeShapes {
  std::function<void(const Snapshot&)> state;  ///< that they are about
  std::function<void(const Snapshot&)> shape;  ///< of each mode
  /// The frames of one period of each, by the name of a series of files.
  std::function<void(const std::string&, const std::vector<Snapshot>&)> turn;
};

/// How a case of modes or buckling is to be run.
ModesOptions modes_options(const CaseAnalysis& analysis);

/// Computes the modes or the buckling factors that a case asks for. The first frame is the state they are
/// about, at time 0; frame i shows mode i, at time i, with an amplitude that makes it visible, and as
/// velocities (0 for buckling) those with which it swings through the state. Throws what
/// `shapes` does.
SimulationReport run_modes(const CaseFile& c, const BuiltModel& built,
                           const std::function<bool()>& interrupted, const ModeShapes& shapes,
                           ModeTable& table);

/// That modes bend in so short waves that shear and rotary inertia, which the beams leave out, count.
std::optional<Diagnostic> short_waves_warning(const std::filesystem::path& file, const ModeTable& table);

/// That elements are too long for the waves of modes.
std::optional<Diagnostic> coarse_waves_warning(const std::filesystem::path& file, const ModeTable& table);

/// That a frequency has lost digits to round-off, or may be no 0.
std::optional<Diagnostic> round_off_warning(const std::filesystem::path& file, const BeamModel& model,
                                            const ModeTable& table);

}  // namespace nurbeam
