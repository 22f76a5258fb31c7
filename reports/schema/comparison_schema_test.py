"""The published schema accepts the comparisons that the program writes and nothing that differs from them.

Usage: comparison_schema_test.py EXAMPLE_PROGRAM. Needs the Debian package python3-jsonschema.
"""

import sys
import unittest

sys.dont_write_bytecode = True  # beside the sources
from schema_test import SchemaCase


class ComparisonSchemaTest(SchemaCase, unittest.TestCase):
    schema = "comparison.schema.json"
    full = "comparison/comparison.json"
    small = "comparison/small/comparison.json"

    def test_accepts_written_comparisons(self):
        self.expect_accepted()

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
        self.expect_refused(self.small, changes)


if __name__ == "__main__":
    ComparisonSchemaTest.program = sys.argv.pop(1)
    unittest.main()
