#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The licence texts of the libraries that are inside a file, by its list of what is linked (SPDX).

    licences.py LIST [ROOT...] > TEXTS

A text is the copyright file of the Debian package that the list names, with what it refers to in /usr/share/common-licenses. It is looked
for in the directories ROOT and then on this machine. A text that is missing is an error.
"""
import json
import re
import sys
from pathlib import Path

INSIDE = {"CONTAINS", "STATIC_LINK"}  # the code is in the file; what is loaded comes with licences of its own
COMMON = "usr/share/common-licenses"


def inside(document: dict) -> dict:
    """Of a list: the names of what is inside, with the Debian package of each ("" where none is named)."""
    relations = {relation["relatedSpdxElement"]: relation["relationshipType"] for relation in document["relationships"]}
    packages = {}
    for package in document["packages"]:
        if relations[package["SPDXID"]] in INSIDE:
            locators = [re.search(r"/([^/@]+)@", reference["referenceLocator"])[1] for reference in package.get("externalRefs", [])]
            packages[package["name"]] = locators[0] if locators else ""
    return packages


def texts(document: dict, roots: list) -> dict:
    """Licence texts by the names of their files: one for each library inside, and those that these refer to."""
    found = {}

    def read(path: str) -> str:
        for root in [*roots, "/"]:
            if Path(root, path).is_file():
                return Path(root, path).read_text(encoding="utf-8", errors="replace")
        raise SystemExit(f"licences.py: there is no /{path}")

    for name, package in inside(document).items():
        if not package:
            raise SystemExit(f"licences.py: the list names no Debian package of {name}, so that its licence is not known")
        found[f"{name}.txt"] = read(f"usr/share/doc/{package}/copyright")
    for text in list(found.values()):
        for common in re.findall(rf"/{COMMON}/([A-Za-z0-9.-]*[A-Za-z0-9])", text):
            found[f"common-licenses/{common}"] = read(f"{COMMON}/{common}")
    return dict(sorted(found.items()))


def main() -> None:
    with open(sys.argv[1], encoding="utf-8") as file:
        document = json.load(file)
    for name, text in texts(document, sys.argv[2:]).items():
        print(f"{'=' * 100}\n{name}\n{'=' * 100}\n{text}\n")


if __name__ == "__main__":
    main()
