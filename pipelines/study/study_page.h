#pragma once
#include <string_view>

namespace nurbeam {

/// pipelines/study/study_page.html: the page of a study, with the markers {{title}} and {{data}} once each.
extern const std::string_view study_page;

}  // namespace nurbeam
