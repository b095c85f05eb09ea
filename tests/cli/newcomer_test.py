# SPDX-License-Identifier: GPL-3.0-or-later
"""The newcomer's way: three commands from an empty directory to a page on which a top moves, all shipped scenarios on one screen.
usage: newcomer_test.py PATH_OF_EARTHTOP [--all | --sanitized]     --all: the hard cases, too; --sanitized: few scenarios, and no time"""
import json
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

LINES, COLUMNS, PROMPTS = 24, 80, 2  # the command above the printout, and the next one below it
MOST_SECONDS = 1.0  # of processor time, for the three commands: they take 0.35 s; a busy or slower machine may take twice half a second
faults = []


def expect(condition, message):
    if not condition:
        faults.append(message)
        print(f"FAULT: {message}")


def run(tool, *arguments, status=0):
    environment = {**os.environ, "COLUMNS": str(COLUMNS), "DISPLAY": "", "WAYLAND_DISPLAY": ""}
    done = subprocess.run([tool, *arguments], capture_output=True, text=True, check=False, env=environment)
    expect(done.returncode == status, f"{' '.join(arguments)}: status {done.returncode}: {done.stderr}")
    return done


def used_s():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def journey(tool):
    """example > top.json, run top.json, and the command in its last line."""
    before = used_s()
    pathlib.Path("top.json").write_text(run(tool, "example").stdout, encoding="utf-8")
    printed = run(tool, "run", "top.json").stdout
    command = printed.rstrip("\n").splitlines()[-1].split()
    expect(command[:2] == ["earthtop", "report"], f"the last line of run is {' '.join(command)}")
    page = pathlib.Path(run(tool, *command[1:]).stdout.strip())
    seconds = used_s() - before
    text = page.read_text(encoding="utf-8")
    expect('<canvas id="top"' in text and "requestAnimationFrame" in text, "the page has no top that moves")
    summary = json.loads((page.parent / "summary.json").read_text(encoding="utf-8"))
    drift = summary["drift"]["axis_final_rad"]
    said = float(re.search(r"([-+0-9.e]+) ± [0-9.e-]+ rad", printed).group(1))
    expect(abs(said - drift) <= 1e-11 * drift,  # thirteen digits are printed
            f"the printout says {said}, the summary {drift}")
    expect(seconds <= MOST_SECONDS or "--sanitized" in sys.argv, f"{seconds:.2f} s of processor time, more than {MOST_SECONDS} s")
    print(f"three commands to a page: {seconds:.2f} s of processor time")
    return page


def newest(tool, page):
    """`report` alone takes the newest results below out, and an edited scenario goes to a directory of its own."""
    before = {file.name: file.read_bytes() for file in page.parent.iterdir()}
    last = run(tool, "run", "top.json", "--set", "tilt_deg=25").stdout.rstrip("\n").splitlines()[-1].split()[-1]
    expect(last == f"{page.parent}-2", f"an edited scenario goes to {last}")
    expect({file.name: file.read_bytes() for file in page.parent.iterdir()} == before, "older results were touched")
    expect(run(tool, "report").stdout.strip() == f"{last}/report.html", "report does not take the newest results")
    os.utime(page.parent / "summary.json", (4e9, 4e9))
    expect(run(tool, "report").stdout.strip() == str(page), "report does not take the results with the newest summary")


def pictures(tool, page):
    """Every picture and every table of verdicts is XML, as what reads them demands."""
    made = [pathlib.Path(line) for line in run(tool, "report", str(page.parent), "--svg", "--out", "p.html").stdout.split()]
    expect(any(file.name == "p-top.svg" for file in made), f"there is no picture of the top among {made}")
    run(tool, "compare", str(page.parent), str(page.parent), "--junit", "verdicts.xml", "--svg", "same.svg", "--quiet")
    for file in [page.parent / "drift.svg", *made[1:], pathlib.Path("verdicts.xml"), pathlib.Path("same.svg")]:
        try:
            xml.etree.ElementTree.parse(file)
        except xml.etree.ElementTree.ParseError as error:
            expect(False, f"{file}: {error}")


def screens(tool, files):
    """The printout of a run fits a screen; it has the verdict, and its last line makes the page."""
    for file in files:
        done = subprocess.run([tool, "run", str(file), "--out", "r", "--force"], capture_output=True, text=True, check=False,
                              env={**os.environ, "COLUMNS": str(COLUMNS)})
        lines = done.stdout.splitlines()
        expect(done.returncode in (0, 3) and len(lines) <= LINES - PROMPTS, f"{file.name}: {len(lines)} lines")
        expect(max(map(len, lines), default=0) <= COLUMNS, f"{file.name}: a line is too wide")
        expect(lines and lines[-1].strip() == "earthtop report r", f"{file.name}: the last line is no command")
        verdict = json.loads(pathlib.Path("r/summary.json").read_text(encoding="utf-8"))["drift"]["verdict"]
        expect(any(line.startswith("Verdict") and verdict.replace("_", " ") in line for line in lines), f"{file.name}: no verdict")


def main():
    tool, scenarios = os.path.realpath(sys.argv[1]), pathlib.Path(__file__).resolve().parents[2] / "scenarios"
    with tempfile.TemporaryDirectory() as work:
        os.chdir(work)
        page = journey(tool)
        newest(tool, page)
        pictures(tool, page)
        shown = "toy-top*.json" if "--sanitized" in sys.argv else "*.json"
        screens(tool, sorted(scenarios.glob(shown)) + (sorted(scenarios.glob("hard/*.json")) if "--all" in sys.argv else []))
        for name in ("toy-top", "foucault-pendulum"):
            for verb in ("run", "check", "explain"):
                expect(name in run(tool, verb, name).stdout or verb != "check", f"{verb} {name}")
            shipped = (scenarios / f"{name}.json").read_text(encoding="utf-8")
            expect(run(tool, "example", name).stdout == shipped, f"example {name}")
        for word, answer in (("plot", "report"), ("draw", "report"), ("picture", "report"), ("animate", "report"),
                             ("list", "example --list"), ("simulate", "run")):
            expect(f"earthtop {answer}" in run(tool, word, status=2).stderr, f"{word} is not answered with {answer}")
        for topic in ("verdicts", "units", "frames", "glossary"):
            expect(len(run(tool, "help", topic).stdout.splitlines()) > 4, f"help {topic}")
        for verdict in ("reliable", "noise_floor", "unstable", "chaotic", "marginal", "unassessed"):
            expect(f"\n{verdict} " in "\n" + run(tool, "help", "verdicts").stdout, f"help verdicts lacks {verdict}")
    print(f"{len(faults)} faults")
    return bool(faults)


sys.exit(main())
