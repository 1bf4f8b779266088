#pragma once
#include <optional>
#include <string>
#include <vector>

namespace nurbeam {

/// One of the runs that an estimate of errors comes from.
struct AccuracyLevel {
  int level;  ///< 2^level times the elements of the case
  long elements, steps;
  std::optional<double> step;  ///< where it is fixed [s]
  double seconds;              ///< wall time
};

/// A number of a run with its error of mesh and step.
struct NumberWithError {
  std::string quantity, unit;
  double value = 0, error = 0;
  double relative = 0;              ///< the error, of the scale of the quantity
  std::optional<double> s = {};     ///< reference arc length, of an extreme along a beam [m]
  std::optional<double> time = {};  ///< [s]; of a static analysis the load factor
  std::string not_converged = {};   ///< why the error is no bound; empty where it is one
  bool is_asked = false;            ///< it counts for the target
  bool is_end = false;              ///< of the last frame
  bool is_nought() const { return value == 0 && error == 0; }
};

/// The errors of a run, estimated from runs of the same case with other elements and steps.
struct Accuracy {
  bool moves = false;
  std::vector<AccuracyLevel> runs;  ///< the finest first: it has the values
  std::optional<double> target;     ///< part of the scale
  bool reached = true;
  std::string unreached = {};  ///< why it is not
  std::vector<NumberWithError> numbers;
  std::optional<double> parted = {};  ///< when the runs part, where they do [s]
  /// Of the case's own run: of its extremes, events of bodies and modes in their order.
  std::vector<double> extremes = {}, events = {}, modes = {};
};

}  // namespace nurbeam
