#pragma once
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "cad_import/report/format.h"
#include "cad_import/report/length_unit.h"
#include "cad_import/report/named_curve.h"

/// What the program that reads and writes CAD files is asked, and what it answers.
namespace nurbeam {

/// A curve of a STEP file and the shape it has taken.
struct DeformedCurve {
  NurbsCurve drawn;     ///< as import_curves() gives it from that file
  NurbsCurve deformed;  ///< [m], world coordinates
  std::string name;     ///< for messages, and for a curve that is added
  bool beside = false;  ///< leave the drawn curve and add the deformed one (it stands for a chain of several)
};

/// Answered by the bytes of an ImportReport.
struct ReadRequest {
  std::filesystem::path file;
  double tolerance;  ///< [m]
};

/// Answered by the text of the file.
struct WriteCurvesRequest {
  CadFormat format;
  std::vector<NamedCurve> curves;
  LengthUnit unit;    ///< millimetre in BREP
  StepSchema schema;  ///< of STEP
};
struct WriteSolidsRequest {
  CadFormat format;  ///< STEP or BREP
  std::vector<NamedSolid> solids;
  LengthUnit unit;
  StepSchema schema;
};

/// Answered by an Exchanged.
struct ExchangeRequest {
  std::filesystem::path source;
  std::vector<DeformedCurve> curves;
};

/// Answered by the bytes of their texts.
struct WriteFilesRequest {
  std::vector<WriteCurvesRequest> files;
};

using CadRequest =
    std::variant<ReadRequest, WriteCurvesRequest, WriteSolidsRequest, ExchangeRequest, WriteFilesRequest>;

/// A STEP file with some of its curves exchanged.
struct Exchanged {
  std::vector<std::string> warnings;
  std::string text;
};

std::string to_bytes(const CadRequest& request);
/// Throws std::runtime_error when the bytes are no request.
CadRequest request_from_bytes(const std::string& bytes);

std::string to_bytes(const std::vector<std::string>& texts);
/// Throws std::runtime_error when the bytes are none.
std::vector<std::string> texts_from_bytes(const std::string& bytes);

std::string to_bytes(const Exchanged& exchanged);
/// Throws std::runtime_error when the bytes are none.
Exchanged exchanged_from_bytes(const std::string& bytes);

}  // namespace nurbeam
