#pragma once
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace nurbeam::test {

/// A fresh directory that is removed at the end of the test.
class TemporaryDirectory {
 public:
  TemporaryDirectory() {
    std::string pattern = (std::filesystem::temp_directory_path() / "nurbeam_XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw std::runtime_error("no temporary directory: " + pattern);
    path_ = pattern;
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  ~TemporaryDirectory() { std::filesystem::remove_all(path_); }

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

/// The smallest useful case: a hanging cable.
inline const char* const smallest_case = R"({
  "nurbeam": 1,
  "beams": [{
    "name": "cable",
    "axis": { "polyline": [[0, 0, 0], [1, 0, 0]] },
    "section": { "radius": 0.01 },
    "material": { "density": 7200, "youngs_modulus": 20e6 }
  }],
  "supports": [{ "beam": "cable", "at": "start", "type": "pinned" }],
  "analysis": { "end_time": 0.5 }
})";

/// A case with a sliding body, a load of each kind and every key that goes with them.
inline const char* const full_case = R"({
  "$schema": "nurbeam.schema.json",
  "nurbeam": 1,  // the format
  "name": "zip line",
  "gravity": [0, 0, "-9.81 m/s^2"],
  "beams": [
    {
      "name": "cable",
      "axis": { "file": "zipline.step", "curve": "Spline1", "chain": true,
                "part": "bridge", "layer": "cables", "colour": "#FF8000", "gap": "0.1 mm" },
      "section": { "area": "3 cm^2", "second_moment": "700 mm^4" },
      "material": { "density": "7.2 g/cm^3", "youngs_modulus": "20 MPa", "damping": "1 ms" },
      "elements": { "per_segment": 2, "grading": "-2 cm" },
      "element": "ale-ancf", "weights": "constant", "merge": "paper", "metric": "reference",
      "stress_free": "straight", "curvature": "spatial", "form": "variational", "axial_strain": "pointwise",
      "corners": "hinge", "smooth_up_to": 3, "closed": false, "approximation_tolerance": "1 um"
    },
    {
      "name": "arch",
      "axis": { "arc": { "center": [0, 0, 0], "start": [1, 0, 0], "end": [0, 1, 0], "normal": [0, 0, 1] } },
      "section": { "radius": "5 mm" },
      "material": { "density": 7200, "youngs_modulus": 20e6 },
      "elements": { "max_length": "5 cm" }
    },
    {
      "name": "curve",
      "axis": { "nurbs": { "degree": 2, "knots": [0, 0, 0, 1, 1, 1],
                           "control_points": [[0, 0, 0], ["50 cm", 0, 0], [1, 1, 0]], "weights": [1, 0.5, 1] } },
      "section": { "radius": 0.01 },
      "material": { "density": 7200, "youngs_modulus": 20e6 },
      "elements": { "count": 12 }
    }
  ],
  "bodies": [{ "name": "trolley", "mass": "800 g" }, { "name": "driven", "mass": 1 }, { "name": "timed", "mass": 1 }],
  "loads": [
    { "beam": "cable", "at": "end", "force": [0, "-5 N", 0], "follower": true, "time": [[0, 0], ["100 ms", 1]] },
    { "beam": "cable", "at": { "fraction": 0.5 }, "moment": [0, 0, "2 N m"] },
    { "beam": "cable", "force_per_length": [0, 0, "-3 N/m"] },
    { "beam": "cable", "at": "start", "force": [0, -10, 0], "moves": { "speed": "72 km/h" } }
  ],
  "supports": [{ "beam": "cable", "at": "start", "type": "clamped" },
               { "beam": "cable", "at": { "near": [1, "20 cm", 0], "within": "1 cm" }, "type": "pinned" }],
  "sliding_joints": [
    { "body": "trolley", "beam": "cable", "at": { "length": "10 cm" }, "speed": 2,
      "slope": "discontinuous", "at_beam_end": "stop" },
    { "body": "driven", "beam": "arch", "at": "start", "motion": { "speed": 5 } },
    { "body": "timed", "beam": "curve", "at": "start", "motion": { "table": [[0, 0], [1, "50 mm"]] } }
  ],
  "joints": [{ "beams": ["arch", "curve"], "type": "rigid", "at": { "near": ["1 m", 0, 0] } }],
  "analysis": { "type": "dynamic", "initial": "equilibrium", "end_time": "700 ms", "step": 1e-3,
                "integrator": { "type": "generalized-alpha", "rho_infinity": 0.7 },
                "length_control": { "min": 0.4, "max": 1.6 } },
  "output": { "every": 0.01,
              "cad": { "formats": ["step", "iges"], "times": [0, "350 ms", 0.7], "unit": "inch", "schema": "ap242",
                       "parameter": "material" },
              "probes": [{ "name": "tip", "beam": "cable", "at": "end" }],
              "paraview": true, "report": true }
})";

}  // namespace nurbeam::test
