#pragma once
#include <vector>

#include "fem/system/material_points.h"

namespace nurbeam {

/// The layer of bending at a place of a beam that its elements do not show (BendingLayer).
struct LayerRecord {
  double s;  ///< [m]
  /// How far it reaches [m]; NaN, as its moment and stress are, where no tension is left: the tension less
  /// what the beam's own flow through a body that slides takes of it, rho A v^2.
  double reach = SectionRecord::no_number;
  double moment = SectionRecord::no_number;  ///< [N m]; signed in a planar model
  double stress = SectionRecord::no_number;  ///< with its axial force [Pa]; NaN where no section gives it
  /// For a beam with torsion, else NaN: about the section's own axes [N m], and the von Mises stress [Pa].
  double moment_1 = SectionRecord::no_number, moment_2 = SectionRecord::no_number,
         von_mises = SectionRecord::no_number;
};

/// The layers of a beam, and the spans whose moments the mesh does not give.
struct BendingLayers {
  std::vector<LayerRecord> layers;
  std::vector<int> unseen;  ///< in order; beside a slope that is continuous, though bending reaches less far
};

/// The layers of a beam in a state: at kinks, at sharp clamps, and where a slope is continuous and sharp
/// (HomeNode::sharp), there by the directions of the section forces on both sides. `only_span`: those in and
/// at the ends of this span alone.
BendingLayers bending_layers(const BeamSystem& system, const State& state, const CarriedBySpans& carried,
                             int beam, int only_span = -1);

/// The section at a place that the mesh gives, with the layers there: moments fall off with
/// exp(-distance/reach). Empty moments and stresses where neither the mesh nor a layer gives them.
SectionRecord with_layers(const Beam& beam, const BendingLayers& layers, int span, double s,
                          const SectionRecord& by_mesh);

/// Takes the numbers out of an element that it cannot show: moments, stresses and shear forces.
void blank_bending(ElementRecord& element);

}  // namespace nurbeam
