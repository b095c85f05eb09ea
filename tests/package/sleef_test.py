#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The functions of SLEEF that are transcribed for one-file programs and wheels give the bits of the shared library.

Every function that src/elementary.cpp calls, at numbers of every size and sign, near multiples of pi/2, at the ends of the number range, at
subnormal numbers, infinities and NaN. A transcript with one constant changed by its last bit has to be found.
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = """#include <sleef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
%s
static uint64_t state = 88172645463325252u;
static uint64_t next(void) { state ^= state << 13; state ^= state >> 7; return state ^= state << 17; }
static double number(long i) {
  static const double ends[] = {0, 1, 2, 0.5, 3, 10, 20, 170, 171.7, 709.78, 710.47, 745, 1e308, 1e-308, 4e-324, 1.0 / 0.0, 0.0 / 0.0};
  const double size = (double)(next() >> 11) * 0x1p-53, sign = next() & 1 ? 1 : -1;
  if (i < 34) return i & 1 ? -ends[i / 2] : ends[i / 2];
  if (i %% 4 == 0) { double x; const uint64_t bits = next(); memcpy(&x, &bits, 8); return x; }
  if (i %% 4 == 1) return sign * size;
  if (i %% 4 == 2) return sign * (double)(next() %% 1000000) * 1.5707963267948966 + 1e-9 * (i %% 8 == 2) * size;
  return sign * size * 700;
}
static int same(double a, double b) { return memcmp(&a, &b, 8) == 0 || (a != a && b != b); }
int main(void) {
  int faults = 0;
  for (long i = 0; i < 200000; ++i) {
    const double x = number(i), y = number(next() %% 4 ? (long)(next() >> 1) : i);
    (void)y;
%s
  }
  return faults != 0;
}
"""


def program(names):
    declared, compared = [], []
    for name in names:
        kind = "Sleef_double_2" if "sincos" in name else "double"
        two = "atan2" in name or "powd1" in name
        declared.append(f"{kind} made_{name}(double{', double' if two else ''});")
        call = "(x, y)" if two else "(x)"
        a, b = f"{name}{call}", f"made_{name}{call}"
        holds = f"same({a}.x, {b}.x) && same({a}.y, {b}.y)" if kind != "double" else f"same({a}, {b})"
        compared.append(f'    if (!({holds}) && ++faults < 20) fprintf(stderr, "{name}: differs at %a, %a\\n", x, y);')
    return PROGRAM % ("\n".join(declared), "\n".join(compared))


def run(*command, **options):
    return subprocess.run([str(word) for word in command], check=True, **options)


def main():
    with tempfile.TemporaryDirectory() as directory:
        work = Path(directory)
        library = next(Path("/usr/lib").glob("*/libsleef.so"))
        with open(work / "sleef.c", "w", encoding="utf-8") as out:
            run(sys.executable, ROOT / "tools/play/engine/transcribe_sleef.py", ROOT / "src/elementary.cpp", library, stdout=out)
        text = (work / "sleef.c").read_text(encoding="utf-8")
        names = re.findall(r"^\S+ (Sleef_cinz_\w+)\(double", text, re.M)
        if len(names) < 28:
            sys.exit(f"only {len(names)} functions are transcribed")
        (work / "main.c").write_text(program(names), encoding="utf-8")
        run("gcc", "-O1", "-c", work / "main.c", "-o", work / "main.o")

        def differs(transcript):
            (work / "sleef.c").write_text(transcript, encoding="utf-8")
            run("gcc", "-std=gnu11", "-O1", "-ffp-contract=off", "-c", work / "sleef.c", "-o", work / "made.o")
            run("objcopy", "--prefix-symbols=made_", work / "made.o")  # of other names than the shared library's
            undefined = re.findall(r" U made_(\w+)", run("nm", work / "made.o", capture_output=True, text=True).stdout)
            run("objcopy", *(f"--redefine-sym=made_{name}={name}" for name in undefined), work / "made.o")
            run("gcc", work / "main.o", work / "made.o", "-lsleef", "-lm", "-o", work / "compare")
            return subprocess.run([work / "compare"], check=False, capture_output=True, text=True)

        found = differs(text)
        if found.returncode:
            sys.exit(f"status {found.returncode}: {found.stderr}")
        one = text.find("0x3ff0000000000000ull", text.index("Sleef_cinz_logd1_u10purec"))
        if not differs(text[:one] + "0x3ff0000000000001ull" + text[one + 21:]).returncode:
            sys.exit("a constant that is wrong by its last bit is not found")
    print(f"{len(names)} functions, 200000 numbers each: the bits of {library}")


main()
