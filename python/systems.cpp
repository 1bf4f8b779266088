#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <stdexcept>

#include "fem/motion/remesh/meshed_state.h"
#include "fem/system/observables.h"
#include "python/bindings.h"
#include "python/laws.h"
#include "python/live_run.h"
#include "solver/system/tangent_matrix.h"

namespace nurbeam::python {

namespace {

namespace py = pybind11;

// The equations of a model in one mesh, and a state of it; both stay as they are.
class Equations {
 public:
  // The same system once more, which belongs to nobody else.
  Equations(const BeamSystem& system, State state)
      : system_(system.shared_model(), system.mesh().plan, system.held()), state_(std::move(state)) {}

  static Equations drawn(const BuiltCase& c, const Functions& functions) {
    const MeshedState drawn = MeshedState::drawn(
        std::make_shared<const BeamModel>(with_laws(c.built(), functions, c.case_file.analysis)));
    return {*drawn.system, drawn.state};
  }
  static Equations of(const LiveRun& run) { return {run.simulation().system(), run.simulation().state()}; }

  const BeamSystem& system() const { return system_; }
  const State& state() const { return state_; }

  // The state with some of its parts exchanged. Throws std::invalid_argument for wrong sizes.
  State at(const std::optional<double>& t, const std::optional<Eigen::VectorXd>& q,
           const std::optional<Eigen::VectorXd>& v, const std::optional<Eigen::VectorXd>& a,
           const std::optional<Eigen::VectorXd>& lambda) const {
    State state = state_;
    if (t) state.t = *t;
    const auto exchange = [](Eigen::VectorXd& part, const std::optional<Eigen::VectorXd>& by,
                             const char* name) {
      if (by && by->size() != part.size())
        throw std::invalid_argument(std::string(name) + " has " + std::to_string(by->size()) +
                                    " components; expected " + std::to_string(part.size()));
      if (by) part = *by;
    };
    exchange(state.q, q, "q");
    exchange(state.v, v, "v");
    exchange(state.a, a, "a");
    exchange(state.lambda, lambda, "multipliers");
    return state;
  }

 private:
  BeamSystem system_;
  State state_;
};

void name_vector(std::vector<std::string>& names, int first, int dimension, const std::string& name) {
  if (first < 0) return;
  for (int d = 0; d < dimension; ++d) names[first + d] = name + "." + "xyz"[d];
}
void name_number(std::vector<std::string>& names, int at, const std::string& name) {
  if (at >= 0) names[at] = name;
}

// "trolley.s", or "trolley.cable.s" of a body that slides on several beams.
std::string place_name(const BeamModel& model, const Rider& joint) {
  const std::string& body = model.bodies[joint.body].name;
  const bool on_others = std::ranges::count(model.riders, joint.body, &Rider::body) > 1;
  return on_others ? body + "." + model.beam_of(joint).name + ".s" : body + ".s";
}

// "cable[3].x", "cable[3].slope.x", "trolley.s", ...
std::vector<std::string> coordinate_names(const Equations& e) {
  const Mesh& mesh = e.system().mesh();
  const BeamModel& model = e.system().model();
  const int D = mesh.dimension;
  std::vector<std::string> names(mesh.coordinate_count);
  for (int b = 0; b < static_cast<int>(mesh.nodes.size()); ++b)
    for (int i = 0; i < static_cast<int>(mesh.nodes[b].size()); ++i) {
      const MeshNode& node = mesh.nodes[b][i];
      const std::string name = model.beams[b].name + "[" + std::to_string(i) + "]";
      name_vector(names, node.r, D, name);
      name_vector(names, node.slope_right, D, name + ".slope_right");
      name_vector(names, node.slope_left, D,
                  name + (node.slope_left == node.slope_right ? ".slope" : ".slope_left"));
      name_number(names, node.angle_right, name + ".angle_right");
      name_number(names, node.angle_left,
                  name + (node.angle_left == node.angle_right ? ".angle" : ".angle_left"));
    }
  for (int i = 0; i < static_cast<int>(mesh.spans.size()); ++i) {
    const int b = mesh.spans[i].beam;
    name_number(names, mesh.spans[i].bubble,
                model.beams[b].name + "[" + std::to_string(i - mesh.first_span[b]) + "].bubble");
  }
  for (int i = 0; i < static_cast<int>(mesh.bodies.size()); ++i)
    name_vector(names, mesh.bodies[i], D, model.bodies[i].name);
  for (int j = 0; j < static_cast<int>(mesh.riders.size()); ++j)
    name_number(names, mesh.riders[j].place, place_name(model, model.riders[j]));
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i].empty()) names[i] = "coordinate[" + std::to_string(i) + "]";
  return names;
}

using Given = const std::optional<Eigen::VectorXd>&;

std::pair<Eigen::VectorXd, Eigen::VectorXd> residual(const Equations& e, const std::optional<double>& t,
                                                     Given q, Given v, Given a, Given lambda) {
  const State state = e.at(t, q, v, a, lambda);
  Eigen::VectorXd dynamics = Eigen::VectorXd::Zero(e.system().coordinate_count()),
                  constraints = Eigen::VectorXd::Zero(e.system().constraint_count());
  e.system().residual(state, dynamics, constraints);
  return {dynamics, constraints};
}

Eigen::SparseMatrix<double> tangent(const Equations& e, double mass, double damping, double stiffness,
                                    const std::optional<double>& t, Given q, Given v, Given a, Given lambda) {
  return tangent_matrix(e.system(), e.at(t, q, v, a, lambda), {mass, damping, stiffness});
}

}  // namespace

void bind_systems(py::module_& module) {
  py::class_<Equations>(module, "Equations", "The equations of motion of a model and a state of it.",
                        py::dynamic_attr())
      .def_static(
          "drawn",
          [](const BuiltCase& c, const py::object& functions) {
            return keeping(functions, py::cast(Equations::drawn(c, functions.cast<Functions>())));
          },
          py::arg("case"), py::arg("functions"))
      .def_static(
          "of",
          [](const py::object& run) {
            return keeping(run.attr("functions"), py::cast(Equations::of(run.cast<const LiveRun&>())));
          },
          py::arg("run"))
      .def_property_readonly(
          "t", [](const Equations& e) { return e.state().t; })
      .def_property_readonly(
          "q", [](const Equations& e) { return e.state().q; })
      .def_property_readonly(
          "v", [](const Equations& e) { return e.state().v; })
      .def_property_readonly(
          "a", [](const Equations& e) { return e.state().a; })
      .def_property_readonly(
          "multipliers", [](const Equations& e) { return e.state().lambda; })
      .def("coordinates", &coordinate_names)
      .def(
          "energy", [](const Equations& e) { return energy(e.system(), e.state()).mechanical(); })
      .def("residual", &residual, py::arg("t"), py::arg("q"), py::arg("v"), py::arg("a"),
           py::arg("multipliers"))
      .def("tangent", &tangent, py::arg("mass"), py::arg("damping"), py::arg("stiffness"), py::arg("t"),
           py::arg("q"), py::arg("v"), py::arg("a"), py::arg("multipliers"));
}

}  // namespace nurbeam::python
