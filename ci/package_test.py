#!/usr/bin/python3
"""Tests that the Debian packages hold a program that works from anywhere. Arguments: CPACK BUILD_DIR SOURCE_DIR."""
import pathlib
import shutil
import subprocess
import sys

cpack, build, source = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]
work = build / "package_test"
shutil.rmtree(work, ignore_errors=True)
work.mkdir()


def said(*command, **options):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=True, **options).stdout


subprocess.run([cpack, "--config", build / "CPackConfig.cmake", "-B", work], check=True, stdout=subprocess.DEVNULL)
packages = {said("dpkg-deb", "--field", file, "Package").strip(): file for file in work.glob("*.deb")}
assert set(packages) == {"glovebench", "libglovebench-dev"}, packages
files = {}
for name, file in packages.items():
    root = work / name
    subprocess.run(["dpkg-deb", "--extract", file, root], check=True)
    files[name] = {path.relative_to(root) for path in root.rglob("*") if path.is_file()}
    for path in files[name]:
        for folder in (source, str(build)):
            assert folder.encode() not in (root / path).read_bytes(), f"{name}: {path} names {folder}"
both = files["glovebench"] & files["libglovebench-dev"]
assert not both, f"dpkg refuses two packages with one file: {both}"
assert "libopencv-core" in said("dpkg-deb", "--field", packages["glovebench"], "Depends")

usr = work / "glovebench" / "usr"
for place in ("share/man/man1/glovebench.1", "share/bash-completion/completions/glovebench",
              "share/zsh/vendor-completions/_glovebench", "share/fish/vendor_completions.d/glovebench.fish",
              "share/doc/glovebench/copyright"):
    assert (usr / place).stat().st_size > 0, f"{place}: found nothing"
environment = {"PATH": "/usr/bin:/bin", "HOME": str(work)}
for arguments in (["list", "suites"], ["list", "trajectories"]):
    installed = said(usr / "bin/glovebench", *arguments, cwd="/", env=environment)
    assert installed and installed == said(build / "bin/glovebench", *arguments), installed
assert (work / "libglovebench-dev/usr/lib/cmake/glovebench/glovebenchConfig.cmake").is_file()
shutil.rmtree(work)
