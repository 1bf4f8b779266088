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
  return choice_field(
             member, "slope",
             {{"automatic", SlopeRule::automatic},
              {"continuous", SlopeRule::continuous},
              {"discontinuous", SlopeRule::discontinuous}},
             "whether the slope of the beam may jump there; automatic: it may where bending reaches over at "
             "most 1/16 of the shorter adjacent element under the tension T, sqrt(EI/T) < l/16, or 1/2 "
             "under a body that slides in a motion")
      .otherwise("automatic");
}

}  // namespace nurbeam
