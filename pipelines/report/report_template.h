#pragma once
#include <string_view>

namespace nurbeam {

/// pipelines/report/dist/report.html: the page, with the markers {{title}} and {{data}} once each.
extern const std::string_view report_template;

}  // namespace nurbeam
