"""The published schema accepts the comparisons that the program writes and nothing that differs from them.

Usage: comparison_schema_test.py EXAMPLE_PROGRAM. Needs the Debian package python3-jsonschema.
"""

import copy
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import jsonschema

SCHEMA = json.loads((pathlib.Path(__file__).parent / "comparison.schema.json").read_text())


class ComparisonSchemaTest(unittest.TestCase):
    program = None

    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([cls.program, folder], check=True, stdout=subprocess.DEVNULL)
            cls.full = json.loads(pathlib.Path(folder, "comparison", "comparison.json").read_text())
            cls.small = json.loads(pathlib.Path(folder, "comparison", "small", "comparison.json").read_text())
        jsonschema.Draft202012Validator.check_schema(SCHEMA)
        cls.validator = jsonschema.Draft202012Validator(SCHEMA)

    def test_accepts_written_comparisons(self):
        for comparison in (self.full, self.small):
            self.assertEqual([e.message for e in self.validator.iter_errors(comparison)], [])

    def test_refuses_changed_comparisons(self):
        changes = {
            "another version": lambda c: c.update(version=2),
            "unknown key": lambda c: c.update(extra=1),
            "missing key": lambda c: c["rows"][0].pop("stops"),
            "unknown verdict": lambda c: c["rows"][0].update(verdict="fine"),
            "quantity without a unit": lambda c: c["rows"][0].update(quantity="error"),
            "text for a difference": lambda c: c["rows"][0].update(difference="3 mm"),
            "negative minimum effect": lambda c: c["rows"][0].update(minimum_effect=-1),
            "text for differences": lambda c: c["frame_differences"][0]["differences"].update(vertex_error_mm="all"),
            "list of uncompared metrics": lambda c: c.update(uncompared_metrics=[]),
            "number for a suite": lambda c: c["baseline"].update(suite=1),
            "text for slower": lambda c: c["speed"][0].update(slower="yes"),
            "family error of one": lambda c: c["method"].update(family_error=1),
        }
        for name, change in changes.items():
            with self.subTest(name):
                comparison = copy.deepcopy(self.small)
                change(comparison)
                self.assertFalse(self.validator.is_valid(comparison))


if __name__ == "__main__":
    ComparisonSchemaTest.program = sys.argv.pop(1)
    unittest.main()
