#pragma once
#include "pipelines/case/fields.h"

namespace nurbeam {

/// Whether the slope of a beam may jump at a place.
enum class SlopeRule {
  automatic,  ///< where bending reaches over a small part of an element alone (decide_slopes)
  continuous,
  discontinuous
};

template <class Owner>
Field<Owner> slope_field(SlopeRule Owner::*member) {
  return choice_field(member, "slope",
                      {{"automatic", SlopeRule::automatic},
                       {"continuous", SlopeRule::continuous},
                       {"discontinuous", SlopeRule::discontinuous}},
                      "whether the beam may have a kink there; automatic: it may where, under its tension T, "
                      "bending reaches over a sixteenth of the shorter element beside it at most, "
                      "sqrt(EI/T) < l/16, or over half of it under a body that slides in a motion")
      .otherwise("automatic");
}

}  // namespace nurbeam
