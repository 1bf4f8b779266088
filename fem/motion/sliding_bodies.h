#pragma once
#include <string>

#include "fem/motion/simulation_report.h"
#include "fem/system/beam_system.h"

/// Where the bodies are that slide on beams.
namespace nurbeam {

/// The name of the body of a joint.
const std::string& body_name(const BeamModel& model, int joint);
/// The curve of the beam on which the joint's body slides.
const ReferenceCurve& curve_of(const BeamModel& model, int joint);
/// Mean length of the standard elements of that beam [m].
double home_spacing(const BeamModel& model, int joint);

/// From one body to the nearest other one on its beam [m]; infinity where it is alone.
template <int D>
double distance_to_others(const BeamSystem<D>& system, const State& state, int joint);

/// For messages: where each body is and how fast it slides, each after a semicolon.
template <int D>
std::string places_text(const BeamSystem<D>& system, const State& state);

/// Two bodies that meet on one beam end the run: false, and the report says so.
template <int D>
bool check_bodies_apart(const BeamSystem<D>& system, const State& state, SimulationReport& report);

extern template double distance_to_others<2>(const BeamSystem<2>&, const State&, int);
extern template double distance_to_others<3>(const BeamSystem<3>&, const State&, int);
extern template std::string places_text<2>(const BeamSystem<2>&, const State&);
extern template std::string places_text<3>(const BeamSystem<3>&, const State&);
extern template bool check_bodies_apart<2>(const BeamSystem<2>&, const State&, SimulationReport&);
extern template bool check_bodies_apart<3>(const BeamSystem<3>&, const State&, SimulationReport&);

}  // namespace nurbeam
