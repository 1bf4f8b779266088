// A curve from a CAD file becomes rational cubics, and one NURBS again: exactly.
#include <cstdio>

#include "cad_import/export_curves.h"
#include "cad_import/import_curves.h"
#include "nurbs/bezier_path.h"

using namespace nurbeam;

int main(int count, char** arguments) {
  const std::filesystem::path file = count > 1 ? arguments[1] : "samples/zipline/cable.step";
  const ImportReport report =
      import_curves(file);  // read by a process of its own: a bad file cannot harm this one
  for (const Diagnostic& d : report.diagnostics) std::printf("%s: %s\n", d.where.c_str(), d.message.c_str());
  if (!report.ok() || report.curves.empty()) return 1;

  const ImportedCurve& drawn = report.curves.front();  // in metres, whatever the file's unit
  const BezierPath path = BezierPath::from_nurbs(drawn.curve, 1e-6);
  const NurbsCurve again = path.to_nurbs();
  const auto problems = export_curves("again.igs", {{drawn.name, again}}, LengthUnit::millimetre);
  for (const Diagnostic& d : problems) std::printf("%s: %s\n", d.where.c_str(), d.message.c_str());

  double apart = 0;
  for (int i = 0; i <= 100; ++i) {
    const auto at = [i](const NurbsCurve& c) {
      const double start = c.knots().start(), end = c.knots().end();
      return c.point(start + (end - start) * i / 100);
    };
    if (path.segments.size() == 1) apart = std::max(apart, (at(drawn.curve) - at(again)).norm());
  }
  const double change = std::abs(length(again) - length(drawn.curve));
  std::printf("%s: degree %d, %zu cubics, %.9f m long; back: %.1e m longer, %.1e m apart\n",
              drawn.name.c_str(), drawn.curve.degree(), path.segments.size(), path.length(), change, apart);
  return problems.empty() && change < 1e-12 * path.length() && apart < 1e-12 ? 0 : 1;
}
