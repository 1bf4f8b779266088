#pragma once
#include <openturns/OT.hxx>

#include "pipelines/study/analysis.h"

/// Private to what uses OpenTURNS.
namespace nurbeam {

/// The distribution, cut off at its ends. Throws OT::Exception where it is none.
OT::Distribution law_of(const StudyDistribution& distribution);

/// The free variables together, independent of each other.
OT::Distribution joint_distribution(const StudyFile& study);

OT::Point to_point(const std::vector<double>& values);
OT::Sample to_sample(const StudyPoints& points);
std::vector<double> from_point(const OT::Point& point);
StudyPoints from_sample(const OT::Sample& sample);

/// `f` of the quantities (none where the variant is not done) and the point, as a function of the point:
/// variants run in batches, as they are asked for. `gradient`: the derivatives of each output by the point;
/// where it is none, differences are taken.
OT::Function study_function(const StudyFile& study, const StudyEvaluation& evaluate, std::size_t outputs,
                            std::function<std::vector<double>(const std::vector<double>& quantities,
                                                              const std::vector<double>& point)>
                                f,
                            const StudyDerivatives& gradient = {});

/// Whether a quantity differs in these rows by no more than round-off.
bool hardly_varies(const StudyPoints& rows, std::size_t quantity);

/// The place of a quantity in the rows.
std::size_t quantity_index(const StudyFile& study, const std::string& name);

}  // namespace nurbeam
