# Longer than 400 lines: one window, driven through one story after another as a user drives it.
# Run by FreeCAD with a window, under the limits of `run`: commands, panels, a run with its progress, the slider, plots.
# Pictures go to the folder NURBEAM_PICTURES; the last line of "gui_report" says whether all was as it should be.
import faulthandler
import math
import os
import tempfile
import traceback

import FreeCAD
import FreeCADGui as Gui
import Part
from FreeCAD import Vector
from PySide import QtCore, QtGui

PICTURES = os.environ["NURBEAM_PICTURES"]
report = open("gui_report", "w")
problems = []
faulthandler.dump_traceback_later(int(os.environ.get("NURBEAM_PATIENCE", "540")), exit=True, file=report)  # where it hangs


def expect(what, condition):
    report.write(f"{'ok   ' if condition else 'WRONG'} {what}\n")
    report.flush()
    if not condition:
        problems.append(what)


def settle(seconds=0.3):
    timer = QtCore.QElapsedTimer()
    timer.start()
    while timer.elapsed() < 1000 * seconds:
        QtGui.QApplication.processEvents(QtCore.QEventLoop.AllEvents, 20)


def wait_for(condition, seconds):
    timer = QtCore.QElapsedTimer()
    timer.start()
    while not condition() and timer.elapsed() < 1000 * seconds:
        QtGui.QApplication.processEvents(QtCore.QEventLoop.AllEvents, 20)
    return condition()


def picture(name, fit=True):
    hide_report()
    if fit:
        Gui.SendMsgToActiveView("ViewFit")
    settle(0.6)
    pixmap = QtGui.QApplication.primaryScreen().grabWindow(0)
    file = os.path.join(PICTURES, f"{name}.png")
    pixmap.save(file)
    image = pixmap.toImage()
    colours = {image.pixel(x, y) for x in range(0, image.width(), 23) for y in range(0, image.height(), 23)}
    expect(f"picture {name} shows something ({len(colours)} colours)", len(colours) > 20)


def dialog():
    return Gui.Control.activeDialog()


def select(obj, *subs):
    Gui.Selection.clearSelection()
    for sub in subs or ("",):
        Gui.Selection.addSelection(obj.Document.Name, obj.Name, sub)
    settle(0.1)


def run_command(name):
    """The command as a user starts it: by its action in the toolbar."""
    Gui.runCommand(name)
    settle(0.3)


def panel_of(obj):
    """The panel as a double click in the tree opens it."""
    from freecad.nurbeam import panels

    opened = []
    make = panels.panel_of
    panels.panel_of = lambda each: opened.append(make(each)) or opened[-1]
    try:
        Gui.ActiveDocument.setEdit(obj.Name)
    finally:
        panels.panel_of = make
    settle(0.3)
    return opened[0] if opened else None


def write(widget, text):
    """Types a text in the place of another."""
    widget.setFocus()
    widget.selectAll()
    for character in text:
        for kind in (QtCore.QEvent.KeyPress, QtCore.QEvent.KeyRelease):
            QtGui.QApplication.sendEvent(widget, QtGui.QKeyEvent(kind, ord(character.upper()), QtCore.Qt.NoModifier, character))
    settle(0.1)


def leave(widget):
    """Takes the focus from a widget, as the tabulator does."""
    widget.clearFocus()
    settle(0.2)


def pipe():
    """As a user draws one: a sketch with lines and an arc, swept by rings."""
    arc = Part.ArcOfCircle(Part.Circle(Vector(500, 200, 0), Vector(0, 0, 1), 200), -math.pi / 2, 0).toShape()
    wire = Part.Wire([Part.makeLine(Vector(0, 0, 0), Vector(500, 0, 0)), arc, Part.makeLine(Vector(700, 200, 0), Vector(700, 600, 0))])
    rods = [wire.makePipeShell([Part.Wire(Part.makeCircle(r, Vector(0, 0, 0), Vector(1, 0, 0)))], True, False) for r in (12, 10)]
    return rods[0].cut(rods[1])


