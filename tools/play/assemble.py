#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Joins the page to play with: engine, shared drawing code of the reports, a preset for each scenario that the engine runs, and a
policy that allows its own scripts and style by their hashes and nothing else.

usage: assemble.py ENGINE.js ENGINE.wasm OUT.html
"""

import base64
import gzip
import hashlib
import json
import pathlib
import re
import subprocess
import sys
from typing import Any

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
ASSETS = ROOT / "src/report/assets"
SIZE_LIMIT = 3_000_000  # bytes of the whole page
FIRST = "toy-top"  # the scene that the page begins with
PARTS = ("chart", "scene", "sheet", "sheet_view", "play")  # of the page's own script, in their order

# A scenario's own tests and texts do not hold for the scenarios that the sliders make of it.
LEFT_OUT = ("$schema", "name", "title", "purpose", "headline", "criteria")


def report_scripts() -> list[str]:
    """The reports' scripts, in their order: the one list of them is assets.cmake's."""
    names = re.search(r"set\(run ([^)]*)\)", (ROOT / "src/report/assets.cmake").read_text())
    if not names:
        raise SystemExit("assemble.py: assets.cmake has no list of scripts")
    return names.group(1).split()


def value_at(document: Any, pointer: str) -> Any:
    """The value at a JSON pointer; None where there is none."""
    for key in pointer.removeprefix("/").split("/"):
        if isinstance(document, list):
            document = document[int(key)] if int(key) < len(document) else None
        elif isinstance(document, dict):
            document = document.get(key)
        else:
            return None
    return document


def kind_of_moments(scenario: dict[str, Any]) -> str:
    first, second, third = value_at(scenario, "/body/inertia/principal_kg_m2") or (0, 1, 2)
    return "spherical" if first == second == third else "axial" if first == second else "triaxial"


def sliders_of(scenario: dict[str, Any], sliders: dict[str, Any], changes: dict[str, Any]) -> dict[str, Any]:
    """The sliders that a scene has: those whose keys it states as numbers. One whose range is a multiple of its value needs a value."""
    def fits(row: dict[str, Any]) -> bool:
        values = [value_at(scenario, pointer) for pointer in row["pointers"]]
        are_numbers = all(isinstance(value, (int, float)) and not isinstance(value, bool) for value in values)
        has_range = "around" not in row or any(values)
        return row.get("rate", False) or are_numbers and has_range and row.get("of", kind_of_moments(scenario)) == kind_of_moments(scenario)
    found = {name: changes.get(name, {}) for name, row in sliders.items() if fits(row)}
    if set(changes) - set(found):
        raise SystemExit(f"assemble.py: {scenario['name']} has no {sorted(set(changes) - set(found))}")
    return found


def settings(glue: pathlib.Path, wasm: pathlib.Path) -> dict[str, Any]:
    """settings.json with the presets: every scenario of the gallery that the engine runs, the toy top first."""
    document = json.loads((HERE / "page/settings.json").read_text())
    texts = {file.stem: file.read_text() for file in sorted((ROOT / "scenarios").glob("*.json"))}
    said = subprocess.run(["node", HERE / "refusals.mjs", glue, wasm], input=json.dumps(texts), capture_output=True, text=True, check=True)
    refusals = json.loads(said.stdout)
    details = document.pop("scenes")
    if set(details) - set(texts):
        raise SystemExit(f"assemble.py: no scenarios are called {sorted(set(details) - set(texts))}")
    document["presets"] = {}
    for name in sorted(texts, key=lambda name: (name != FIRST, name)):
        if refusals[name]:
            print(f"{name} is no preset: {refusals[name]}")
            continue
        shipped, detail = json.loads(texts[name]), details.get(name, {})
        scenario = {key: value for key, value in shipped.items() if key not in LEFT_OUT}
        if "tolerance" in detail:  # looser than the program's, so that the pictures follow a slider; the bound is certified all the same
            scenario["numerics"] = {**scenario.get("numerics", {}), "relative_tolerance": detail["tolerance"]}
        rows = round(scenario["motion"]["duration_s"] / scenario["motion"]["output_step_s"])
        document["presets"][name] = {
            "label": name.replace("-", " "), "title": shipped["title"], "says": f"{shipped['title']}. {shipped['purpose']}",
            "rows": detail.get("rows", min(rows, document["most_rows"])),
            "sliders": sliders_of(shipped, document["sliders"], detail.get("sliders", {})),
            "scenario": {"$schema": "earthtop-scenario-1.json", "name": name, "title": name.replace("-", " "), **scenario}}
    return document


def hash_of(text: str) -> str:
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"


def page(glue: str, wasm: bytes, presets: dict[str, Any]) -> str:
    style = (ASSETS / "page.css").read_text() + (HERE / "page/play.css").read_text()
    parts = [ASSETS / f"{name}.js" for name in report_scripts()] + [HERE / f"page/{name}.js" for name in PARTS]
    script = '(() => {\n"use strict";\n' + "".join(part.read_text() for part in parts) + "})();\n"
    for text in (glue, script):
        if re.search(r"</script|<!--", text, re.IGNORECASE):
            raise SystemExit("assemble.py: a script contains </script or <!--")
    scripts = " ".join(map(hash_of, (glue, script)))
    policy = (f"default-src 'none'; script-src {scripts} 'wasm-unsafe-eval'; style-src {hash_of(style)}; "
              "img-src data:; base-uri 'none'; form-action 'none'")
    # A smaller page: the browser unpacks the engine itself. No time in the archive, so that equal inputs give equal pages.
    engine = base64.b64encode(gzip.compress(wasm, 9, mtime=0)).decode()
    data = json.dumps(presets, ensure_ascii=True).replace("<", "\\u003c")
    parts_of_page = {"POLICY": policy, "STYLE": style, "SETTINGS": data, "ENGINE": engine, "GLUE": glue, "SCRIPT": script}
    template = (HERE / "page/play.html").read_text()
    found = re.findall(r'(?<=[>"])[A-Z]+(?=[<"])', template)
    if sorted(found) != sorted(parts_of_page):
        raise SystemExit(f"assemble.py: play.html has places for {found}, not for {list(parts_of_page)}")
    return re.sub(r'(?<=[>"])[A-Z]+(?=[<"])', lambda match: parts_of_page[match.group()], template)


def main() -> None:
    if len(sys.argv) != 4:
        raise SystemExit(__doc__)
    glue, wasm, out = map(pathlib.Path, sys.argv[1:])
    html = page(glue.read_text(), wasm.read_bytes(), settings(glue, wasm))
    size = len(html.encode())
    if size >= SIZE_LIMIT:
        raise SystemExit(f"assemble.py: the page has {size} bytes, at most {SIZE_LIMIT} are allowed")
    out.write_text(html)
    print(f"{out}: {size} bytes")


if __name__ == "__main__":
    main()
