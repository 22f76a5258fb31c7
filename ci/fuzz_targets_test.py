#!/usr/bin/python3
"""Tests that each reader of input is listed in core/README.md, with its largest input and a fuzz target.

fuzz_targets_test.py SOURCE_FOLDER
"""

import pathlib
import re
import sys


def main() -> int:
    root = pathlib.Path(sys.argv[1])
    section = (root / "core/README.md").read_text().split("## Largest inputs")[1].split("\n## ")[0]
    rows = [line.strip("|").split("|") for line in section.splitlines() if line.startswith("|")][2:]
    listed = [target for row in rows for target in re.findall(r"`(\w+)`", row[2])]
    targets = [path.name.removesuffix("_fuzz.cpp")
               for module in ("core", "trajectories", "render", "reports", "eval")
               for path in (root / module).rglob("*_fuzz.cpp")]
    targets += [f"format_{path.name.removesuffix('_format.cpp')}"
                for path in (root / "trajectories/formats").glob("*_format.cpp")]
    faults = [f"core/README.md: {row[0].strip()}: found no fuzz target, expected one" for row in rows if "`" not in row[2]]
    faults += [f"core/README.md: {name}: found no such target" for name in listed if name not in targets]
    faults += [f"target {name}: found {listed.count(name)} times in core/README.md, expected once"
               for name in targets if listed.count(name) != 1]
    faults += [f"ci/corpora/{name}: found nothing, expected inputs to start from"
               for name in targets if not any((root / "ci/corpora" / name).glob("*"))]
    faults += [f"ci/corpora/{folder.name}: found no such target"
               for folder in (root / "ci/corpora").iterdir() if folder.name not in targets]
    print("\n".join(faults + [f"{len(rows)} inputs, {len(targets)} targets, {len(faults)} faults"]))
    return 1 if faults or not rows else 0


sys.exit(main())
