# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads a manual: its code blocks with their marks, the tables that the program makes, its headings and its links.

A mark is a comment on the line before a block:
  <!-- status 2 -->           the status that the commands of the block must end with, instead of 0
  <!-- file: app.cpp -->      the block is also written into this file, for the blocks after it
  <!-- not run: REASON -->    the block is neither run nor checked, for a reason of two words at least
A table that a command prints stands between <!-- made by: COMMAND --> and <!-- end -->.
"""
import dataclasses
import json
import os
import re
import unicodedata
import urllib.parse
from typing import Optional

FENCE = re.compile(r"^( *)(`{3,}|~{3,})[ \t]*([^`]*?)[ \t]*$")
COMMENT = re.compile(r"^\s*<!--\s*(.*?)\s*-->\s*$")
HEADING = re.compile(r"^ {0,3}#{1,6}[ \t]+(.*?)(?:[ \t]+#+)?[ \t]*$")
LINK = re.compile(r"\]\(\s*<?([^)\s>]+)>?(?:\s+[\"'][^)]*)?\)"  # [text](target) and ![text](target)
                  r"|^ {0,3}\[[^\]]+\]:\s*<?([^\s>]+)"  # [name]: target
                  r"|<[^>]*\b(?:href|src)=\"([^\"]+)\"", re.MULTILINE)
NAMED = re.compile(r"<[^>]*\b(?:id|name)=\"([^\"]+)\"")
PLACEHOLDER = re.compile(r"^\s*([A-Z][A-Z_]{2,})\s*$|\b(TODO|TBD|FIXME|XXX)\b")  # what was to be replaced: a word in capitals on a line
CODE_SPAN = re.compile(r"(?<!`)(`+)(?!`)((?:(?!\n\s*\n).)+?)(?<!`)\1(?!`)", re.DOTALL)


@dataclasses.dataclass
class Block:
    """A code block. Lines count from 1; `line` is that of the fence."""
    line: int
    language: str
    text: str = ""
    status: Optional[int] = None
    file: Optional[str] = None
    reason: Optional[str] = None  # why it is not run


@dataclasses.dataclass
class Table:
    """What stands between two marks, made by a command: lines[first:last] of the manual."""
    line: int
    command: str
    first: int = 0
    last: int = 0
    reason: Optional[str] = None
    language = "made by"


class Manual:
    """`parts` are its blocks and tables in their order; `faults` are pairs of a line and what is wrong there."""

    def __init__(self, text):
        self.lines = text.splitlines()
        self.parts, self.faults, self.marks = [], [], []
        self.prose = list(self.lines)  # without blocks, so that what looks like a heading or a link there is none
        self._read()

    def fault(self, line, message):
        self.faults.append((line, message))

    def _read(self):
        table, fence, block, in_list = None, None, None, False
        for at, line in enumerate(self.lines):
            opened, comment = FENCE.match(line), COMMENT.match(line)
            indented = line.startswith("    ")
            if fence:
                self.prose[at] = ""
                if opened and not opened[3] and opened[2].startswith(fence[2]):
                    fence, block = None, None
                elif block:
                    block.text += (line[len(fence[1]):] if not line[:len(fence[1])].strip() else line) + "\n"
                continue
            if block and (indented or not line.strip()):  # code that is only indented, without a fence
                block.text += line[4:] + "\n"
                self.prose[at] = ""
                continue
            block = None
            if opened and not (indented and not in_list):
                self.prose[at], fence = "", opened
                if not table:  # what is in a table is the command's affair
                    block = self._new_block(Block(at + 1, (opened[3].split() or [""])[0].lower()))
            elif comment and comment[1] == "end":
                self._drop_marks()
                if not table:
                    self.fault(at + 1, "an `end` without `made by`")
                else:
                    table.last, table = at, None
            elif comment and comment[1].startswith("made by:"):
                if table:
                    self.fault(at + 1, f"the table of line {table.line} has no end")
                    self.parts.remove(table)
                table = self._new_block(Table(at + 1, comment[1][len("made by:"):].strip(), first=at + 1))
            elif comment:
                self.marks.append((at + 1, comment[1]))
            elif indented and not in_list and not table and (self.marks or at == 0 or not self.lines[at - 1].strip()):
                self.prose[at] = ""
                block = self._new_block(Block(at + 1, "", line[4:] + "\n"))
            else:
                self._drop_marks()
                if re.match(r" {0,3}([-*+]|\d+[.)])\s", line):
                    in_list = True
                elif line.strip() and not line.startswith("  "):
                    in_list = False
        self._drop_marks()
        for at, line in enumerate(self.prose):
            if left := PLACEHOLDER.search(line):
                self.fault(at + 1, f"a placeholder was left: {left[1] or left[2]}")
        if fence:
            self.fault(len(self.lines), "a block has no end")
        if table:
            self.fault(table.line, "the table has no end")
            self.parts.remove(table)

    def _new_block(self, part):
        self._put_marks(part)
        self.parts.append(part)
        return part

    def _put_marks(self, part):
        for line, mark in self.marks:
            if found := re.fullmatch(r"not run(?::\s*(.*))?", mark):
                part.reason = found[1] or ""
                if len(part.reason.split()) < 2:
                    self.fault(line, "`not run` must say why, in two words at least")
            elif isinstance(part, Block) and (found := re.fullmatch(r"status (\d+)", mark)):
                part.status = int(found[1])
            elif isinstance(part, Block) and (found := re.fullmatch(r"file: (\S+)", mark)):
                part.file = found[1]
            else:
                self.fault(line, f"not a mark of a {'block' if isinstance(part, Block) else 'table'}: {mark}")
        self.marks = []

    def _drop_marks(self):
        for line, mark in self.marks:
            if re.match(r"(not run|status|file)\b", mark):
                self.fault(line, f"no block follows this mark: {mark}")
        self.marks = []

    def anchors(self):
        """The names that links can have after #, as GitHub makes them."""
        found, seen = set(), {}
        for at, line in enumerate(self.prose):
            found.update(NAMED.findall(line))
            heading = HEADING.match(line)
            under = at + 1 < len(self.prose) and re.fullmatch(r" {0,3}(=+|-{2,})\s*", self.prose[at + 1])
            if heading or (under and line.strip() and not line.startswith(("|", ">", "-", "*", "    "))):
                name = slug(heading[1] if heading else line.strip())
                while (anchor := f"{name}-{seen[name]}" if seen.get(name) else name) in found:
                    seen[name] = seen.get(name, 0) + 1
                found.add(anchor)
                seen[name] = seen.get(name, 0) + 1
        return found

    def links(self):
        """Pairs of a line and the target of a link there."""
        text = re.sub(r"<!--.*?-->", _only_line_breaks, "\n".join(self.prose), flags=re.DOTALL)
        text = CODE_SPAN.sub(_only_line_breaks, text)
        return [(text.count("\n", 0, found.start(found.lastindex)) + 1, found[found.lastindex]) for found in LINK.finditer(text)]


