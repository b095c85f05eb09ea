#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Joins the page to play with: engine, shared drawing code of the reports, presets from scenarios/, and a policy that
allows its own scripts and style by their hashes and nothing else.

usage: assemble.py ENGINE.js ENGINE.wasm OUT.html
"""

import base64
import gzip
import hashlib
import json
import pathlib
import re
import sys
from typing import Any

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
ASSETS = ROOT / "src/report/assets"
SIZE_LIMIT = 2_000_000  # bytes of the whole page

# A scenario's own tests and texts do not hold for the scenarios that the sliders make of it.
LEFT_OUT = ("$schema", "name", "title", "purpose", "headline", "criteria")


def report_scripts() -> list[str]:
    """The reports' scripts, in their order: the one list of them is assets.cmake's."""
    names = re.search(r"foreach\(name ([^)]*)\)", (ROOT / "src/report/assets.cmake").read_text())
    if not names:
        raise SystemExit("assemble.py: assets.cmake has no list of scripts")
    return names.group(1).split()


def set_pointer(document: Any, pointer: str, value: Any) -> None:
    *path, last = pointer.removeprefix("/").split("/")
    for key in path:
        document = document[int(key)] if isinstance(document, list) else document.setdefault(key, {})
    if isinstance(document, list):
        document[int(last)] = value
    else:
        document[last] = value


def settings() -> dict[str, Any]:
    """settings.json with each preset's scenario in place of its file."""
    document = json.loads((HERE / "page/settings.json").read_text())
    for name, preset in document["presets"].items():
        scenario = json.loads((ROOT / "scenarios" / preset.pop("file")).read_text())
        scenario = {key: value for key, value in scenario.items() if key not in LEFT_OUT}
        for pointer, value in preset.pop("set", {}).items():
            set_pointer(scenario, pointer, value)
        preset["scenario"] = {"$schema": "earthtop-scenario-1.json", "name": name, "title": preset["label"], **scenario}
    return document


def hash_of(text: str) -> str:
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"


def page(glue: str, wasm: bytes) -> str:
    style = (ASSETS / "page.css").read_text() + (HERE / "page/play.css").read_text()
    parts = [ASSETS / f"{name}.js" for name in report_scripts()] + [HERE / "page" / name for name in ("chart.js", "play.js")]
    script = '(() => {\n"use strict";\n' + "".join(part.read_text() for part in parts) + "})();\n"
    for text in (glue, script):
        if re.search(r"</script|<!--", text, re.IGNORECASE):
            raise SystemExit("assemble.py: a script contains </script or <!--")
    scripts = " ".join(map(hash_of, (glue, script)))
    policy = (f"default-src 'none'; script-src {scripts} 'wasm-unsafe-eval'; style-src {hash_of(style)}; "
              "img-src data:; base-uri 'none'; form-action 'none'")
    # A smaller page: the browser unpacks the engine itself. No time in the archive, so that equal inputs give equal pages.
    engine = base64.b64encode(gzip.compress(wasm, 9, mtime=0)).decode()
    data = json.dumps(settings(), ensure_ascii=True).replace("<", "\\u003c")
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
    html = page(glue.read_text(), wasm.read_bytes())
    size = len(html.encode())
    if size >= SIZE_LIMIT:
        raise SystemExit(f"assemble.py: the page has {size} bytes, at most {SIZE_LIMIT} are allowed")
    out.write_text(html)
    print(f"{out}: {size} bytes")


if __name__ == "__main__":
    main()
