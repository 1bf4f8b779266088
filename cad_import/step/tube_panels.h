#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "cad_import/step/spine.h"

/// The pieces that the surface of a tube is made of.
namespace nurbeam::tubes {

/// The curve at one node of the surface, and the section there, whose axes turn about the tangent at the rate
/// of `twist`.
struct Node {
  double parameter;
  Eigen::Vector3d centre, rate, acceleration;  // derivatives in the parameter
  Eigen::Vector3d across = Eigen::Vector3d::Zero(), along = across, forward = across;  // of the section
  double twist = 0;
  // How far forward a point of the section is, per its distance across and along, and the rate of that.
  Eigen::Vector2d lean = Eigen::Vector2d::Zero(), lean_rate = Eigen::Vector2d::Zero();

  Eigen::Vector3d tangent() const { return rate.normalized(); }
  Eigen::Vector3d tangent_rate() const {
    const Eigen::Vector3d t = tangent();
    return (acceleration - t * t.dot(acceleration)) / rate.norm();
  }
  void set_section(const Eigen::Vector3d& direction) {
    across = (direction - tangent() * tangent().dot(direction)).normalized();
    along = tangent().cross(across);
    forward = tangent();
  }
  /// A place of the section (x across, y along) and its derivative in the parameter.
  Eigen::Vector3d place(double x, double y) const;
  Eigen::Vector3d place_rate(double x, double y) const;
};

/// A direction carried from one node to the next with the least turn about the tangent.
Eigen::Vector3d carried(const Eigen::Vector3d& across, const Node& from, const Node& to);

/// A piece of the surface, between two nodes of one span; whether its sections lean over into a mitre.
struct Panel {
  Node from, to;
  bool leans = false;

  /// The poles of the cubic along which a place of the section goes.
  std::array<Eigen::Vector3d, 4> poles(double x, double y) const;
};

/// The panels of all spans, and the numbers of those that begin a face: each is of one span, and a panel that
/// leans is one by itself. Those that begin a run, and the end of all.
struct Panels {
  std::vector<Panel> all;
  std::vector<std::size_t> faces, runs;

  std::span<const Panel> of_face(std::size_t f) const {
    const std::size_t end = f + 1 < faces.size() ? faces[f + 1] : all.size();
    return {all.data() + faces[f], end - faces[f]};
  }
};

inline double chord(const Panel& panel) { return (panel.to.centre - panel.from.centre).norm(); }

/// How far from a corner sections lean, at most.
inline double reach_of_lean(double lean, double radius) { return 6 * radius * lean; }

/// Panels along the spine, for a section of this radius: short enough that walls are within 1e-7 of the
/// radius, but where they lean, and go along evenly enough for OpenCASCADE to integrate over them; shorter
/// where they lean.
Panels panels_of(const Spine& spine, double radius);

}  // namespace nurbeam::tubes
