#!/usr/bin/python3
"""Runs the commands of a guide as a reader would: guide_test.py PROGRAM GUIDE.md

The indented blocks of the page run one after the other in one shell, in an empty folder, with PROGRAM as `glovebench`.
Each must end with exit code 0.
"""
import os
import pathlib
import signal
import subprocess
import sys
import tempfile


def commands_of(page):
    """The lines of indented blocks, without their indentation."""
    lines = page.read_text().splitlines()
    return [line[4:] for line in lines if line.startswith("    ")]


def main():
    program, page = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    commands = commands_of(page)
    if not any(line.startswith("glovebench ") for line in commands):
        sys.exit(f"{page}: found no command, expected an indented line that begins with glovebench")
    with tempfile.TemporaryDirectory() as folder:
        search_path = f"{program.parent}{os.pathsep}{os.environ['PATH']}"
        shell = subprocess.Popen(["bash", "-e", "-o", "pipefail", "-c", "\n".join(commands)], cwd=folder,
                                 env={**os.environ, "PATH": search_path}, stdin=subprocess.DEVNULL,
                                 start_new_session=True)
        status = shell.wait()
        try:  # what a failing page left in the background
            os.killpg(shell.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
    sys.exit(f"{page}: found exit code {status}, expected 0" if status else 0)


if __name__ == "__main__":
    main()
