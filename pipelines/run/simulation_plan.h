#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include "cad_import/report/diagnostic.h"
#include "fem/motion/run/simulation.h"
#include "pipelines/model/build_model.h"
#include "pipelines/results/run_summary.h"
#include "pipelines/results/shared_pull.h"

namespace nurbeam {

/// How a case of motion or statics is to be run.
SimulationOptions simulation_options(const CaseFile& case_file);

/// Where the probes of a model are.
std::vector<ProbePlace> probe_places(const BuiltModel& built);

/// A note where an analysis of modes or buckling was asked for more of them than there are.
std::optional<Diagnostic> fewer_modes_note(const CaseFile& case_file, const ModeTable& table);

/// A warning where an element is compressed to nothing.
std::optional<Diagnostic> compression_warning(const CaseFile& case_file, const LeastStrain& strain);
/// And where one folds back on itself.
std::optional<Diagnostic> fold_warning(const CaseFile& case_file, const Fold& fold);

/// Warnings where elements beside supports are too long for what these share of a pull; `file` heads them.
std::vector<Diagnostic> shared_pull_warnings(const std::filesystem::path& file,
                                             const std::vector<SharedPull>& coarse);

/// A note where every tenth step of a fixed length or more had to be shorter; `file` heads it.
std::optional<Diagnostic> short_steps_note(const std::filesystem::path& file, const SimulationReport& run);

/// Notes where bodies are carried as points from a moment on, as changes of the mesh beside their nodes would
/// have cost energy; `file` heads them.
std::vector<Diagnostic> given_up_node_notes(const std::filesystem::path& file, const SimulationReport& run,
                                            const BeamModel& model);

/// A warning where an equilibrium is unstable and no stable one was found; `file` heads it.
std::optional<Diagnostic> divergence_warning(const std::filesystem::path& file, const SimulationReport& run);

/// A warning where loads have led past the end of a branch of equilibria, or nothing but what acts besides
/// loads; `file` heads it.
std::optional<Diagnostic> snap_warning(const std::filesystem::path& file, const SimulationReport& run,
                                       const BeamModel& model);

/// A warning where a model at rest is a mechanism; `file` heads it.
std::optional<Diagnostic> mechanism_warning(const std::filesystem::path& file, const SimulationReport& run,
                                            const BuiltModel& built);

/// A warning where energy comes from nowhere or is lost.
std::optional<Diagnostic> energy_warning(const CaseFile& case_file, const SimulationReport& run);

}  // namespace nurbeam