def test_workbench():
    Gui.activateWorkbench("NurbeamWorkbench")
    settle(0.5)
    expect("the workbench is active", Gui.activeWorkbench().name() == "NurbeamWorkbench")
    known = [name for name in Gui.listCommands() if name.startswith("Nurbeam_")]
    expect(f"18 commands are there, not {len(known)}", len(known) == 18)
    infos = [Gui.Command.get(name).getInfo() for name in known]
    expect("all commands have tooltips", all(info["toolTip"] and info["menuText"] for info in infos))
    expect("without a document none is active", not any(Gui.Command.get(name).isActive() for name in known))
    expect("all commands have icons", all(not Gui.Command.get(n).getAction()[0].icon().isNull() for n in known if Gui.Command.get(n).getAction()))


def test_a_pipe_of_a_foreign_file_becomes_a_beam_in_three_clicks(folder):
    import Import

    file = os.path.join(folder, "pipe.step")
    drawn = FreeCAD.newDocument("Drawing")
    solid = drawn.addObject("Part::Feature", "Pipe")
    solid.Shape = pipe()
    Import.export([solid], file)
    FreeCAD.closeDocument("Drawing")
    document = FreeCAD.newDocument("Pipe")
    Import.insert(file, "Pipe")
    document.recompute()
    solid = next(o for o in document.Objects if hasattr(o, "Shape") and o.Shape.Solids and not o.TypeId.startswith("App::"))
    Gui.activeDocument().activeView().viewIsometric()
    select(solid, "Face2")  # one: a click in the view is one at a face
    run_command("Nurbeam_Beam")  # two
    expect("a panel is open", dialog())
    picture("beam")
    from freecad.nurbeam import objects

    beam = next(o for o in document.Objects if objects.type_of(o) == objects.Beam.TYPE)
    expect("the section is that of the pipe", beam.SectionKind == "Of the pipe")
    close(True)  # three
    length = 500 + 100 * math.pi + 400
    expect(f"its length is {beam.Length}", abs(beam.Length.Value - length) < 1e-8)
    expect(f"the beam is up to date: {beam.getStatusString()}", beam.State == ["Up-to-date"])
    return document, beam


def close(keep):
    """OK or Cancel of the open panel, by its buttons."""
    window = Gui.getMainWindow()
    for box in window.findChildren(QtGui.QDialogButtonBox):
        button = box.button(QtGui.QDialogButtonBox.Ok if keep else QtGui.QDialogButtonBox.Cancel) or (None if keep else box.button(QtGui.QDialogButtonBox.Close))
        if button is not None and button.isVisible():
            button.click()
            break
    settle(0.4)
    if dialog():
        Gui.Control.closeDialog()
        settle(0.2)


def test_hang_load_and_run(document, beam):
    from freecad.nurbeam import objects

    run_command("Nurbeam_Support")
    picture("support")
    close(True)
    run_command("Nurbeam_Load")
    load = next(o for o in document.Objects if objects.type_of(o) == objects.Load.TYPE)
    load.PlaceKind, load.Force = "End", "200 N"
    close(True)
    expect("the load stays after OK", abs(load.Force.getValueAs("N").Value - 200) < 1e-9)
    panel = panel_of(load)
    panel.fields["PlaceKind"].setCurrentText("Start")
    expect("a choice of the panel is written at once", load.PlaceKind == "Start")
    expect("and the symbol follows", wait_for(lambda: load.Position.Length < 1e-9, 5))
    close(False)
    expect("Cancel takes it back", load.PlaceKind == "End")
    panel = panel_of(load)
    panel.fields["Force"].setProperty("rawValue", 300.0 * 1000)
    expect(f"a quantity of the panel is written: {load.Force}", abs(load.Force.getValueAs("N").Value - 300) < 1e-9)
    close(False)
    expect("Cancel takes the quantity back", abs(load.Force.getValueAs("N").Value - 200) < 1e-9)
    analysis = objects.analysis_of(beam)
    analysis.AnalysisType = "Motion"
    analysis.EndTime, analysis.Every = "1 s", "0.025 s"
    beam.Elements = 16
    document.recompute()
    run_and_look(document, analysis)


