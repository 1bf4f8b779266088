"""Files of translations: nothing is missing, and what is compiled is what is written."""

import glob
import os
import unittest
import xml.etree.ElementTree as tree

from PySide import QtCore

from .. import translations
from ..translations.texts import all_texts

FILES = sorted(glob.glob(os.path.join(os.path.dirname(translations.__file__), "nurbeam_*.ts")))
WINDOW = "NurbeamPreferences"  # whose texts are those of a .ui file


def messages(file):
    for context in tree.parse(file).getroot().iter("context"):
        for message in context.iter("message"):
            yield context.find("name").text, message.find("source").text, message.find("translation")


class Translations(unittest.TestCase):
    def test_files_hold_all_texts_of_the_workbench_translated(self):
        self.assertTrue(FILES)
        for file in FILES:
            found = {(context, source) for context, source, _ in messages(file) if context != WINDOW}
            self.assertEqual(found ^ all_texts(), set(), f"{file}: run integrations/freecad/translate")
            for context, source, translation in messages(file):
                self.assertNotIn("type", translation.attrib, f"{file}: {context}: {source} is not translated")
                self.assertEqual(source.count("{}"), translation.text.count("{}"), f"{file}: {source}")

    def test_compiled_files_are_those_that_are_written(self):
        for file in FILES:
            compiled = QtCore.QTranslator()
            self.assertTrue(compiled.load(file[: -len(".ts")] + ".qm"))
            for context, source, translation in messages(file):
                self.assertEqual(compiled.translate(context, source), translation.text, f"{file}: run integrations/freecad/translate")
