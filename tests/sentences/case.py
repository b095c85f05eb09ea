# SPDX-License-Identifier: GPL-3.0-or-later
"""A case: commands, what they must say, and a change after which they must not say it."""
import dataclasses
import html
import json
import os
import re
import shlex
import subprocess
import tempfile
from typing import Callable, Dict, List, Optional, Union

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


@dataclasses.dataclass
class Case:
    """One or several sentences that commands print.

    commands   lines with the program's arguments, run one after the other in an empty directory; the last one is looked at. The
               scenario lies there as s.json, the scenarios of the repository as scenarios/; a line that ends in "> FILE" keeps in
               the file what is printed
    says       what it prints, as a reader reads it: lines joined, tags, styles and scripts of pages left out
    scenario   the name of a shipped scenario, or a whole one; None: there is no s.json
    set        changes of it, by JSON pointer; None leaves a key out
    unless     further changes, after which none of the sentences is printed (whatever the status is then): the sentence is said
               because of what they change
    status     of the last command
    files      further files, by name
    page       a file that the last command writes, which is looked at, too
    holds      gets the text and must return true: the numbers in the sentence are those of the scenario
    environment  variables
    """
    commands: Union[str, List[str]]
    says: Union[str, List[str]]
    scenario: Union[str, Dict, None] = "toy-top"
    set: Dict = dataclasses.field(default_factory=dict)
    unless: Optional[Dict] = None
    status: int = 0
    files: Dict[str, Union[str, bytes]] = dataclasses.field(default_factory=dict)
    page: Optional[str] = None
    holds: Optional[Callable[[str], bool]] = None
    environment: Dict[str, str] = dataclasses.field(default_factory=dict)
    stdin: Optional[str] = None

    def expected(self):
        return [self.says] if isinstance(self.says, str) else self.says

    def faults(self, program):
        """What is wrong, in sentences."""
        status, text = self._run(program, self.set)
        found = [] if status == self.status else [f"status {status} instead of {self.status}"]
        found += [f"not said: {one}" for one in self.expected() if one not in text]
        found += [f"two ends of a sentence: {one}" for one in re.findall(r"[^.]{0,40}[?!]\.(?!\S)", text)]
        if not found and self.holds and not self.holds(text):
            found.append("the numbers do not hold")
        if self.unless is not None:
            _, other = self._run(program, {**self.set, **self.unless})
            found += [f"said after {self.unless}, too: {one}" for one in self.expected() if one in other]
            text += "\n--- after the change ---\n" + other
        return found, text

    def _run(self, program, changes):
        with tempfile.TemporaryDirectory() as directory:
            os.symlink(os.path.join(ROOT, "scenarios"), os.path.join(directory, "scenarios"))
            if self.scenario is not None:
                with open(os.path.join(directory, "s.json"), "w", encoding="utf-8") as file:
                    json.dump(changed(self.scenario, changes), file)
            for name, content in self.files.items():
                os.makedirs(os.path.dirname(os.path.join(directory, name)) or directory, exist_ok=True)
                with open(os.path.join(directory, name), "wb") as file:
                    file.write(content if isinstance(content, bytes) else content.encode())
            done = None
            for line in [self.commands] if isinstance(self.commands, str) else self.commands:
                line, _, kept = line.partition(" > ")
                done = subprocess.run([program, *shlex.split(line)], cwd=directory, input=self.stdin or "", text=True,
                                      stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=600, check=False,
                                      env={**os.environ, "COLUMNS": "100", **self.environment})
                if kept:
                    with open(os.path.join(directory, kept), "w", encoding="utf-8") as file:
                        file.write(done.stdout)
            text = done.stdout
            if self.page and os.path.exists(os.path.join(directory, self.page)):
                with open(os.path.join(directory, self.page), encoding="utf-8") as file:
                    text += "\n" + html.unescape(re.sub(r"<(style|script)\b.*?</\1>|<[^>]*>", "", file.read(), flags=re.S))
            return done.returncode, re.sub(r"\s+", " ", text)


def changed(scenario, changes):
    """A shipped scenario or a whole one with other values at some JSON pointers."""
    if isinstance(scenario, str):
        with open(os.path.join(ROOT, "scenarios", scenario + ".json"), encoding="utf-8") as file:
            scenario = json.load(file)
    result = json.loads(json.dumps(scenario))
    for pointer, value in json.loads(json.dumps(changes)).items():  # copies: a later change may be within an earlier one
        *way, last = pointer.split("/")[1:]
        node = result
        for key in way:
            node = node[int(key)] if isinstance(node, list) else node.setdefault(key, {})
        if isinstance(node, list):
            node[int(last)] = value
        elif value is None:
            node.pop(last, None)
        else:
            node[last] = value
    return result
