# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes pages of every kind with the program, for the tests in browsers and for looking at them."""

import dataclasses
import json
import pathlib
import subprocess
from collections.abc import Callable, Iterable
from typing import Any

SCENARIOS = pathlib.Path(__file__).resolve().parents[2] / "scenarios"
PROGRAM_TIMEOUT_S = 120.0


@dataclasses.dataclass
class Report:
    name: str
    kind: str  # run, study, comparison or bench
    page: pathlib.Path
    summary: dict[str, Any] | None = None  # of a run
    hostile: bool = False


class Program:
    """Runs earthtop in a directory of its own."""

    def __init__(self, earthtop: pathlib.Path, directory: pathlib.Path) -> None:
        self.earthtop = earthtop.resolve()
        self.directory = directory

    def run(self, *arguments: str | pathlib.Path, statuses: Iterable[int] = (0,)) -> str:
        words = [str(word) for word in arguments]
        done = subprocess.run([str(self.earthtop), *words], cwd=self.directory, capture_output=True, text=True,
                              timeout=PROGRAM_TIMEOUT_S, check=False)
        if done.returncode not in statuses:
            raise RuntimeError(f"earthtop {' '.join(words)}: status {done.returncode}: {done.stderr.strip()[:300]}")
        return done.stdout

    def write(self, name: str, document: Any) -> pathlib.Path:
        path = self.directory / name
        path.write_text(document if isinstance(document, str) else json.dumps(document))
        return path

    def run_report(self, name: str, scenario: pathlib.Path, out: str, hostile: bool = False) -> Report:
        directory = self.directory / out
        directory.parent.mkdir(parents=True, exist_ok=True)
        self.run("run", scenario, "--out", directory, "--quiet")
        self.run("report", directory)
        summary = json.loads((directory / "summary.json").read_text())
        return Report(name, "run", directory / "report.html", summary, hostile)

    def study_report(self, name: str, study: pathlib.Path, hostile: bool = False) -> Report:
        self.run("study", study, "--out", self.directory / name, "--quiet")
        self.run("report", self.directory / name)
        return Report(name, "study", self.directory / name / "report.html", None, hostile)

    def document_report(self, name: str, kind: str, document: str, hostile: bool = False) -> Report:
        path = self.write(f"{name}.json", document)
        self.run("report", path)
        return Report(name, kind, path.with_suffix(".html"), None, hostile)

    def compare(self, reference: str, new: str) -> str:
        return self.run("compare", reference, new, "--json", statuses=(0, 1))


MANY_POINTS = 2000  # above the number up to which a page draws each point


def monte_carlo(points: int = MANY_POINTS) -> dict[str, Any]:
    """A study that draws its points: two unknowns of a toy top, a short run each."""
    base = json.loads((SCENARIOS / "toy-top.json").read_text())
    base["motion"] = {"duration_s": 0.2, "output_step_s": 0.1}
    return {
        "$schema": "earthtop-study-1.json", "name": "monte-carlo", "title": "A toy top whose spin and tilt are uncertain",
        "purpose": "The spread of the drift.", "base": base, "set": {},
        "axes": [{"name": "spin_rad_s", "pointer": "/release/spin_rad_s", "range": {"from": 150, "to": 250}},
                 {"name": "tilt_deg", "pointer": "/release/tilt_deg", "range": {"from": 10, "to": 30}}],
        "design": {"kind": "random", "points": points, "seed": 7},
        "collect": ["drift.azimuth_final_rad", "drift.axis_final_rad"]}


def shipped_pages(program: Program) -> list[Report]:
    """Pages of every kind, all of scenarios and studies that the program comes with but for the drawn study's."""
    def comparison(name: str, reference: str, new: str) -> Report:
        return program.document_report(name, "comparison", program.compare(reference, new))

    def elsewhere() -> Report:
        toy_top = json.loads((SCENARIOS / "toy-top.json").read_text())
        changed = program.write("elsewhere.json", {**toy_top, "site": {**toy_top["site"], "latitude_deg": 46}})
        program.run("run", changed, "--out", "elsewhere", "--quiet")
        return comparison("compare-different", "toy-top", "elsewhere")

    def measurement() -> Report:
        measured = program.write("measured.csv", "t_s,azimuth_deg,azimuth_se_deg\n" + "".join(
            f"{t},{90 + 0.1 * (-1) ** t},0.1\n" for t in range(30)))
        return program.document_report("measurement", "measurement", program.run(
            "compare", SCENARIOS / "free-gyro.json", measured, "--estimate", "omega_sin_latitude_rad_s",
            "--estimate", "/release/azimuth_deg", "--json"))

    makers: list[Callable[[], Report]] = [
        *[lambda name=name: program.run_report(name, SCENARIOS / f"{name}.json", name)
          for name in ("toy-top", "walking-top", "foucault-pendulum")],
        lambda: program.study_report("study-1d", SCENARIOS / "studies/latitude.json"),
        lambda: program.study_report("study-2d", SCENARIOS / "studies/latitude-azimuth.json"),
        lambda: program.study_report("study-drawn", program.write("monte-carlo.json", monte_carlo())),
        lambda: comparison("compare-same", "toy-top", "toy-top"),
        elsewhere,
        lambda: program.document_report("bench", "bench", program.run(
            "bench", SCENARIOS / "toy-top.json", "--duration", "2", "--repetitions", "1", "--json")),
        lambda: program.document_report("plan", "plan", program.run(
            "plan", SCENARIOS / "free-gyro.json", "--measure", "azimuth_deg", "--sigma", "0.05", "--every", "1", "--json")),
        measurement]
    return [make() for make in makers]
