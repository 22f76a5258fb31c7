#!/usr/bin/python3
"""Runs the commands of a guide as a reader would: guide_test.py PROGRAM GUIDE.md

The indented blocks of the page run one after the other in one shell, in a folder that holds only `eval/external`, with
PROGRAM as `glovebench`.
Each must end with exit code 0. So must those of a GitHub workflow that the page links to, with the page's files; what
it compares must have one configuration.
"""
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile


def commands_of(page):
    """The lines of indented blocks, without their indentation."""
    lines = page.read_text().splitlines()
    return [line[4:] for line in lines if line.startswith("    ")]


def workflow_commands(page):
    """The commands of linked workflows, after their variables."""
    commands = []
    for link in re.findall(r"\]\(([^)]+\.yml)\)", page.read_text()):
        workflow = (page.parent / link).read_text()
        commands += [f"export {name}={value}" for name, value in re.findall(r"^      ([A-Z]+): (\S+)$", workflow, re.M)]
        commands += re.findall(r"run: \S*/(glovebench .*)$", workflow, re.M)
    return commands


def main():
    program, page = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    commands = commands_of(page)
    if not any(line.startswith("glovebench ") for line in commands):
        sys.exit(f"{page}: found no command, expected an indented line that begins with glovebench")
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "eval").mkdir()
        (pathlib.Path(folder) / "eval/external").symlink_to(page.resolve().parent.parent / "external")
        search_path = f"{program.parent}{os.pathsep}{os.environ['PATH']}"
        shell = subprocess.Popen(["bash", "-e", "-o", "pipefail", "-c", "\n".join(commands + workflow_commands(page))],
                                 cwd=folder,
                                 env={**os.environ, "PATH": search_path}, stdin=subprocess.DEVNULL,
                                 start_new_session=True)
        status = shell.wait()
        try:  # what a failing page left in the background
            os.killpg(shell.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        for file in pathlib.Path(folder).glob("*/comparison.json"):
            if changes := json.loads(file.read_text())["configuration_changes"]:
                sys.exit(f"{page}: workflow: found {changes}, expected one configuration")
    sys.exit(f"{page}: found exit code {status}, expected 0" if status else 0)


if __name__ == "__main__":
    main()
