#include "pipelines/model/check_freedom.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "fem/mesh/stop_distance.h"
#include "fem/system/initial_state.h"
#include "fem/system/names.h"
#include "fem/system/observables.h"
#include "nurbs/number_text.h"
#include "pipelines/diagnostics/closest_name.h"
#include "solver/system/dependent_constraints.h"
#include "solver/system/tangent_matrix.h"

namespace nurbeam {

namespace {

template <class T>
bool contains(const std::vector<T>& values, const T& value) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

std::vector<int> joints_of(const BeamModel& model, int body) {
  std::vector<int> joints;
  for (int j = 0; j < static_cast<int>(model.riders.size()); ++j)
    if (model.riders[j].body == body) joints.push_back(j);
  return joints;
}

// The first of the bodies on several beams whose coordinates a set ties; -1 where there is none.
int tied_body(const BeamSystem& system, const DependentConstraints& set) {
  for (int body = 0; body < static_cast<int>(system.model().bodies.size()); ++body)
    if (joints_of(system.model(), body).size() > 1 && contains(set.coordinates, system.mesh().bodies[body]))
      return body;
  return -1;
}

class FreedomCheck {
 public:
  FreedomCheck(const ResolvedCase& resolved, const BeamModel& model, Findings& findings)
      : resolved_(resolved), model_(model), findings_(findings) {}

  // With all sliding bodies held, as a search for rest does it, or as the motion starts. Whether nothing was
  // found.
  bool refuse_dependence(bool held) {
    const BeamSystem system(model_, initial_plan(model_), std::vector<bool>(model_.riders.size(), held));
    const auto sets = dependent_constraints(system, drawn_state(system));
    for (const DependentConstraints& set : sets) refuse(system, set, held);
    return sets.empty();
  }

  // A hard stop at which a body starts that a rod keeps there.
  void refuse_idle_stops() {
    for (std::size_t i = 0; i < model_.stops.size(); ++i) {
      const Stop& stop = model_.stops[i];
      const double length = model_.beam_of(model_.riders[stop.rider]).curve.length();
      MeshPlan plan = initial_plan(model_);
      plan.closed.assign(model_.stops.size(), false);
      plan.closed[i] = !stop.buffer;
      const BeamSystem system(model_, plan);
      const State drawn = drawn_state(system);
      if (stop.buffer ||
          !(std::abs(StopDistance(model_, system.mesh(), stop).value(drawn.q)) <= 1e-9 * length))
        continue;
      if (!dependent_constraints(system, drawn).empty())
        findings_.error("stops",
                        "body " + in_quotes(name_of(stop.rider)) +
                            " starts at a hard stop, at s = " + text_of(model_.riders[stop.rider].s) +
                            " m, where a rod keeps it anyway; leave the stop out of there");
    }
  }

  void warn_of_speeds() {
    const BeamSystem system(model_);
    State state = drawn_state(system);
    start_moving(system, state);
    Eigen::SparseMatrix<double> kkt = tangent_matrix(system, state, {});
    Eigen::VectorXd padded = Eigen::VectorXd::Zero(kkt.rows());
    padded.head(system.coordinate_count()) = state.v;
    const Eigen::VectorXd rates = (kkt * padded).tail(system.constraint_count());
    for (std::size_t i = 0; i < resolved_.connectors.size(); ++i) {  // those of collectors come behind them
      const auto row = row_of_rod(system, static_cast<int>(i));
      if (!row || std::abs(rates[*row]) <= 1e-9 * state.v.lpNorm<Eigen::Infinity>()) continue;
      findings_.warn(
          resolved_.connectors[i].path,
          "is a rod whose ends start at " + text_of(rates[*row], 6) +
              " m/s from each other along it: an impulse along the rod removes this at time 0; give its ends "
              "matching velocities");
    }
  }

 private:
  const std::string& name_of(int joint) const { return model_.body_of(model_.riders[joint]).name; }

