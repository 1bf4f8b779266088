#pragma once

namespace nurbeam {

/// A body, or a material point of a beam.
struct Attachment {
  int body = -1;
  int beam = -1;
  double s = 0;  ///< [m]
  static Attachment to_body(int body) { return {body, -1, 0}; }
  static Attachment to_beam(int beam, double s) { return {-1, beam, s}; }
};

}  // namespace nurbeam
