#include "cad_import/step/nested_piece.h"

#include <StepGeom_HArray1OfTrimmingSelect.hxx>
#include <StepGeom_TrimmedCurve.hxx>
#include <StepGeom_TrimmingSelect.hxx>
#include <optional>
#include <stdexcept>

namespace nurbeam {
namespace {

using TrimValues = Handle(StepGeom_HArray1OfTrimmingSelect);

std::optional<double> parameter_of(const TrimValues& trim) {
  for (int i = 1; !trim.IsNull() && i <= trim->Length(); ++i)
    if (trim->Value(i).CaseMember() > 0) return trim->Value(i).ParameterValue();
  return std::nullopt;
}

/// The trim with its parameter in that of the curve below `piece`.
TrimValues below(const TrimValues& trim, const StepGeom_TrimmedCurve& piece) {
  if (!parameter_of(trim)) return trim;
  const std::optional<double> start = parameter_of(piece.Trim1());
  if (!start)
    throw std::runtime_error(
        "it is trimmed by parameters out of another piece (TRIMMED_CURVE) that begins at a point alone; trim "
        "it by points, or the curve itself");
  const TrimValues moved = new StepGeom_HArray1OfTrimmingSelect(1, trim->Length());
  for (int i = 1; i <= trim->Length(); ++i) {
    StepGeom_TrimmingSelect value = trim->Value(i);
    if (value.CaseMember() > 0) {
      const double along = value.ParameterValue();
      value = StepGeom_TrimmingSelect();
      value.SetParameterValue(*start + (piece.SenseAgreement() ? along : -along));
    }
    moved->SetValue(i, value);
  }
  return moved;
}

}  // namespace

void restate_nested(StepGeom_TrimmedCurve& trimmed) {
  constexpr int deepest = 100;
  for (int depth = 0;; ++depth) {
    const auto piece = Handle(StepGeom_TrimmedCurve)::DownCast(trimmed.BasisCurve());
    if (piece.IsNull()) return;
    if (depth > deepest) throw std::runtime_error("it is a piece of itself, or nested too deeply");
    const TrimValues first = below(trimmed.Trim1(), *piece), last = below(trimmed.Trim2(), *piece);
    trimmed.SetTrim1(first);
    trimmed.SetTrim2(last);
    trimmed.SetSenseAgreement(trimmed.SenseAgreement() == piece->SenseAgreement());
    trimmed.SetBasisCurve(piece->BasisCurve());
  }
}

}  // namespace nurbeam
