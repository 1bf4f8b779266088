"""Tables of spreadsheets, and names and values of cases."""

from ..case.places_of_case import Place, object_at, place_in_case
from ..case.tables import BadTable, rows_of_table
from ..case.values import agree, merged, name_for_case
from ..run.command import line_of
from .support import DocumentTest


class Tables(DocumentTest):
    def setUp(self):
        super().setUp()
        self.sheet = self.document.addObject("Spreadsheet::Sheet", "Sheet")
        for cell, content in {"A1": "s", "B1": "mm", "A2": "0", "B2": "=2 mm + 1 mm", "A3": "0.5 s", "B3": "7", "A4": "1",
                              "B4": "0.02 m"}.items():  # fmt: skip
            self.sheet.set(cell, content)
        self.document.recompute()

    def test_numbers_quantities_and_texts_are_read_in_their_units(self):
        self.assertEqual(rows_of_table(self.sheet, "A1:B4", ("s", "m")), [[0, 0.003], [0.5, 0.007], [1, 0.02]])

    def test_what_is_no_table_is_named_by_its_cell(self):
        for cells, units, message in (
            ("A1", ("s",), "no range of cells"),
            ("A1:B4", ("s", "m", "m"), "2 columns; expected 3"),
            ("A1:B5", ("s", "m"), "A5 of Sheet is empty"),
            ("A1:B4", ("s", "kg"), "B2 of Sheet is .* expected a quantity in kg"),
            ("A2:B4", ("s", "m"), "A2 of Sheet has a number; the first row has units"),
        ):
            with self.subTest(cells=cells), self.assertRaisesRegex(BadTable, message):
                rows_of_table(self.sheet, cells, units)


class Values(DocumentTest):
    def test_names_have_no_forbidden_characters_and_are_unlike_each_other(self):
        self.assertEqual(name_for_case('a,"b', set(), "Beam"), "a__b")
        self.assertEqual(name_for_case("rail", {"rail"}, "Beam001"), "rail (Beam001)")
        self.assertEqual(name_for_case("=x", set(), "Beam"), "_x")

    def test_extra_keys_are_merged_and_null_removes(self):
        self.assertEqual(merged({"a": {"b": 1, "c": 2}, "d": 3}, '{"a": {"c": 4}, "d": null}'), {"a": {"b": 1, "c": 4}})

    def test_cases_agree_up_to_what_saving_rounds(self):
        self.assertTrue(agree({"density": 7850.0}, {"density": 7850.0000004}))
        self.assertFalse(agree({"density": 7850.0}, {"density": 7850.1}))
        self.assertFalse(agree({"second_moment": 3e-13}, {"second_moment": 4e-13}))
        self.assertTrue(agree({"control_points": [[1e-17, 1]]}, {"control_points": [[0, 1]]}))

    def test_messages_lead_to_the_nearest_object(self):
        places = {"beams[0]": Place("beam", "Axis"), "beams[0].section.radius": Place("beam", "Radius")}
        self.assertEqual(place_in_case("folder/case.json: beams[0].section.radius"), "beams[0].section.radius")
        self.assertEqual(object_at(places, "case.json: beams[0].section.radius").prop, "Radius")
        self.assertEqual(object_at(places, "case.json: beams[0].element.count").prop, "Axis")
        self.assertIsNone(object_at(places, "case.json: loads[0]"))

    def test_lines_of_the_command_are_read_with_their_place(self):
        for text, severity, where, message in (
            ("error: a b/case.json: beams[0].section.radius: is 0 m; must be at least 1e-09 m", "error", "a b/case.json: beams[0].section.radius",
             "is 0 m; must be at least 1e-09 m"),
            ("warning: supports[1]: stands at 2: one too many", "warning", "supports[1]", "stands at 2: one too many"),
            ("note: all is well: as it seems", "note", "", "all is well: as it seems"),
            ('{"severity": "error", "where": "beams[0]", "message": "x: y"}', "error", "beams[0]", "x: y"),
        ):  # fmt: skip
            line = line_of(text)
            self.assertEqual((line.severity, line.where, line.message), (severity, where, message))
