#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the measured figures of the manuals again.

    tools/bench/measure.py [--list [--markdown]] [--slow] [--program EARTHTOP] [--build DIR] [--dry-run] [NAME ...]

    NAME ...    only these parts, in this order; default: all parts but the slow ones
    --slow      the slow parts, too, which take hours
    --list      what each part makes, which manual and table it fills, and about how long it takes; --markdown: as a table
    --dry-run   prints the commands instead of running them
    --program   measures this program where a part needs nothing else; default: the one in DIR
    --build     the build directory; default: build/bench, which is configured and built first (preset `bench`)

Every part prints date and processor with what it measures. Parts marked `writes` in the list put their table or picture into the
manual, between the marks `<!-- NAME: begin -->` and `<!-- NAME: end -->`; of the others the output has the figures, to be carried over by
hand. Times are processor times: other work on the machine lengthens them less than it does the time on the clock, yet two threads that
share a core can double them. Measure on an idle machine.
Exit status: 0, or 1 if a part failed (the others run all the same).
"""

import argparse
import datetime
import json
import os
import pathlib
import platform
import resource
import shlex
import signal
import statistics
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
SPEED = "tools/bench/README.md"
TESTS = "tests/README.md"


def processor():
    """As `earthtop bench` names it."""
    name = platform.machine()
    try:
        for line in pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                name = line.split(":", 1)[1].strip()
                break
    except OSError:
        pass
    return f"{name}, {os.cpu_count()} cores"


class Lab:
    """Where things are, and how they are run."""

    def __init__(self, program, build, dry):
        self.program, self.build, self.dry = program, build, dry

    def built(self, target):
        """A program of the build: a path."""
        found = [p for folder in ("tools/bench", "tools/earthtop", "tests", "tests/headlines") for p in [self.build / folder / target] if p.exists()]
        return str(found[0] if found else self.build / "tools/bench" / target)

    def call(self, command, to=None):
        """Runs a command from the root of the repository; its output is shown, or goes to a file."""
        print("$ " + shlex.join(map(str, command)) + (f" > {to}" if to else ""), flush=True)
        if self.dry:
            return ""
        done = subprocess.run(list(map(str, command)), cwd=ROOT, stdout=subprocess.PIPE, text=True, check=True)
        if to:
            (ROOT / to).write_text(done.stdout, encoding="utf-8")
        else:
            print(done.stdout, end="", flush=True)
        return done.stdout

    def run(self, scenario, *sets, repetitions=1):
        """Runs a scenario `repetitions` times on one thread: the median of the processor times (s) and the summary."""
        if self.dry:
            print("$ " + shlex.join(["earthtop", "run", str(scenario), *[a for s in sets for a in ("--set", s)]]))
            return 0.0, SAMPLE
        seconds = []
        with tempfile.TemporaryDirectory() as directory:
            command = [self.program, "run", str(ROOT / scenario), "--jobs", "1", "--force", "--quiet", "--out", directory + "/out"]
            for change in sets:
                command += ["--set", change]
            for _ in range(repetitions):
                before = resource.getrusage(resource.RUSAGE_CHILDREN)
                done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
                after = resource.getrusage(resource.RUSAGE_CHILDREN)
                if done.returncode not in (0, 3):
                    raise RuntimeError(f"{shlex.join(command)}: status {done.returncode}\n{done.stderr}")
                seconds.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
            summary = json.loads(pathlib.Path(directory, "out/summary.json").read_text(encoding="utf-8"))
            return statistics.median(seconds), summary

    def write_between(self, manual, mark, text):
        """Replaces what is between the marks of a manual."""
        print(text)
        if not self.dry:
            write_between(manual, mark, text)


# What a dry run takes for a summary.
SAMPLE = {
    "solution": {"right_hand_side_evaluations": 0},
    "certificate": {"right_hand_side_evaluations": 0},
    "drift": {"axis_final_rad": 0.0, "axis_bound_rad": 0.0},
    "scenario": {"motion": {"duration_s": 1.0, "output_step_s": 1.0}},
}


def write_between(manual, mark, text):
    begin, end = f"<!-- {mark}: begin -->\n", f"<!-- {mark}: end -->\n"
    path = ROOT / manual
    old = path.read_text(encoding="utf-8")
    if old.count(begin) != 1 or old.count(end) != 1:
        raise RuntimeError(f"{manual} does not have the marks of {mark} once")
    before, rest = old.split(begin)
    path.write_text(before + begin + text.rstrip("\n") + "\n" + end + rest.split(end)[1], encoding="utf-8")


def measured(by):
    return f"Measured by `{by}` on an {processor().replace(' Processor', '')}, {datetime.date.today():%B %Y}"


def numerics_sets(numerics):
    return [f"/numerics/{key}={value}" for key, value in numerics.items()]


# ---- The parts that need more than one command --------------------------------------------------------------------------------


def reduced(lab):
    text = lab.call([lab.built("earthtop-reduced-general")])
    if text:
        lab.write_between(SPEED, "reduced and general", f"{measured('earthtop-reduced-general')}: processor time of one core.\n\n{text}")


def long_horizons(lab):
    """A day of the fast gyroscope, ten minutes and an hour of an unbalanced one, by three methods."""
    lines = ["| whole run | `fourier`: time, bound | `long_horizon`: time, bound | `taylor`: time, bound |", "| --- | ---: | ---: | ---: |"]
    day = ["/earth/rotation_rate_rad_s=7.292115e-05", f"/motion/output_step_s={86164 / 60!r}"]
    for title, name, changes in (
        ("a sidereal day of `fast-gyro-day`", "fast-gyro-day", day),
        ("`unbalanced-gyro-600s`", "unbalanced-gyro-600s", []),
        ("`unbalanced-gyro-hour`", "unbalanced-gyro-hour", []),
    ):
        cells = []
        for method in ("fourier", "long_horizon", "taylor"):
            if method == "taylor" and changes:  # more than two minutes
                cells.append("")
                continue
            sets = [*changes, f"/numerics/method={method}"]
            seconds, summary = lab.run(f"tools/bench/scenarios/{name}.json", *sets, repetitions=3)
            cells.append(f"{seconds:.2f} s, {summary['drift']['axis_bound_rad']:.1e} rad")
        lines.append(f"| {title} | {' | '.join(cells)} |")
    lab.write_between(SPEED, "long horizons", f"{measured('tools/bench/measure.py long-horizons')}: processor time of one core, the start of the\nprogram included, median of three runs.\n\n" + "\n".join(lines))


def real_tops(lab):
    """Friction and tables beside two motions by odeint."""
    table = lab.call([lab.built("earthtop-real-tops"), "7"])
    lab.write_between(
        "README.md",
        "real tops",
        "The same for a minute of real tops, with friction in the pivot and on a table, against the difference of two motions in the equations of\n"
        "any body:\n\n"
        + table
        + f"\n{measured('tools/bench/measure.py real-tops')}.",
    )


def digits(lab):
    """One second in three precisions; of the drift in double, the digits that agree with those of float128."""
    lines = ["| one second, 11 rows | evaluations | final axis drift (rad) | its bound (rad) |", "| --- | ---: | --- | ---: |"]
    for name in ("toy-top", "fast-gyro"):
        rows = {}
        for title, numerics in (
            ("`double` (`taylor`)", {"method": "taylor"}),
            ("`long_double`", {"precision": "long_double"}),
            ("`float128`", {"precision": "float128"}),
            (
                "`float128`, `rkf78` in body axes at 1e-28",
                {"precision": "float128", "method": "rkf78", "observer": "body", "relative_tolerance": 1e-28},
            ),
        ):
            second = ["/motion/duration_s=1", "/motion/output_step_s=0.1"]
            _, summary = lab.run(f"scenarios/{name}.json", *second, *numerics_sets(numerics))
            drift = summary["drift"]
            text = drift["digits"]["axis_final_rad"] if "digits" in drift else f"{drift['axis_final_rad']:.15e}"
            rows[title] = (summary["solution"]["right_hand_side_evaluations"], text, drift["axis_bound_rad"])
            print(f"{name}, {title}: {rows[title]}", flush=True)
        exact = rows["`float128`"][1]
        for title, (evaluations, text, bound) in rows.items():
            if title.startswith("`double`"):
                mantissa, exponent = text.split("e")
                text = os.path.commonprefix([mantissa, exact]) + "…e" + exponent
            lines.append(f"| {f'`{name}`, ' if title.startswith('`double`') else ''}{title} | {evaluations:,} | {text} | {bound:.1e} |")
    lab.write_between(SPEED, "more digits", f"{measured('tools/bench/measure.py digits')}.\n\n" + "\n".join(lines))


def closed_form(lab):
    """Whole runs by closed form and by integration."""
    pole = "/site/latitude_deg=90"
    lines = ["| whole run | rows | `closed_form` | its bound (rad) | `rkf78` at 1e-14 | its bound (rad) |", "| --- | ---: | ---: | ---: | ---: | ---: |"]
    for title, name, *sets in (
        ("`free-rotor-benchmark`", "free-rotor-benchmark"),
        ("`dzhanibekov`", "dzhanibekov"),
        *(
            (f"`toy-top` at the pole, matched in {rates} rates, {duration} s", "toy-top", pole, f"/release/rates_relative_to={rates}", f"/motion/duration_s={duration}")
            for rates in ("inertial", "laboratory")
            for duration in (60, 600)
        ),
    ):
        cells = []
        for numerics in ({"method": "closed_form"}, {"method": "rkf78", "relative_tolerance": 1e-14}):
            seconds, summary = lab.run(f"scenarios/{name}.json", *sets, *numerics_sets(numerics), repetitions=5)
            cells += [f"{1e3 * seconds:.3g} ms", f"{summary['drift']['axis_bound_rad']:.1e}"]
        motion = summary["scenario"]["motion"]
        lines.append(f"| {title} | {round(motion['duration_s'] / motion['output_step_s']) + 1:,} | " + " | ".join(cells) + " |")
        print(lines[-1], flush=True)
    text = f"{measured('tools/bench/measure.py closed-form')}: processor time of one core, the start of the\nprogram (8 ms) and the writing of the rows included, median of five runs.\n\n"
    lab.write_between(SPEED, "closed form against integration", text + "\n".join(lines))


def studies(lab):
    """What a point of a study costs in processor time, and all points in memory."""
    toy = str(ROOT / "scenarios/toy-top.json")
    gyro = str(ROOT / "scenarios/fast-gyro.json")

    def axis(pointer, first, last, points):
        return {"pointer": pointer, "range": {"from": first, "to": last, "points": points}}

    def grid(latitudes, spins, low=200, high=400):
        return [axis("/site/latitude_deg", -60, 60, latitudes), axis("/release/spin_rad_s", low, high, spins)]

    loose = {"/numerics/relative_tolerance": 1e-10}
    short = {"/motion/duration_s": 0.1, "/motion/output_step_s": 0.1}
    end = ["drift.axis_final_rad", "drift.verdict"]
    table = [
        ("toy tops of a minute at 1e-10, only the end", {"base": toy, "set": loose, "axes": grid(40, 25), "collect": end}, 1),
        ("the same with all rows", {"base": toy, "set": loose, "axes": grid(40, 25), "collect": end, "rows": "all"}, 1),
        ("toy tops of a minute with a viscous pivot", {"base": toy, "set": {"/effects/viscous_torque_N_m_s": 1e-8}, "axes": grid(20, 10)}, 1),
        ("toy tops of a minute in a tide", {"base": toy, "set": {"/effects/tide": {"amplitude_m_s2": [1e-6, 0, 1e-6], "frequency_hz": 2e-5, "phase_deg": 0}}, "axes": grid(20, 10)}, 1),
        ("toy tops of a minute, two threads", {"base": toy, "axes": grid(40, 25)}, 2),
        ("toy tops of a minute, one thread", {"base": toy, "axes": grid(40, 25)}, 1),
        (
            "fast gyroscopes of ten minutes, only the end",
            {"base": gyro, "axes": [axis("/site/latitude_deg", -60, 60, 10), axis("/release/spin_rad_s", 950, 1150, 10), axis("/release/tilt_deg", 30, 80, 10)], "collect": end},
            1,
        ),
        *((f"{n:,} tops of 0.1 s", {"base": toy, "set": short, "axes": grid(n // 50, 50, 150, 250), "collect": end}, 1) for n in (1000, 20000, 200000)),
    ]
    print("| study | points | processor ms a point | seconds, wall | memory, MB |\n| --- | ---: | ---: | ---: | ---: |")
    for title, document, jobs in table:
        points = 1
        for each in document["axes"]:
            points *= each["range"]["points"]
        with tempfile.TemporaryDirectory() as directory:
            file = pathlib.Path(directory, "study.json")
            file.write_text(json.dumps({"$schema": "earthtop-study-1.json", "name": "cost", **document}), encoding="utf-8")
            command = [lab.program, "study", str(file), "--jobs", str(jobs), "--quiet", "--out", directory + "/out"]
            if lab.dry:
                print("$ " + shlex.join(command))
                continue
            start = datetime.datetime.now()
            with subprocess.Popen(command, stdout=subprocess.DEVNULL) as process:
                _, status, usage = os.wait4(process.pid, 0)
                process.returncode = os.waitstatus_to_exitcode(status)
            if process.returncode != 0:
                raise RuntimeError(f"{title}: status {process.returncode}")
            wall = (datetime.datetime.now() - start).total_seconds()
        print(f"| {title} | {points:,} | {1e3 * (usage.ru_utime + usage.ru_stime) / points:.3g} | {wall:.1f} | {usage.ru_maxrss / 1024:.0f} |", flush=True)


def several(*commands):
    """A part that consists of commands, each made from the lab: a list, or a pair of a list and the file that takes its output."""

    def act(lab):
        for command in commands:
            made = command(lab)
            if isinstance(made, tuple):
                lab.call(made[0], made[1])
            else:
                lab.call(made)

    return act


def headline_files():
    """The scenarios whose figures are in tests/data/headlines.json."""
    names = [each["name"] for each in json.loads((ROOT / "tests/data/headlines.json").read_text(encoding="utf-8"))["scenarios"]]
    files = [ROOT / folder / f"{name}.json" for name in names for folder in ("scenarios", "tests/headlines/scenes", "scenarios/hard")]
    return [file.relative_to(ROOT) for file in files if file.exists()]


# name, what it makes, manual: place, about how long on two idle cores, whether it writes, whether it is slow, targets, the part itself
PARTS = [
    ("short", "what auto takes beside odeint, GSL and SUNDIALS", "README.md: the table of speed", "a minute", True, False, [],
     several(lambda lab: [HERE / "speed-against-error.py", "--short", lab.program])),
    ("real-tops", "tops with friction and on a table beside two motions by odeint", "README.md: the table of real tops", "a minute", True, False,
     ["earthtop-real-tops"], real_tops),
    ("speed", "every method and peer at three errors, fronts, four pictures; the short table", f"{SPEED}: Speed against error; README.md", "minutes", True, False, [],
     several(lambda lab: [HERE / "speed-against-error.py", lab.program])),
    ("runs", "whole runs, one motion, a study", f"{SPEED}: Whole runs", "minutes", False, False, [],
     several(lambda lab: [HERE / "table.sh", lab.program])),
    ("cost", "whole runs against duration, spin and friction", f"{SPEED}: Whole runs, the picture", "minutes", True, False, [],
     several(lambda lab: [HERE / "cost.py", "--draw", lab.program])),
    ("ladders", "whole runs as duration, spin, tilt, Earth rate, rows, tolerance, asymmetry and offset go up; where the cost jumps",
     f"{SPEED}: Whole runs, cliffs", "5 minutes", False, False, [], several(lambda lab: [HERE / "cost.py", lab.program])),
    ("resonance", "error of the compositions against the step", f"{SPEED}: Fixed steps, the picture", "minutes", True, False, ["earthtop-step-resonance"],
     several(lambda lab: ([lab.built("earthtop-step-resonance")], "tools/bench/pictures/step-resonance.svg"))),
    ("reduced", "the reduced against the general equations", f"{SPEED}: Reduced and general equations", "minutes", True, False, ["earthtop-reduced-general"], reduced),
    ("lanes", "points in SIMD lanes against one by one and against odeint", f"{SPEED}: What a study costs, the table", "minutes", False, False, ["earthtop-lanes"],
     several(lambda lab: [lab.built("earthtop-lanes"), "300"], lambda lab: [lab.built("earthtop-lanes"), "1000"])),
    ("studies", "processor time and memory of a study's points", f"{SPEED}: What a study costs; Memory", "minutes", False, False, [], studies),
    ("long-horizons", "a day, an hour and ten minutes of two gyroscopes", f"{SPEED}: Long horizons", "half a minute", True, False, [], long_horizons),
    ("digits", "one second in three precisions", f"{SPEED}: More digits", "minutes", True, False, [], digits),
    ("closed-form", "whole runs by closed form and by rkf78", f"{SPEED}: Closed forms against integration", "half a minute", True, False, [], closed_form),
    ("calls", "one call of a closed form; whole runs in one process", "include/earthtop/README.md: closed forms", "a minute", False, False,
     ["earthtop-closed-form-benchmark", "earthtop-run-benchmark"],
     several(lambda lab: [lab.built("earthtop-closed-form-benchmark")], lambda lab: [lab.built("earthtop-run-benchmark")])),
    ("verify", "the hard cases with their cost", f"{TESTS}: Verification, the cases", "2 minutes", False, False, [],
     several(lambda lab: [lab.program, "verify", "--slow"])),
    ("work", "estimated against actual work of random scenarios", f"{TESTS}: tests/work", "minutes", False, False, ["tests:earthtop-work-table"],
     several(lambda lab: [lab.built("earthtop-work-table"), "100"])),
    ("bounds", "how often the error is within its bound: methods as auto takes them", f"{TESTS}: How far the bounds can be trusted", "hours", False, True,
     ["tests:earthtop-bound-coverage"], several(lambda lab: [lab.built("earthtop-bound-coverage"), "42", "3", "200"])),
    ("bounds-by-hand", "the same for methods named by hand", f"{TESTS}: How far the bounds can be trusted, the first table", "hours", False, True,
     ["tests:earthtop-bound-coverage"], several(lambda lab: [lab.built("earthtop-bound-coverage"), "--by-hand"])),
    ("bounds-on-table", "the same for tops on a table", f"{TESTS}: How far the bounds can be trusted, the second table", "hours", False, True,
     ["tests:earthtop-bound-coverage"],
     several(lambda lab: [lab.built("earthtop-bound-coverage"), "--on-table", "30", "8", "60"],
             lambda lab: [lab.built("earthtop-bound-coverage"), "--on-table", "6", "8", "60", "--agreement"])),
    ("closed-form-errors", "errors of the closed forms in 49 regimes", "include/earthtop/README.md: the table of closed forms", "hours", False, True,
     ["tests:earthtop-closed-form-errors"], several(lambda lab: [lab.built("earthtop-closed-form-errors"), "100000"])),
    ("trend", "how often the trend of a run holds for longer ones", "tools/README.md: earthtop-trend-coverage", "hours", False, True,
     ["tests:earthtop-trend-coverage"], several(lambda lab: [lab.built("earthtop-trend-coverage"), "1000", "100", "4000"])),
    ("effect-choice", "effects auto against all effects on", "scenarios/README.md: effects auto", "hours", False, True,
     ["tests:earthtop-effect-choice"], several(lambda lab: [lab.built("earthtop-effect-choice"), "15", "2000", "30000"])),
    ("headlines", "headline figures in 113 bits, independently", "scenarios/README.md: shipped scenarios (the figures in their files)", "hours", False, True,
     ["tests:earthtop-headlines"],
     several(lambda lab: [lab.built("earthtop-headlines"), *headline_files()])),
]


def list_parts(markdown):
    if markdown:
        print("| part | what it makes | fills | how | program | takes about |\n| --- | --- | --- | --- | --- | --- |")
        for name, makes, place, time, writes, slow, targets, _ in PARTS:
            by = ", ".join(f"`{t.removeprefix('tests:')}`" for t in targets) or "`earthtop`"
            print(f"| `{name}` | {makes} | {place} | {'writes' if writes else 'prints'} | {by} | {time}{' (`--slow`)' if slow else ''} |")
        return
    for name, makes, place, time, writes, slow, targets, _ in PARTS:
        by = ", ".join(t.removeprefix("tests:") for t in targets) or "earthtop"
        print(f"{name:<19}{makes}\n{'':<19}fills {place} ({'writes it' if writes else 'prints it'})\n{'':<19}by {by}; takes {time}{'; only by name or with --slow' if slow else ''}")


def build(lab, parts, directory):
    """Configures and builds what the parts need."""
    targets = ["earthtop-tool", *dict.fromkeys(t.removeprefix("tests:") for p in parts for t in p[6])]
    tests = "ON" if any(t.startswith("tests:") for p in parts for t in p[6]) else None
    configure = ["cmake", "--preset", "bench", "-B", directory] + ([f"-DEARTHTOP_BUILD_TESTS={tests}"] if tests else [])
    lab.call(configure)
    lab.call(["cmake", "--build", directory, "--parallel", str(os.cpu_count()), "--target", *targets])


def main():
    parser = argparse.ArgumentParser(description="Makes the measured figures of the manuals again.")
    parser.add_argument("--list", action="store_true", help="list the parts")
    parser.add_argument("--markdown", action="store_true", help="as a table")
    parser.add_argument("--slow", action="store_true", help="the parts that take hours, too")
    parser.add_argument("--dry-run", action="store_true", help="print the commands only")
    parser.add_argument("--program", type=pathlib.Path, metavar="EARTHTOP", help="measure this program")
    parser.add_argument("--build", type=pathlib.Path, metavar="DIR", default=ROOT / "build/bench", help="the build directory")
    parser.add_argument("parts", nargs="*", metavar="NAME", help="only these parts")
    arguments = parser.parse_args()
    if arguments.list:
        list_parts(arguments.markdown)
        return 0
    known = {part[0]: part for part in PARTS}
    for name in arguments.parts:
        if name not in known:
            parser.error(f"no part is named {name}; --list names them")
    parts = [known[name] for name in arguments.parts] or [part for part in PARTS if arguments.slow or not part[5]]
    if not arguments.parts:
        parts = [part for part in parts if part[0] != "short"]  # speed makes that table, too
    directory = arguments.build.resolve()
    program = (arguments.program or directory / "tools/earthtop/earthtop").resolve()
    lab = Lab(str(program), directory, arguments.dry_run)
    if not arguments.program or any(part[6] for part in parts):
        build(lab, parts, directory)
    failed = []
    for name, makes, place, *_, act in parts:
        print(f"\n=== {name}: {makes}\n    {datetime.datetime.now():%d %B %Y %H:%M}, {processor()}; fills {place}", flush=True)
        start = datetime.datetime.now()
        try:
            act(lab)
        except (RuntimeError, OSError, subprocess.CalledProcessError) as error:
            print(f"{name} failed: {error}", file=sys.stderr)
            failed.append(name)
        print(f"=== {name}: {(datetime.datetime.now() - start).total_seconds():.0f} s", flush=True)
    if failed:
        print("Failed: " + ", ".join(failed), file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    sys.exit(main())
