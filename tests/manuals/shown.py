# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares what a manual shows of an output with the output."""


def missing_line(shown, printed):
    """The first line that is shown and was not printed after the one before it; None if there is none.

    Runs of white space count as one blank, empty lines and lines that are "..." as nothing. Lines that follow one another may be
    broken differently: as many lines together must then be as many whole lines of the output.
    """
    words, starts, ends = [], set(), set()
    for line in printed.replace("\r", "\n").splitlines():
        if line.split():
            starts.add(len(words))
            words += line.split()
            ends.add(len(words))
    places = {}  # where an output line begins with this word
    for start in sorted(starts):
        places.setdefault(words[start], []).append(start)

    def end_of(group, after):
        """Where the first whole lines of the output, from there on, end that are these words; None if there are none."""
        for start in places.get(group[0], ()):
            end = start + len(group)
            if start >= after and end in ends and words[start:end] == group:
                return end
        return None

    groups = [[]]  # of lines without "..." between them
    for line in shown.splitlines():
        if line.strip() == "...":
            groups.append([])
        elif line.strip():
            groups[-1].append(line)
    at = 0
    for group in groups:
        # reached[i]: the earliest word after the first i lines of the group
        reached = [at] + [None] * len(group)
        for first in range(len(group)):
            if reached[first] is None:
                continue
            joined = []
            for last in range(first, min(first + 20, len(group))):
                joined = joined + group[last].split()
                end = end_of(joined, reached[first])
                if end is not None and (reached[last + 1] is None or end < reached[last + 1]):
                    reached[last + 1] = end
        if reached[-1] is None:
            return group[max(i for i, end in enumerate(reached) if end is not None)]
        at = reached[-1]
    return None
