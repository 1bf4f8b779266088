// Frames and arches that snap: their limit loads, which force control alone does not reach.

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "fem/system/beam_system.h"
#include "fem/system/initial_state.h"
#include "nurbs/number_text.h"
#include "pipelines/verification/models.h"
#include "pipelines/verification/noted.h"
#include "pipelines/verification/verify.h"
#include "solver/algebra/sparse_lu.h"
#include "solver/system/tangent_matrix.h"

namespace nurbeam {

namespace {

using namespace verification;
using Eigen::Vector2d;
using Eigen::VectorXd;
using std::numbers::pi;

/// A planar model under one load, whose place is moved by known steps; the load is what holds it there.
class MovedByItsLoad {
 public:
  /// `s`: of the load on the first beam, at a node.
  MovedByItsLoad(const BeamModel& model, double s, const Vector2d& direction)
      : system_(noted(model, as_statics)), state_(drawn_state(system_)), direction_(direction) {
    for (const MeshNode& node : system_.mesh().nodes[0])
      if (std::abs(node.s - s) < 1e-9 * s) place_ = node.r;
    if (place_ < 0) throw std::runtime_error("no node stands under the load");
    state_.load = 0;
    start_ = position();
  }

  /// The load [times that of the model] that moves its place by `way` from the drawing, along itself.
  double load_at(double way) {
    const int n = system_.coordinate_count(), size = n + system_.constraint_count();
    VectorXd rows(size), with_more(size);
    const auto residual = [&](VectorXd& into) {
      system_.residual(state_, into.head(n), into.tail(size - n));
    };
    for (int i = 0; i < 40; ++i) {
      residual(rows);
      state_.load += 1;
      residual(with_more);
      state_.load -= 1;
      const VectorXd by_load = with_more - rows;  // dead loads
      const Eigen::SparseMatrix<double> tangent = tangent_matrix(system_, state_, {.stiffness = 1});
      SparseLu<double> factors;
      if (!factors.analyse(tangent) || factors.factorise(tangent) == 0)
        throw std::runtime_error("the tangent is singular at a load of " + text_of(state_.load));
      const VectorXd of_rows = factors.solve(rows), of_load = factors.solve(by_load);
      const double open = (position() - start_) - way;
      const double more = (open - along(of_rows)) / along(of_load);
      const VectorXd step = -of_rows - more * of_load;
      state_.q += step.head(n);
      state_.lambda += step.tail(size - n);
      state_.load += more;
      if (step.head(n).norm() < 1e-11 * (1 + state_.q.norm())) return state_.load;
    }
    throw std::runtime_error("no equilibrium was found");
  }

 private:
  double along(const VectorXd& q) const { return direction_.dot(q.segment<2>(place_)); }
  double position() const { return along(state_.q); }

  BeamSystem system_;
  State state_;
  Vector2d direction_;
  int place_ = -1;
  double start_ = 0;
};

/// The first maximum of the load as its place is moved on by `step`, with a parabola through its three
/// greatest loads, twice refined.
double limit_load(MovedByItsLoad model, double step) {
  double way = 0;
  std::vector<double> loads{0};
  const auto goes_up = [&] { return loads.size() < 3 || loads.back() > loads[loads.size() - 2]; };
  while (goes_up()) {
    if (loads.size() > 10000) throw std::runtime_error("the load has no maximum");
    loads.push_back(model.load_at(way += step));
  }
  for (int refined = 0; refined < 2; ++refined) {
    const double before = loads[loads.size() - 3], at = loads[loads.size() - 2], after = loads.back();
    const double top = way - step + step / 2 * (before - after) / (before - 2 * at + after);
    step /= 16;
    loads.clear();
    for (const int k : {-1, 0, 1}) loads.push_back(model.load_at(way = top + k * step));
  }
  return *std::max_element(loads.begin(), loads.end());
}

VerifyResult lee_frame() {
  constexpr double leg = 120, E = 7.2e6, area = 6, inertia = 2;
  constexpr int per_leg = 40;
  BeamModel frame = one_beam({line_cubic({0, 0, 0}, {0, leg, 0}), line_cubic({0, leg, 0}, {leg, leg, 0})}, 2,
                             {E * area, E * inertia, 1, 0, {}}, 2 * per_leg, {{0, false}, {2 * leg, false}});
  frame.gravity.setZero();
  frame.beams[0].home[per_leg].kind = NodeKind::rigid;
  add_force(frame, {0, -1, 0}, 1.2 * leg);
  VerifyResult result;
  result.add("limit load of Lee's frame [10 kN], 40 elements a leg", 1.8556,
             "Lee, Manuel & Rossow 1968 and after",
             limit_load(MovedByItsLoad(frame, 1.2 * leg, {0, -1}), 1) / 1e4, 1e-4);
  return result;
}

/// Its reference: the elastica without stretch, by shooting from the clamp through the load to the hinge,
/// over the greatest load. Da Deppo & Schmidt have 897.
VerifyResult deep_arch() {
  constexpr double R = 100, EI = 1e6, EA = 1e10, half = 215 * pi / 360, exact = 897.308997;
  VerifyResult result;
  ConvergenceTable table{"the limit load [N]", "elements", {}};
  for (const int elements : {40, 80, 160}) {
    BeamModel arch = one_beam(arc_cubics({0, 0, 0}, R, pi / 2 + half, pi / 2 - half, 4), 2,
                              {EA, EI, 1, 0, {}}, elements, {{0, true}, {4 * R * half, false}});
    arch.gravity.setZero();
    const double top = arch.beams[0].curve.length() / 2;
    add_force(arch, {0, -1, 0}, top);
    const double load = limit_load(MovedByItsLoad(arch, top, {0, -1}), 2);
    table.rows.emplace_back(elements, std::abs(load - exact));
    if (elements == 160)
      result.add("limit load of a clamped-hinged arch of 215 degrees [N], 160 elements", exact,
                 "elastica (Da Deppo & Schmidt 1975)", load, 5e-4);
  }
  result.add(std::move(table), 3.9, 0.1, "cubic elements");
  return result;
}

}  // namespace

std::vector<VerifyProblem> limit_problems() {
  return {{"limit-lee", "material, Green, as drawn", lee_frame},
          {"limit-arch", "material, Green, as drawn", deep_arch}};
}

}  // namespace nurbeam
