#pragma once
#include <string>
#include <vector>

#include "pipelines/model/build_model.h"
#include "pipelines/verification/verify_run.h"

/// Ropes and nets as case files, so that what a case leaves to the program is decided as for everybody; z is
/// up, gravity 9.81 m/s^2.
namespace nurbeam::verification {

/// Runs the text of a case; the frames are in the world's coordinates. Throws std::runtime_error, with the
/// message, where it has an error or the run ends early.
RunRecord run_text(const std::string& text);

/// The largest distance in z of the first probe from the heights of a reference, frame by frame.
double largest_z_error(const RunRecord& run, const std::vector<double>& heights);

/// Four cables of 12 m, 1 kg/m and 1 MN under 5 kN that cross at 4 and 8 m and are joined there; the first
/// probe is the crossing of both second cables. `more`: loads, connectors, analysis, output but probes.
std::string net_case(int elements, const std::string& more);
inline constexpr double net_span = 12, net_tension = 5e3, net_stiffness = 1e6, net_mass = 1;
inline constexpr double net_crossings[] = {4, 8};

/// A webbing of 18 m and 20 kN between points 18.9 m apart, `mass` in kg/m; the probe is at a fraction of it.
std::string slackline_case(int elements, const std::string& law, double mass, double fraction,
                           const std::string& more);
inline constexpr double slackline_length = 18, slackline_span = 18.9, slackline_stiffness = 2e4;

/// A rope of 20 m and 1.5 kN that hangs plumb, `mass` in kg/m; the probe is its lower end, recorded `every`
/// [s].
std::string bungee_case(int elements, const std::string& law, double mass, double every,
                        const std::string& more);
inline constexpr double bungee_length = 20, bungee_stiffness = 1500;

/// A rope between points at one height; the probe is at two fifths of it.
std::string hanging_case(int elements, double length, double span, double stiffness, double mass,
                         const std::string& more);

/// A rope that hangs from the origin, drawn straight to `tip`, and turns about the plumb line [rad/s] at
/// first; the probe is its end.
std::string whirling_case(int elements, const Eigen::Vector3d& tip, double stiffness, double mass,
                          double spin, const std::string& more);

/// Half of a rope that a hook pulls out between two eyelets, its start guided along x, its tail behind the
/// eyelet along y; probes are the start and the end.
std::string arresting_case(int elements, double stiffness, double half, double tail,
                           const std::string& loads);

/// Half of an arresting gear: an aircraft of 15 t at 66 m/s hooks a rope of 4 kg/m and 20 MN in its middle,
/// 17 m from a sheave behind which a brake of 350 kN holds a tail of 60 m that 20 kN pull straight. The body
/// is the sheave, then the aircraft, which is 1 m behind the rope at first.
std::string arrested_aircraft(double longest_element);

}  // namespace nurbeam::verification
