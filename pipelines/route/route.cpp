#include "pipelines/route/route.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fem/motion/run/simulation.h"
#include "nurbs/number_text.h"
#include "pipelines/model/build_model.h"
#include "pipelines/model/model_snapshot.h"
#include "pipelines/results/export_results.h"
#include "pipelines/route/route_case.h"
#include "pipelines/run/run_checks.h"
#include "pipelines/run/simulation_plan.h"

namespace nurbeam {

namespace {

constexpr int digits = 6;

std::string metres(double value) { return text_of(value, digits) + " m"; }

double distance_of(const RouteRequest& request) { return (request.to.point - request.from.point).norm(); }

// An equilibrium, or why there is none.
struct Attempt {
  std::optional<Route> route;
  std::vector<Diagnostic> diagnostics;
  bool out_of_time = false, unsolved = false;
};

class RouteSearch {
 public:
  RouteSearch(const RouteRequest& request, const RouteOptions& options)
      : request_(request), options_(options), begun_(Clock::now()) {}

  RouteReport find() {
    if (!check_ends()) return report();
    switch (request_.goal.kind) {
      case RouteGoal::Kind::length:
        take(at_length(request_.goal.value, "length"));
        break;
      case RouteGoal::Kind::slack:
        take(at_length((1 + request_.goal.value) * distance_of(request_), "slack"));
        break;
      case RouteGoal::Kind::least_bend_radius:
        limit_ = searches_per_radius * options_.time_limit;
        keep_radius(request_.goal.value);
        break;
    }
    return report();
  }

 private:
  using Clock = std::chrono::steady_clock;

  void say(Severity severity, const std::string& key, const std::string& message) {
    diagnostics_.push_back({severity, request_.where + (key.empty() ? "" : "." + key), message});
  }

  bool check_ends() {
    if (distance_of(request_) > 0) return true;
    say(Severity::error, "to",
        "is the point of \"from\", " + text_of(request_.to.point, digits) +
            " m; a cable goes from one place to another");
    return false;
  }

  bool is_late() const { return Clock::now() - begun_ > limit_; }

  RouteReport report() {
    if (has_errors(diagnostics_)) found_.reset();
    return {std::move(found_), unsolved_, std::move(diagnostics_)};
  }

  void take(Attempt attempt) {
    found_ = std::move(attempt.route);
    diagnostics_.insert(diagnostics_.end(), attempt.diagnostics.begin(), attempt.diagnostics.end());
    unsolved_ = attempt.unsolved || attempt.out_of_time;
    if (attempt.out_of_time)
      say(Severity::error, "",
          "no equilibrium is found within the time limit of " + text_of(limit_.count(), 3) +
              " s; give it a greater one (--time-limit), more length, or ends that look towards each other");
  }

  Attempt at_length(double length, const std::string& key) {
    const double distance = distance_of(request_);
    // Nothing is left to find where the cable is taut; that is what the extension is for.
    constexpr double least_excess = 1e-6;
    if (!(length > (1 + least_excess) * distance)) {
      Attempt none;
      none.diagnostics = {{Severity::error, request_.where + "." + key,
                           "makes a cable of " + metres(length) + ", and its ends are " + metres(distance) +
                               " apart; it must be longer than that"}};
      return none;
    }
    return equilibrium(length, options_.tolerance);
  }

  Attempt equilibrium(double length, double tolerance) {
    Attempt attempt;
    const NurbsCurve start = route_start(request_.from, request_.to, length, request_.gravity);
    const CaseFileReport read = route_case(request_, start, length, tolerance);
    attempt.diagnostics = in_places_of(request_, read.diagnostics);
    if (!read.value) return attempt;
    const auto ends = [this] { return is_late() || (options_.interrupted && options_.interrupted()); };
    const BuildReport built = build_model(*read.value, ends);
    if (!built.value && ends()) {
      attempt.out_of_time = true;
      return attempt;
    }
    for (Diagnostic& each : in_places_of(request_, built.diagnostics))
      attempt.diagnostics.push_back(std::move(each));
    if (built.value) solve(*read.value, *built.value, length, ends, attempt);
    return attempt;
  }

