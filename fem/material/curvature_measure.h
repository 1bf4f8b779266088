#pragma once

namespace nurbeam {

enum class CurvatureMeasure {
  material,  ///< |r_s x r_ss| / |r_s|^2: rotation per unit reference length, conjugate to the bending moment
  spatial    ///< |r_s x r_ss| / |r_s|^3: that of Ding & Ouyang
};

}  // namespace nurbeam