def run_and_look(document, analysis):
    from freecad.nurbeam import objects
    from freecad.nurbeam.run.run_analysis import Run

    panel = panel_of(analysis)
    expect("the panel of the analysis opens", panel is not None)
    every = panel.fields["Every"]
    expect(f"a time has all its digits: {every.property('text')}", every.property("text").replace(" ", "") == "0.025s")
    write(every, "0.0123 s")
    leave(every)
    expect(f"a time that is typed keeps them: {analysis.Every}", abs(analysis.Every.getValueAs("s").Value - 0.0123) < 1e-12)
    close(False)
    settle(0.3)
    expect("Cancel takes it back", abs(analysis.Every.getValueAs("s").Value - 0.025) < 1e-12)
    panel = panel_of(analysis)
    write(panel.fields["Every"], "0.02 s")
    expect("and is written", abs(analysis.Every.getValueAs("s").Value - 0.02) < 1e-12)
    expect("of other kinds of analysis nothing is asked", not panel.fields["ModeCount"].isVisible())
    ticks = []
    timer = QtCore.QTimer()
    timer.timeout.connect(lambda: ticks.append(1))
    timer.start(20)
    panel.run_button.click()
    expect("a run goes on", bool(Run.running))
    wait_for(lambda: panel.phase.text().startswith("Motion"), 10)
    picture("run", fit=False)
    wait_for(lambda: not Run.running, 60)
    timer.stop()
    expect(f"the window stayed alive ({len(ticks)} ticks)", len(ticks) > 5)
    expect(f"the run is done: {analysis.Message}", analysis.Status == "Done")
    close(True)
    result = objects.result_of(analysis)
    expect("there is a result", result is not None and len(result.Times) == 51)
    look_at_result(document, result)


def look_at_result(document, result):
    document.saveAs(os.path.join(tempfile.mkdtemp(), "gui.FCStd"))
    Gui.SendMsgToActiveView("Save")
    settle(0.2)
    expect("the document is saved", not Gui.ActiveDocument.Modified)
    panel = panel_of(result)
    expect("the panel of the result opens", panel is not None)
    for frame in (10, 30, 50):
        panel.slider.setValue(frame)
        settle(0.1)
    panel.colour.setCurrentText("Bending moment")
    expect("looking leaves the document as it was", not Gui.ActiveDocument.Modified)
    picture("results")
    panel.tube.setChecked(True)
    panel.exaggeration.setValue(3)
    picture("tube")
    panel.play_button.setChecked(True)
    settle(0.5)
    panel.play_button.setChecked(False)
    expect("looking still leaves the document as it was", not Gui.ActiveDocument.Modified)
    panel.exaggeration.setValue(1)
    panel.slider.setValue(50)
    panel.plots.setCurrentText(next(n for n in panel.animation.results.histories if n.startswith("energy.")))
    panel.plot_button.click()
    settle(0.4)
    dock = Gui.getMainWindow().findChild(QtGui.QDockWidget, "nurbeam plot")
    expect("the plot is there", dock is not None and dock.isVisible())
    picture("plot", fit=False)
    dock.hide()
    panel.keep_button.click()
    settle(0.3)
    kept = [o for o in document.Objects if o.Name.startswith("DeformedShape")]
    expect("a kept frame is a shape of its own", len(kept) == 1 and kept[0].Shape.Length > 1000)
    close(True)
    expect("OK writes the frame", result.Frame == 50)


def test_gate():
    from freecad.nurbeam.panels.references import Gate

    gate = Gate("Axis")
    expect("edges may be chosen as axis", gate.allow(None, None, "Sketch.Edge2"))
    expect("vertices may not", not gate.allow(None, None, "Sketch.Vertex1"))


def test_quantities_in_their_own_units(document):
    from freecad.nurbeam import objects

    connector = objects.make(objects.Connector, document, analysis=next(o for o in document.Objects if objects.type_of(o) == objects.Analysis.TYPE))
    connector.RotationalStiffness = "2 N*m/rad"
    panel = panel_of(connector)
    panel.fields["ConnectorKind"].setCurrentText("Rotational")
    line = panel.fields["RotationalStiffness"]
    expect(f"a stiffness has its own unit: {line.text()}", line.text() == "2 N*m/rad")
    for text, shown, value in (("3 N*m/deg", "", 540 / math.pi), ("7 kg", "red", 7), ("= 4 N * 1 m / 1 rad", "", 4)):
        write(line, text)
        document.recompute()
        found = connector.RotationalStiffness.getValueAs("N*m/rad").Value
        expect(f"{text} is {found}", abs(found - value) < 1e-9 and shown in line.styleSheet())
    close(False)
    document.removeObject(connector.Name)


