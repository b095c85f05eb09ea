# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the wheel and the source distribution.

For a wheel CMake compiles the extension and installs the whole package into the place that the wheel is made of. The libraries
are those of an installed earthtop, which CMake looks for (CMAKE_PREFIX_PATH), or are compiled from the source tree. If the
environment variable EARTHTOP_BUILD names a build directory of the source tree, its libraries are taken; CMAKE_ARGS are options
for CMake.

The source distribution is the source tree, with this file and pyproject.toml at its top, where `pip install` looks for them.
"""

import gzip
import os
import re
import shlex
import shutil
import subprocess
import sys
import tarfile
import time
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext
from setuptools.command.sdist import sdist

HERE = Path(__file__).resolve().parent
ROOT = HERE if (HERE / "src").is_dir() else HERE.parent.parent  # the former in an unpacked source distribution
SOURCE = ROOT / "tools" / "python"
BUILD = ROOT / "build" / "python"


def read(name: str) -> str:
    return (ROOT / name).read_text(encoding="utf-8")


def version() -> str:
    """The version of the whole project, which is written in one place."""
    found = re.search(r"^project\(earthtop VERSION ([0-9.]+)", read("CMakeLists.txt"), re.M)
    if not found:
        raise SystemExit(f"{ROOT / 'CMakeLists.txt'} states no version")
    return found[1]


def description() -> str:
    """The manual, without links into the source tree, which lead nowhere from an index of packages."""
    return re.sub(r"(?<!!)\[([^][]+)\]\((?!https?://)[^()\s]+\)", r"\1", read("tools/python/README.md"))


def stop_without_tools() -> None:
    """Without the tools of a build nothing finds out which libraries are missing: so all that is missing is said by the names of Debian's packages."""
    tools = {"cmake": "cmake", os.environ.get("CXX", "c++"): "g++", "pkg-config": "pkg-config", "ninja": "ninja-build"}
    lacking = [tool for tool in tools if not shutil.which(tool) and not (tool == "ninja" and shutil.which("make"))]
    if not lacking:
        return
    table = re.findall(r'^  "([^|"]*)\|[^|]*\|([^|"]+)\|', read("tools/package/linked-libraries.cmake"), re.M)
    packages = [package for target, row in table for package in row.split() if target != "CLI11::CLI11"]  # which is the program's alone
    if shutil.which("dpkg-query"):
        def installed(package: str) -> bool:
            asked = subprocess.run(["dpkg-query", "-W", "-f=${db:Status-Status} ", package], check=False, capture_output=True, text=True)
            return "installed" in asked.stdout.split()
        packages = [package for package in packages if not installed(package)]
    names = dict.fromkeys([tools[tool] for tool in lacking] + [re.sub(r"\[[^]]*\]\*", "", package) for package in packages])
    raise SystemExit(f"Not found: {', '.join(lacking)}, and perhaps libraries. On Debian:\n"
                     f"  apt-get install --no-install-recommends {' '.join(names)}")


def cmake(*arguments: object) -> None:
    if subprocess.run(["cmake", *map(str, arguments)], check=False).returncode:
        raise SystemExit("CMake failed; it says above why.")


def common_options() -> list:
    ninja = ["-G", "Ninja"] if shutil.which("ninja") and "CMAKE_GENERATOR" not in os.environ else []
    return [f"-DPython_EXECUTABLE={sys.executable}", *ninja, *shlex.split(os.environ.get("CMAKE_ARGS", ""))]


def needs() -> list:
    """What the package needs to run, by the pybind11 that its extension is built with."""
    stop_without_tools()
    work = BUILD / "needs"
    cmake("--fresh", "-S", SOURCE / "needs", "-B", work, *common_options())
    return (work / "needs.txt").read_text(encoding="utf-8").splitlines()


class BuildByCMake(build_ext):
    """Installs CMake's component `python` where setuptools collects the files of the wheel."""

    def run(self) -> None:
        parallel = ["--parallel"] if "CMAKE_BUILD_PARALLEL_LEVEL" in os.environ else ["--parallel", os.cpu_count() or 1]
        options = ["-DCMAKE_BUILD_TYPE=Release", "-DEARTHTOP_PYTHON_DIR=.", "-DEARTHTOP_UNITY=ON", "-DEARTHTOP_MPI=OFF",
                   "-DEARTHTOP_SUNDIALS=OFF", *common_options()]
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


class WholeSource(sdist):
    """The files of the commit, or of the source distribution that this is; the same files give the same bytes, with SOURCE_DATE_EPOCH."""

    def run(self) -> None:
        self.run_command("egg_info")
        listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-z"], check=False, capture_output=True).stdout.decode()
        files = set(listed.split("\0")) - {""} or {str(path.relative_to(ROOT)) for path in ROOT.rglob("*") if path.is_file()}
        files = {name for name in files if not name.startswith(("build/", ".git/"))}
        sources = {name: ROOT / name for name in files} | {name: HERE / name for name in ("setup.py", "pyproject.toml")}
        metadata = Path(self.get_finalized_command("egg_info").egg_info, "PKG-INFO")
        sources["PKG-INFO"] = metadata
        name = f"{self.distribution.get_name()}-{self.distribution.get_version()}"
        Path(self.dist_dir).mkdir(parents=True, exist_ok=True)
        archive = Path(self.dist_dir, f"{name}.tar.gz")
        when = int(os.environ.get("SOURCE_DATE_EPOCH", time.time()))
        with open(archive, "wb") as file, gzip.GzipFile("", "wb", 9, file, when) as packed, tarfile.open(fileobj=packed, mode="w") as tar:
            for path, source in sorted(sources.items()):
                entry = tar.gettarinfo(source, f"{name}/{path}")
                entry.mode = 0o755 if entry.mode & 0o100 else 0o644
                entry.mtime, entry.uid, entry.gid, entry.uname, entry.gname = when, 0, 0, "", ""
                with open(source, "rb") as content:
                    tar.addfile(entry, content)
        self.archive_files = [str(archive)]
        self.distribution.dist_files.append(("sdist", "", str(archive)))


# What setuptools writes is kept out of the source tree.
shutil.rmtree(BUILD / "wheel", ignore_errors=True)
(BUILD / "wheel").mkdir(parents=True)
setup(
    version=version(),
    long_description=description(),
    long_description_content_type="text/markdown",
    install_requires=[] if "sdist" in sys.argv else needs(),
    packages=[],
    ext_modules=[Extension("earthtop._core", [])],  # its name tells setuptools that the wheel belongs to one Python
    cmdclass={"build_ext": BuildByCMake, "sdist": WholeSource},
    options={"build": {"build_base": str(BUILD / "wheel")}, "egg_info": {"egg_base": str(BUILD / "wheel")}},
)
