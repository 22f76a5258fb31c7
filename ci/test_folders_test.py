#!/usr/bin/python3
"""Tests that CTest runs side by side share no file: each takes its folder from core/test_folder.h.

test_folders_test.py SOURCE_FOLDER
"""

import pathlib
import re
import sys

MODULES = ["core", "render", "eval", "trajectories", "reports", "bench"]
FIXED_NAME = re.compile(r'TempDir\(\)|temp_directory_path|mkdtemp|tmpnam|gettempdir|"/(var/)?tmp')


def main() -> int:
    root = pathlib.Path(sys.argv[1])
    files = [
        path
        for module in MODULES
        for path in sorted((root / module).rglob("*"))
        if path.suffix in {".cpp", ".h", ".py"} and re.search("test|fixture", path.name)
    ]
    if len(files) < 100:
        print(f"{root}: found {len(files)} sources of tests, expected hundreds")
        return 1
    found = [
        f"{path.relative_to(root)}:{number}: {line.strip()}"
        for path in files
        if path != root / "core/test_folder.h"
        for number, line in enumerate(path.read_text().splitlines(), 1)
        if FIXED_NAME.search(line)
    ]
    print("\n".join(found + [f"{len(found)} names in the temporary folder, expected test_folder() of core/test_folder.h"]))
    return 1 if found else 0


sys.exit(main())
