"""The published schema accepts what the program writes and nothing that differs from it.

Usage: schema_test.py EXAMPLE_PROGRAM. Needs the Debian package python3-jsonschema.
"""

import copy
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import jsonschema


class SchemaCase:
    """A schema of this folder, and two documents that the example program writes."""

    program = schema = full = small = None

    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([cls.program, folder], check=True, stdout=subprocess.DEVNULL)
            cls.full = json.loads(pathlib.Path(folder, cls.full).read_text())
            cls.small = json.loads(pathlib.Path(folder, cls.small).read_text())
        schema = json.loads((pathlib.Path(__file__).parent / cls.schema).read_text())
        jsonschema.Draft202012Validator.check_schema(schema)
        cls.validator = jsonschema.Draft202012Validator(schema)

    def expect_accepted(self):
        for document in (self.full, self.small):
            self.assertEqual([e.message for e in self.validator.iter_errors(document)], [])

    def expect_refused(self, document, changes):
        for name, change in changes.items():
            with self.subTest(name):
                changed = copy.deepcopy(document)
                change(changed)
                self.assertFalse(self.validator.is_valid(changed))


class SchemaTest(SchemaCase, unittest.TestCase):
    schema = "results.schema.json"
    full = "results.json"
    small = "small/results.json"

    def test_accepts_written_results(self):
        self.expect_accepted()

    def test_refuses_changed_results(self):
        def frame(r):
            return r["experiments"][0]["runs"][0]["frames"][0]

        changes = {
            "another version": lambda r: r.update(version=1),
            "unknown key": lambda r: r.update(extra=1),
            "missing key": lambda r: r["experiments"][0].pop("coverage"),
            "text for the hashes": lambda r: r.update(inputs="0a"),
            "unknown truth": lambda r: r["experiments"][0].update(truth="guessed"),
            "unknown status": lambda r: frame(r).__setitem__(2, "fine"),
            "text for an error": lambda r: frame(r).__setitem__(9, "3 mm"),
            "no whole frame": lambda r: frame(r).__delitem__(slice(8, None)),
            "share over one": lambda r: r["experiments"][0]["coverage"].update(share=1.5),
            "metric without a unit": lambda r: r["protocol"]["metric_keys"].append("error"),
            "a rule of coverage left out": lambda r: r["protocol"]["coverage_rules"].pop("usable_fingertips_mm"),
            "a share of usable frames over one": lambda r: r["experiments"][0]["coverage"].update(usable_share=1.5),
            "other columns": lambda r: r["frame_columns"].reverse(),
        }
        self.expect_refused(self.small, changes)

    def test_refuses_changed_studies(self):
        def table(r):
            return r["studies"][1]["tables"][0]

        # Few frames: validating those of the whole example takes a second each time.
        studies = {**self.small, "studies": self.full["studies"]}
        self.assertTrue(self.validator.is_valid(studies))

        changes = {
            "no list": lambda r: r.update(studies=None),
            "unknown key": lambda r: r["studies"][0].update(extra=1),
            "missing key": lambda r: table(r).pop("name_columns"),
            "name that leads out": lambda r: table(r).update(name="../figure8"),
            "a time's mark": lambda r: table(r)["columns"][0].update(is_time=True),
            "cell of another kind": lambda r: table(r)["rows"][0].__setitem__(5, True),
            "too many digits": lambda r: table(r)["columns"][5].update(digits=7),
            "text for a value": lambda r: r["studies"][1]["measures"][0].update(value="1"),
        }
        self.expect_refused(studies, changes)


if __name__ == "__main__":
    SchemaTest.program = sys.argv.pop(1)
    unittest.main()
