#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "cad_import/dxf/dxf_text.h"
#include "cad_import/files/child_work.h"
#include "cad_import/iges/iges_text.h"
#include "cad_import/program/brep_text.h"
#include "cad_import/program/contained_reading.h"
#include "cad_import/program/exchange_curves.h"
#include "cad_import/report/report_bytes.h"
#include "cad_import/report/request.h"
#include "cad_import/step/step_text.h"

/// nurbeam-cad: reads and writes CAD files for nurbeam, one request a process. A bad file may crash it.
namespace nurbeam {
namespace {

std::string answer(const ReadRequest& request) { return contained_reading(request.file, request.tolerance); }
std::string answer(const WriteCurvesRequest& request) {
  switch (request.format) {
    case CadFormat::step:
      return step_text(request.curves, request.unit, request.schema);
    case CadFormat::iges:
      return iges_text(request.curves, request.unit);
    case CadFormat::dxf:
      return dxf_text(request.curves, request.unit);
    case CadFormat::brep:
      return brep_text(request.curves);
    case CadFormat::ifc:
      break;
  }
  throw std::runtime_error("files of this format are not written");
}
std::string answer(const WriteFilesRequest& request) {
  std::vector<std::string> texts;
  for (const WriteCurvesRequest& file : request.files) texts.push_back(answer(file));
  return to_bytes(texts);
}
std::string answer(const WriteSolidsRequest& request) {
  return request.format == CadFormat::brep ? brep_solid_text(request.solids)
                                           : step_solid_text(request.solids, request.unit, request.schema);
}
std::string answer(const ExchangeRequest& request) {
  return to_bytes(exchange_curves(request.source, request.curves));
}

}  // namespace
}  // namespace nurbeam

int main(int argc, char** argv) {
  return nurbeam::serve_one_request(
      argc, argv,
      [](const std::string& bytes) {
        return std::visit([](const auto& request) { return nurbeam::answer(request); },
                          nurbeam::request_from_bytes(bytes));
      });
}
