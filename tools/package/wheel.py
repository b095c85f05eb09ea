#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes of a wheel one that may go to an index of packages, or checks that it may.

    wheel.py make WHEEL FOLDER [ROOT...]     adds the licence texts of what is inside (found by licences.py), and the tag manylinux_2_N
    wheel.py check WHEEL...                  what a wheel for an index must be; says N, and what decides it

N is the least release 2.N of the C library with which every usual Linux has what the wheel needs (PEP 600): by the versions of the symbols
that it takes from the C library and from those of the compiler. Libraries beside these must be inside. The same wheel gives the same bytes,
with SOURCE_DATE_EPOCH.
"""
import base64
import csv
import hashlib
import io
import json
import os
import re
import subprocess
import sys
import tempfile
import time
import zipfile
from email.parser import Parser
from pathlib import Path

import licences

# The libraries that PEP 600 lets a wheel take from the machine, as far as an extension in C++ may need them.
PROMISED = {"libc.so.6", "libm.so.6", "libpthread.so.0", "libdl.so.2", "librt.so.1", "libgcc_s.so.1", "libstdc++.so.6", "ld-linux-x86-64.so.2"}
# The compiler's libraries, by the versions of their symbols: from which 2.N on the usual systems have them. These are the releases of the C
# library in the first distributions with GCC 7, 9, 10, 11, 12, 13 and 14.
COMPILER = {
    "GLIBCXX": {"3.4.24": 27, "3.4.26": 31, "3.4.28": 31, "3.4.29": 34, "3.4.30": 35, "3.4.32": 38, "3.4.33": 39},
    "CXXABI": {"1.3.11": 27, "1.3.12": 31, "1.3.13": 34, "1.3.14": 38, "1.3.15": 39},
    "GCC": {"7.0.0": 27, "12.0.0": 35, "13.0.0": 38, "14.0.0": 39},
}


class Unfit(Exception):
    """What a wheel is not fit for an index for."""


def number(version: str) -> tuple:
    return tuple(int(part) for part in version.split("."))


def release(library: str, version: str) -> int:
    """The N from which on the usual systems have this version of the symbols of a library."""
    if (library, version) == ("GLIBC", "ABI_DT_RELR"):
        return 36
    if not re.fullmatch(r"[0-9]+(\.[0-9]+)*", version):
        raise Unfit(f"it needs {library}_{version}, of which is not known who has it")
    if library == "GLIBC":
        return max(number(version)[1], 5)
    for known, least in COMPILER[library].items():
        if number(version) <= number(known):
            return least
    raise Unfit(f"it needs {library}_{version}, of which is not known who has it")


def needs(path: Path) -> tuple:
    """Of a shared library: N, the symbols that decide it, the libraries that it loads, and where it looks for them."""
    def output(*options: str) -> str:
        return subprocess.run(["objdump", *options, path], check=True, capture_output=True, text=True).stdout
    least, deciding = 5, []
    wanted = re.findall(r"\*UND\*\s+[0-9a-f]+\s+\(?([A-Z]+)_([A-Za-z0-9_.]+)\)?\s+(\S+)$", output("-T"), re.M)
    headers = output("-p")
    wanted += [(library, version, "") for library, version in re.findall(r"^\s+0x\S+ 0x\S+ \d+ ([A-Z]+)_(\S+)$", headers, re.M)]
    for library, version, symbol in wanted:
        if library in {"GLIBC", *COMPILER}:
            this = release(library, version)
            if this > least:
                least, deciding = this, []
            if this == least and symbol:
                deciding.append(f"{symbol}@{library}_{version}")
    return least, sorted(set(deciding)), re.findall(r"NEEDED\s+(\S+)", headers), re.findall(r"(?:RPATH|RUNPATH)\s+(\S+)", headers)


def libraries(files: dict) -> tuple:
    """Of all shared libraries in a wheel: N, and the symbols that decide it. A library that is not inside and not promised is an error."""
    least, deciding = 5, []
    inside = {name.rsplit("/", 1)[-1] for name in files if ".so" in name}
    with tempfile.TemporaryDirectory() as directory:
        for name, data in files.items():
            if data[:4] != b"\x7fELF":
                continue
            path = Path(directory, "library")
            path.write_bytes(data)
            this, symbols, loaded, places = needs(path)
            for library in loaded:
                if library not in PROMISED | inside:
                    raise Unfit(f"{name} loads {library}, which not every Linux has")
            for place in places:
                if not all(part == "$ORIGIN" or part.startswith("$ORIGIN/") for part in place.split(":")):
                    raise Unfit(f"{name} looks for libraries in {place}")
            if this >= least:
                least, deciding = this, symbols + (deciding if this == least else [])
    return least, deciding


def read(wheel: str) -> tuple:
    """The files of a wheel by their names, the modes of those that may be executed, and the folder of its metadata."""
    with zipfile.ZipFile(wheel) as archive:
        files = {entry.filename: archive.read(entry) for entry in archive.infolist() if not entry.is_dir()}
        modes = {entry.filename: 0o755 if entry.external_attr >> 16 & 0o100 else 0o644 for entry in archive.infolist()}
    info = next(name.split("/")[0] for name in files if name.endswith(".dist-info/WHEEL"))
    return files, modes, info


def linked(files: dict) -> dict:
    """The list of what is linked that the wheel has inside."""
    lists = [name for name in files if name.endswith(".spdx.json")]
    if len(lists) != 1:
        raise Unfit("it has no list of what is linked (*.spdx.json)")
    return json.loads(files[lists[0]])


def record(files: dict, info: str) -> bytes:
    """The wheel's RECORD: names, hashes and sizes."""
    text = io.StringIO()
    rows = csv.writer(text, lineterminator="\n")
    for name, data in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        rows.writerow([name, f"sha256={digest}", len(data)])
    rows.writerow([f"{info}/RECORD", "", ""])
    return text.getvalue().encode()


