#pragma once
#include <vector>

namespace nurbeam {

/// The one rule for entities that nearly agree with themselves: what others read is read, and the repair is
/// told with its size; what cannot be repaired is named; nothing else. Lengths are those of the file.
struct Leniency {
  double resolution = 0;  ///< within which points of the file are one; 0: undeclared

  /// Whether places of an entity of this size that should be one, and are `off` apart, are made one: up to
  /// 1 % of the size, or up to the resolution where that is at most a tenth of it.
  bool repairs(double off, double size) const;

  /// Whether a repair of that size is more than the digits of a text.
  static bool is_told(double off, double size);
};

/// Raises knots that are less than the one before by what is repaired, and makes those of an end one that
/// differ in their last digits. Returns the largest change, as a part of their range; 0 for none.
double repair_knots(std::vector<double>& knots, int degree);

}  // namespace nurbeam