def titles():
    found = []
    for widget in Gui.getMainWindow().findChildren(QtGui.QWidget):
        try:
            found += [widget.windowTitle()] if widget.isVisible() else []
        except RuntimeError:
            pass  # deleted meanwhile
    return found


def test_commands_of_a_result():
    run_command("Nurbeam_Check")
    expect("Check opens the panel of the analysis", any(t == "Analysis" for t in titles()) and dialog())
    close(False)
    run_command("Nurbeam_Results")
    expect("Results opens that of the result", wait_for(lambda: dialog() and "Result of Analysis" in titles(), 20))
    close(False)
    run_command("Nurbeam_Plot")
    dock = Gui.getMainWindow().findChild(QtGui.QDockWidget, "nurbeam plot")
    expect("Plot shows the energy", dock is not None and dock.isVisible())
    dock.hide()


def test_fem():
    """A cantilever of FEM, as its own commands make it."""
    import ObjectsFem

    from freecad.nurbeam import objects

    document = FreeCAD.newDocument("Fem")
    expect("without a FEM analysis there is nothing to take over", not Gui.Command.get("Nurbeam_TakeOverFem").isActive())
    bar = document.addObject("Part::Feature", "Bar")
    bar.Shape = Part.makeLine(Vector(0, 0, 0), Vector(1000, 0, 0))
    fem = ObjectsFem.makeAnalysis(document, "FEM")
    section, card = ObjectsFem.makeElementGeometry1D(document, sectiontype="Circular"), ObjectsFem.makeMaterialSolid(document, "Steel")
    section.References, section.CircDiameter = [(bar, "Edge1")], "20 mm"
    card.Material = {"Name": "Steel", "Density": "7900 kg/m^3", "YoungsModulus": "200000 MPa"}
    fixed, force = ObjectsFem.makeConstraintFixed(document), ObjectsFem.makeConstraintForce(document)
    fixed.References, force.References, force.Force = [(bar, "Vertex1")], [(bar, "Vertex2")], 25.0
    for each in (section, card, fixed, force):
        fem.addObject(each)
    document.recompute()
    run_command("Nurbeam_TakeOverFem")
    found = [objects.type_of(o) for o in document.Objects if objects.type_of(o)]
    wanted = [cls.TYPE for cls in (objects.Analysis, objects.Beam, objects.Support, objects.Load)]
    expect(f"a FEM analysis is taken over: {found}", sorted(found) == sorted(wanted))
    document.undo()
    expect("in one step of undo", not any(objects.type_of(o) for o in document.Objects))
    FreeCAD.closeDocument("Fem")


def test_a_connector_is_a_line_between_its_ends(document, beam):
    from freecad.nurbeam import objects

    connector = objects.make(objects.Connector, document, analysis=objects.analysis_of(beam))
    point = document.addObject("Part::Feature", "Anchor")
    point.Shape = Part.Vertex(0, 0, 500)
    span = connector.ViewObject.Proxy.symbol
    expect("one without ends is not shown", span._switch.whichChild.getValue() == -1)
    connector.FromObject, connector.FromPlaceKind, connector.ToPoint = beam, "End", (point, ["Vertex1"])
    document.recompute()
    ends = [p.getValue() for p in span._points.point.getValues()]
    expect(f"its line goes from beam to point: {ends}", ends[1] == (0, 0, 500) and span._switch.whichChild.getValue() == -3)
    panel = panel_of(connector)
    expect("of a point in space no length is asked", not panel.fields["ToPlaceKind"].isVisibleTo(panel.form))
    picture("connector")
    close(False)
    document.removeObject(connector.Name)
    document.removeObject(point.Name)