  void solve(const CaseFile& c, const BuiltModel& built, double length, const std::function<bool()>& ends,
             Attempt& attempt) {
    std::optional<Snapshot> rest;
    SimulationObserver observer;
    observer.snapshot = [&](Snapshot local) { rest = to_world(built.frame, std::move(local)); };
    observer.interrupted = ends;
    const SimulationReport run = simulate(built.model, {}, simulation_options(c), observer);
    attempt.out_of_time = run.status == SimulationStatus::interrupted;
    if (attempt.out_of_time) return;
    if (run.status != SimulationStatus::done || !rest) {
      attempt.unsolved = true;
      attempt.diagnostics.push_back({Severity::error, request_.where, outcome_in_world(run, built)});
      return;
    }
    FrameChecks checks(built.model);
    checks.look_at(*rest);
    for (Diagnostic& each : in_places_of(request_, run_warnings(c, built, run, checks)))
      attempt.diagnostics.push_back(std::move(each));
    attempt.route = route_of(built, *rest, length);
  }

  Route route_of(const BuiltModel& built, const Snapshot& rest, double length) const {
    const BeamRecord& beam = rest.beams.at(0);
    const BeamProperties& properties = built.model.beams.at(0).properties;
    // The model counts by its drawn length: EI and places are those of the unstressed one after this factor.
    const double stretch = std::sqrt(1 + 2 * properties.free_strain.constant);
    // Reactions are those on the beam at its two clamps, in the order of the case.
    return {.name = request_.name,
            .curve = deformed_curve(beam.elements),
            .length = length,
            .drawn_length = beam.length,
            .distance = distance_of(request_),
            .least_radius = stretch * properties.bending_stiffness / std::abs(beam.moment_max.value),
            .least_radius_s = stretch * beam.moment_max.s,
            .largest_tension = std::max(0.0, beam.axial_force_max.value),
            .largest_thrust = std::max(0.0, -beam.axial_force_min.value),
            .sag = beam.sag,
            .from_force = rest.reactions.at(0).force,
            .to_force = rest.reactions.at(1).force,
            .elements = static_cast<int>(beam.elements.size())};
  }

  // The radius is no monotone function of the length: lengths are tried from short to long, and the first
  // that keeps it bounds a search by halves.
  void keep_radius(double wanted) {
    constexpr double coarse = 1e-4;
    double too_short = 0, longest = 0;
    std::optional<Route> best;
    for (const double excess : scanned_excesses) {
      const double length = (1 + excess) * distance_of(request_);
      Attempt tried = equilibrium(length, coarse);
      if (tried.out_of_time || (has_errors(tried.diagnostics) && !tried.unsolved))
        return take(std::move(tried));
      longest = length;
      if (!tried.route) continue;  // too taut, or not found: another length may do
      if (tried.route->least_radius >= wanted) return shorten(wanted, too_short, length);
      too_short = length;
      if (!best || tried.route->least_radius > best->least_radius) best = std::move(tried.route);
    }
    if (!best) return take(at_length(longest, "least_bend_radius"));
    say(Severity::error, "least_bend_radius",
        "is " + metres(wanted) + ", which no length up to " + metres(longest) +
            " keeps; the largest possible is about " + metres(best->least_radius) + ", at a length of " +
            metres(best->length));
  }

  // The shortest length between one that does not keep the radius (0: there is none) and one that does.
  void shorten(double wanted, double too_short, double enough) {
    constexpr double relative = 1e-4, margin = 1.02;
    Attempt kept = equilibrium(enough, options_.tolerance);
    // The radius of the coarse search may be a little off.
    while (kept.route && kept.route->least_radius < wanted && !is_late())
      kept = equilibrium(enough *= margin, options_.tolerance);
    while (kept.route && too_short > 0 && enough - too_short > relative * enough) {
      const double length = 0.5 * (too_short + enough);
      Attempt tried = equilibrium(length, options_.tolerance);
      if (!tried.route) return take(std::move(tried));
      if (tried.route->least_radius >= wanted) {
        enough = length;
        kept = std::move(tried);
      } else {
        too_short = length;
      }
    }
    take(std::move(kept));
  }

  static constexpr std::array scanned_excesses{0.001, 0.002, 0.005, 0.01, 0.02, 0.03, 0.045, 0.06,
                                               0.08,  0.1,   0.13,  0.16, 0.2,  0.25, 0.32,  0.4,
                                               0.5,   0.65,  0.8,   1.0,  1.3,  1.6,  2.0};

  const RouteRequest& request_;
  const RouteOptions& options_;
  Clock::time_point begun_;
  std::chrono::duration<double> limit_ = options_.time_limit;
  std::optional<Route> found_;
  bool unsolved_ = false;
  std::vector<Diagnostic> diagnostics_;
};

}  // namespace

RouteReport find_route(const RouteRequest& request, const RouteOptions& options) {
  return RouteSearch(request, options).find();
}

}  // namespace nurbeam
