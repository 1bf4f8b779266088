#pragma once
#include <string>
#include <vector>

#include "fem/model/beam_model.h"
#include "fem/motion/record/snapshot.h"

namespace nurbeam {

/// How well elements that are smooth across a support inside a beam share what it takes up of a pull along
/// it.
struct SharedPull {
  std::string beam;
  double s = 0;      ///< of the support [m]
  double pull = 0;   ///< the largest that it takes up along the beam [N]
  double error = 0;  ///< of the axial force from there to the next support, the largest, about [N]
  double force = 0;  ///< the largest axial force there [N]
};

/// Looks at such supports frame by frame.
///
/// The axial force jumps by the pull dN, while the strain of the elements does not: their elongation on
/// either side misses c dN h / EA, h the length of the element beside the support, and the axial force up to
/// the next support, l away, c dN h / l. c = 0.06 is measured, to a twentieth
/// (with one or two elements up to the next support: to a fourth).
/// Where the axis between them is longer than its chord by r of the strain N / EA, the elongation of a slack
/// cable or of an arch by its shape takes up the rest: 1 / (1 + 2 r) of that is left (Ernst's modulus).
class SharedPulls {
 public:
  explicit SharedPulls(const BeamModel& model);
  void look_at(const Snapshot& frame);
  /// Those where axial forces may be off by more than a fiftieth, and by more than a fiftieth of what the
  /// next support gives.
  std::vector<SharedPull> coarse() const;

 private:
  // From a support to the next one.
  struct Part {
    int beam, constraint, next;  // numbers in the model
    double s, s_next;            // [m]
    SharedPull seen;
    double reaction = 0;  // of the next support, the largest [N]
  };
  static void look_at(Part& part, double stiffness, const Snapshot& frame);

  const BeamModel& model_;
  std::vector<Part> parts_;
};

}  // namespace nurbeam