def test_faults(document, beam):
    from freecad.nurbeam import objects

    analysis = objects.analysis_of(beam)
    beam.Material = None
    panel = panel_of(analysis)
    panel.check_button.click()
    settle(0.3)
    texts = [panel.messages.item(i).text() for i in range(panel.messages.count())]
    expect(f"the missing material is told: {texts}", any("no material is chosen" in t for t in texts))
    expect("the beam is marked", "Invalid" in beam.State)
    picture("faults")
    panel.messages.itemClicked.emit(panel.messages.item(0))
    settle(0.4)
    expect("one click selects the object", Gui.Selection.getSelection() == [beam])
    expect("and opens its panel", wait_for(lambda: beam.Label in titles(), 20))
    close(False)


def test_every_panel_opens(document, beam):
    from freecad.nurbeam import objects

    analysis = objects.analysis_of(beam)
    for cls in (objects.SlidingBody, objects.Joint, objects.Connector, objects.Stop, objects.Probe):
        obj = objects.make(cls, document, analysis=analysis)
        expect(f"{cls.__name__} has its view", type(obj.ViewObject.Proxy).__module__ == "freecad.nurbeam.view.providers")
        panel = panel_of(obj)
        expect(f"the panel of {cls.__name__} opens", panel is not None and dialog())
        close(False)
        document.removeObject(obj.Name)


def test_cable():
    from freecad.nurbeam.run import route

    route.RECOMPUTE_LIMIT = 60.0  # of a machine that does much else besides
    document = FreeCAD.newDocument("Cable")
    for name, base, direction in (("Left", Vector(0, 0, 0), Vector(1, 0, 0)), ("Right", Vector(830, 200, 100), Vector(-1, 0, 0))):
        plug = document.addObject("Part::Feature", name)
        plug.Shape = Part.makeCylinder(20, 30, base, direction)
    document.recompute()
    faces = {}
    for plug in document.Objects:
        far = Vector(30, 0, 0) if plug.Name == "Left" else Vector(800, 200, 100)
        faces[plug.Name] = next(f"Face{i}" for i, f in enumerate(plug.Shape.Faces, 1) if f.CenterOfMass.distanceToPoint(far) < 1e-6)
    Gui.activeDocument().activeView().viewIsometric()
    Gui.Selection.clearSelection()
    for name, face in faces.items():
        Gui.Selection.addSelection("Cable", name, face)
    run_command("Nurbeam_CableOfLength")
    cable = next(o for o in document.Objects if o.Name.startswith("CableOfLength"))
    expect(f"the cable is found: {cable.getStatusString()}", cable.State == ["Up-to-date"])
    cable.Slack, cable.Solid = 40, True
    document.recompute()
    close(True)
    panel_of(cable)
    picture("cable")
    close(True)
    before = cable.Shape.Edges[0].Length
    cable.Slack = 60
    document.recompute()
    expect("it follows its length", cable.Shape.Edges[0].Length != before and cable.State == ["Up-to-date"])


