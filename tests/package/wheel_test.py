#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""tools/package/wheel.py finds the least manylinux_2_N of libraries whose needs are known, and every way in which a wheel is unfit for an index.

The wheels are small ones, of libraries that are compiled here.
"""
import json
import re
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[2] / "tools" / "package"
sys.path.insert(0, str(PACKAGE))
import wheel  # noqa: E402

INFO = "earthtop-1.0.0.dist-info"
METADATA = b"Metadata-Version: 2.1\nName: earthtop\nVersion: 1.0.0\n\nSee [what](https://example.org/x) and [this.\n"
LISTED = json.dumps({"packages": [{"SPDXID": "SPDXRef-a", "name": "liba.a", "externalRefs": [{"referenceLocator": "pkg:deb/debian/libc6@1?arch=amd64"}]},
                                  {"SPDXID": "SPDXRef-b", "name": "libb.so"}],
                     "relationships": [{"relatedSpdxElement": "SPDXRef-a", "relationshipType": "STATIC_LINK"},
                                       {"relatedSpdxElement": "SPDXRef-b", "relationshipType": "DYNAMIC_LINK"}]}).encode()
NEEDING = {  # sources, and the N that they need: the releases in which the C library got its present memcpy, pthread_once and hypot
    "int f(int x) { return x + 1; }": 5,
    "#include <string.h>\nvoid* f(void* a, void* b, size_t n) { return memcpy(a, b, n); }": 14,
    "#include <pthread.h>\nint f(pthread_once_t* o, void (*g)(void)) { return pthread_once(o, g); }": 34,
    "#include <math.h>\ndouble f(double x, double y) { return hypot(x, y); }": 35,
    "#include <condition_variable>\nvoid f(std::condition_variable& c, std::unique_lock<std::mutex>& l) { c.wait(l); }": 35,  # GCC 12's
}
faults = []


def compiled(folder, source, *options):
    is_cxx = "std::" in source
    path = Path(folder, "source.cpp" if is_cxx else "source.c")
    path.write_text(source, encoding="utf-8")
    subprocess.run(["g++" if is_cxx else "gcc", "-O2", "-fno-builtin", "-shared", "-fPIC", path, "-o", Path(folder, "_core.so"), *options, "-lm"], check=True)
    return Path(folder, "_core.so").read_bytes()


def written(folder, name, files):
    path = Path(folder, name)
    with zipfile.ZipFile(path, "w") as archive:
        for entry, data in files.items():
            archive.writestr(entry, data)
    return str(path)


def unmade(folder, library):
    """A wheel as setuptools makes it."""
    files = {"earthtop/_core.so": library, "earthtop/LICENSE": b"GPL", "earthtop/earthtop.spdx.json": LISTED, f"{INFO}/METADATA": METADATA,
             f"{INFO}/WHEEL": b"Wheel-Version: 1.0\nTag: cp311-cp311-linux_x86_64\n", f"{INFO}/RECORD": b""}
    return written(folder, "earthtop-1.0.0-cp311-cp311-linux_x86_64.whl", files)


def refused(what, sentence, folder, name, files):
    """The check of these files has to say the sentence; RECORD is made to fit, so that nothing else is wrong."""
    if f"{INFO}/RECORD" in files and "RECORD" not in what:
        files = {entry: data for entry, data in files.items() if entry != f"{INFO}/RECORD"}
        files[f"{INFO}/RECORD"] = wheel.record(files, INFO)
    try:
        faults.append(f"{what}: not refused, but {wheel.check(written(folder, name, files))}")
    except wheel.Unfit as unfit:
        if not re.search(sentence, str(unfit)):
            faults.append(f"{what}: said is: {unfit}")


def main():
    with tempfile.TemporaryDirectory() as directory:
        for source, least in NEEDING.items():
            made = wheel.make(unmade(directory, compiled(directory, source)), directory, [])
            if not made.endswith(f"-cp311-cp311-manylinux_2_{least}_x86_64.whl") or f"glibc 2.{least} " not in wheel.check(made):
                faults.append(f"2.{least} expected, made is {made}")
        good = Path(made).name
        files = wheel.read(made)[0]
        twice = wheel.make(unmade(directory, compiled(directory, source)), directory, [])
        with zipfile.ZipFile(twice) as archive:
            if f"{INFO}/licenses/liba.a.txt" not in archive.namelist() or f"{INFO}/licenses/common-licenses/LGPL-2.1" not in archive.namelist():
                faults.append(f"licences: {archive.namelist()}")
        refused("a tag too low", r"promises that 2\.34 is enough, but it needs 2\.35: .*condition_variable.*GLIBCXX_3\.4\.30", directory,
                good.replace("_2_35_", "_2_34_"), files)
        refused("a tag too high", r"demands 2\.36, but 2\.35 is enough", directory, good.replace("_2_35_", "_2_36_"), files)
        refused("no manylinux", "none of manylinux", directory, good.replace("manylinux_2_35", "linux"), files)
        refused("another tag inside", "another tag than its name", directory, good, files | {f"{INFO}/WHEEL": b"Tag: cp311-cp311-linux_x86_64\n"})
        refused("no licence of a library", r"liba\.a is inside without its licence text", directory, good,
                {name: data for name, data in files.items() if not name.endswith("/liba.a.txt")})
        refused("an empty licence", r"liba\.a is inside without", directory, good, files | {f"{INFO}/licenses/liba.a.txt": b"\n"})
        refused("no licence of its own", "its own licence text is missing", directory, good,
                {name: data for name, data in files.items() if not name.endswith("licenses/LICENSE")})
        refused("no licence that another one refers to", r"refers to the licence LGPL-2\.1, which is not inside", directory, good,
                {name: data for name, data in files.items() if not name.endswith("/LGPL-2.1")})
        refused("no list", "no list of what is linked", directory, good, {name: data for name, data in files.items() if not name.endswith(".json")})
        refused("a relative link", r"relative link \.\./README\.md", directory, good, files | {f"{INFO}/METADATA": METADATA + b"[a](../README.md)\n"})
        refused("a link into the page", "relative link #x", directory, good, files | {f"{INFO}/METADATA": METADATA + b"[a](#x)\n"})
        refused("RECORD", "RECORD does not fit", directory, good, files | {"earthtop/more.py": b""})
        outside = compiled(directory, "int sqlite3_libversion_number(void); int f(void) { return sqlite3_libversion_number(); }", "-lsqlite3")
        refused("an outside library", r"_core\.so loads lib\S+, which not every Linux has", directory, good, files | {"earthtop/_core.so": outside})
        placed = compiled(directory, source, "-Wl,-rpath,/opt/lib")
        refused("a place of its own", "looks for libraries in /opt/lib", directory, good, files | {"earthtop/_core.so": placed})
        inside = compiled(directory, source, "-Wl,-rpath,$ORIGIN/../earthtop.libs")
        if wheel.libraries({"earthtop/_core.so": inside})[0] != 35:
            faults.append("a place beside the library is refused")
    for fault in faults:
        print("FAULT:", fault, file=sys.stderr)
    if not faults:
        print(f"{len(NEEDING)} libraries have the tag they need, and every unfit wheel is refused")
    sys.exit(bool(faults))


main()
