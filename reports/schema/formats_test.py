"""What other programs read is read by them, or by what they document.

Usage: formats_test.py EXAMPLE_PROGRAM. Needs the Debian packages python3-jsonschema, python3-junitparser and
python3-pylatexenc.

JUnit XML goes through junitparser, LaTeX through pylatexenc's parser. Bencher publishes a JSON schema of its metric
format (https://bencher.dev/docs/reference/bencher-metric-format), github-action-benchmark a list of fields in its
README; neither is in Debian or npm, so both are stated here in our words.
"""

import csv
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import jsonschema
import junitparser
from pylatexenc.latexwalker import LatexCommentNode, LatexEnvironmentNode, LatexWalker

BENCHER_SCHEMA = {
    "type": "object",
    "additionalProperties": {
        "type": "object",
        "additionalProperties": {
            "type": "object",
            "properties": {name: {"type": "number"} for name in ("value", "lower_value", "upper_value")},
            "required": ["value"],
            "additionalProperties": False,
        },
    },
}
GITHUB_ACTION_BENCHMARK_SCHEMA = {
    "type": "array",
    "minItems": 1,
    "items": {
        "type": "object",
        "properties": {
            "name": {"type": "string", "minLength": 1},
            "unit": {"type": "string"},
            "value": {"type": "number"},
            "range": {"type": "string", "pattern": r"^± \d+\.\d+$"},
            "extra": {"type": "string"},
        },
        "required": ["name", "unit", "value"],
        "additionalProperties": False,
    },
}


class FormatsTest(unittest.TestCase):
    program = None

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        subprocess.run([cls.program, cls.folder], check=True, stdout=subprocess.DEVNULL)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_junit(self):
        comparison = json.loads((self.folder / "comparison" / "comparison.json").read_text())
        suites = list(junitparser.JUnitXml.fromfile(str(self.folder / "comparison" / "junit.xml")))
        cases = [case for suite in suites for case in suite]
        self.assertEqual([suite.name for suite in suites if suite.name != "speed"],
                         list(dict.fromkeys(row["experiment"] for row in comparison["rows"])))
        self.assertEqual(len(cases), len(comparison["rows"]) + len(comparison["speed"]))
        for row, case in zip(comparison["rows"], cases):
            self.assertEqual((case.name, case.classname), (row["quantity"], "glovebench." + row["experiment"]))
            outcome = [type(result) for result in case.result]
            skips = not row["stops"] and row["verdict"] == "not enough data"
            self.assertEqual(outcome, [junitparser.Failure] if row["stops"] else [junitparser.Skipped] * skips)
            self.assertIn(f"{row['pairs']} of {row['frames']} frames", case.system_out)

    def test_junit_counts_are_those_of_its_cases(self):
        for name in ("junit.xml", "small/junit.xml", "incomparable.xml"):
            xml = junitparser.JUnitXml.fromfile(str(self.folder / "comparison" / name))
            said = (xml.tests, xml.failures, xml.errors, xml.skipped)
            xml.update_statistics()
            self.assertEqual((xml.tests, xml.failures, xml.errors, xml.skipped), said)

    def test_junit_error(self):
        (suite,) = junitparser.JUnitXml.fromfile(str(self.folder / "comparison" / "incomparable.xml"))
        (case,) = suite
        self.assertIsInstance(case.result[0], junitparser.Error)
        self.assertEqual(case.result[0].message, "a.json: seeds: found <1>\n\ufffd")

    def test_bencher(self):
        for folder in (self.folder, self.folder / "small"):
            benchmarks = json.loads((folder / "histories" / "bencher.json").read_text())
            jsonschema.validate(benchmarks, BENCHER_SCHEMA)
            for name, measures in benchmarks.items():
                self.assertLessEqual(len(name), 1024)
                for measure, metric in measures.items():
                    self.assertLessEqual(len(measure), 64)
                    if "lower_value" in metric:
                        self.assertLessEqual(metric["lower_value"], metric["value"])
                        self.assertLessEqual(metric["value"], metric["upper_value"])

    def test_github_action_benchmark(self):
        for folder in (self.folder, self.folder / "small"):
            entries = json.loads((folder / "histories" / "github_action_benchmark.json").read_text())
            jsonschema.validate(entries, GITHUB_ACTION_BENCHMARK_SCHEMA)
            self.assertEqual(len({entry["name"] for entry in entries}), len(entries))

    def test_csv(self):
        for name in ("comparison/comparison.csv", "tables/figure4.csv", "tables/figure7.csv", "tables/figure8.csv",
                     "tables/claims.csv", "tables/metrics.csv", "tables/figure5.csv", "tables/commands.csv", "own/tables/errors.csv"):
            with (self.folder / name).open(newline="") as file:
                rows = list(csv.reader(file, strict=True))
            self.assertGreater(len(rows), 1)
            self.assertIn("run", rows[0][0])
            self.assertEqual({len(row) for row in rows}, {len(rows[0])})

    def test_latex(self):
        for name in ("comparison/comparison.tex", "tables/figure4.tex", "small/tables/figure4.tex",
                     "own/tables/errors.tex"):
            text = (self.folder / name).read_text()
            nodes, _, length = LatexWalker(text, tolerant_parsing=False).get_latex_nodes()
            self.assertEqual(length, len(text))
            self.assertIsInstance(nodes[0], LatexCommentNode)
            (tabular,) = [node for node in nodes if isinstance(node, LatexEnvironmentNode)]
            self.assertEqual(tabular.environmentname, "tabular")
            # Every row has the columns that the tabular announces; \multicolumn has several at once.
            columns = len(re.search(r"\\begin\{tabular\}\{([lr]+)\}", text)[1])
            for row in re.findall(r"^(.*) \\\\$", text, re.MULTILINE):
                spanned = sum(int(n) - 1 for n in re.findall(r"\\multicolumn\{(\d+)\}", row))
                self.assertEqual(len(re.findall(r"(?<!\\)&", row)) + 1 + spanned, columns, row)


if __name__ == "__main__":
    FormatsTest.program = sys.argv.pop(1)
    unittest.main()
