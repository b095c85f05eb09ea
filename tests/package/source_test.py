#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The source distribution: every file of the commit, the same bytes when made again, a description without dead links; and what is missing for a
build is said all at once. Nothing is compiled; tests/package/release_test.sh builds from it.
"""
import os
import re
import subprocess
import sys
import tarfile
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SKIPPED = 77
faults = []


def want(holds, what):
    if not holds:
        faults.append(what)


def run(*command, **options):
    return subprocess.run([str(word) for word in command], check=False, capture_output=True, text=True, **options)


def archive(folder):
    made = run("/usr/bin/python3", "-c", f"import setuptools.build_meta as b; b.build_sdist({str(folder)!r})", cwd=ROOT / "tools/python",
               env=os.environ | {"SOURCE_DATE_EPOCH": "1700000000"})
    if made.returncode:
        sys.exit(made.stdout + made.stderr)
    return next(folder.glob("*.tar.gz"))


def packages_of(said):
    """What is to be installed, by a message."""
    return set(re.search(r"apt-get install --no-install-recommends (.*)", said + "\napt-get install --no-install-recommends ")[1].split())


def main():
    if run("/usr/bin/python3", "-c", "import setuptools, wheel").returncode:
        print("SKIPPED: python3-setuptools and python3-wheel are not installed")
        sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory() as directory:
        work = Path(directory)
        for name in ("first", "second"):
            (work / name).mkdir()
        made = archive(work / "first")
        want(made.read_bytes() == archive(work / "second").read_bytes(), "made twice, it has other bytes")
        with tarfile.open(made) as tar:
            tar.extractall(work)
        source = work / made.name[:-7]
        inside = {str(path.relative_to(source)) for path in source.rglob("*") if path.is_file()}
        tracked = set(run("git", "-C", ROOT, "ls-files").stdout.splitlines())
        if tracked:
            want(inside == tracked | {"setup.py", "pyproject.toml", "PKG-INFO"}, f"files: {sorted(inside ^ tracked)}")
        want(not re.search(r"\]\((?!https?://)", (source / "PKG-INFO").read_text(encoding="utf-8")), "its description has relative links")

        # From the unpacked archive alone: first without any tool, then without libraries.
        (work / "bin").mkdir()
        (work / "bin" / "python3").symlink_to("/usr/bin/python3")
        said = run("/usr/bin/python3", "-c", "import setuptools.build_meta as b; b.prepare_metadata_for_build_wheel('.')", cwd=source,
                   env={"PATH": str(work / "bin")})
        table = (source / "tools/package/linked-libraries.cmake").read_text(encoding="utf-8")
        known = {package for row in re.findall(r'^  "[^|"]*\|[^|]*\|([^|"]+)\|', table, re.M) for package in row.split()} - {"libcli11-dev"}
        known = {re.sub(r"\[.*\]\*", "", package) for package in known}
        want(len(known) > 12, f"the table has {sorted(known)}")
        want(said.returncode and packages_of(said.stderr) == known | {"cmake", "g++", "pkg-config", "ninja-build"},
             f"without tools is said: {said.stdout}{said.stderr}")
        hidden = [f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=ON" for name in ("Boost", "Eigen3", "GSL", "nlohmann_json", "fmt", "SQLite3", "GeographicLib", "pybind11")]
        said = run("cmake", "-S", source / "tools/python/needs", "-B", work / "needs", *hidden, env=os.environ | {"PKG_CONFIG_LIBDIR": "/nonexistent"})
        want(said.returncode and known - {"python3-dev", "python3-numpy"} <= packages_of(said.stderr), f"without libraries is said: {said.stderr}")
    for fault in faults:
        print("FAULT:", fault, file=sys.stderr)
    if not faults:
        print(f"{len(inside)} files, and {len(known)} packages that are named where they are missing")
    sys.exit(bool(faults))


main()
