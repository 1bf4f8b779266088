#include "cad_import/iges/subfigure_instance.h"

#include <IGESBasic_SingularSubfigure.hxx>
#include <IGESBasic_SubfigureDef.hxx>
#include <gp_XYZ.hxx>
#include <stdexcept>

#include "cad_import/iges/location.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

Eigen::Vector3d translation_of(const IGESBasic_SingularSubfigure& instance) {
  const gp_XYZ translation = instance.Translation();
  return {translation.X(), translation.Y(), translation.Z()};
}

}  // namespace

bool is_scaled(const IGESBasic_SingularSubfigure& instance) {
  return instance.HasScaleFactor() && instance.ScaleFactor() != 1;
}

bool is_moved_after_turning(const IGESBasic_SingularSubfigure& instance) {
  const Eigen::Vector3d translation = translation_of(instance);
  const Eigen::Vector3d turned = location_of(instance).linear() * translation;
  return (turned - translation).norm() > 1e-9 * translation.norm();
}

Eigen::Affine3d place_of(const IGESBasic_SingularSubfigure& instance) {
  const double scale = is_scaled(instance) ? instance.ScaleFactor() : 1;
  if (!(scale > 0)) throw std::runtime_error("its scale is " + text_of(scale) + "; it must be positive");
  return Eigen::Translation3d(translation_of(instance)) * rigid_location(instance) * Eigen::Scaling(scale);
}

void set_place(IGESBasic_SingularSubfigure& instance, const Eigen::Affine3d& place) {
  instance.Init(instance.Subfigure(), gp_XYZ(), false, 1);
  set_location(instance, place);
}

}  // namespace nurbeam