def test_a_new_user(folder):
    """A sketch with an arc, a pipe, hung and loaded, run, looked at, exported: by the panels alone."""
    import subprocess

    from freecad.nurbeam import objects
    from freecad.nurbeam.case.write_case import written_case
    from freecad.nurbeam.run.run_analysis import Run

    document = FreeCAD.newDocument("NewUser")
    sketch = document.addObject("Sketcher::SketchObject", "Sketch")
    sketch.Placement = FreeCAD.Placement(Vector(0, 0, 0), FreeCAD.Rotation(Vector(1, 0, 0), 90))
    sketch.addGeometry(Part.LineSegment(Vector(0, 0, 0), Vector(500, 0, 0)))
    sketch.addGeometry(Part.ArcOfCircle(Part.Circle(Vector(500, 200, 0), Vector(0, 0, 1), 200), -math.pi / 2, 0))
    sketch.addGeometry(Part.LineSegment(Vector(700, 200, 0), Vector(700, 600, 0)))
    document.recompute()
    Gui.activeDocument().activeView().viewFront()
    select(sketch)
    beam_panel = made_by("Nurbeam_Beam")
    beam = beam_panel.obj
    beam_panel.fields["SectionKind"].setCurrentText("Pipe")
    beam_panel.show_property("Radius")
    for name, text in (("Radius", "12 mm"), ("Bore", "10 mm")):
        write(beam_panel.fields[name], text)
    picture("user_section")
    beam_panel.show_property("Material")
    beam_panel.fields["Material"].setCurrentText("Steel-S235JR")
    picture("user_material", fit=False)
    close(True)
    expect(f"the sketch is a pipe of S235JR: {beam.getStatusString()}", beam.Material.Label == "Steel-S235JR" and beam.Bore.Value == 10)
    made_by("Nurbeam_Support")
    close(True)
    load_panel = made_by("Nurbeam_Load")
    load = load_panel.obj
    expect("a load stands at the end where nothing else is said", load.PlaceKind == "End")
    write(load_panel.fields["Force"], "80 N")
    wait_for(lambda: load.Position.Length > 1, 5)
    picture("user_load")
    close(True)
    analysis = objects.analysis_of(beam)
    panel = panel_of(analysis)
    panel.fields["AnalysisType"].setCurrentText("Equilibrium")
    panel.run_button.click()
    wait_for(lambda: not Run.running, 60)
    expect(f"the run is done: {analysis.Message}", analysis.Status == "Done")
    settle(0.3)
    picture("user_run", fit=False)
    panel.results_button.click()
    expect("the results are open", wait_for(lambda: dialog() and objects.result_of(analysis).Label in titles(), 20))
    picture("user_results")
    close(True)
    kept = sag_of_kept_shape(document)
    path = os.path.join(folder, "user", "case.json")
    export_by_dialog(path)
    done = subprocess.run([os.environ["NURBEAM_COMMAND"], "run", path, "--quiet", "--out", os.path.join(folder, "user", "out")], timeout=60)
    expect("the exported case runs", done.returncode == 0)
    expect("with its axes as STEP", os.path.getsize(os.path.join(folder, "user", "axes.step")) > 1000)
    with open(path, encoding="utf-8") as stream:
        expect("it is the case of the document", stream.read() == written_case(analysis).text)
    expect(f"the pipe bends down by {kept:.4g} mm", 1 < kept < 100)


def made_by(command):
    """The panel of the object that a command makes."""
    from freecad.nurbeam import panels

    opened = []
    make = panels.panel_of
    panels.panel_of = lambda each: opened.append(make(each)) or opened[-1]
    try:
        run_command(command)
    finally:
        panels.panel_of = make
    return opened[0]


def sag_of_kept_shape(document):
    """How far the end of the kept shape lies below that of the drawing [mm]."""
    run_command("Nurbeam_KeepFrame")
    shape = next(o for o in document.Objects if o.Name.startswith("DeformedShape"))
    edge = shape.Shape.Edges[0]
    expect("a kept shape has the radii of its pipe", abs(shape.Radius.Value - 12) < 1e-9 and abs(shape.Bore.Value - 10) < 1e-9)
    return 600 - max(edge.valueAt(edge.FirstParameter).z, edge.valueAt(edge.LastParameter).z)


def export_by_dialog(path):
    os.makedirs(os.path.dirname(path))
    dialogs = QtGui.QFileDialog.getSaveFileName, QtGui.QMessageBox.question
    QtGui.QFileDialog.getSaveFileName = lambda *_: (path, "")
    QtGui.QMessageBox.question = lambda *_: QtGui.QMessageBox.Yes
    try:
        run_command("Nurbeam_ExportCase")
    finally:
        QtGui.QFileDialog.getSaveFileName, QtGui.QMessageBox.question = dialogs


def test_material_and_edges_of_two_objects():
    from freecad.nurbeam import objects

    document = FreeCAD.newDocument("Frame")
    for name, start, end in (("Long", Vector(0, 0, 0), Vector(500, 0, 0)), ("Short", Vector(500, 0, 0), Vector(500, 0, 300))):
        document.addObject("Part::Feature", name).Shape = Part.makeLine(start, end)
    document.recompute()
    Gui.Selection.clearSelection()
    for name in ("Long", "Short"):
        Gui.Selection.addSelection("Frame", name, "Edge1")
    run_command("Nurbeam_Beam")
    close(True)
    beam = next(o for o in document.Objects if objects.type_of(o) == objects.Beam.TYPE)
    expect(f"edges of two objects are one beam of {beam.Length}", beam.Length.Value == 800)
    steel = beam.Material
    run_command("Nurbeam_Material")
    line = next(w for w in Gui.getMainWindow().findChildren(QtGui.QLineEdit) if w.isVisible() and w.placeholderText())
    write(line, "al-zn4")
    write(line, "alzn4")
    picture("material")
    close(True)
    expect(f"the beam has the card that was chosen: {beam.Material.Label}", beam.Material.Label.startswith("AlZn4"))
    document.undo()
    expect("which is one step of undo", beam.Material == steel and len(document.findObjects(Label="AlZn4.*")) == 0)


