#include "fem/system/observables.h"

#include "fem/forces/field_on_point.h"
#include "fem/mesh/grip_position.h"
#include "fem/mesh/widened.h"
#include "fem/system/with_assembly.h"

namespace nurbeam {

namespace {

// Axial energy of an element in a state, with the free strain of another moment.
template <int D>
double axial_energy(const MeshElement<D>& e, const State& state, double free_strain) {
  ElementState<D> x = gather<D>(e, state);
  x.free_strain = free_strain;
  return e.element.energy(x, Eigen::Matrix<double, D, 1>::Zero()).axial;
}

// Energy that heating gives to the axial strain between two states: the mean of both shapes.
template <int D>
double heating_of(const Assembly<D>& a, const State& from, const State& to) {
  double sum = 0;
  for (const MeshElement<D>& e : a.elements()) {
    if (e.element.properties().free_strain.thermal.empty()) continue;
    const double before = free_strain(e, from), after = free_strain(e, to);
    for (const State* state : {&from, &to})
      sum += (axial_energy(e, *state, after) - axial_energy(e, *state, before)) / 2;
  }
  return sum;
}

template <int D>
double load_work_of(const Assembly<D>& a, const State& from, const State& to) {
  double sum = 0;
  const MeshedBeams<D> at = a.beams();
  for (const BoundForce<D>& force : a.forces())
    std::visit(
        [&](const auto& f) {
          if constexpr (requires { f.template work<D>(at, from, to); })
            sum += f.template work<D>(at, from, to);
          else if constexpr (offers_of<decltype(f)>.work)
            sum += f.work(at, from, to);
        },
        force);
  return sum + heating_of(a, from, to);
}

template <int D>
double motion_work_of(const Assembly<D>& a, const State& from, const State& to) {
  double sum = 0;
  a.for_each_constraint([&](const auto& c, const auto& rows) {
    const auto y = [&](const State& state) { return state.lambda.segment(rows.first, rows.count); };
    if constexpr (requires { c.work(a.beams(), from, to, y(from), y(to)); })
      sum += c.work(a.beams(), from, to, y(from), y(to));
    else if constexpr (offers_of<decltype(c)>.work)
      sum += c.work(from, to, y(from), y(to));
  });
  return sum;
}

}  // namespace

double load_work(const BeamSystem& system, const State& from, const State& to) {
  return with_assembly(
      system, [&](const auto& a) { return load_work_of(a, from, to); });
}

double motion_work(const BeamSystem& system, const State& from, const State& to) {
  return with_assembly(
      system, [&](const auto& a) { return motion_work_of(a, from, to); });
}

double motion_power(const BeamSystem& system, const State& state) {
  return state.lambda.dot(system.constraint_rate(state));
}

double lost_energy(const BeamSystem& system, const State& from, const State& to) {
  return with_assembly(
      system,
      [&](const auto& a) {
        double sum = 0;
        for (const auto& force : a.forces())
          std::visit(
              [&](const auto& f) {
                if constexpr (offers_of<decltype(f)>.loss) sum += f.loss(a.beams(), from, to);
              },
              force);
        return sum;
      });
}

std::optional<FrictionForce> sliding_friction(const BeamSystem& system, const State& state, int rider) {
  std::optional<FrictionForce> found;
  if (state.memory.size() == 0) return found;
  with_assembly(system, [&](const auto& a) {
    const int i = a.parts().friction[rider];
    if (i < 0) return;
    std::visit(
        [&](const auto& f) {
          if constexpr (offers_of<decltype(f)>.friction) found = f.friction(a.beams(), state);
        },
        a.forces()[i]);
  });
  return found;
}

Eigen::Vector3d vector_at(const BeamSystem& system, const Eigen::VectorXd& y, int first) {
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  vector.head(system.dimension()) = y.segment(first, system.dimension());
  return vector;
}

Eigen::Vector3d joint_force(const BeamSystem& system, const State& state, int rider) {
  const Mesh& mesh = system.mesh();
  if (mesh.plan.modes[rider] == Carried::free) return Eigen::Vector3d::Zero();
  const int body = system.model().riders[rider].body;
  const double mass = system.model().bodies[body].mass;
  const Eigen::Vector3d given = with_assembly(system, [&]<int D>(const Assembly<D>& a) {
    return widened<D>(a.force_on_body(body, state) +
                      mass * field_on_point<D>(system.model(), state, mesh.bodies[body]));
  });
  const Eigen::Vector3d acceleration = vector_at(system, state.a, mesh.bodies[body]);
  return mass * (acceleration - system.model().gravity) - given;
}

namespace {

// First row of constraint i of the mesh; nothing for -1.
template <int D>
std::optional<int> first_row(const Assembly<D>& a, int i) {
  std::optional<int> row;
  if (i >= 0) a.visit_constraint(i, [&](const auto&, const auto& rows) { row = rows.first; });
  return row;
}

}  // namespace

std::optional<int> row_of_place(const BeamSystem& system, int rider) {
  return with_assembly(
      system, [&](const auto& a) { return first_row(a, a.parts().held_places[rider]); });
}

namespace {

// Weight of a rider's s in the distance that a stop keeps; 0 for riders of other stops.
double weight_in_stop(const Stop& stop, int rider) {
  if (stop.rider == rider) return stop.weight_of_rider();
  return stop.other == rider ? stop.weight_of_other() : 0;
}

}  // namespace

double holding_force(const BeamSystem& system, const State& state, int rider) {
  if (const std::optional<int> row = row_of_place(system, rider)) return -state.lambda[*row];
  const std::vector<Stop>& stops = system.model().stops;
  double force = 0;
  for (std::size_t i = 0; i < stops.size(); ++i) {
    const double weight = weight_in_stop(stops[i], rider);
    if (weight != 0) force += weight * contact_force(system, state, static_cast<int>(i));
  }
  return force;
}

std::pair<double, double> length_and_force(const BeamSystem& system, const State& state, int connector) {
  std::pair<double, double> found;
  with_assembly(system, [&](const auto& a) {
    if (const int i = a.parts().springs[connector]; i >= 0)
      std::visit(
          [&](const auto& f) {
            if constexpr (offers_of<decltype(f)>.connector) found = f.length_and_force(a.beams(), state);
          },
          a.forces()[i]);
    if (const int i = a.parts().rods[connector]; i >= 0)
      a.visit_constraint(i, [&](const auto& c, const auto& rows) {
        if constexpr (offers_of<decltype(c)>.connector)
          found = c.length_and_force(state, state.lambda.segment(rows.first, rows.count));
      });
  });
  return found;
}

std::pair<double, double> angle_and_moment(const BeamSystem& system, const State& state, int connector) {
  std::pair<double, double> found;
  with_assembly(system, [&](const auto& a) {
    for (const auto& force : a.forces())
      std::visit(
          [&](const auto& f) {
            if constexpr (offers_of<decltype(f)>.rotational)
              if (f.rotational_connector() == connector) found = f.angle_and_moment(a.beams(), state);
          },
          force);
  });
  return found;
}

std::optional<int> row_of_rod(const BeamSystem& system, int connector) {
  return with_assembly(
      system, [&](const auto& a) { return first_row(a, a.parts().rods[connector]); });
}

Eigen::Vector3d grip_place(const BeamSystem& system, const State& state, const Grip& grip,
                           const std::string& what) {
  const std::optional<int> r = grip_position(system.model(), system.mesh(), grip, what);
  return r ? vector_at(system, state.q, *r) : grip.point;
}

std::array<Eigen::Vector3d, 2> connector_ends(const BeamSystem& system, const State& state, int connector) {
  const Connector& described = system.model().connectors[connector];
  return {grip_place(system, state, described.ends[0], described.name),
          grip_place(system, state, described.ends[1], described.name)};
}

double contact_force(const BeamSystem& system, const State& state, int stop) {
  return with_assembly(
      system,
      [&](const auto& a) {
        const std::optional<int> row = first_row(a, a.parts().contacts[stop]);
        return row ? -state.lambda[*row] : 0;
      });
}

std::optional<double> place(const BeamSystem& system, const State& state, int rider) {
  const int dof = system.mesh().riders[rider].place;
  return dof >= 0 ? std::optional<double>(state.q[dof]) : std::nullopt;
}

double place_rate(const BeamSystem& system, const State& state, int rider) {
  const int dof = system.mesh().riders[rider].place;
  return dof >= 0 ? state.v[dof] : 0;
}

Reaction reaction(const BeamSystem& system, const State& state, const Eigen::VectorXd& multipliers,
                  int constraint) {
  return with_assembly(
      system,
      [&](const auto& a) {
        const auto [force, couple] = a.reaction(constraint, state, multipliers);
        return Reaction{force, couple};
      });
}

double drive_moment(const BeamSystem& system, const State& state, int constraint) {
  return with_assembly(
      system, [&](const auto& a) { return a.drive_moment(constraint, state); });
}

}  // namespace nurbeam
