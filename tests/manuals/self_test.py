#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of manuals_test.py: manuals with one planted fault each, beside a program that only pretends to be earthtop."""
import contextlib
import io
import os
import tempfile
import unittest

import manual
import manuals_test
from shown import missing_line

PROGRAM = r"""#!/usr/bin/env bash
case $1 in
  check) grep -q '"body"' "$2" || { echo "$2: no body"; exit 1; } ;;
  study) [[ $3 == --dry-run ]] && grep -q '"base"' "$2" ;;
  schema) printf '| key | meaning |\n| --- | --- |\n| mass_kg | mass |\n' ;;
  say) shift; printf '%s\n' "$@" ;;
  width) echo "$COLUMNS ${NO_COLOR:-colour} $HOME" ;;
  *) echo "what is $1?" >&2; exit 2 ;;
esac
"""
LIBRARY = "Name: {0}\nDescription: planted\nVersion: 1\nCflags:\nLibs:\n"


def block(language, text, *marks):
    return "".join(f"<!-- {mark} -->\n" for mark in marks) + f"```{language}\n{text}\n```\n"


class Planted(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.root, self.prefix = os.path.join(scratch.name, "root"), os.path.join(scratch.name, "prefix")
        self.program = os.path.join(scratch.name, "bin", "earthtop")
        self.write(self.program, PROGRAM)
        os.chmod(self.program, 0o755)
        for name in ("earthtop", "earthtop-workbench"):
            self.write(os.path.join(self.prefix, "lib", "pkgconfig", name + ".pc"), LIBRARY.format(name))

    @staticmethod
    def write(path, text):
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as stream:
            stream.write(text)

    def run_on(self, text, *options, **others):
        """Runs a manual, and others beside it whose names have __ for a slash; gives the status and what is said."""
        self.write(os.path.join(self.root, "README.md"), text)
        for name, content in others.items():
            self.write(os.path.join(self.root, name.replace("__", "/") + ".md"), content)
        return self.judgement("README.md", "--prefix", self.prefix, *options)

    def judgement(self, *arguments):
        with contextlib.redirect_stdout(io.StringIO()) as said:
            status = manuals_test.main([self.program, "--root", self.root, *arguments])
        return status, said.getvalue()

    def sound(self, text, *options, **others):
        status, said = self.run_on(text, *options, **others)
        self.assertEqual(status, 0, said)
        return said

    def faulty(self, text, line, message, *options, **others):
        status, said = self.run_on(text, *options, **others)
        self.assertEqual(status, 1, said)
        self.assertIn(f"README.md:{line}: {message}", said)
        self.assertIn(" 1 faults, ", said)  # this one alone
        return said


class Blocks(Planted):
    def test_a_wrong_status(self):
        self.sound(block("sh", "earthtop say hello"))
        self.faulty("\n" + block("sh", "earthtop say hello\nearthtop nonsense"), 2,
                    "status 2 instead of 0, from line 4: earthtop nonsense")
        self.faulty(block("sh", "false | true"), 1, "status 1 instead of 0")
        self.faulty(block("sh", "echo $undefined"), 1, "status 1 instead of 0")
        self.sound(block("sh", "earthtop nonsense", "status 2"))
        self.faulty(block("sh", "earthtop say hello", "status 2"), 2, "status 0 instead of 2")

    def test_time(self):
        self.faulty(block("sh", "sleep 30"), 1, "takes more than 0.2 s", "--timeout", "0.2")

    def test_shown_output(self):
        said = block("sh", "earthtop say 'one  1' two; earthtop nonsense || true")
        self.sound(said + "Text.\n" + block("text", "one 1\n...\nwhat is nonsense?"))
        self.faulty(said + block("text", "one 2"), 4, "not printed, or not in this order: one 2")
        self.faulty(said + block("text", "two\none 1"), 4, "not printed, or not in this order: one 1")
        self.faulty(block("text", "one 1"), 1, "nothing was printed before")
        self.assertIn("README.md:5: a status is expected", self.run_on(block("sh", "earthtop say a") + block("text", "b", "status 1"))[1])

    def test_blocks_share_files_but_manuals_do_not(self):
        self.sound(block("sh", "ls other.md; earthtop say 1 > made") + block("sh", "cat made") + block("text", "1"), other="# Other\n")
        self.faulty(block("sh", "cat made"), 1, "status 1")
        self.sound(block("json", '{ "body": 1 }', "file: my/top.json") + block("sh", "earthtop check my/top.json"))

    def test_environment(self):
        home = os.environ.get("HOME", "/")
        self.faulty(block("sh", "earthtop width") + block("text", f"100 1 {home}"), 4, f"not printed, or not in this order: 100 1 {home}")

        said = self.faulty(block("sh", "sudo true"), 1, "status 1 instead of 0")
        self.assertIn("sudo changes the machine", said)

    def test_json(self):
        self.sound(block("json", '{ "body": 1 }'))
        self.faulty(block("json", '{ "boby": 1 }'), 1, "status 1 instead of 0")
        self.sound(block("json", '{ "boby": 1 }', "status 1"))
        self.faulty(block("json", '"contact": { }'), 1, "not a JSON document")
        self.sound(block("json", '"contact": { }', "not run: a fragment"))
        self.faulty(block("json", '{ "body": 1 }', "not run: a fragment"), 2, "is marked as a fragment, but it is complete")
        self.sound(block("json", '{ "axes": [], "base": "x.json" }'))
        self.faulty(block("json", '{ "axes": [] }'), 1, "status 1 instead of 0")

    def test_cpp_and_cmake(self):
        program = '#include <cstdio>\nint main() { std::puts("spun"); }'
        lists = "cmake_minimum_required(VERSION 3.20)\nproject(app LANGUAGES NONE)\nfile(READ app.cpp text)"
        said = self.sound(block("cpp", program) + block("text", "spun") + block("cmake", lists))
        self.assertIn("README.md: 2 run, 1 checked, 0 not run\n", said)
        self.faulty(block("cpp", "int main() { return no_such_name; }"), 1, "does not compile")
        self.faulty(block("cpp", "int main() { return 3; }"), 1, "status 3 instead of 0")
        self.faulty(block("cpp", "auto top = read();"), 1, "is not complete; a fragment needs a mark")
        self.faulty(block("cpp", "int main() {}", "not run: a fragment"), 2, "is marked as a fragment, but it is complete")
        self.faulty(block("cmake", lists), 1, "status 1")
        self.faulty(block("cmake", "find_package(earthtop)"), 1, "is not complete; a fragment needs a mark")

    def test_python(self):
        session = block("python", ">>> a = 2\n>>> a + 1\n3") + block("python", "print(a * 2)") + block("text", "4")
        self.assertIn("README.md: 2 run, 1 checked", self.sound(session, "--python", self.root))
        self.assertIn("lines 1, 6: python, not run: the tests of the Python package run it", self.sound(session))
        self.faulty("\n" + block("python", ">>> 1 + 1\n3"), 2, "fails in Python", "--python", self.root)
        self.assertIn('"README.md", line 2', self.faulty(block("python", "1 / 0"), 1, "fails in Python", "--python", self.root))

    def test_nothing_is_silently_unchecked(self):
        for language in ("", "console", "csv"):
            self.faulty(block(language, "earthtop"), 1, f"nothing checks a block of {language or 'no language'}")
            said = self.sound(block(language, "earthtop", "not run: needs a cluster"))
            self.assertIn(f"  line 2: {language or 'no language'}, not run: needs a cluster\n", said)
        self.faulty("Text:\n\n    earthtop\n", 3, "nothing checks a block of no language")
        self.sound("Text:\n\n<!-- not run: a formula -->\n    a = [b](c)\n\n    d\n")
        self.sound("- A list\n\n    goes on.\n")
        self.faulty("Text.\n```sh\nearthtop say 1\n", 3, "a block has no end")

    def test_marks(self):
        for mark in ("not run", "not run:", "not run: slow"):
            self.faulty(block("sh", "exit 1", mark), 1, "`not run` must say why")
        self.faulty("<!-- not run: needs a cluster -->\n\n" + block("sh", "true"), 1, "no block follows this mark")
        self.faulty(block("sh", "true", "stauts 2"), 1, "not a mark of a block: stauts 2")
        said = self.sound(block("sh", "exit 1", "not run: takes 20 minutes") + block("text", "result"))
        self.assertIn("README.md: 0 run, 0 checked, 2 not run\n  line 2: sh, not run: takes 20 minutes\n  line 5: text, not run: as ", said)

    def test_placeholders(self):
        self.faulty("# Speed\n\nPARTS\n", 3, "a placeholder was left: PARTS")
        self.faulty("# Speed\nA toy top: TBD ms.\n", 2, "a placeholder was left: TBD")
        self.sound("# GPL\n\nThe GPL\n" + block("text", "PARTS", "not run: a picture"))

    def test_list(self):
        said = self.sound(block("sh", "exit 1") + block("text", "no") + block("sh", "exit 1", "not run: needs a cluster") * 2, "--list")
        self.assertEqual(said, "README.md: 1 run, 1 checked, 2 not run\n  lines 8, 12: sh, not run: needs a cluster\n")

    def test_all_manuals(self):
        self.write(os.path.join(self.root, "room", "README.md"), block("sh", "exit 1"))
        self.write(os.path.join(self.root, ".github", "CHANGELOG.md"), block("sh", "exit 1") + "[a](b)\n")
        status, said = self.judgement("--jobs", "2")
        self.assertEqual(status, 1)
        self.assertIn("room/README.md:1: status 1 instead of 0", said)
        self.assertIn(".github/CHANGELOG.md:4: dead link", said)
        self.assertIn("2 manuals, 2 faults", said)


class Tables(Planted):
    STALE = "# A\n\n<!-- made by: earthtop schema -->\n\n| key | meaning |\n\n<!-- end -->\n\nText.\n"

    def test_a_stale_table(self):
        self.faulty(self.STALE, 3, "is not what is printed now, --write puts it right: earthtop schema")
        self.sound(self.STALE, "--write")
        with open(os.path.join(self.root, "README.md"), encoding="utf-8") as stream:
            written = stream.read()
        self.assertEqual(written, self.STALE.replace("meaning |\n", "meaning |\n| --- | --- |\n| mass_kg | mass |\n"))
        self.sound(written)
        self.faulty(written.replace("| mass_kg | mass |\n", ""), 3, "is not what is printed now")
        self.faulty(written.replace("| mass |", "| mass  |"), 3, "is not what is printed now")

    def test_a_block(self):
        self.sound("<!-- made by: earthtop say 1 2 -->\n" + block("text", "1\n2") + "<!-- end -->\n")
        self.faulty("<!-- made by: earthtop say 1 2 -->\n" + block("text", "1\n3") + "<!-- end -->\n", 1, "is not what is printed")

    def test_marks(self):
        self.faulty("<!-- made by: earthtop nonsense -->\n<!-- end -->\n", 1, "status 2 instead of 0")
        self.faulty("<!-- made by: earthtop schema -->\n| key | meaning |\n", 1, "the table has no end")
        self.faulty("<!-- end -->\n", 1, "an `end` without `made by`")
        self.sound("<!-- not run: takes an hour -->\n<!-- made by: earthtop nonsense -->\n<!-- end -->\n")


class Links(Planted):
    def test_dead_links(self):
        other = "# What is it?\n\n## Ω² and `drift_axis_rad`\n\n## What is it?\n\n```sh\n# no heading\n```\n<a name=\"here\"></a>\n"
        alive = ("# One\n[a](#one) [b](room/other.md) [c](room/other.md#what-is-it-1) [d](room/other.md#ω-and-drift_axis_rad)\n"
                 "[e](room) [f](https://example.org/#x) [g](/room/other.md#here) ![h](README.md)\n`[i](none)`\n<!-- [j](none) -->\n")
        self.sound(alive, room__other=other)
        for link, message in (("none.md", "file"), ("#two", "heading"), ("room/other.md#no-heading", "heading"),
                              ("room/other.md#what-is-it-2", "heading"), ("room#x", "heading"), ("../../none", "file")):
            self.faulty(alive + f"A [link\nto]({link}).\n", 7, f"dead link, there is no such {message}: {link}", room__other=other)
        self.faulty(alive + "[x]: none.md\n", 6, "dead link", room__other=other)
        self.faulty(alive + '<img src="none.svg">\n', 6, "dead link", room__other=other)

    def test_titles_of_scenarios(self):
        row = "| case | what it is |\n| --- | --- |\n| [`a`](room/other.json) | A top |\n"
        self.write(os.path.join(self.root, "room", "other.json"), '{ "title": "A top", "finding": "It drifts." }')
        self.sound(row)
        self.sound(row.replace("A top", "It drifts."))
        self.faulty(row.replace("A top", "A tip"), 3, "room/other.json says of itself: A top / It drifts.")
        self.sound(row.replace("A top", "A tip").replace("what it is", "more"))

    def test_slugs(self):
        for heading, anchor in (("Effects, and the Earth's rate", "effects-and-the-earths-rate"), ("C++ & Python", "c--python"),
                                ("A – b", "a--b"), ("`run --partial`", "run---partial"), ("I₁ = I₂", "i--i"),
                                ("The *emphasised* _one_ `_kept_`", "the-emphasised-one-_kept_"), ("[Text](link.md) 2.5 s", "text-25-s"),
                                ("Über Größe", "über-größe"), ("snake_case and __bold__", "snake_case-and-bold")):
            self.assertEqual(manual.slug(heading), anchor)
        text = "Title\n=====\n\nPart\n---\n\n| a |\n|---|\n\n## Part\n## Part ##\n"
        self.assertEqual(manual.Manual(text).anchors(), {"title", "part", "part-1", "part-2"})


class Shown(unittest.TestCase):
    PRINTED = "Drift after 60 s\n  axis   1.5e-04 rad\nA long sentence that\n  the program has broken\nhere.\nEnd 2\n"

    def test_sound(self):
        for shown in ("Drift after 60 s\naxis 1.5e-04   rad", "...\nEnd 2\n...", "\nA long sentence that the program has broken here.",
                      "A long\nsentence that the\nprogram has broken here.\nEnd 2", "", "here.", "Drift after 60 s\nEnd 2"):
            self.assertIsNone(missing_line(shown, self.PRINTED), shown)

    def test_faulty(self):
        for shown, line in (("axis 1.5e-04", "axis 1.5e-04"), ("1.5e-04 rad", "1.5e-04 rad"), ("End 2\nhere.", "here."),
                            ("A long sentence that the program", "A long sentence that the program"), ("End 2\nEnd 2", "End 2"),
                            ("A long\n...\nsentence that", "A long"), ("axis 1.5e-04 rad\nEnd", "End"), ("drift after 60 s",) * 2):
            self.assertEqual(missing_line(shown, self.PRINTED), line)


if __name__ == "__main__":
    unittest.main()
