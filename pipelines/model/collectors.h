#pragma once
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "fem/model/beam_model.h"
#include "pipelines/diagnostics/findings.h"
#include "pipelines/model/drawn_beam.h"
#include "pipelines/model/model_frame.h"
#include "pipelines/model/resolved_case.h"

namespace nurbeam {

/// A collector of a model: of which parts it is made, and what is told of it.
struct Collector {
  std::string name;
  int head;                                                ///< number of the body
  int contact;                                             ///< number of the connector
  std::vector<int> springs;                                ///< numbers of the connectors, from the base up
  Eigen::Vector3d travel, up;                              ///< of unit length, in the world
  double from = -std::numeric_limits<double>::infinity();  ///< of the evaluation, along `travel` [m]
  double to = std::numeric_limits<double>::infinity();     ///< [m]
  double filter;                                           ///< [Hz]
  std::vector<std::pair<double, double>> bands;            ///< [Hz]
  std::vector<std::string> uplift;                         ///< names of probes
};

/// Adds the collectors of a case to a model that has its beams and bodies. Each becomes a place of its wire
/// that moves, without mass; a base that travels; masses, which rods keep above it; springs and dampers
/// between them; and a connector between the head and the place that pushes alone.
std::vector<Collector> add_collectors(const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams,
                                      const ModelFrame& frame, BeamModel& model, Findings& findings);

/// Finds the free lengths of connectors that an equilibrium gives, without collectors: droppers are made for
/// the line, and not for what runs below it. An error where there is no such equilibrium, and where the
/// search is interrupted.
void find_lengths_without(const std::vector<Collector>& collectors, const std::function<bool()>& interrupted,
                          BeamModel& model, Findings& findings);

}  // namespace nurbeam
