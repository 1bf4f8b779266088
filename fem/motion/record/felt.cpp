#include "fem/motion/record/felt.h"

#include <Eigen/Geometry>

#include "fem/mesh/attitude.h"
#include "fem/system/observables.h"

namespace nurbeam {

namespace {

using Eigen::Vector3d;

constexpr double standard_gravity = 9.80665;  // [m/s^2]

// Of what is at r, moves at v and accelerates by a: less what acts on all mass.
Vector3d felt(const BeamModel& model, const State& state, const Vector3d& r, const Vector3d& v,
              const Vector3d& a) {
  Vector3d fall = model.gravity;
  if (model.field) fall += state.load * (model.field->at_rest(r) + model.field->by_velocity() * v);
  return (a - fall) / standard_gravity;
}

// (t, left, up) of a beam, columns: by its section, or else by gravity; NaN where neither tells.
Eigen::Matrix3d axes_at(const BeamSystem& system, const State& state, int beam, double s) {
  const Beam& of = system.model().beams[beam];
  Eigen::Matrix3d axes;
  if (of.has_torsion()) {
    const SectionTriad<double> triad = section_point(system, state, beam, s).triad;
    axes << triad.t, triad.d1, triad.d2;
    return axes;
  }
  if (of.rigid && of.curve.has_sections()) {
    const DrawnSection section = of.curve.section(s);
    axes << section.t, section.d1, section.d2;
    return axes;
  }
  const Vector3d t = material_point(system, state, beam, s).rs.normalized(), g = system.model().gravity;
  const Vector3d up = -(g - g.dot(t) * t);
  constexpr double upright = 1e-6;
  axes.setConstant(SectionRecord::no_number);
  axes.col(0) = t;
  if (up.norm() <= upright * g.norm()) return axes;
  axes.col(2) = up.normalized();
  axes.col(1) = axes.col(2).cross(t);
  return axes;
}

// The rider that carries a body along a beam just now; -1 where none does.
int rider_of(const BeamSystem& system, const State& state, int body) {
  for (int j = 0; j < static_cast<int>(system.model().riders.size()); ++j)
    if (system.model().riders[j].body == body && place(system, state, j)) return j;
  return -1;
}

}  // namespace

std::optional<FeltRecord> felt_by(const BeamSystem& system, const State& state, int body) {
  const BeamModel& model = system.model();
  const Body& of = model.bodies[body];
  const int carrier = of.rigid ? body : of.point_of ? of.point_of->body : -1;
  if (carrier < 0 && !model.accelerations) return {};
  const int first = system.mesh().bodies[body];
  const Vector3d a = vector_at(system, state.a, first),
                 f = felt(model, state, vector_at(system, state.q, first), vector_at(system, state.v, first),
                          a);
  if (carrier >= 0) {
    const Vector3d own =
        attitude::turned_back<double>(state.q.segment<4>(system.mesh().attitudes[carrier]), f);
    return FeltRecord{a, model.bodies[carrier].rigid->axes.transpose() * own};
  }
  const int rider = rider_of(system, state, body);
  if (rider < 0) return FeltRecord{a, f, true};
  const int beam = model.riders[rider].beam;
  const double s = model.beams[beam].curve.wrapped(*place(system, state, rider));
  return FeltRecord{a, axes_at(system, state, beam, s).transpose() * f};
}

std::optional<FeltRecord> felt_at(const BeamSystem& system, const State& state, int beam, double s) {
  if (!system.model().accelerations) return {};
  const MaterialPoint<3> point = material_point(system, state, beam, s);
  const Vector3d a = material_acceleration(system, state, beam, s),
                 f = felt(system.model(), state, point.r, point.velocity, a);
  return FeltRecord{a, axes_at(system, state, beam, s).transpose() * f};
}

}  // namespace nurbeam
