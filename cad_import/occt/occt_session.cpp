#include "cad_import/occt/occt_session.h"

#include <IGESControl_Controller.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <OSD.hxx>
#include <STEPControl_Controller.hxx>

namespace nurbeam {

void be_silent() {
  OSD::SetSignal(Standard_False);
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer));
}

void start_step() {
  STEPControl_Controller::Init();
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
}

void start_iges() {
  IGESControl_Controller::Init();
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
}

}  // namespace nurbeam
