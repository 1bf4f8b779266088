#pragma once
#include "fem/element/inertia.h"
#include "fem/element/point_response.h"

namespace nurbeam {

/// One quadrature point of an element with moving ends: the fields there as functions of q, and the strain
/// rates at fixed material. With z = (r_s, r_ss): B = dz/dq, Z = dz/dq at the fixed material point, and zeta
/// = dz/dt there.
template <int D>
struct MovingPoint {
  static constexpr int n = element_size<D>;
  using Vector = Eigen::Matrix<double, D, 1>;
  using Pair = Eigen::Matrix<double, 2 * D, 1>;
  using PairGradient = Eigen::Matrix<double, 2 * D, n>;
  using Motion = typename PointInertia<D>::Motion;

  static Motion motion(const ElementState<D>& x) {
    using Layout = ElementLayout<D>;
    const auto ends = [](const ElementVector<D>& y) {
      return std::array<double, 2>{y[Layout::place(0)], y[Layout::place(1)]};
    };
    return {Layout::nodes(x.q), Layout::nodes(x.v), Layout::nodes(x.a), ends(x.v), ends(x.a)};
  }

  /// `x` must outlive the point.
  MovingPoint(const ShapeFunctions<Jet>& shape, const Jet& s, const Jet& omega, const Motion& x)
      : motion_(x),
        r(shape.value, x.e),
        rs(shape.d1, x.e),
        rss(shape.d2, x.e),
        inertia(shape, s, omega, r, rs, x),
        kappa0(shape.kappa0),
        weight(omega.value()) {
    kappa_q.setZero();
    for (int i = 0; i < 2; ++i) kappa_q[ElementLayout<D>::place(i)] = kappa0.d(i);
    B << rs.gradient, rss.gradient;
  }
  MovingPoint(const MovingPoint&) = delete;
  MovingPoint& operator=(const MovingPoint&) = delete;

  const ElementVector<D>& weight_gradient() const { return inertia.weight_gradient(); }

 private:
  const Motion& motion_;

 public:
  PointField<D> r, rs, rss;
  PointInertia<D> inertia;
  Jet kappa0;
  double weight;
  ElementVector<D> kappa_q;
  PairGradient B;

  /// Additional fields for the rates at fixed material: r_sss.
  struct Rates {
    PointField<D> rsss;
    Pair z_s, zeta;
    PairGradient Z;
  };
  Rates rates(const ShapeFunctions<Jet>& shape) const {
    Rates x{PointField<D>(shape.d3, motion_.e), {}, {}, {}};
    x.z_s << rss.value, x.rsss.value;
    x.zeta << rs.rate(motion_.e, motion_.e_rate, motion_.w), rss.rate(motion_.e, motion_.e_rate, motion_.w);
    x.zeta -= x.z_s * inertia.place_rate();
    x.Z = B - x.z_s * inertia.place_gradient().transpose();
    return x;
  }
  /// d(zeta)/dq at fixed rates, and d(z_s)/dq.
  std::pair<PairGradient, PairGradient> rate_gradients(const Rates& x) const {
    PairGradient z_s_q, zeta_q;
    z_s_q << rss.gradient, x.rsss.gradient;
    zeta_q << rs.rate_gradient(motion_.e, motion_.e_rate, motion_.w),
        rss.rate_gradient(motion_.e, motion_.e_rate, motion_.w);
    zeta_q -= inertia.place_rate() * z_s_q;
    return {zeta_q, z_s_q};
  }
};

}  // namespace nurbeam
