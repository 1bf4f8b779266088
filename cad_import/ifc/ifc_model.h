#pragma once
#include <Eigen/Geometry>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "cad_import/ifc/ifc_value.h"

namespace nurbeam {

/// The instances of an IFC file (ISO 16739, as a STEP text), read when they are asked for.
class IfcModel {
 public:
  /// `text` must outlive it.
  explicit IfcModel(std::string_view text);

  /// The instance that a value refers to. Throws std::runtime_error where it refers to none that is there.
  IfcValue at(const IfcValue& reference) const;
  IfcValue instance(int number) const;
  /// "IFCLINE" of an instance; "" where it is not there.
  std::string_view keyword(int number) const;
  /// Those with this keyword, or whose keyword begins with it, in the order of their numbers.
  std::vector<int> with_keyword(std::string_view keyword) const;
  std::vector<int> with_prefix(std::string_view keyword) const;
  /// "#7 IFCLINE".
  std::string label(int number) const;
  /// All numbers.
  std::vector<int> numbers() const;

  /// How statements begin that are no instances, though they begin as one, or have the number of another.
  const std::vector<std::string>& damaged() const { return damaged_; }

  double length_unit() const { return length_unit_; }  ///< [m]; 0: undeclared
  double angle_unit() const { return angle_unit_; }    ///< [rad]

 private:
  void read_units();
  double unit_of(const IfcValue& unit, int depth = 0) const;

  std::map<int, std::string_view> instances_;
  std::vector<std::string> damaged_;
  double length_unit_ = 0, angle_unit_ = 1;
};

/// The coordinates of a point or direction in space; z is 0 where it has two. Lengths in the file's unit.
Eigen::Vector3d ifc_vector(const IfcValue& coordinates);
Eigen::Vector3d ifc_point(const IfcModel& model, const IfcValue& point);

/// Where an axis placement (2D or 3D), a local placement or a transformation operator puts things, lengths in
/// the file's unit; nowhere else where there is none. Throws std::runtime_error where it cannot be told.
Eigen::Affine3d ifc_placement(const IfcModel& model, const IfcValue& placement);

}  // namespace nurbeam
