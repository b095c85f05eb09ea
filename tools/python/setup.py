# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the wheel. CMake compiles the extension and installs the whole package into the place that the wheel is made of.

The libraries are those of an installed earthtop, which CMake looks for (CMAKE_PREFIX_PATH), or are compiled from the source
tree. If the environment variable EARTHTOP_BUILD names a build directory of the source tree, its libraries are taken.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = Path(__file__).resolve().parent
ROOT = SOURCE.parent.parent
BUILD = ROOT / "build" / "python"


def version() -> str:
    """The version of the whole project, which is written in one place."""
    found = re.search(r"^project\(earthtop VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"), re.M)
    if not found:
        raise SystemExit(f"{ROOT / 'CMakeLists.txt'} states no version")
    return found[1]


def cmake(*arguments: object) -> None:
    subprocess.run(["cmake", *map(str, arguments)], check=True)


def needs() -> list:
    """What the package needs to run, by the pybind11 that its extension is built with."""
    work = BUILD / "needs"
    cmake("--fresh", "-S", SOURCE / "needs", "-B", work, f"-DPython_EXECUTABLE={sys.executable}")
    return (work / "needs.txt").read_text(encoding="utf-8").splitlines()


class BuildByCMake(build_ext):
    """Installs CMake's component `python` where setuptools collects the files of the wheel."""

    def run(self) -> None:
        parallel = ["--parallel"] if "CMAKE_BUILD_PARALLEL_LEVEL" in os.environ else ["--parallel", os.cpu_count() or 1]
        options = ["-DCMAKE_BUILD_TYPE=Release", f"-DPython_EXECUTABLE={sys.executable}", "-DEARTHTOP_PYTHON_DIR=.",
                   "-DEARTHTOP_UNITY=ON", "-DEARTHTOP_MPI=OFF", "-DEARTHTOP_SUNDIALS=OFF"]
        if shutil.which("ninja") and "CMAKE_GENERATOR" not in os.environ:
            options += ["-G", "Ninja"]
        given = os.environ.get("EARTHTOP_BUILD")
        if given:
            installed = BUILD / "installed"
            cmake("--build", Path(given).resolve(), *parallel, "--target", "earthtop", "earthtop-workbench")
            shutil.rmtree(installed, ignore_errors=True)
            cmake("--install", Path(given).resolve(), "--component", "development", "--prefix", installed)
            options += [f"-DCMAKE_PREFIX_PATH={installed}", "-DCMAKE_REQUIRE_FIND_PACKAGE_earthtop=ON"]
        work = BUILD / "extension"
        cmake("--fresh", "-S", SOURCE, "-B", work, *options)  # fresh: whatever was found by an earlier call is looked for anew
        cmake("--build", work, *parallel, "--target", "earthtop-python", "earthtop-python-list")
        cmake("--install", work, "--component", "python", "--strip", "--prefix", Path(self.build_lib).resolve())
        shutil.copy(ROOT / "LICENSE", Path(self.build_lib) / "earthtop")


# What setuptools writes is kept out of the source tree.
shutil.rmtree(BUILD / "wheel", ignore_errors=True)
(BUILD / "wheel").mkdir(parents=True)
setup(
    version=version(),
    install_requires=needs(),
    packages=[],
    ext_modules=[Extension("earthtop._core", [])],  # its name tells setuptools that the wheel belongs to one Python
    cmdclass={"build_ext": BuildByCMake},
    options={"build": {"build_base": str(BUILD / "wheel")}, "egg_info": {"egg_base": str(BUILD / "wheel")}},
)
