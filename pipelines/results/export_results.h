#pragma once
#include <filesystem>
#include <utility>
#include <vector>

#include "cad_import/export_curves.h"
#include "nurbs/smooth/smooth_nurbs.h"
#include "pipelines/results/results.h"

namespace nurbeam {

/// How a whole circle or ellipse of quadratic arcs is written.
enum class WholeConics {
  as_drawn,  ///< as the arcs that it was drawn of, where these are four at most, else smooth
  smooth     ///< as a cubic that is C1 throughout
};

/// The deformed axis through the elements of one beam, in order: one NURBS curve of the lowest exact degree
/// with few control points, within 1e-12 of its size; over reference arc length at the elements' ends with
/// CurveParameter::material.
NurbsCurve deformed_curve(const std::vector<ElementRecord>& elements,
                          CurveParameter parameter = CurveParameter::free,
                          WholeConics conics = WholeConics::as_drawn);

/// The elements of a beam with displacements from the drawing times `factor`: 1 leaves them as they are, 0 is
/// the drawing. Throws std::invalid_argument where the drawing is not known, in results of earlier versions.
std::vector<ElementRecord> exaggerated(std::vector<ElementRecord> elements, double factor);

/// How whole circles and ellipses are written to files of a format: readers of IGES split curves at double
/// knots of quadratics.
WholeConics whole_conics_in(CadFormat format);

/// The deformed axes stored nearest to `time` [s] in a results directory, under the names of the drawn
/// curves, each a part under that of its beam, and the time they were stored at, with displacements times
/// `exaggeration`. Throws as read_stored_beams() and exaggerated() do.
std::pair<double, std::vector<NamedCurve>> stored_curves(const std::filesystem::path& directory, double time,
                                                         CurveParameter parameter = CurveParameter::free,
                                                         WholeConics conics = WholeConics::as_drawn,
                                                         double exaggeration = 1);

}  // namespace nurbeam