  void refuse(const BeamSystem& system, const DependentConstraints& set, bool held) {
    const std::string where = held ? "where an equilibrium is sought, with sliding bodies held, " : "";
    for (int i = static_cast<int>(resolved_.connectors.size()) - 1; i >= 0; --i)
      if (const auto row = row_of_rod(system, i); row && contains(set.rows, *row))
        return findings_.error(
            resolved_.connectors[i].path,
            "is a rod, but " + where + "what else holds its ends" + others(system, set, i) +
                " keeps their distance already, and nothing says which bears what; leave one of them out, or "
                "make this a \"spring\" with a great stiffness" +
                (held ? ", or start as drawn" : ""));
    if (const int body = tied_body(system, set); body >= 0)
      return findings_.error(
          resolved_.sliding_joints[joints_of(model_, body).back()].path,
          "body " + in_quotes(model_.bodies[body].name) + " slides on several beams, but " + where +
              "these hold it in more ways than it can move, and nothing says which bears what; let it slide "
              "on one of them, or let one of them deform");
    refuse_joints(system, set, where);
  }

  // What holds a rigid body in more ways than it can move: a second hinge of a door, a fourth wheel.
  void refuse_joints(const BeamSystem& system, const DependentConstraints& set, const std::string& where) {
    const std::vector<std::string> names = row_names(system);
    const auto is_in = [&](const std::string& name) {
      return std::ranges::any_of(set.rows,
                                 [&](int row) { return names[row].substr(0, names[row].find('[')) == name; });
    };
    std::vector<std::string> parts;
    std::string path = "bodies";
    std::size_t number = 0;
    for (const Constraint& constraint : model_.constraints)
      if (const auto* joint = std::get_if<BodyJoint>(&constraint)) {
        const std::string& of = resolved_.body_joints[number++].path;
        if (!is_in(joint->reaction_name(model_))) continue;
        path = of;
        parts.push_back(joint->reaction_name(model_));
      }
    for (std::size_t j = 0; j < resolved_.sliding_joints.size(); ++j) {
      const int body = model_.riders[j].body;
      if (model_.turning_body(model_.riders[j]) < 0 || !contains(set.coordinates, system.mesh().bodies[body]))
        continue;
      path = resolved_.sliding_joints[j].path;
      parts.push_back(model_.bodies[body].name);
    }
    if (parts.empty()) return;
    findings_.error(
        path, where + quoted_list(parts) +
                  " hold bodies in more ways than these can move, and nothing says which bears "
                  "what; let one be a ball (\"pinned\" or \"hinged\" without an \"axis\") or free along a "
                  "line (\"guided\", \"cylinder\"), or put a stiff spring in its place");
  }

  // What of a set has a name, as ": the rod "a", the place of body "b"".
  std::string others(const BeamSystem& system, const DependentConstraints& set, int rod) const {
    std::string text;
    const auto name = [&](const std::string& what) { text += (text.empty() ? " (" : ", ") + what; };
    for (int i = 0; i < static_cast<int>(model_.connectors.size()); ++i)
      if (const auto row = row_of_rod(system, i); i != rod && row && contains(set.rows, *row))
        name("the rod " + in_quotes(model_.connectors[i].name));
    for (int j = 0; j < static_cast<int>(model_.riders.size()); ++j)
      if (const auto row = row_of_place(system, j); row && contains(set.rows, *row))
        name("the place at which body " + in_quotes(name_of(j)) + " is " +
             (model_.riders[j].motion ? "driven" : "held"));
    return text.empty() ? text : text + ")";
  }

  const ResolvedCase& resolved_;
  const BeamModel& model_;
  Findings& findings_;
};

}  // namespace

void check_freedom(const ResolvedCase& resolved, const BeamModel& model, Findings& findings) {
  const bool has_rods =
      std::any_of(model.connectors.begin(), model.connectors.end(),
                  [](const Connector& connector) { return connector.type == ConnectorType::rod; });
  bool shared = false;
  for (int body = 0; body < static_cast<int>(model.bodies.size()); ++body)
    shared = shared || joints_of(model, body).size() > 1;
  const bool joined = std::ranges::any_of(
      model.constraints, [](const Constraint& each) { return std::holds_alternative<BodyJoint>(each); });
  const bool on_wheels =
      std::ranges::any_of(model.riders, [&](const Rider& rider) { return model.turning_body(rider) >= 0; });
  if (!has_rods && !shared && !joined && !on_wheels) return;
  FreedomCheck check(resolved, model, findings);
  const bool moves = resolved.analysis.type == CaseAnalysis::Type::dynamic;
  const bool rests = !moves || resolved.analysis.start_from_equilibrium;
  if (moves && !check.refuse_dependence(false)) return;
  if (rests && !check.refuse_dependence(true)) return;
  if (!moves || !has_rods) return;
  check.refuse_idle_stops();
  if (!rests) check.warn_of_speeds();
}

}  // namespace nurbeam