def test_german():
    from freecad.nurbeam import objects

    document = FreeCAD.getDocument("Frame")
    beam = next(o for o in document.Objects if objects.type_of(o) == objects.Beam.TYPE)
    Gui.setLocale("German")
    settle(0.5)
    panel = panel_of(beam)
    names = [panel.tabs.tabText(i) for i in range(panel.tabs.count())]
    expect(f"tabs are German: {names}", names[:2] == ["Achse", "Querschnitt"] and names[-1] == "Mehr")
    panel.fields["SectionKind"].setCurrentText("Rohr")
    expect(f"a choice is written as the document has it: {beam.SectionKind}", beam.SectionKind == "Pipe")
    panel.show_property("Bore")
    picture("german")
    close(False)
    expect("menus are German", Gui.Command.get("Nurbeam_Support").getAction()[0].text().replace("&", "") == "Lager")
    Gui.setLocale("English")
    settle(0.3)


def test_two_analyses():
    from freecad.nurbeam import objects
    from freecad.nurbeam.run.run_analysis import Run

    document = FreeCAD.newDocument("Two")
    bar = document.addObject("Part::Feature", "Bar")
    bar.Shape = Part.makeLine(Vector(0, 0, 0), Vector(1000, 0, 0))
    select(bar, "Edge1")
    run_command("Nurbeam_Beam")
    close(True)
    run_command("Nurbeam_Support")
    close(True)
    run_command("Nurbeam_Analysis")
    close(True)
    first, second = [o for o in document.Objects if objects.type_of(o) == objects.Analysis.TYPE]
    run_command("Nurbeam_Support")
    close(True)
    expect("what is new goes to the analysis that was made last", len(second.Group) == 1)
    first.ViewObject.Proxy.doubleClicked(first.ViewObject)
    settle(0.3)
    close(True)
    run_command("Nurbeam_Support")
    close(True)
    expect("the second support of a beam stands at its end", first.Group[-1].PlaceKind == "End")
    document.removeObject(first.Group[-1].Name)
    run_command("Nurbeam_Probe")
    close(True)
    expect("a double click makes the other one active", len(first.Group) == 3 and len(second.Group) == 1)
    first.EndTime, first.Step = "1000 s", "0.0002 s"
    panel = panel_of(first)
    panel.run_button.click()
    wait_for(lambda: "Motion" in panel.phase.text(), 20)
    close(True)
    bar = Gui.getMainWindow().statusBar()
    before = bar.currentMessage()
    expect("a run goes on when its panel is closed, as the status bar tells", wait_for(lambda: bar.currentMessage() != before, 20))
    panel = panel_of(first)
    expect("a panel that is opened again follows it", panel.process is not None and not panel.run_button.isEnabled())
    FreeCAD.closeDocument(document.Name)
    expect("closing the document ends its runs", wait_for(lambda: not Run.running, 20))


def test_a_document_that_is_opened_again():
    from freecad.nurbeam import objects

    document = FreeCAD.getDocument(next(name for name in FreeCAD.listDocuments() if name.startswith("ZipLine")))
    folder = tempfile.mkdtemp()
    for what, lost in (("opened again", False), ("saved without the workbench", True)):
        for obj in document.Objects if lost else ():
            if objects.type_of(obj):
                obj.Proxy = obj.ViewObject.Proxy = None
        file = os.path.join(folder, f"lost {lost}.FCStd")
        document.saveAs(file)
        FreeCAD.closeDocument(document.Name)
        document = FreeCAD.openDocument(file)
        settle(0.5)
        own = [o for o in document.Objects if objects.type_of(o)]
        expect(f"{what}: all views are attached", own and all(getattr(o.ViewObject.Proxy, "Object", None) is o for o in own))
        expect(f"{what}: a look at it changes nothing", lost or not Gui.ActiveDocument.Modified)
        result = next(o for o in own if objects.type_of(o) == objects.Result.TYPE)
        expect(f"{what}: the panel of the result opens", panel_of(result) is not None)
        picture(f"again_{lost}")
        close(True)


