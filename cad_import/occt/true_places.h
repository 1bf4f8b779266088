#pragma once
#include <Eigen/Geometry>
#include <TopLoc_Datum3D.hxx>
#include <TopLoc_Location.hxx>
#include <optional>
#include <unordered_map>

namespace nurbeam {

struct ImportedCurve;

/// A placement that only moves and turns, near this one, and never its own way back: a location of
/// OpenCASCADE must not scale or mirror, and is left out where it does nothing.
Eigen::Affine3d stand_in(const Eigen::Affine3d& place);

/// Whether the placement of axes at right angles neither scales nor mirrors.
bool is_rigid(const Eigen::Affine3d& place);

/// The placements that scale or mirror, by the locations that stand in for them. [m]
class TruePlaces {
 public:
  /// `location`: of a shape that was placed by the stand-in last, or by its inverse where `stand_in` [m] says
  /// so. `place`: nothing where the shape cannot be.
  void add(const TopLoc_Location& location, const std::optional<Eigen::Affine3d>& place,
           const std::optional<Eigen::Affine3d>& stand_in = {});

  /// Whether one of them is in this location.
  bool concern(const TopLoc_Location& location) const;

  /// From the coordinates of an edge or face under this location to the world; nothing where it cannot be.
  std::optional<Eigen::Affine3d> to_world(const TopLoc_Location& location) const;

  /// Brings the curve of an edge or face from where its location puts it to where it truly stands, with its
  /// deviation and radii; false where it cannot be.
  bool put_in_place(const TopLoc_Location& location, ImportedCurve& curve) const;

 private:
  struct Place {
    opencascade::handle<TopLoc_Datum3D> stand_in;
    std::optional<Eigen::Affine3d> place;
  };
  std::unordered_map<const TopLoc_Datum3D*, Place> places_;  // only ever looked up
};

}  // namespace nurbeam
