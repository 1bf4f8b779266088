#include "fem/forces/line_load.h"

namespace nurbeam {

Eigen::Vector3d LineLoad::per_length(int on_beam, double t) const {
  if (on_beam != beam) return Eigen::Vector3d::Zero();
  return value_and_slope(time, t).first * even * value;
}

PointLoad LineLoad::at_place(const Share& share, double t) const {
  const double factor = value_and_slope(time, t).first;
  return {LoadAtPlace{.beam = beam, .s = share.s, .value = factor * share.length * value}};
}

template <int D>
double LineLoad::work(const MeshedBeams<D>& at, const State& from, const State& to) const {
  const Eigen::Matrix<double, D, 1> mean =
      ((from.load * per_length(beam, from.t) + to.load * per_length(beam, to.t)) / 2).template head<D>();
  double sum = 0;
  for (int i = at.mesh.first_span[beam]; i < at.mesh.first_span[beam + 1]; ++i) {
    const MeshElement<D>& e = at.elements[i];
    sum += e.element.energy(gather<D>(e, from), mean).external -
           e.element.energy(gather<D>(e, to), mean).external;
  }
  for (const Share& share : uneven)
    sum +=
        PointLoad{LoadAtPlace{.beam = beam, .s = share.s, .value = share.length * value, .time = time}}.work(
            at, from, to);
  return sum;
}

template double LineLoad::work(const MeshedBeams<2>&, const State&, const State&) const;
template double LineLoad::work(const MeshedBeams<3>&, const State&, const State&) const;

}  // namespace nurbeam
