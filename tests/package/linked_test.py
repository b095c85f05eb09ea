#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holds a list of what is linked (SPDX 2.3) against the linked file itself.

    linked_test.py LIST LINKED [--build BUILD OBJECTS...]

What the file loads by `ldd` has to be listed, with a version and a licence. With --build, also every archive in the command that linked it,
and every package whose headers the objects include whose paths in BUILD begin with one of OBJECTS. A table that lacks a library has to stop
the build.
"""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
REQUIRED = {"spdxVersion", "dataLicense", "SPDXID", "name", "documentNamespace", "creationInfo", "packages", "relationships"}
OF_PACKAGE = {"SPDXID", "name", "versionInfo", "downloadLocation", "filesAnalyzed", "licenseConcluded", "licenseDeclared", "copyrightText",
              "externalRefs"}
faults = []


def want(holds, what):
    if not holds:
        faults.append(what)


def output(*command):
    return subprocess.run(command, check=False, capture_output=True, text=True).stdout


def check_form(document):
    """What SPDX 2.3 demands of a document, as far as ours use it."""
    want(set(document) == REQUIRED, f"members of the document: {sorted(document)}")
    want(document["spdxVersion"] == "SPDX-2.3" and document["dataLicense"] == "CC0-1.0" and document["SPDXID"] == "SPDXRef-DOCUMENT", "its head")
    want(re.fullmatch(r"https://[^#\s]+", document["documentNamespace"]), "documentNamespace is no URI")
    want(re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", document["creationInfo"]["created"]), "created is no time in UTC")
    want(all(re.match(r"(Person|Organization|Tool): ", creator) for creator in document["creationInfo"]["creators"]), "its creators")
    ids = [package["SPDXID"] for package in document["packages"]]
    want(len(ids) == len(set(ids)), "two packages with one SPDXID")
    for package in document["packages"]:
        name = package["name"]
        want(re.fullmatch(r"SPDXRef-[A-Za-z0-9.-]+", package["SPDXID"]), f"{name}: SPDXID {package['SPDXID']}")
        want(set(package) <= OF_PACKAGE and package["downloadLocation"] and package["filesAnalyzed"] is False, f"{name}: members {sorted(package)}")
        for reference in package.get("externalRefs", []):
            want(reference["referenceCategory"] == "PACKAGE-MANAGER" and reference["referenceType"] == "purl"
                 and re.fullmatch(r"pkg:deb/[a-z]+/[a-z0-9.+-]+@[A-Za-z0-9.~%-]+[?]arch=[a-z0-9]+", reference["referenceLocator"]),
                 f"{name}: {reference}")
    related = [relation["relatedSpdxElement"] for relation in document["relationships"]]
    want(sorted(related) == sorted(ids), "not every package has one relationship")
    for relation in document["relationships"]:
        want(relation["relationshipType"] in {"DESCRIBES", "CONTAINS", "STATIC_LINK", "DYNAMIC_LINK", "DEPENDS_ON"}
             and relation["spdxElementId"] in {"SPDXRef-DOCUMENT", ids[0]}, f"relationship {relation}")


def check_loaded(packages, relations, linked):
    """What the linker wrote into the file, and what the loader finds."""
    needed = set(re.findall(r"\(NEEDED\).*\[(.*)\]", output("readelf", "-d", linked)))
    loaded = {os.path.basename(line.split()[0]) for line in output("ldd", linked).splitlines() if "linux-vdso" not in line}
    want(needed and needed <= loaded, f"ldd does not find what {linked} needs: {sorted(needed - loaded)}")
    for name in sorted(loaded):
        want(name in packages, f"{name} is loaded and not listed")
    for name in sorted(needed & set(packages)):
        want(packages[name]["licenseConcluded"] != "NOASSERTION", f"{name} has no licence")
        want(relations[name] == "DYNAMIC_LINK", f"{name} is called {relations[name]}")
    dynamic = {name for name, relation in relations.items() if relation in {"DYNAMIC_LINK", "DEPENDS_ON"}}
    want(dynamic <= loaded, f"listed and not loaded: {sorted(dynamic - loaded)}")


def source_of(names):
    """Of Debian packages: the source package, by name."""
    lines = output("dpkg-query", "--show", "--showformat", "${Package} ${source:Package}\n", *sorted(names)).splitlines()
    return dict(line.split() for line in lines)


def check_compiled(packages, relations, linked, build, prefixes):
    """What was handed to the linker, and what the compiler read."""
    command = output("ninja", "-C", build, "-t", "commands", "-s", os.path.relpath(linked, build)).split()
    archives = {os.path.basename(word) for word in command if re.fullmatch(r"/.*\.a", word) and not word.startswith(build)}
    want(command, "ninja does not know how it was linked")
    want(archives == {name for name, relation in relations.items() if relation == "STATIC_LINK"}, f"archives that are linked: {sorted(archives)}")

    headers, counted = set(), False
    for line in output("ninja", "-C", build, "-t", "deps").splitlines():
        if not line.startswith(" "):
            counted = line.startswith(tuple(prefixes))
        elif counted and line.strip().startswith("/usr/"):
            headers.add(line.strip())
    want(len(headers) > 100, f"only {len(headers)} headers of the system are known")
    if not shutil.which("dpkg-query"):
        return
    owners = {owner.split(":")[0] for line in output("dpkg-query", "--search", *sorted(headers)).splitlines()
              for owner in line.split(": /")[0].split(", ")}
    listed = {re.search(r"/([^/@]+)@", reference["referenceLocator"])[1] for package in packages.values()
              for reference in package.get("externalRefs", [])}
    sources = set(source_of(listed).values())
    for owner, source in sorted(source_of(owners).items()):
        if not re.match(r"(gcc-|llvm-|glibc$|linux$|libxcrypt$|python3)", source):  # compiler, system, and the Python that loads a module
            want(source in sources, f"headers of {owner} are compiled in, and nothing of {source} is listed")


def check_refusal(linked):
    """A table without a library that is linked."""
    with tempfile.TemporaryDirectory() as folder:
        for name in ("spdx.cmake", "linked-libraries.cmake"):
            shutil.copy(ROOT / "tools" / "package" / name, folder)
        table = Path(folder, "linked-libraries.cmake")
        table.write_text("".join(line for line in table.read_text(encoding="utf-8").splitlines(True) if "|sleef|" not in line), encoding="utf-8")
        made = subprocess.run(["cmake", "-DNAME=x", "-DVERSION=1", "-DCREATED=2026-01-01T00:00:00Z", f"-DLINKED={linked}", "-DOBJDUMP=objdump",
                               f"-DLIST={folder}/list", "-P", f"{folder}/spdx.cmake"], check=False, capture_output=True, text=True)
        said = " ".join(made.stderr.split())
        want(made.returncode and not os.path.exists(f"{folder}/list"), "a library that the table does not know is no error")
        want(re.search(r"x is linked with libsleef\.so\.\d+, which tools/package/linked-libraries\.cmake does not know\.", said), f"said: {said}")


def main():
    arguments = sys.argv[1:]
    build, prefixes = None, []
    if "--build" in arguments:
        at = arguments.index("--build")
        build, prefixes = os.path.abspath(arguments[at + 1]), arguments[at + 2:]
        del arguments[at:]
    path, linked = arguments[0], os.path.abspath(arguments[1])
    with open(path, encoding="utf-8") as stream:
        document = json.load(stream)
    check_form(document)
    packages = {package["name"]: package for package in document["packages"][1:]}
    name_of = {package["SPDXID"]: name for name, package in packages.items()}
    relations = {name_of[relation["relatedSpdxElement"]]: relation["relationshipType"] for relation in document["relationships"][1:]}
    if shutil.which("dpkg-query"):
        for name, package in packages.items():
            want(package.get("versionInfo") and package.get("externalRefs"), f"{name} has no version")
    check_loaded(packages, relations, linked)
    if build:
        check_compiled(packages, relations, linked, build, prefixes)
    check_refusal(linked)
    for fault in faults:
        print("FAULT:", fault, file=sys.stderr)
    if not faults:
        print(f"{path}: {len(packages)} libraries, as they are linked")
    sys.exit(bool(faults))


main()
