#pragma once
#include "fem/material/section.h"

namespace nurbeam {

/// Strains of a section against the drawing, per reference length [1/m], of any scalar T.
template <class T>
struct SectionStrain {
  T bend_1, bend_2;  ///< rotation rates about the section's axes d1, d2
  T twist;           ///< about the tangent
};

/// Moments of a section about d1, d2 and the tangent [N m].
template <class T>
struct SectionMoments {
  T bending_1, bending_2, torque;
};

/// The constitutive law of sections: M1 = EI1 k1 + EI12 k2, M2 = EI12 k1 + EI2 k2, Mt = GJ gamma.
template <class T>
SectionMoments<T> section_moments(const SectionStiffness& stiffness, const SectionStrain<T>& strain) {
  return {stiffness.bending_1 * strain.bend_1 + stiffness.bending_product * strain.bend_2,
          stiffness.bending_product * strain.bend_1 + stiffness.bending_2 * strain.bend_2,
          stiffness.torsion * strain.twist};
}

}  // namespace nurbeam
