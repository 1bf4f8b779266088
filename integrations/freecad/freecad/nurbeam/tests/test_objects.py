"""Objects in documents: properties, units, saving, versions."""

import FreeCAD

from .. import objects
from ..objects.feature import SCHEMA_VERSION
from .support import DocumentTest, cantilever


class Objects(DocumentTest):
    def test_every_object_is_made_saved_and_loaded_with_its_units(self):
        names = {cls: objects.make(cls, self.document).Name for cls in objects.CLASSES}
        self.reopened()
        for cls, name in names.items():
            obj = self.document.getObject(name)
            self.assertIsInstance(obj.Proxy, cls)
            for row in cls.PROPERTIES:
                self.assertIn(row.name, obj.PropertiesList)
                if row.unit:
                    self.assertEqual(getattr(obj, row.name).Unit, FreeCAD.Units.Unit(row.unit), f"{name}.{row.name}")

    def test_quantities_take_texts_keep_values_and_refuse_other_units(self):
        body = objects.make(objects.SlidingBody, self.document)
        body.Mass = "80 kg"
        body.setExpression("RollInertia", "2 kg * 3 m^2")
        self.document.recompute()
        with self.assertRaises(ArithmeticError):
            body.Mass = "3 m"
        name = body.Name
        body = self.reopened().getObject(name)
        self.assertEqual(body.Mass.getValueAs("kg").Value, 80)
        self.assertEqual(body.RollInertia.getValueAs("kg*m^2").Value, 6)
        self.assertEqual(dict(body.ExpressionEngine)["RollInertia"].replace(" ", ""), "2kg*3(m^2)")
        body.Mass = "5 g"
        self.assertAlmostEqual(body.Mass.getValueAs("kg").Value, 0.005, 15)

    def test_properties_of_an_older_version_are_carried_over(self):
        class Renamed(objects.Support):
            RENAMED = {SCHEMA_VERSION: {"OldPull": "Pull"}}

        support = objects.make(objects.Support, self.document)
        support.removeProperty("Pull")
        support.addProperty("App::PropertyForce", "OldPull", "Support", "")
        support.OldPull = "7 N"
        support.setExpression("OldPull", "3 N + 4 N")
        support.SchemaVersion = 0
        Renamed.onDocumentRestored(Renamed.__new__(Renamed), support)
        self.assertEqual(support.Pull.getValueAs("N").Value, 7)
        self.assertEqual(dict(support.ExpressionEngine), {"Pull": "3N + 4N"})
        self.assertNotIn("OldPull", support.PropertiesList)
        self.assertEqual(support.SchemaVersion, SCHEMA_VERSION)

    def test_a_beam_of_the_first_version_keeps_its_axis(self):
        """Its axis was of one object."""
        _, beam, _, _ = cantilever(self.document)
        bar = beam.Axis[0][0]
        beam.removeProperty("Axis")
        beam.addProperty("App::PropertyXLinkSub", "Axis", "Axis", "")
        beam.Axis, beam.SchemaVersion = (bar, ["Edge1"]), 1
        name = beam.Name
        beam = self.reopened().getObject(name)
        self.assertEqual(beam.getTypeIdOfProperty("Axis"), "App::PropertyXLinkSubList")
        self.assertEqual(beam.SchemaVersion, SCHEMA_VERSION)
        beam.touch()
        self.document.recompute()
        self.assertEqual((beam.State, beam.Length.Value), (["Up-to-date"], 1000))

    def test_an_object_of_a_newer_version_is_invalid_and_unchanged(self):
        support = objects.make(objects.Support, self.document)
        support.SchemaVersion = SCHEMA_VERSION + 1
        support = self.reopened().getObject("Support")
        self.document.recompute()
        self.assertIn("Invalid", support.State)
        self.assertIn("newer nurbeam workbench", support.getStatusString())
        self.assertEqual(support.SchemaVersion, SCHEMA_VERSION + 1)

    def test_lost_proxies_are_mended(self):
        analysis, beam, support, load = cantilever(self.document)
        for obj in (analysis, beam, support, load):
            obj.Proxy = None  # as a FreeCAD without the workbench leaves it
        load.removeProperty("Follower")
        mended = objects.mend(self.document)
        self.assertEqual(set(mended), {analysis, beam, support, load})
        self.assertIsInstance(beam.Proxy, objects.Beam)
        self.assertIn("Follower", load.PropertiesList)
        self.assertEqual(load.Force.getValueAs("N").Value, 10)

    def test_a_beam_finds_its_length_again_when_its_edge_changes(self):
        import Part
        from FreeCAD import Vector

        _, beam, _, _ = cantilever(self.document)
        self.assertAlmostEqual(beam.Length.Value, 1000, 9)
        beam.Axis[0][0].Shape = Part.makeLine(Vector(0, 0, 0), Vector(0, 700, 0))
        self.document.recompute()
        self.assertAlmostEqual(beam.Length.Value, 700, 9)

    def test_a_broken_link_is_told_at_the_object(self):
        _, beam, _, _ = cantilever(self.document)
        self.document.removeObject(beam.Axis[0][0].Name)
        self.document.recompute()
        self.assertIn("Invalid", beam.State)
        self.assertIn("no axis is chosen", beam.getStatusString())
