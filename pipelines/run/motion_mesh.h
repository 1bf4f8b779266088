#pragma once
#include <functional>
#include <vector>

#include "pipelines/model/build_model.h"

namespace nurbeam {

/// Divides the beams whose `elements.tolerance` is one over the motion, until it is met: the run is held
/// against one with twice the elements, at every output time and 33 places of each beam. 1.5 times their
/// greatest distance, over the length of the beam, is taken as the error of the coarser one, whose mesh
/// stays; of 100 true errors 95 are below it (docs/theory.md). Steps are those of the case in each run: what
/// they leave out is not seen. Returns notes and warnings. Does nothing without such beams, or where nothing
/// moves.
std::vector<Diagnostic> divide_for_motion(const CaseFile& case_file, BuiltModel& built,
                                          const std::function<bool()>& interrupted = {});

}  // namespace nurbeam