def hide_report():
    for dock in Gui.getMainWindow().findChildren(QtGui.QDockWidget):
        if dock.objectName() == "Report view":
            dock.hide()


def widen_panels():
    """As wide as a panel needs."""
    window = Gui.getMainWindow()
    for dock in window.findChildren(QtGui.QDockWidget):
        if dock.objectName() == "Combo View":
            window.resizeDocks([dock], [430], QtCore.Qt.Horizontal)


def test_zip_line():
    """The sample, with its body on the way."""
    import importlib.util

    from freecad.nurbeam import objects
    from freecad.nurbeam.run.run_analysis import start_run

    file = os.path.join(os.environ["NURBEAM_SAMPLES"], "freecad", "zip_line.py")
    spec = importlib.util.spec_from_file_location("zip_line_sample", file)
    sample = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(sample)
    document = FreeCAD.newDocument("ZipLine")
    analysis = sample.make(document)
    analysis.EndTime = "3 s"
    trolley = document.addObject("Part::Feature", "Trolley")
    body = objects.members(analysis, objects.SlidingBody)[0]
    trolley.Shape = Part.makeBox(800, 800, 1200, body.Position - Vector(400, 400, 1200))
    body.MovesWith = trolley
    document.recompute()
    run, findings = start_run(analysis)
    expect(f"the zip line runs: {findings}", run is not None and wait_for(lambda: run.code is not None, 40) and run.code == 0)
    Gui.activeDocument().activeView().viewFront()
    placed = FreeCAD.Placement(trolley.Placement)
    panel = panel_of(objects.result_of(analysis))
    panel.slider.setValue(0)
    picture("zip_line_start")
    panel.colour.setCurrentText("Velocity")
    panel.slider.setValue(150)
    picture("zip_line")
    shift = trolley.ViewObject.RootNode[0].translation.getValue().getValue()
    moved = panel.animation.results[150].bodies["trolley"].position - panel.animation.results[0].bodies["trolley"].position
    expect("the solid is shown where the body is", max(abs(a - 1000 * b) for a, b in zip(shift, moved)) < 1e-3)
    expect("its placement stays", trolley.Placement == placed)
    close(True)
    first = trolley.ViewObject.RootNode[0]
    expect("its picture is back", first.getTypeId().getName() != "Translation")


def main():
    Gui.getMainWindow().setGeometry(QtGui.QApplication.primaryScreen().geometry())  # all of it, whose pixels may be no whole ones
    widen_panels()
    FreeCAD.ParamGet("User parameter:BaseApp/Preferences/Mod/Start").SetBool("ShowOnStartup", False)
    folder = tempfile.mkdtemp()
    test_workbench()
    document, beam = test_a_pipe_of_a_foreign_file_becomes_a_beam_in_three_clicks(folder)
    test_hang_load_and_run(document, beam)
    test_gate()
    test_every_panel_opens(document, beam)
    test_quantities_in_their_own_units(document)
    test_commands_of_a_result()
    test_a_connector_is_a_line_between_its_ends(document, beam)
    test_faults(document, beam)
    test_cable()
    test_a_new_user(folder)
    test_material_and_edges_of_two_objects()
    test_german()
    test_fem()
    test_zip_line()
    test_a_document_that_is_opened_again()
    test_two_analyses()


def guarded():
    try:
        main()
    except BaseException:
        problems.append("exception")
        report.write(traceback.format_exc())
    finally:
        report.write("all is as it should be\n" if not problems else f"{len(problems)} problems\n")
        report.close()
        os._exit(1 if problems else 0)


QtCore.QTimer.singleShot(500, guarded)
