#pragma once
#include <Eigen/Core>
#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cad_import/report/diagnostic.h"
#include "nurbs/nurbs_curve.h"

namespace nurbeam {

/// Where a cable is clamped.
struct RouteEnd {
  Eigen::Vector3d point;    ///< [m]
  Eigen::Vector3d outward;  ///< the way in which the cable leaves it; of any length, not zero
};

/// What is known of a cable's length.
struct RouteGoal {
  enum class Kind {
    length,            ///< `value` is its unstressed length [m]
    slack,             ///< its unstressed length is (1 + `value`) times the distance of its ends
    least_bend_radius  ///< the shortest length at which no place has a bend radius below `value` [m]
  };
  Kind kind;
  double value;
};

/// A cable between two clamps that is straight where it is free.
struct RouteRequest {
  std::string name;
  std::string where;  ///< of messages: "cables.json: cables[0]"
  RouteEnd from, to;
  RouteGoal goal;
  std::string section, material;                           ///< JSON, by the keys of a case
  Eigen::Vector3d gravity = Eigen::Vector3d(0, 0, -9.81);  ///< [m/s^2]
};

struct RouteOptions {
  std::chrono::duration<double> time_limit{3};  ///< wall time of one equilibrium; the search for a bend
                                                ///< radius takes up to searches_per_radius times that
  double tolerance = 1e-6;                      ///< error of positions, over the length of the cable
  std::function<bool()> interrupted = {};       ///< asked often; true ends the search with an error
};
inline constexpr int searches_per_radius = 10;

/// A cable in equilibrium.
struct Route {
  std::string name;
  NurbsCurve curve;       ///< the deformed axis, from `from` to `to` [m]
  double length;          ///< unstressed [m]
  double drawn_length;    ///< of the curve: the unstressed length and the stretch of the tension [m]
  double distance;        ///< of its ends [m]
  double least_radius;    ///< of bending, EI over the largest moment [m]; infinite where it is straight
  double least_radius_s;  ///< its place, reference arc length from `from` [m]
  double largest_tension, largest_thrust;  ///< of the axial force along it; 0 where there is none [N]
  double sag;                              ///< below the line between the ends [m]; NaN where there is none
  Eigen::Vector3d from_force, to_force;    ///< of the clamps on the cable [N]
  int elements;
};

struct RouteReport {
  std::optional<Route> value;  ///< empty where any diagnostic is an error
  bool unsolved = false;  ///< the solver, or its time, came to an end; else errors are those of the request
  std::vector<Diagnostic> diagnostics;
};

/// The equilibrium of a cable under its weight. A cable shorter than the distance of its ends, a bend radius
/// that no length keeps and a search beyond its time limit are diagnostics that name the values.
RouteReport find_route(const RouteRequest& request, const RouteOptions& options = {});

/// A smooth curve from one end to the other along both directions, from which the search for equilibrium
/// starts: a cubic of five control points a, a + h t_a, m, b + h t_b, b, where h is a quarter of the shorter
/// of length and distance, and m lies midway, pushed along gravity until the curve has that length [m];
/// without gravity, or where that is along the chord, across the chord. Where it is longer than that already,
/// as with ends across the chord of a taut cable, it is pushed by half of h, so that it has no cusp.
/// Precondition: the distance of the ends is not 0.
NurbsCurve route_start(const RouteEnd& from, const RouteEnd& to, double length,
                       const Eigen::Vector3d& gravity);

}  // namespace nurbeam
