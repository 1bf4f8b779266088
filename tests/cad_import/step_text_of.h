#pragma once
#include <string>

namespace nurbeam {

inline const std::string millimetres = "( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.) )";
inline const std::string inches =
    "( CONVERSION_BASED_UNIT('INCH',#31) LENGTH_UNIT() NAMED_UNIT(#33) );\n"
    "#31 = LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#32);\n"
    "#32 = ( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.) );\n"
    "#33 = DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.)";

/// A STEP file (AP214) whose geometric curve set, of the given name, holds the entities `references`
/// ("#100,#101") among `entities` (numbers from 100; #11 is the placement at the origin, #13 is z, #14 is x).
inline std::string step_text_of(const std::string& references, const std::string& entities,
                                const std::string& set_name = "", const std::string& unit = millimetres) {
  return R"(ISO-10303-21;
HEADER;
FILE_DESCRIPTION(('curves'),'2;1');
FILE_NAME('curves','2024-01-01T00:00:00',(''),(''),'','','');
FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));
ENDSEC;
DATA;
#1 = APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,#2);
#2 = APPLICATION_CONTEXT('core data for automotive mechanical design processes');
#3 = SHAPE_DEFINITION_REPRESENTATION(#4,#10);
#4 = PRODUCT_DEFINITION_SHAPE('','',#5);
#5 = PRODUCT_DEFINITION('design','',#6,#9);
#6 = PRODUCT_DEFINITION_FORMATION('','',#7);
#7 = PRODUCT('curves','curves','',(#8));
#8 = PRODUCT_CONTEXT('',#2,'mechanical');
#9 = PRODUCT_DEFINITION_CONTEXT('part definition',#2,'design');
#10 = GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION('',(#11,#15),#26);
#11 = AXIS2_PLACEMENT_3D('',#12,#13,#14);
#12 = CARTESIAN_POINT('',(0.,0.,0.));
#13 = DIRECTION('',(0.,0.,1.));
#14 = DIRECTION('',(1.,0.,0.));
#15 = GEOMETRIC_CURVE_SET(')" +
         set_name + "',(" + references + R"());
#26 = ( GEOMETRIC_REPRESENTATION_CONTEXT(3) GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#30))
GLOBAL_UNIT_ASSIGNED_CONTEXT((#27,#28,#29)) REPRESENTATION_CONTEXT('','3D') );
#27 = )" +
         unit +
         R"(;
#28 = ( NAMED_UNIT(*) PLANE_ANGLE_UNIT() SI_UNIT($,.RADIAN.) );
#29 = ( NAMED_UNIT(*) SI_UNIT($,.STERADIAN.) SOLID_ANGLE_UNIT() );
#30 = UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-07),#27,'distance_accuracy_value','');
)" + entities +
         R"(
ENDSEC;
END-ISO-10303-21;
)";
}

/// An occurrence of the part #51, whose representation is #55, in the assembly #5: its instances are numbered
/// from `n`; its axes are moved to (x, 0, 0) and turned by 90 degrees about z.
inline std::string occurrence(int n, const std::string& name, double x) {
  const auto number = [&](int i) { return "#" + std::to_string(n + i); };
  return number(0) + " = NEXT_ASSEMBLY_USAGE_OCCURRENCE('" + name + "','" + name + "','',#5,#51,$);\n" +
         number(1) + " = PRODUCT_DEFINITION_SHAPE('',''," + number(0) + ");\n" + number(2) +
         " = CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(" + number(3) + "," + number(1) + ");\n" + number(3) +
         " = ( REPRESENTATION_RELATIONSHIP('','',#55,#10) "
         "REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(" +
         number(4) + ") SHAPE_REPRESENTATION_RELATIONSHIP() );\n" + number(4) +
         " = ITEM_DEFINED_TRANSFORMATION('','',#11," + number(5) + ");\n" + number(5) +
         " = AXIS2_PLACEMENT_3D(''," + number(6) + ",#13," + number(7) + ");\n" + number(6) +
         " = CARTESIAN_POINT('',(" + std::to_string(x) + ",0.,0.));\n" + number(7) +
         " = DIRECTION('',(0.,1.,0.));\n";
}

}  // namespace nurbeam
