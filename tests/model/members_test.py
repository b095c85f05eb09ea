#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A struct with a member that it does not list (include/earthtop/members.hpp) must not compile where its members are gone through.

    members_test.py [--all] COMPILER ROOT [FLAG...]

Members are added to copies of the real headers, and the real sources that carry coefficients from one scalar to another are
compiled with these (without generating code). Each must be refused, for the reason that is meant, and must compile again once the
member is listed. --all: every such source; without: a small one and two of those.
"""

import pathlib
import re
import subprocess
import sys
import tempfile

NOT_LISTED = r"error: .*(structured binding|decomposes into \d+ elements)"  # of g++, of clang++
NO_COUNTERPART = r"a member has no counterpart in the other list"

SMALL = """
#include "earthtop/model/converted.hpp"
using namespace earthtop;
template <class T>
struct Inner {
  T a = T(1);
  EARTHTOP_MEMBERS(a)
};
template <class T>
struct Outer {
  bool flag = true;
  Inner<T> inner;
  Vec3<T> vector = Vec3<T>::Zero();
  EARTHTOP_MEMBERS(flag, inner, vector)
};
Outer<long double> wide(const Outer<double>& x) {
  return converted<long double>(x, [](double number) { return static_cast<long double>(number); });
}
"""

# Sources that carry coefficients, and a struct of coefficients that each of them goes through.
TORQUES = "AppliedTorques", "earthtop/model/applied_torques.hpp"
CONTACT = "Contact", "earthtop/model/contact.hpp"
MODEL = "Model", "earthtop/model/model.hpp"
CARRIERS = [
    (TORQUES, "src/drift/derivatives/moved_problem.cpp"),  # problems with an input that is a little larger
    (TORQUES, "src/scene/input_derivatives.cpp"),  # derivatives by an input
    (TORQUES, "src/drift/derivatives/sensitivity.cpp"),  # jets
    (TORQUES, "src/budget/effects.cpp"),  # the size of an effect
    (TORQUES, "src/scene/stretches.cpp"),  # stronger friction
    (TORQUES, "src/drift/derivatives/growth.cpp"),  # whether anything rubs
    (TORQUES, "src/integrate/taylor/record_motion.cpp"),  # series
    (TORQUES, "src/drift/pivot/record_drift.cpp"),
    (TORQUES, "src/drift/derivatives/record_single_motion.cpp"),
    (CONTACT, "src/drift/table/record_contact.cpp"),
]
# Sources that have to say of each member what becomes of it, whether it is listed or not: struct, source and reason.
DECIDERS = [
    (MODEL, "src/drift/derivatives/moved_problem.cpp", NO_COUNTERPART),
    (MODEL, "src/scene/input_derivatives.cpp", NO_COUNTERPART),
    (MODEL, "src/drift/derivatives/sensitivity.cpp", NO_COUNTERPART),
    (CONTACT, "src/run/assemble.cpp", NOT_LISTED),
]


def with_member(text, struct, listed):
    """The text with a further number in a struct, which is listed or not."""
    template = re.search(rf"template <class (\w+)>\nstruct {struct} {{", text)
    assert template, f"there is no struct {struct}"
    at = text.index("EARTHTOP_MEMBERS(", template.end())
    scalar = template.group(1)
    rest = text[at:].replace(")", ", forgotten)", 1) if listed else text[at:]
    return f"{text[:at]}{scalar} forgotten = {scalar}(0);\n  {rest}"


class Compiler:
    def __init__(self, command, root, flags):
        self.command, self.root, self.flags = command, root, flags

    def complaint(self, source, overlay):
        """What the compiler says against a source; nothing where it compiles.  overlay: headers that hide those of the same name"""
        run = subprocess.run(
            [self.command, "-std=c++20", "-fsyntax-only", "-Wfatal-errors", "-I", str(overlay), "-I", self.root / "include",
             "-I", self.root / "src", *self.flags, str(source)], capture_output=True, text=True, check=False)
        return run.stdout + run.stderr if run.returncode else ""


def main():
    arguments = sys.argv[1:]
    every = "--all" in arguments
    command, root, *flags = [a for a in arguments if a != "--all"]
    root = pathlib.Path(root)
    compiler = Compiler(command, root, flags)
    failures = []

    def expect(what, complaint, reason):
        fits = re.search(reason, complaint) if reason else not complaint
        print("as it should be:" if fits else "NOT as it should be:", what, flush=True)
        if not fits:
            failures.append("\n".join([what, *complaint.splitlines()[-6:]]) if complaint else f"{what}\nit compiles")

    with tempfile.TemporaryDirectory() as directory:
        folder = pathlib.Path(directory)

        def small(struct, listed):
            source = folder / "small.cpp"
            source.write_text(with_member(SMALL, struct, listed) if struct else SMALL)
            return compiler.complaint(source, folder)

        def real(what, source, listed):
            struct, header = what
            overlay = folder / f"{struct}-{listed}"
            (overlay / header).parent.mkdir(parents=True, exist_ok=True)
            (overlay / header).write_text(with_member((root / "include" / header).read_text(), struct, listed))
            return compiler.complaint(root / source, overlay)

        expect("a small source", small(None, True), None)
        for struct in ("Inner", "Outer"):
            expect(f"a small source, {struct} with a member that is not listed", small(struct, False), NOT_LISTED)
            expect(f"a small source, {struct} with a member that is listed", small(struct, True), None)
        for what, source in CARRIERS if every else CARRIERS[:2]:
            expect(f"{source}, {what[0]} with a member that is not listed", real(what, source, False), NOT_LISTED)
            if every:
                expect(f"{source}, {what[0]} with a member that is listed", real(what, source, True), None)
        for what, source, reason in DECIDERS if every else DECIDERS[:1]:
            expect(f"{source}, {what[0]} with a member that is listed and has no place here", real(what, source, True), reason)

    for failure in failures:
        print(f"\n{failure}", file=sys.stderr)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
