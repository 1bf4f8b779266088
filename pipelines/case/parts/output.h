#pragma once
#include <string>
#include <vector>

#include "cad_import/report/format.h"
#include "nurbs/smooth/smooth_nurbs.h"
#include "pipelines/case/parts/clearance.h"
#include "pipelines/case/parts/probe.h"

namespace nurbeam {

struct CaseOutput {
  std::optional<double> every;                 ///< [s]; always there in a dynamic analysis
  std::optional<double> histories_every = {};  ///< [s]; empty: rows of frames alone, or of steps
  bool histories_at_steps = false;             ///< a row of histories at every step
  std::vector<std::string> cad_formats;        ///< "step", "iges", "dxf", "step-solid", ...
  std::vector<double> cad_times;               ///< [s]; the end time unless the file says otherwise
  bool cad_at_all_times = false;               ///< every stored frame, numbered
  std::string cad_unit = "mm";
  StepSchema cad_schema = StepSchema::ap214;
  CurveParameter cad_parameter = CurveParameter::free;
  std::vector<CaseProbe> probes;
  std::vector<CaseClearance> clearances;
  bool accelerations = false;  ///< of point masses and probes too
  bool paraview = false;       ///< a series of files for ParaView
  bool report = true;          ///< report.html
};

/// The shape of "output"; case_output.h reads it.
Shape output_shape();

}  // namespace nurbeam
