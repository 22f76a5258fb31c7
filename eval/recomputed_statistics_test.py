"""Aggregates of experiments and Student's intervals over movements, computed again from the frames of a run.

Usage: recomputed_statistics_test.py GLOVEBENCH. Shares nothing with the program.
"""

import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

# Files have six decimals: a mean of rounded numbers and a rounded mean differ by at most this.
TOLERANCE = 1e-6
MOVEMENTS, FRAMES = 5, 10
SUITE = {"format": "glovebench-suite", "version": 1, "name": "recomputed", "description": "for a test", "seeds": [1, 2],
         "experiments": [{"family": family, "movements": {"first": 11, "count": MOVEMENTS},
                          "subjects": {"first": 3, "count": MOVEMENTS}, "frames": {"first": 0, "count": FRAMES},
                          "databases": ["DB_open_power"]} for family in ("above", "border")]}


def mean(values):
    return math.fsum(values) / len(values)


def percentile(values, share):
    values = sorted(values)
    rank = share * (len(values) - 1)
    low = math.floor(rank)
    high = min(low + 1, len(values) - 1)
    return values[low] + (rank - low) * (values[high] - values[low])


def student_quantile(level, degrees):
    """By bisection of the distribution, which Simpson's rule integrates."""
    scale = math.exp(math.lgamma((degrees + 1) / 2) - math.lgamma(degrees / 2)) / math.sqrt(degrees * math.pi)

    def within(t, steps=2000):
        width = t / steps
        heights = [(1 + (i * width) ** 2 / degrees) ** (-(degrees + 1) / 2) for i in range(steps + 1)]
        return 2 * scale * width / 3 * (heights[0] + heights[-1] + 4 * sum(heights[1:-1:2]) + 2 * sum(heights[2:-1:2]))

    low, high = 0, 1000
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if within(middle) < level else (low, middle)
    return low


class RecomputedStatistics(unittest.TestCase):
    program = None

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        suite = pathlib.Path(cls.folder.name) / "recomputed.json"
        suite.write_text(json.dumps(SUITE))
        out = pathlib.Path(cls.folder.name) / "out"
        subprocess.run([cls.program, "run", "--suite", suite, "--quiet", "--output", out], check=True,
                       stderr=subprocess.DEVNULL)  # a hand at the border may get lost
        cls.results = json.loads((out / "results.json").read_text())
        with (out / "tables/families.csv").open(newline="") as file:
            cls.families = list(csv.DictReader(file))

    def frames_of(self, experiment):
        for run in experiment["runs"]:
            for frame in run["frames"]:
                yield dict(zip(self.results["frame_columns"], frame))

    def values_of(self, experiment, key):
        return [frame[key] for frame in self.frames_of(experiment) if frame[key] is not None]

    def test_aggregates(self):
        checked = 0
        for experiment in self.results["experiments"]:
            for key, aggregate in experiment["aggregates"].items():
                if key not in self.results["frame_columns"]:
                    continue
                values = self.values_of(experiment, key)
                self.assertEqual(len(values), aggregate["count"], key)
                if not values:
                    continue
                expected = {"mean": mean(values), "median": percentile(values, 0.5), "p95": percentile(values, 0.95),
                            "rms": math.sqrt(mean([value * value for value in values])), "max": max(values)}
                for name, value in expected.items():
                    self.assertAlmostEqual(aggregate[name], value, delta=TOLERANCE, msg=f"{key} {name}")
                checked += 1
        self.assertGreater(checked, 10 * 2 * MOVEMENTS)

    def test_intervals_over_movements(self):
        quantile = student_quantile(0.95, MOVEMENTS - 1)
        self.assertAlmostEqual(quantile, 2.776445, delta=1e-6, msg="as tables of Student's t have it")
        for row in self.families:
            of_family = [experiment for experiment in self.results["experiments"]
                         if experiment["trajectory"].startswith(row["family"] + "_")]
            self.assertEqual(len(of_family), MOVEMENTS)
            for key in ("position_error_mm", "rotation_error_deg", "posture_rms_deg", "fingertip_error_mm"):
                means = [mean(values) for values in (self.values_of(each, key) for each in of_family) if values]
                if len(means) < MOVEMENTS:
                    continue
                middle = mean(means)
                spread = math.sqrt(math.fsum((value - middle) ** 2 for value in means) / (MOVEMENTS - 1))
                half = quantile * spread / math.sqrt(MOVEMENTS)
                for column, value in ((key, middle), (key + "_low", middle - half), (key + "_high", middle + half)):
                    self.assertAlmostEqual(float(row[column]), value, delta=3 * TOLERANCE, msg=f"{row['family']} {column}")

    def test_shares_of_visible_frames(self):
        for experiment in self.results["experiments"]:
            frames = list(self.frames_of(experiment))
            visible = [frame for frame in frames if frame["visible_percent"] >= 30]
            coverage = experiment["coverage"]
            self.assertEqual(coverage["frames"], 2 * FRAMES)
            self.assertEqual(coverage["visible"], len(visible))
            usable = [frame for frame in visible if frame["status"] == "tracked" and frame["position_error_mm"] <= 10
                      and frame["rotation_error_deg"] <= 10 and frame["fingertip_error_mm"] <= 20]
            self.assertEqual(coverage["usable"], len(usable), experiment["trajectory"])


if __name__ == "__main__":
    RecomputedStatistics.program = sys.argv.pop(1)
    unittest.main()