def make(wheel: str, folder: str, roots: list) -> str:
    files, modes, info = read(wheel)
    least, _ = libraries(files)
    name, version, python, abi, _ = Path(wheel).stem.split("-")
    platform = f"manylinux_2_{least}_x86_64"
    for path, text in licences.texts(linked(files), roots).items():
        files[f"{info}/licenses/{path}"] = text.encode()
    files[f"{info}/licenses/LICENSE"] = next(data for path, data in files.items() if path.endswith("/LICENSE"))
    files[f"{info}/WHEEL"] = re.sub(rb"(?m)^Tag: .*$", f"Tag: {python}-{abi}-{platform}".encode(), files[f"{info}/WHEEL"])
    del files[f"{info}/RECORD"]
    files = dict(sorted(files.items(), key=lambda item: (item[0].startswith(info), item[0])))  # metadata last, as recommended
    files[f"{info}/RECORD"] = record(files, info)
    made = Path(folder, f"{name}-{version}-{python}-{abi}-{platform}.whl")
    when = time.gmtime(max(int(os.environ.get("SOURCE_DATE_EPOCH", time.time())), 315532800))[:6]  # a zip file knows no time before 1980
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for path, data in files.items():
            entry = zipfile.ZipInfo(path, when)
            entry.external_attr = (0o100000 | modes.get(path, 0o644)) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, data, compresslevel=9)
    return str(made)


def check(wheel: str) -> str:
    """A sentence on a wheel that is fit for an index; else Unfit says what is wrong."""
    files, _, info = read(wheel)
    least, deciding = libraries(files)
    tag = Path(wheel).stem.split("-", 2)[2]
    found = re.fullmatch(r"cp3\d+-cp3\d+-manylinux_2_(\d+)_x86_64", tag)
    if not found:
        raise Unfit(f"its tag {tag} is none of manylinux_2_N")
    if int(found[1]) < least:
        raise Unfit(f"its tag promises that 2.{found[1]} is enough, but it needs 2.{least}: {', '.join(deciding)}")
    if int(found[1]) > least:
        raise Unfit(f"its tag demands 2.{found[1]}, but 2.{least} is enough")
    if re.findall(r"^Tag: (.*)$", files[f"{info}/WHEEL"].decode(), re.M) != [tag]:
        raise Unfit("its file WHEEL has another tag than its name")
    for library in licences.inside(linked(files)):
        if not files.get(f"{info}/licenses/{library}.txt", b"").strip():
            raise Unfit(f"{library} is inside without its licence text")
    if not files.get(f"{info}/licenses/LICENSE", b"").strip():
        raise Unfit("its own licence text is missing")
    for path in [name for name in files if name.startswith(f"{info}/licenses/")]:
        for common in re.findall(rf"/{licences.COMMON}/([A-Za-z0-9.-]*[A-Za-z0-9])", files[path].decode()):
            if path.count("/") == 2 and f"{info}/licenses/common-licenses/{common}" not in files:
                raise Unfit(f"{path} refers to the licence {common}, which is not inside")
    metadata = Parser().parsestr(files[f"{info}/METADATA"].decode())
    for link in re.findall(r"\]\(([^()\s]+)\)", metadata.get_payload()):
        if not link.startswith(("https://", "http://")):
            raise Unfit(f"its description has the relative link {link}")
    rest = {name: data for name, data in files.items() if name != f"{info}/RECORD"}
    if sorted(record(rest, info).splitlines()) != sorted(files[f"{info}/RECORD"].splitlines()):
        raise Unfit("its RECORD does not fit its files")
    return f"needs glibc 2.{least} for {', '.join(deciding)}; {len(licences.inside(linked(files)))} libraries inside with their licences"


def main() -> None:
    verb, *operands = sys.argv[1:]
    try:
        if verb == "make":
            operands = [make(operands[0], operands[1], operands[2:])]
            print(operands[0])
        for wheel in operands:
            print(f"{Path(wheel).name}: {check(wheel)}", file=sys.stderr if verb == "make" else sys.stdout)
    except Unfit as fault:
        sys.exit(f"{Path(operands[0]).name}: {fault}")


if __name__ == "__main__":
    main()
