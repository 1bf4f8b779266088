#pragma once
#include <string>

#include "pipelines/case/case_file.h"

namespace nurbeam {

/// The moment of a value, for messages: "t = 0.31 s" of a motion, "load factor 0.4" of load steps; empty
/// where a static analysis has one state alone, and of modes.
std::string moment_text(const CaseAnalysis& analysis, double time, int digits);

/// The same with a word before it, " at t = 0.31 s"; empty where there is no moment.
std::string at_moment(const CaseAnalysis& analysis, double time, int digits);

}  // namespace nurbeam
