#pragma once
#include <Eigen/Core>
#include <memory>

#include "fem/motion/length_control.h"
#include "fem/motion/simulation_report.h"

namespace nurbeam {

/// A mesh of a model, and the model's state on it.
template <int D>
struct MeshedState {
  std::unique_ptr<BeamSystem<D>> system;
  State state;
};

/// The model as it is drawn, which must outlive what is returned.
template <int D>
MeshedState<D> as_drawn(const BeamModel& model);

/// Goes on on the mesh that length control asks for. `at_rest`: joints are held there, and there are no
/// velocities to project; else `impulse` is set to the projection's (see transfer). False, and the report
/// says so, when velocities cannot be projected.
template <int D>
bool change_mesh(MeshedState<D>& at, const NextPlan& next, bool at_rest, Eigen::VectorXd& impulse,
                 SimulationReport& report);

/// Each change of the mesh makes the next less likely: false, and the report says so, when there were more
/// at one moment than that can be.
template <int D>
bool check_changes(const MeshedState<D>& at, std::size_t count, SimulationReport& report);

extern template MeshedState<2> as_drawn<2>(const BeamModel&);
extern template MeshedState<3> as_drawn<3>(const BeamModel&);
extern template bool change_mesh<2>(MeshedState<2>&, const NextPlan&, bool, Eigen::VectorXd&,
                                    SimulationReport&);
extern template bool change_mesh<3>(MeshedState<3>&, const NextPlan&, bool, Eigen::VectorXd&,
                                    SimulationReport&);
extern template bool check_changes<2>(const MeshedState<2>&, std::size_t, SimulationReport&);
extern template bool check_changes<3>(const MeshedState<3>&, std::size_t, SimulationReport&);

}  // namespace nurbeam
