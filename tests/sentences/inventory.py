#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lists every sentence that run, check, explain, compare, plan and the pages can print, from the sources, each with the test that
holds it. Fails where there is one without a test.

A sentence is a string literal of three words or more in one of the rooms below, adjacent literals joined. A test holds it that quotes
three words of it in a row which no other sentence has, or a whole part of it between two numbers where it has no such three.
Texts of help and of keys are not among them: tables of the manuals, which are compared with what the program prints, hold these.
"""
import argparse
import collections
import glob
import html
import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
ROOMS = ["src/input", "src/scenario", "src/scene", "src/budget", "src/run", "src/results", "src/measure", "src/plan", "src/compare",
         "src/report"]
TEXTS = ["check", "compare", "explain", "plan", "report", "run", "*_text"]  # of tools/earthtop
NO_SENTENCES = ["src/compare/fields.cpp", "src/results/meanings.cpp", "src/scenario/fields.cpp", "src/scenario/schema.cpp", "src/results/columns.cpp"]  # meanings of keys and columns
QUOTED = ("*.cpp", "*.hpp", "*.py", "*.sh", "*.mjs", "*.json", "*.txt")
ESCAPES = {"n": "\n", "t": "\t"}


def literals(source):
    """Yields line and text of the C++ string literals of a source, adjacent ones joined."""
    source = re.sub(r"^#include.*$", "", source, flags=re.M)
    source = re.sub(r"static_assert\([^;]*;", lambda found: "\n" * found.group(0).count("\n"), source)
    token = re.compile(r'//[^\n]*|/\*.*?\*/|R"([^(]*)\((.*?)\)\1"|"((?:\\.|[^"\\])*)"|(?<!\w)\'(?:\\.|[^\'\\])+\'|\s+|.', re.S)
    joined, begin = None, 0
    for found in token.finditer(source):
        text = found.group(0)
        if text.startswith('"') or text.startswith('R"'):
            plain = found.group(2)
            if plain is None:
                plain = re.sub(r"\\(.)", lambda one: ESCAPES.get(one.group(1), one.group(1)), found.group(3))
            if joined is None:
                joined, begin = "", found.start()
            joined += plain
        elif joined is not None and not text.isspace() and not text.startswith(("//", "/*")):
            yield source.count("\n", 0, begin) + 1, joined
            joined = None
    if joined is not None:
        yield source.count("\n", 0, begin) + 1, joined


def plain(text):
    """Without escapes, entities and line ends."""
    return re.sub(r"\s+", " ", html.unescape(text.replace("\\n", " ").replace('\\"', '"')))


def words(text):
    return [word for word in text.split(" ") if re.fullmatch(r"[(\"'‘“]?[A-Za-zΩ][A-Za-z'’-]*[,.;:)\"'?]*", word)]


def parts(sentence):
    """What is fixed in a sentence: what stands between numbers and between tags."""
    fixed = re.split(r"\{[^{}]*\}|<[^>]*>", plain(sentence))
    return [part.strip() for part in fixed if len(words(part)) >= 2]


def runs(part):
    """Three words in a row."""
    row = part.split(" ")
    return [" ".join(row[at:at + 3]) for at in range(max(1, len(row) - 2))]


class Sentence:
    def __init__(self, file, line, text):
        self.file, self.line, self.text, self.parts = file, line, text, parts(text)
        self.test = None

    def is_one(self):
        markup = re.search(r"stroke|fill=|class=|xmlns|=>|href|^#|\$schema", self.text)
        return not markup and sum(len(words(part)) for part in self.parts) >= 3


def sentences(root):
    files = [file for room in ROOMS for file in glob.glob(f"{root}/{room}/**/*.?pp", recursive=True)]
    files += [file for name in TEXTS for file in glob.glob(f"{root}/tools/earthtop/{name}.cpp")]
    found = []
    for file in sorted(set(files)):
        name = os.path.relpath(file, root)
        with open(file, encoding="utf-8") as source:
            text = source.read().split("\nVerb describe_")[0]  # what follows is help
        if name not in NO_SENTENCES:
            found += [Sentence(name, line, literal) for line, literal in literals(text)]
    return [sentence for sentence in found if sentence.is_one()]


def quotations(root):
    """What the tests quote: texts by the tests' names."""
    for pattern in QUOTED:
        for file in sorted(glob.glob(f"{root}/tests/**/{pattern}", recursive=True)):
            with open(file, encoding="utf-8", errors="replace") as source:
                text = source.read()
            if file.endswith("pp"):
                text = " \n ".join(literal for _, literal in literals(text))
            elif file.endswith(".py"):
                text = re.sub(r"""["']\s*\n\s*[fr]*["']""", "", re.sub(r"^\s*#.*$", "", text, flags=re.M))
            yield os.path.relpath(file, root), plain(text)
    for file in sorted(glob.glob(f"{root}/**/*.md", recursive=True)):
        if f"{root}/build/" in file:
            continue
        with open(file, encoding="utf-8") as source:
            blocks = re.findall(r"```(?:text|python)\n.*?```", source.read(), re.S)
        if blocks:
            yield f"tests/manuals: {os.path.relpath(file, root)}", plain("\n".join(blocks))


def find_tests(root, found):
    common = collections.Counter()
    for parts_of_one in {tuple(sentence.parts) for sentence in found}:
        common.update({run for part in parts_of_one for run in runs(part)})
    quoted = list(quotations(root))
    for sentence in found:
        own = [run for part in sentence.parts for run in runs(part) if common[run] == 1 and len(run) >= 9]
        sought = own or sentence.parts
        sentence.test = next((test for test, text in quoted if any(run in text for run in sought)), None)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("rooms", nargs="*", help="only sentences of files whose names begin so")
    parser.add_argument("--missing", action="store_true", help="list only those without a test")
    parser.add_argument("--quiet", action="store_true", help="list only those without a test, and say nothing where there are none")
    options = parser.parse_args()
    found = sentences(ROOT)
    find_tests(ROOT, found)
    if options.rooms:
        found = [sentence for sentence in found if sentence.file.startswith(tuple(options.rooms))]
    missing = [sentence for sentence in found if not sentence.test]
    for sentence in missing if options.missing or options.quiet else found:
        print(f"{sentence.file}:{sentence.line}: {plain(sentence.text).strip()!r}: {sentence.test or 'NO TEST'}")
    if not options.quiet or missing:
        print(f"{len(found)} sentences, {len(missing)} without a test")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
