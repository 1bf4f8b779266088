"""Read by FreeCAD at its start, also without a window."""

import FreeCAD

FreeCAD.__unit_test__ += ["freecad.nurbeam.tests"]
