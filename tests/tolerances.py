#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Counts the tolerances in the tests that are bare literals: numbers of which nobody can say whether they are too loose. Fails unless
there are MOST of them: a new one needs a reason, and for each that is mended MOST is lowered.

tolerances.py [--list]    --list prints each with its place

A tolerance is the last argument of EXPECT_NEAR, or the right side of an EXPECT_LT or EXPECT_LE with a number below SMALL in it; the same
of ASSERT_... A constant is followed to its definition in the file: a name is no reason. A reason is a comment in the tolerance's lines or
alone in the line before them, or that a function of support/tolerances.hpp computes it.
"""
import os
import re
import sys

FOLDER = os.path.dirname(os.path.abspath(__file__))
MOST = 342
SMALL = 1e-3
CHECK = re.compile(r"\b(?:EXPECT|ASSERT)_(NEAR|LT|LE)\s*\(")
NAMED = re.compile(r"\b(rounding|truncation|reference)(?:<[^<>()]*>)?\(")
NUMBER = re.compile(r"(?<![\w.])(\d+\.?\d*(?:[eE][-+]?\d+)?)[fFlLuU]*(?![\w.])")
PASSED_OVER = re.compile(r'//[^\n]*|/\*.*?\*/|R"([^(]*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<!\w)\'(?:\\.|[^\'\\\n])+\'', re.S)


def line_of(text, at):
    return text.count("\n", 0, at) + 1


def split(text):
    """The text with blanks for its comments, strings and characters, and the numbers of the lines that have a comment."""
    commented = set()

    def blank(found):
        if found.group(0).startswith(("//", "/*")):
            commented.update(range(line_of(text, found.start()), line_of(text, found.end()) + 1))
        return re.sub(r"[^\n]", " ", found.group(0))

    return PASSED_OVER.sub(blank, text), commented


def arguments(code, at):
    """The arguments of a call from `at`, behind its parenthesis, and where it closes."""
    found, depth, begin = [], 0, at
    for i in range(at, len(code)):
        depth += (code[i] in "([{") - (code[i] in ")]}")
        if depth < 0 or (depth == 0 and code[i] == ","):
            found.append(code[begin:i].strip())
            begin = i + 1
        if depth < 0:
            return found, i
    raise ValueError("a call that does not end")


def unnamed(tolerance):
    """The tolerance without what a named function computes. What is left of truncation(...) is the first argument: not a number, either,
    but the tolerance that was asked for."""
    while found := NAMED.search(tolerance):
        given, end = arguments(tolerance, found.end())
        kept = given[0] if found.group(1) == "truncation" else ""
        tolerance = f"{tolerance[:found.start()]}({kept}){tolerance[end + 1:]}"
    return tolerance


def is_literal(tolerance, check):
    """Is it a number, or one below 1 (of a limit: below SMALL) times a scale?"""
    left = unnamed(tolerance)
    values = [float(number) for number in NUMBER.findall(left)]
    if check != "NEAR":
        return any(0 < value < SMALL for value in values)
    return any(0 < value < 1 for value in values) or (any(values) and not re.search("[A-Za-z_]", NUMBER.sub("", left)))


def literals(text):
    """Yields of each literal tolerance its line, itself, and whether it is bare."""
    code, commented = split(text)
    rows, followed = code.split("\n"), set()
    for found in CHECK.finditer(code):
        given, end = arguments(code, found.end())
        tolerance, first, last = given[-1], found.start(), code.find(";", end)
        definition = rf"\bconst(?:expr)?\b[^;=(){{}}]*\b{tolerance}\s*=([^;{{}}]*);" if tolerance.isidentifier() else "(?!)"
        for definition in re.finditer(definition, code[:first]):  # the last one counts
            tolerance, first, last = definition.group(1).strip(), definition.start(), definition.end()
        if first in followed or not is_literal(tolerance, found.group(1)):
            continue
        followed.add(first)
        lines = range(line_of(code, first), line_of(code, last) + 1)
        has_reason = not commented.isdisjoint(lines) or (lines[0] - 1 in commented and not rows[lines[0] - 2].strip())
        yield lines[0], " ".join(tolerance.split()), not has_reason


def verdict(bare):
    """What is wrong with so many bare literals; None if nothing is."""
    if bare > MOST:
        return (f"There must be no more than {MOST}: compute the new ones by tests/support/tolerances.hpp, or say in a comment "
                "beside them why they are what they are. --list shows all.")
    return f"Lower MOST in tests/tolerances.py to {bare}." if bare < MOST else None


def main():
    count = bare = 0
    for path, _, names in sorted(os.walk(FOLDER)):
        for name in sorted(name for name in names if name.endswith((".cpp", ".hpp"))):
            place = os.path.join(path, name)
            with open(place, encoding="utf-8") as stream:
                for line, tolerance, is_bare in literals(stream.read()):
                    count += 1
                    bare += is_bare
                    if is_bare and "--list" in sys.argv:
                        print(f"{os.path.relpath(place, FOLDER)}:{line}: {tolerance}")
    print(f"{bare} of {count} literal tolerances have no reason beside them.")
    sys.exit(verdict(bare))


if __name__ == "__main__":
    main()
