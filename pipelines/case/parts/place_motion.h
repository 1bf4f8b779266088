#pragma once
#include "nurbs/row_curve.h"
#include "pipelines/case/fields.h"

namespace nurbeam {

/// A prescribed motion along a beam, at a constant speed or by rows.
struct CasePlaceMotion {
  std::optional<double> speed;  ///< [m/s]
  double ramp = 0;              ///< time in which the speed is reached, from rest [s]
  TimeTable table;              ///< [m]; empty: none
  RowJoin join = RowJoin::smooth;

  bool is_given() const { return speed || !table.empty(); }
};

/// Its key. `of_table`: what the rows are.
template <class Owner>
Field<Owner> place_motion_field(CasePlaceMotion Owner::*member, const std::string& of_table,
                                const char* help) {
  using namespace shapes;
  const Shape motion = object(
      {{"speed", quantity(Dimension::speed, plausible(-1e9, 1e9)), "constant speed along the beam"},
       {"ramp", quantity(Dimension::time, plausible(0, 1e9)),
        "time in which the speed is reached from rest, evenly; the speed is there at once when omitted",
        false, "speed"},
       {"table", table(Dimension::length),
        of_table + " over time, constant outside the rows; between them smooth, with a continuous speed and "
                   "acceleration"},
       {"interpolation", choice({"smooth", "linear"}),
        "between the rows of the table; linear: the speed jumps at each row; smooth when omitted", false,
        "table"}},
      {{{"speed", "table"}, required}});
  return field_by<Owner>("motion", motion, help,
                         [member](const Json& json, const std::string&, Owner& owner, Findings&) {
                           CasePlaceMotion& read = owner.*member;
                           if (const Json* speed = value_under(json, "speed")) take(*speed, read.speed);
                           if (const Json* ramp = value_under(json, "ramp")) take(*ramp, read.ramp);
                           if (const Json* rows = value_under(json, "table")) take(*rows, read.table);
                           if (const Json* join = value_under(json, "interpolation"))
                             if (text_of_choice(*join) == "linear") read.join = RowJoin::linear;
                         });
}

}  // namespace nurbeam
