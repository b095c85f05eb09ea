#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts an x86 processor into states in which digits would differ or exceptions end the process, each alone and some together.

usage: states_test.py PROGRAM PRELOADED [--seed N] [--python DIR]

PRELOADED is the library made of processor_state.cpp. The program has to say what is wrong, with status 3 and nothing written. In
the Python package, for which such a state is the caller's affair, every digit is that of the usual state, and the caller's state is
kept. Kinds: the program; the package with the state at its import; with the state at each call.
"""
import json
import os
import pathlib
import subprocess
import sys

import attack

# Bits set and cleared in x87's control word, then in MXCSR; and what the program says.
NEAREST, DIGITS, FLUSHED = "not rounded to nearest", "fewer digits than it has", "flushed to zero"
TRAPPED = "exceptions are trapped"
STATES = {"x87 in 53 bits": (0x200, 0x300, 0, 0, DIGITS), "x87 in 24 bits": (0, 0x300, 0, 0, DIGITS),
          **{f"x87 rounding {way}": (bits << 10, 0xC00, 0, 0, NEAREST) for way, bits in (("down", 1), ("up", 2), ("to zero", 3))},
          **{f"SSE rounding {way}": (0, 0, bits << 13, 0, NEAREST) for way, bits in (("down", 1), ("up", 2), ("to zero", 3))},
          "flush to zero": (0, 0, 0x8000, 0, FLUSHED), "denormals are zero": (0, 0, 0x40, 0, FLUSHED),
          **{f"{unit} trapping {name}": (0, bit if unit == "x87" else 0, 0, bit << 7 if unit == "SSE" else 0, TRAPPED)
             for unit in ("x87", "SSE") for name, bit in (("invalid", 1), ("denormal", 2), ("division", 4), ("overflow", 8),
                                                          ("underflow", 16), ("inexact", 32))
             if (unit, name) != ("x87", "denormal")},
          "all but inexact trapping": (0, 0xF, 0, 0xF << 7, TRAPPED)}

# What Python itself computes can trap, too: all is imported and called once before the state is set, and results are read after it
# has been put back. In sys.argv: the scenario's texts, when the state is set, and the state.
CHILD = """
import ctypes, json, sys
import numpy as np
texts, when, state = json.loads(sys.argv[1]), sys.argv[2], json.loads(sys.argv[3])
libm = ctypes.CDLL("libm.so.6")
before, changed, after = (ctypes.create_string_buffer(32) for _ in range(3))
libm.fegetenv(before)
def controls(environment):
    return ctypes.c_uint16.from_buffer(environment, 0), ctypes.c_uint32.from_buffer(environment, 28)
ctypes.memmove(changed, before, 32)
x87, mxcsr = controls(changed)
x87.value, mxcsr.value = x87.value & ~state[1] | state[0], mxcsr.value & ~state[3] | state[2]
if when == "import":
    import _ctypes, pathlib
    core = str(next(pathlib.Path(sys.path[1] if sys.path[0] == "" else sys.path[0], "earthtop").glob("_core*.so")))
    libm.fesetenv(changed)
    library = _ctypes.dlopen(core, 2)  # its static objects are made here
    libm.fesetenv(before)
import earthtop as et
def all_of():
    kept = []
    for text in texts:
        scene = et.Scenario(text).scene()
        r = et.run(text)
        kept.append((r, r.svg, scene.canonical, scene.top, scene.estimated_seconds))
    return kept
kept = all_of()
if when == "call":
    libm.fesetenv(changed)
    kept = all_of()
    libm.fegetenv(after)
    libm.fesetenv(before)
    if [c.value & 0xFFC0 if i else c.value for i, c in enumerate(controls(after))] != [
            c.value & 0xFFC0 if i else c.value for i, c in enumerate(controls(changed))]:
        print("the caller's state was not kept")
for r, *others in kept:
    print(json.dumps(r.summary["drift"]), [str(x) for x in np.ravel(r.q_LB)], others)
"""


def scenario(chosen, precision):
    """The text of a top that the seed chooses."""
    return {"site": {"latitude_deg": chosen.uniform(-90, 90)}, "earth": {"rotation_rate_rad_s": 7.292115e-5},
            "body": {"mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.03],
                     "inertia": {"about": "pivot", "principal_kg_m2": [1.2e-4, 1.2e-4, 4e-5]}},
            "release": {"tilt_deg": chosen.uniform(1, 60), "spin_rad_s": chosen.uniform(100, 300)},
            "motion": {"duration_s": 0.5, "output_step_s": 0.1}, "numerics": {"precision": precision}}


def combined(states):
    """Several states at once."""
    bits = [0, 0, 0, 0]
    for state in states:
        bits = [one | other for one, other in zip(bits, state[:4])]
    return bits


def main():
    """Tries all states."""
    def describe(parser):
        parser.add_argument("preloaded")
        parser.add_argument("--python", metavar="DIR")

    under = attack.Attack(__doc__, describe)
    preloaded = os.path.abspath(under.options.preloaded)
    tried = [([name], list(state[:4]), [state[4]]) for name, state in STATES.items()]
    for _ in range(12):
        names = under.random.sample(list(STATES), 2)
        tried.append((names, combined([STATES[name] for name in names]), [STATES[name][4] for name in names if STATES[name][4] != DIGITS]))
    texts = [json.dumps(scenario(under.random, precision)) for precision in ("double", "long_double", "float128")]

    def python(when, bits):
        return subprocess.run([sys.executable, "-c", CHILD, json.dumps(texts), when, json.dumps(bits)], capture_output=True, text=True,
                              check=False, env={**os.environ, "PYTHONPATH": os.path.abspath(under.options.python)}, timeout=120)

    usual = python("call", [0, 0, 0, 0]) if under.options.python else None

    def attempt(case, folder):
        kind, _, bits, words, _ = case
        if kind != "program":
            end = python(kind.split()[-1], bits)
            if end.returncode != 0:
                return [f"status {end.returncode}: {end.stderr[-200:]!r}"]
            return [] if end.stdout == usual.stdout else ["another digit, or another state afterwards: " + end.stdout[:100]]
        folder = pathlib.Path(folder)
        (folder / "top.json").write_text(case[4])
        end = under.run("run", "top.json", "--out", "new", "--quiet", cwd=folder,
                        env={**os.environ, "LD_PRELOAD": preloaded, "PROCESSOR_STATE": " ".join(map(str, bits))})
        faults = [] if end.status == 3 else [f"status {end.status}: {end.err[:200]!r}"]
        if (folder / "new").exists():
            faults.append("results were written")
        return faults + [f"does not say {word!r}: {end.err[:200]!r}" for word in words if word not in end.err]

    kinds = ["program"] + (["Python, state at import", "Python, state at call"] if under.options.python else [])
    # Where inexact results trap, Python's own divisions end it.
    under.all([(kind, " and ".join(names), bits, words, texts[i % 3]) for kind in kinds for i, (names, bits, words) in enumerate(tried)
               if kind[-4:] != "call" or not any("trapping inexact" in name for name in names)], attempt)
    under.end()


if __name__ == "__main__":
    main()
