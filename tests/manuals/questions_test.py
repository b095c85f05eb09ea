#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Newcomers' questions find their entries in the manuals by their own words.

Each question is put as somebody asks it who does not know the manual's terms. Among all parts of all manuals - sections, and entries that
begin with a bold sentence - the entry that answers it must be the first by the words that both have, the rarer ones counting more.
"""
import collections
import math
import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
MANUALS = ["README.md", "scenarios/README.md", "tools/README.md", "tools/python/README.md", "tools/peers/README.md", "tests/README.md"]
STOP = set("a an and are as at be but by can do does for from have how i if in is it its me my no not of on or our so than that the there "
           "this to was we what when where which why will with you your".split())
QUESTIONS = [
    ("how can i turn a phone video of a gyroscope into angles", "I filmed my gyroscope with a phone"),
    ("what if the camera was crooked and not level", "My camera was not level"),
    ("the recording's clock runs too fast and started before the release", "The clock of my recording"),
    ("the film starts while the top has already been spinning for a while", "My film starts when the top"),
    ("huge chi-squared, the fit does not converge", "The fit did not converge"),
    ("which standard error should i write beside each reading", "Which standard error do I write"),
    ("is it worth spinning clockwise and anticlockwise", "Why should I spin it clockwise"),
    ("could a toy gyroscope show the rotation of the Earth", "Can a toy gyroscope show"),
    ("words for the result in a thesis", "How do I word the result"),
    ("install on Windows or a Mac", "Does it run on Windows"),
]


def words(text):
    """The words of a text without their endings."""
    found = re.findall(r"[a-z]{2,}", text.lower())
    return [re.sub(r"(ning|ing|ed|es|s|ly)$", "", word) if len(word) > 4 else word for word in found if word not in STOP]


def parts():
    """Title and text of each section and of each entry of the manuals."""
    for manual in MANUALS:
        with open(os.path.join(ROOT, manual), encoding="utf-8") as file:
            text = re.sub(r"```.*?```", "", file.read(), flags=re.S)
        for section in re.split(r"^#+ ", text, flags=re.M):
            title, _, body = section.partition("\n")
            entries = re.findall(r"^- \*\*(.*?)\*\*(.*?)(?=^- \*\*|\Z)", body, flags=re.M | re.S)
            for entry, answer in entries:
                yield f"{manual}: {' '.join(entry.split())}", entry + " " + entry + answer
            yield f"{manual}: {title}", title + " " + re.sub(r"^- \*\*.*", "", body, flags=re.M | re.S)


def ranked(question, collection, rarity, usual):
    """The titles of all parts, the best first (Okapi BM25)."""
    def score(counts):
        length = sum(counts.values())
        return sum(rarity.get(word, 0) * counts[word] * 2.2 / (counts[word] + 1.2 * (0.25 + 0.75 * length / usual))
                   for word in set(words(question)))

    return sorted(collection, key=lambda title: -score(collection[title]))


def main():
    collection = {title: collections.Counter(words(text)) for title, text in parts()}
    having = collections.Counter(word for counts in collection.values() for word in counts)
    rarity = {word: math.log(1 + len(collection) / number) for word, number in having.items()}
    usual = sum(sum(counts.values()) for counts in collection.values()) / len(collection)
    faults = 0
    for question, entry in QUESTIONS:
        best = ranked(question, collection, rarity, usual)
        if entry not in best[0]:
            faults += 1
            print(f"{question}: finds {best[0]}; then {best[1]}; {best[2]}")
    print(f"{len(QUESTIONS)} questions among {len(collection)} parts of the manuals, {faults} do not find their entries")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
