#include "fem/element/beam_element.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "fem/element/axial_sums.h"
#include "fem/element/moving_point.h"
#include "fem/material/fold_resistance.h"

namespace nurbeam {

namespace {

Eigen::Vector4d row(const std::array<double, 4>& values) {
  return Eigen::Map<const Eigen::Vector4d>(values.data());
}

}  // namespace

template <int D>
BeamElement<D>::BeamElement(const ReferenceCurve& curve, const BeamProperties& properties, Chart chart,
                            double s_a, double s_b, Ends ends, const AxialRule& axial_rule)
    : curve_(&curve),
      properties_(&properties),
      chart_(std::move(chart)),
      ends_(ends),
      axial_rule_(axial_rule) {
  if (!fixed() && curve.metric() == Metric::label)
    throw std::invalid_argument("an element whose ends move needs the metric of the drawn curve");
  if (!fixed()) return;
  const auto own = std::make_shared<Own>();
  int point = 0;
  for_each_point(s_a, s_b, [&](const ShapeFunctions<double>& shape, double s, double weight) {
    const StrainCoefficients<double> in_strain = strain_weights(s, weight, s_a, s_b - s_a);
    add_point(point++ % GaussRule::size, shape, weight, curve.strain(s), in_strain, *own);
  });
  own->sums.length = s_b - s_a;
  own->sums.strain0[1] = curve.strain(s_a);
  own->sums.strain0[2] = curve.strain(s_b, true);
  own->sums.ends = assumed_ends(own_slopes());
  own->sums.buckling_strain = axial_rule_.buckling_strain;
  own->sums.fold_resistance = axial_rule_.fold_resistance;
  own_ = own;
}

template <int D>
void BeamElement<D>::stand_beside(std::shared_ptr<FixedLanes> others, int lane) {
  with_sums([&](const FixedSums& sums) {
    for_each_pack([&](const PointPack& pack) { others->put(lane, sums, pack); });
  });
  own_ = nullptr;
  beside_ = std::move(others);
  lane_ = lane;
}

// Adds the next Gauss point of a fixed element; `point`: its number in its part.
template <int D>
void BeamElement<D>::add_point(int point, const ShapeFunctions<double>& shape, double weight, double eps0,
                               const StrainCoefficients<double>& in_strain, Own& own) const {
  const double mass = properties_->mass_per_length * weight;
  for (int k = 0; k < 4; ++k) {
    own.sums.load_factor[k] += weight * shape.value[k];
    for (int l = 0; l < 4; ++l) {
      own.sums.mass[k][l] += mass * shape.value[k] * shape.value[l];
      own.sums.stretch[k][l] += weight * shape.d1[k] * shape.d1[l];
    }
  }
  own.sums.strain0[0] += weight * eps0;
  for (const int k : {3, 4}) own.sums.strain0[k] += in_strain[k] * eps0;
  if (point == 0) own.packs.emplace_back();
  PointPack& pack = own.packs.back();
  // The last point fills the lanes beyond it.
  const int more = point + 1 == GaussRule::size ? Lanes::SizeAtCompileTime - point : 1;
  for (int k = 0; k < 4; ++k) {
    pack.S1[k].segment(point, more) = shape.d1[k];
    pack.S2[k].segment(point, more) = shape.d2[k];
  }
  for (int k = 0; k < 4; ++k) {
    pack.in_strain[k].segment(point, more) = 0;
    pack.in_strain[k][point] = in_strain[k + 1];
  }
  pack.weight.segment(point, more) = 0;
  pack.weight[point] = weight;
  pack.kappa0.segment(point, more) = shape.kappa0;
  pack.eps0.segment(point, more) = eps0;
}

template <int D>
bool BeamElement<D>::assumes_strain() const {
  return properties_->axial_strain == AxialStrain::ends_and_mean;
}

template <int D>
AxialSums<D> BeamElement<D>::axial_sums(const ElementVector<D>& q) const {
  if (fixed()) return fixed_axial_sums(q);
  AxialSums<D> sums(q);
  const ElementNodes<D> e = ElementLayout<D>::nodes(q);
  for_each_point(q, [&](const ShapeFunctions<Jet>& shape, const Jet&, const Jet& weight) {
    ElementVector<D> weight_q = ElementVector<D>::Zero();
    for (const int end : {0, 1}) weight_q[ElementLayout<D>::place(end)] = weight.d(end);
    sums.add_point(PointField<D>(shape.d1, e), weight.value(), weight_q);
  });
  return sums;
}

template <int D>
Eigen::Matrix4d BeamElement<D>::stretch(const ElementVector<D>& q) const {
  if (fixed())
    return with_sums([](const FixedSums& sums) { return Eigen::Matrix4d(matrix_of(sums.stretch)); });
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  for_each_point(q[ElementLayout<D>::place(0)], q[ElementLayout<D>::place(1)],
                 [&](const ShapeFunctions<double>& shape, double, double weight) {
                   const Eigen::Vector4d S1 = row(shape.d1);
                   sum += weight * S1 * S1.transpose();
                 });
  return sum;
}

template <int D>
Eigen::Matrix4d BeamElement<D>::stretch_coefficient(const ElementVector<D>& q, int k) const {
  const double s_a = q[ElementLayout<D>::place(0)], length = q[ElementLayout<D>::place(1)] - s_a;
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  for_each_point(s_a, s_a + length, [&](const ShapeFunctions<double>& shape, double s, double weight) {
    const Eigen::Vector4d S1 = row(shape.d1);
    sum += strain_weights(s, weight, s_a, length)[static_cast<std::size_t>(k)] * S1 * S1.transpose();
  });
  return sum;
}

template <int D>
double BeamElement<D>::strain_of_axis(const ElementVector<D>& q) const {
  const double strain0 = fixed() ? with_sums([](const FixedSums& sums) { return sums.strain0[0]; }) : 0;
  return (q[ElementLayout<D>::place(1)] - q[ElementLayout<D>::place(0)]) / 2 + strain0;
}

template <int D>
TautViscosity<D> BeamElement<D>::taut_viscosity(const ElementState<D>& x) const {
  if (!(properties_->tension_damping > 0)) return {};
  AxialSums<D> sums = axial_sums(x.q);
  sums.take_out(x.free_strain);
  return {*properties_, sums, x.free_strain, x.taut};
}

template <int D>
double BeamElement<D>::axial_mismatch(const ElementVector<D>& q) const {
  const AssumedStrain assumed = ends_and_mean(q);
  if (is_one_part()) return fixed_axial_mismatch(q, assumed);
  const ElementNodes<D> e = ElementLayout<D>::nodes(q);
  double largest = 0;
  const double s_a = q[ElementLayout<D>::place(0)], s_b = q[ElementLayout<D>::place(1)];
  for_each_point(s_a, s_b, [&](const ShapeFunctions<double>& shape, double s, double) {
    const double pointwise = ((e * row(shape.d1)).squaredNorm() - 1) / 2 - curve_->strain(s);
    largest = std::max(largest, std::abs(pointwise - assumed.at((s - s_a) / (s_b - s_a))));
  });
  return largest;
}

template <int D>
StrainCoefficients<double> BeamElement<D>::strain_coefficients(const ElementVector<D>& q) const {
  const ElementNodes<D> e = ElementLayout<D>::nodes(q);
  const double s_a = q[ElementLayout<D>::place(0)], length = q[ElementLayout<D>::place(1)] - s_a;
  StrainCoefficients<double> sum{};
  for_each_point(s_a, s_a + length, [&](const ShapeFunctions<double>& shape, double s, double weight) {
    const double strain = ((e * row(shape.d1)).squaredNorm() - 1) / 2 - curve_->strain(s);
    const StrainCoefficients<double> weights = strain_weights(s, weight, s_a, length);
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weights[k] * strain;
  });
  return sum;
}

template <int D>
double BeamElement<D>::strain_residue(const ElementVector<D>& q) const {
  const StrainCoefficients<double> of = strain_coefficients(q);
  return std::sqrt(squared_residue(of[3], of[4]));
}

template <int D>
AssumedStrain BeamElement<D>::ends_and_mean(const ElementVector<D>& q) const {
  const Eigen::Vector4d y = axial_sums(q).y;
  if (own_slopes().count() == 0) return {y[0], y[1], y[2], y[3]};
  const StrainCoefficients<double> of = strain_coefficients(q);
  const AssumedEnds<double> ends = assumed_ends(own_slopes());
  const std::array<double, 5> values{y[1], y[2], of[0], of[1], of[2]};
  return {y[0], dot(ends.a, values), dot(ends.b, values), y[3]};
}

template <int D>
std::optional<AssumedStrain> BeamElement<D>::assumed_strain(const ElementVector<D>& q) const {
  if (!assumes_strain()) return std::nullopt;
  return ends_and_mean(q);
}

template <int D>
ElementEnergy BeamElement<D>::energy(const ElementState<D>& x, const Vector& load) const {
  if (fixed()) return fixed_energy(x, load);
  using Layout = ElementLayout<D>;
  ElementEnergy sum;
  const auto motion = MovingPoint<D>::motion(x);
  const ElementNodes<D>&e = motion.e, &e_rate = motion.e_rate;
  const std::array<double, 2>& w = motion.w;
  const std::array<Jet, 2> ends{Jet::variable(x.q[Layout::place(0)], 0),
                                Jet::variable(x.q[Layout::place(1)], 1)};
  const MovingBasis basis(*curve_, chart_, ends[0], ends[1], Derivatives::one);
  AxialSums<D> axial(x.q);
  double stretch_rate = 0;
  std::array<double, 5> values{axial.y[1], axial.y[2]}, rates{};  // of AssumedEnds
  std::array<double, 2> residue{}, residue_rate{};
  const double s_a = ends[0].value(), length = ends[1].value() - s_a;
  const double eta = taut_viscosity(x).value;
  for_each_place(ends[0], ends[1], [&](const Jet& s, const Jet& weight) {
    const MovingRows rows = basis.rows_at(s);
    const double s_rate = s.d(0) * w[0] + s.d(1) * w[1], omega = weight.value();
    const auto rate_of = [&](const MovingRows::Series& row) {
      return Vector(e_rate * row.value + e * (row.first[0] * w[0] + row.first[1] * w[1]));
    };
    const Vector r = e * rows.r.value, rs = e * rows.rs.value, rss = e * rows.rss.value;
    const Vector v = rate_of(rows.r) - rs * s_rate;
    const EnergyDensity density =
        elastic_response<D, Derivatives::one>(*properties_, rs, rss, rows.kappa0, curve_->strain(s.value()))
            .energy;
    sum.kinetic += omega * properties_->mass_per_length * v.squaredNorm() / 2;
    sum.axial += omega * density.axial;
    sum.bending += omega * density.bending;
    sum.external -= omega * load.dot(r);
    const double strain = (rs.squaredNorm() - 1) / 2;
    axial.y[0] += omega * strain;
    const StrainCoefficients<double> weights = strain_weights(s.value(), omega, s_a, length);
    for (std::size_t k = 0; k < 3; ++k) values[2 + k] += weights[k] * strain;
    for (std::size_t k = 0; k < 2; ++k) residue[k] += weights[3 + k] * strain;
    sum.dissipation += omega * mass_viscosity() * v.squaredNorm();
    if (!(properties_->damping > 0 || eta > 0)) return;
    Eigen::Matrix<double, 2 * D, 1> rate;
    rate << rate_of(rows.rs) - rss * s_rate, rate_of(rows.rss) - e * rows.rsss * s_rate;
    sum.dissipation += omega * damping_response<D>(*properties_, rs, rss, rate, eta).power;
    const double strain_rate = rs.dot(rate.template head<D>());
    stretch_rate += omega * strain_rate;
    for (std::size_t k = 0; k < 3; ++k) rates[2 + k] += weights[k] * strain_rate;
    for (std::size_t k = 0; k < 2; ++k) residue_rate[k] += weights[3 + k] * strain_rate;
  });
  if (!assumes_strain()) return sum;
  const AssumedEnds<double> rule = assumed_ends(own_slopes());
  axial.y.template segment<2>(1) << dot(rule.a, values), dot(rule.b, values);
  axial.take_out(x.free_strain);
  const FoldStresses<double> fold(*properties_, x.stabilisation * axial_rule_.fold_resistance, residue);
  sum.axial =
      axial.energy(*properties_, x.free_strain, axial_rule_.buckling_strain).value + length * fold.energy;
  if (!(properties_->damping > 0)) return sum;
  for (const int end : {0, 1}) {
    const Vector rss = e * basis.rows_at(ends[end]).rss.value;
    rates[static_cast<std::size_t>(end)] = e.col(2 * end + 1).dot(e_rate.col(2 * end + 1) - rss * w[end]);
  }
  const Eigen::Vector3d axial_rate(stretch_rate, dot(rule.a, rates), dot(rule.b, rates));
  sum.dissipation += length * dot(fold.viscous_force(residue_rate), residue_rate);
  sum.dissipation += axial_rate.dot(AssumedAxialDamping(*properties_, axial.y[3], axial_rate).stress);
  return sum;
}

template <int D>
double BeamElement<D>::length(const ElementVector<D>& q) const {
  using Layout = ElementLayout<D>;
  if (fixed()) return fixed_length(q);
  const ElementNodes<D> e = Layout::nodes(q);
  double sum = 0;
  for_each_point(q[Layout::place(0)], q[Layout::place(1)],
                 [&](const ShapeFunctions<double>& shape, double, double weight) {
                   sum += weight * (e * row(shape.d1)).norm();
                 });
  return sum;
}

template <int D>
ElementBasis<double> BeamElement<D>::basis(const ElementVector<D>& q) const {
  return {*curve_, chart_, q[ElementLayout<D>::place(0)], q[ElementLayout<D>::place(1)]};
}

template <int D>
MovingBasis BeamElement<D>::moving_basis(const ElementVector<D>& q, Derivatives wanted) const {
  using Layout = ElementLayout<D>;
  return {*curve_, chart_, Jet::variable(q[Layout::place(0)], 0), Jet::variable(q[Layout::place(1)], 1),
          wanted};
}

template <int D>
ShapeFunctions<Jet> BeamElement<D>::shape_series(const ElementVector<D>& q, double s) const {
  return moving_basis(q).at(Jet(s));
}

template <int D>
Eigen::Vector4d BeamElement<D>::bezier_weights(const ElementVector<D>& q) const {
  return row(basis(q).weights());
}

template <int D>
double BeamElement<D>::place(const ElementVector<D>& q, double u) const {
  const double s_a = q[ElementLayout<D>::place(0)], s_b = q[ElementLayout<D>::place(1)];
  if (u == 0 || u == 1 || chart_.segment < 0) return u == 1 ? s_b : s_a + u * (s_b - s_a);
  const double u_a = curve_->parameter(chart_.segment, s_a), u_b = curve_->parameter(chart_.segment, s_b);
  return curve_->unrolled(curve_->arc_length(chart_.segment, u_a + u * (u_b - u_a)), (s_a + s_b) / 2);
}

template class BeamElement<2>;
template class BeamElement<3>;

}  // namespace nurbeam
