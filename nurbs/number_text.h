#pragma once
#include <Eigen/Core>
#include <string>

namespace nurbeam {

/// All the decimal digits that a double keeps: for a number as somebody wrote it.
constexpr int all_digits = 15;

/// A number for messages, with that many significant digits at most.
std::string text_of(double value, int digits = 10);

/// "(x, y, z) m", for messages.
std::string text_of(const Eigen::Vector3d& point, int digits = 10);

}  // namespace nurbeam
