#include "fem/motion/run/damper_settling.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "fem/forces/memory.h"
#include "fem/mesh/stop_distance.h"
#include "fem/motion/run/integrators.h"
#include "fem/system/observables.h"
#include "solver/system/consistent.h"

namespace nurbeam {

namespace {

constexpr double first_step_of_damper = 0.1;  // part of m/c
constexpr double growth_beside_damper = 1.2;  // from step to step

// The acceleration that a change of the memory causes; nothing where the mass matrix is singular.
template <class Change>
std::optional<Eigen::VectorXd> change_of_acceleration(const MeshedState& at, const Change& change) {
  State with = at.state, without = at.state;
  change(without.memory);
  if (make_accelerations_consistent(*at.system, with) != ConsistencyStatus::done ||
      make_accelerations_consistent(*at.system, without) != ConsistencyStatus::done)
    return {};
  return with.a - without.a;
}

// m/c of the buffer that a body has come to [s].
std::optional<double> time_of_buffer(const MeshedState& at, int number) {
  const BeamModel& model = at.system->model();
  const Stop& stop = model.stops[number];
  const auto damped = change_of_acceleration(at, [&](Eigen::VectorXd& memory) {
    set_buffer_contact(at.system->mesh().memory, memory, number, BufferContact::away);
  });
  if (!damped) return {};
  const StopDistance distance(model, at.system->mesh(), stop);
  return std::abs(distance.rate(at.state.q, at.state.v) / distance.rate(at.state.q, *damped));
}

// m/c of a connector that has come taut [s].
std::optional<double> time_of_connector(const MeshedState& at, int number) {
  const auto damped = change_of_acceleration(
      at, [&](Eigen::VectorXd& memory) { set_taut(at.system->mesh().memory, memory, number, false); });
  if (!damped) return {};
  // The force of the connector is linear in its stretch and rate.
  const auto force = [&](const Eigen::VectorXd& v) {
    State moving = at.state;
    moving.v = v;
    return std::abs(length_and_force(*at.system, moving, number).second);
  };
  return force(at.state.v) / force(-*damped);
}

}  // namespace

bool settle_damper(Run& run, const StepEvent& event) {
  if (!damps_fast_motions(run.options.integrator)) return true;
  const auto* contact = std::get_if<ContactEvent>(&event);
  const auto* taut = std::get_if<TautEvent>(&event);
  std::optional<double> time;
  if (contact && contact->kind == ContactEvent::Kind::hits) {
    const auto& buffer = run.model->stops[contact->stop].buffer;
    if (!buffer || buffer->damping == 0) return true;
    time = time_of_buffer(run.at, contact->stop);
  } else if (taut) {
    time = time_of_connector(run.at, taut->connector);
  } else {
    return true;
  }
  if (!time) return run.fail(Failure::Kind::mass_matrix);
  // A damper that settles sooner than the shortest step acts as an impact.
  const double asked = std::max(first_step_of_damper * *time, run.resolution());
  if (!(asked < run.step)) return true;
  run.transient = run.transient > 0 ? std::min(run.transient, asked) : asked;
  return true;
}

void grow_transient(Run& run) {
  run.transient *= growth_beside_damper;
  if (run.transient >= run.step) run.transient = 0;
}

}  // namespace nurbeam
