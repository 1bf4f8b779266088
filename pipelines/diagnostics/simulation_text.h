#pragma once
#include <string>

#include "fem/model/beam_model.h"
#include "fem/motion/record/simulation_report.h"

namespace nurbeam {

/// "split", "merge", "left the beam", ...
std::string name_of(EventKind kind);

/// Why a simulation of the model ended before its end, and what may help; "done" when it did not.
std::string outcome_text(const SimulationReport& report, const BeamModel& model);

/// What the motion of a loose part is, where the supports tell: of a beam that has the model's only support,
/// that it turns about that, of a model without any that it has none; else "".
std::string turns_about_text(const BeamModel& model, const LoosePart& loose);

}  // namespace nurbeam