def _only_line_breaks(found):
    return "\n" * found[0].count("\n")


def slug(heading):
    """The anchor that GitHub gives to the first heading with this text."""
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    spans = re.split(r"(`+[^`]+`+)", text)  # in code nothing is emphasised
    for i in range(0, len(spans), 2):
        plain = re.sub(r"</?\w[^>]*>", "", spans[i])
        spans[i] = re.sub(r"(?<!\w)(_{1,2})(?=\S)(.+?)(?<=\S)\1(?!\w)", r"\2", plain)
    return "".join("-" if c == " " else c for c in "".join(spans).strip().lower() if c in " -" or _in_word(c))


def _in_word(c):
    return unicodedata.category(c) in ("Lu", "Ll", "Lt", "Lm", "Lo", "Nl", "Nd", "Pc", "Mn", "Mc", "Me")


def dead_links(path, root):
    """Pairs of a line of the manual root/path and what is wrong with a link there. Other hosts are not asked."""
    faults, manuals = [], {}

    def manual(name):
        if name not in manuals:
            with open(os.path.join(root, name), encoding="utf-8") as stream:
                manuals[name] = Manual(stream.read())
        return manuals[name]

    for line, target in manual(path).links():
        if re.match(r"[a-z][a-z0-9+.-]*:|//", target):
            continue
        file, _, anchor = urllib.parse.unquote(target).partition("#")
        there = path
        if file:
            there = file.lstrip("/") if file.startswith("/") else os.path.join(os.path.dirname(path), file)
            there = os.path.normpath(there)
        full = os.path.join(root, there)
        if there.startswith("..") or not os.path.exists(full):
            faults.append((line, f"dead link, there is no such file: {target}"))
            continue
        if anchor and os.path.isdir(full):
            there = os.path.normpath(os.path.join(there, "README.md"))
        if anchor and there.endswith(".md") and (not os.path.isfile(os.path.join(root, there))
                                                 or anchor not in manual(there).anchors()):
            faults.append((line, f"dead link, there is no such heading: {target}"))
    return faults


def other_titles(path, root):
    """Pairs of a line of the manual root/path, where a table of scenarios or studies begins a row with a link to one, and what that
    file says of itself if the next cell says something else: it must be the file's title or finding."""
    faults, judged = [], False
    with open(os.path.join(root, path), encoding="utf-8") as stream:
        for line, row in enumerate(stream, 1):
            if not row.startswith("|"):
                judged = False
            elif re.match(r"\| \w+ \| (what it is|what it shows|finding) \|", row):
                judged = True
            found = judged and re.match(r"\| \[`[^`]+`\]\(([^)]+[.]json)\) \| ([^|]*) \|", row)
            file = found and os.path.normpath(os.path.join(root, os.path.dirname(path), found[1]))
            if not found or not os.path.isfile(file):
                continue
            with open(file, encoding="utf-8") as told:
                document = json.load(told)
            says = [document[key] for key in ("title", "finding") if key in document]
            if found[2] not in says:
                faults.append((line, f"{found[1]} says of itself: {' / '.join(says)}"))
    return faults
