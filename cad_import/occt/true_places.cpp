#include "cad_import/occt/true_places.h"

#include <Eigen/LU>
#include <cmath>
#include <cstdlib>

#include "cad_import/occt/placed_curve.h"
#include "cad_import/report/import_report.h"
#include "cad_import/report/length_unit.h"

namespace nurbeam {

Eigen::Affine3d stand_in(const Eigen::Affine3d& place) {
  Eigen::Affine3d rigid = place;
  rigid.linear().colwise().normalize();
  if (rigid.linear().determinant() < 0) rigid.linear().col(2) *= -1;
  if ((rigid * rigid).isApprox(Eigen::Affine3d::Identity())) rigid.translation() += Eigen::Vector3d(1, 2, 3);
  return rigid;
}

bool is_rigid(const Eigen::Affine3d& place) { return std::abs(place.linear().determinant() - 1) <= 1e-12; }

void TruePlaces::add(const TopLoc_Location& location, const std::optional<Eigen::Affine3d>& place,
                     const std::optional<Eigen::Affine3d>& stand_in) {
  if (location.IsIdentity()) return;
  TopLoc_Location last = location;
  while (!last.NextLocation().IsIdentity()) last = last.NextLocation();
  const Eigen::Affine3d found = in_metres(last.FirstDatum()->Transformation(), metres_per_millimetre);
  const bool inverted =
      stand_in && !found.isApprox(*stand_in, 1e-9) && found.isApprox(stand_in->inverse(), 1e-9);
  places_[last.FirstDatum().get()] = {last.FirstDatum(),
                                      inverted && place ? std::optional(place->inverse()) : place};
}

bool TruePlaces::concern(const TopLoc_Location& location) const {
  for (TopLoc_Location rest = location; !rest.IsIdentity(); rest = rest.NextLocation())
    if (places_.contains(rest.FirstDatum().get())) return true;
  return false;
}

std::optional<Eigen::Affine3d> TruePlaces::to_world(const TopLoc_Location& location) const {
  if (!concern(location)) return in_metres(location.Transformation(), metres_per_millimetre);
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  for (TopLoc_Location rest = location; !rest.IsIdentity(); rest = rest.NextLocation()) {
    const auto known = places_.find(rest.FirstDatum().get());
    const std::optional<Eigen::Affine3d> place =
        known == places_.end() ? in_metres(rest.FirstDatum()->Transformation(), metres_per_millimetre)
                               : known->second.place;
    if (!place) return std::nullopt;
    const int power = rest.FirstPower();
    for (int i = 0; i < std::abs(power); ++i) result = (power > 0 ? *place : place->inverse()) * result;
  }
  return result;
}

bool TruePlaces::put_in_place(const TopLoc_Location& location, ImportedCurve& curve) const {
  if (!concern(location)) return true;
  const std::optional<Eigen::Affine3d> place = to_world(location);
  if (!place) return false;
  const Eigen::Affine3d move = *place * in_metres(location.Transformation(), metres_per_millimetre).inverse();
  const double scale = std::cbrt(std::abs(move.linear().determinant()));
  curve.curve = placed(curve.curve, move);
  for (double* size :
       {&curve.deviation, &curve.pipe_radius, &curve.bore_radius, &curve.bar.width, &curve.bar.height})
    *size *= scale;
  curve.bar.area *= std::pow(scale, 2);
  curve.bar.second_moments *= std::pow(scale, 4);
  return true;
}

}  // namespace nurbeam
