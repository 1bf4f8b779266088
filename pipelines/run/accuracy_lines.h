#pragma once
#include <string>
#include <vector>

#include "pipelines/results/accuracy.h"

namespace nurbeam {

/// "9.38 N m ± 0.03 N m": the digits of a number are those that its error leaves.
std::string text_with_error(double value, double error, const std::string& unit);

/// What came of the errors of a run, in lines for people: the runs, what is asked, the worst of it first, and
/// how many of all numbers are right to how much.
std::vector<std::string> accuracy_lines(const Accuracy& accuracy);

}  // namespace nurbeam
