#pragma once
#include <string>

#include "cad_import/import_curves.h"
#include "tests/cad_import/scratch_directory.h"

/// Texts of IFC files.
namespace nurbeam::ifc {

inline ImportReport imported(const std::string& text) {
  const ScratchDirectory scratch;
  return import_curves(scratch.file("model.ifc", text));
}

/// A file with a project in millimetres, and these instances, whose numbers begin at 100.
inline std::string file_of(const std::string& instances, const std::string& prefix = ".MILLI.") {
  return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('ViewDefinition'),'2;1');\n"
         "FILE_NAME('case','2026-01-01T00:00:00',(''),(''),'','','');\nFILE_SCHEMA(('IFC4X3_ADD2'));\nENDSEC;\n"
         "DATA;\n#1=IFCPROJECT('0',$,'case',$,$,$,$,(#5),#2);\n#2=IFCUNITASSIGNMENT((#3,#4));\n"
         "#3=IFCSIUNIT(*,.LENGTHUNIT.," +
         prefix +
         ",.METRE.);\n#4=IFCSIUNIT(*,.PLANEANGLEUNIT.,$,.RADIAN.);\n"
         "#5=IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-05,#6,$);\n#6=IFCAXIS2PLACEMENT3D(#7,$,$);\n"
         "#7=IFCCARTESIANPOINT((0.,0.,0.));\n" +
         instances + "ENDSEC;\nEND-ISO-10303-21;\n";
}

/// The product #90 of this name, moved to (1000, 0, 0) and turned by 90 degrees about z, whose shape is #100.
inline std::string product(const std::string& keyword = "IFCREINFORCINGBAR", const std::string& name = "bar",
                           const std::string& identifier = "Body") {
  return "#90=" + keyword + "('1',$,'" + name +
         "',$,$,#91,#94,$);\n#91=IFCLOCALPLACEMENT($,#92);\n"
         "#92=IFCAXIS2PLACEMENT3D(#93,$,#96);\n#93=IFCCARTESIANPOINT((1000.,0.,0.));\n"
         "#94=IFCPRODUCTDEFINITIONSHAPE($,$,(#95));\n#95=IFCSHAPEREPRESENTATION(#5,'" +
         identifier + "','AdvancedSweptSolid',(#100));\n#96=IFCDIRECTION((0.,1.,0.));\n";
}

}  // namespace nurbeam::ifc
