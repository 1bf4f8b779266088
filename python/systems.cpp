#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <stdexcept>

#include "fem/motion/remesh/meshed_state.h"
#include "fem/system/names.h"
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
  static Equations of(const LiveRun& run) {
    return run.between_steps(
        [](const Simulation& simulation) { return Equations(simulation.system(), simulation.state()); });
  }

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
      .def(
          "coordinates", [](const Equations& e) { return coordinate_names(e.system()); })
      .def(
          "rows", [](const Equations& e) { return row_names(e.system()); })
      .def(
          "energy", [](const Equations& e) { return energy(e.system(), e.state()).mechanical(); })
      .def("residual", &residual, py::arg("t"), py::arg("q"), py::arg("v"), py::arg("a"),
           py::arg("multipliers"))
      .def("tangent", &tangent, py::arg("mass"), py::arg("damping"), py::arg("stiffness"), py::arg("t"),
           py::arg("q"), py::arg("v"), py::arg("a"), py::arg("multipliers"));
}

}  // namespace nurbeam::python
