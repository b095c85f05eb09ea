# SPDX-License-Identifier: GPL-3.0-or-later
"""The exceptions of the package."""

from __future__ import annotations

import builtins
import errno
import os
import re
import sys
import warnings
from dataclasses import dataclass
from types import FrameType
from typing import Any, Iterable, Optional, Sequence, Tuple, Union


class Error(Exception):
    """The base of all exceptions that earthtop raises by itself.

    Numerical trouble is no exception: it is the status of the result, as in the program.
    """


@dataclass(frozen=True)
class Finding:
    """One thing that is wrong, or looks wrong, in a text."""

    path: str  #: the file, or what the text was called; empty if it had no name
    line: Optional[int]  #: from 1; None if the place is not known
    column: Optional[int]  #: from 1; None if the place is not known
    pointer: str  #: JSON pointer of the key; empty for the whole document
    message: str  #: what is wrong, and what is allowed
    text: str  #: all of it in one line, as the program prints it

    def __str__(self) -> str:
        return self.text


class ScenarioError(Error, ValueError):
    """Input was refused; ``findings`` lists everything that is wrong with it."""

    def __init__(self, findings: Iterable[Union[Finding, Tuple[Any, ...]]]) -> None:
        self.findings = tuple(one if isinstance(one, Finding) else Finding(*one) for one in findings)
        super().__init__("\n".join(str(one) for one in self.findings))

    def __reduce__(self) -> Tuple[Any, ...]:
        return type(self), (self.findings,)


class FileError(Error, OSError):
    """A file cannot be read or written although the request was right."""

    def __init__(self, path: str, reason: str) -> None:
        super().__init__(f"{path}: {reason}")
        self.path = path
        self.reason = reason

    def __reduce__(self) -> Tuple[Any, ...]:
        return type(self), (self.path, self.reason)


class MissingFileError(FileError, ScenarioError, FileNotFoundError):
    """A file or directory that was to be read does not exist. It is a ScenarioError, too, which it was in earthtop 1.0."""

    def __init__(self, findings: Iterable[Union[Finding, Tuple[Any, ...]]]) -> None:
        self.findings = tuple(one if isinstance(one, Finding) else Finding(*one) for one in findings)
        OSError.__init__(self, "\n".join(str(one) for one in self.findings))
        self.path = self.filename = self.findings[0].path
        self.reason = self.findings[0].message
        self.errno = errno.ENOENT

    def __str__(self) -> str:
        return str(self.args[0])

    def __reduce__(self) -> Tuple[Any, ...]:
        return type(self), (self.findings,)


class UnverifiedWarning(UserWarning):
    """What was read has no checksums, as what earthtop 1.0 wrote may have none: damage to it would go unnoticed."""


class ArithmeticError(Error, builtins.ArithmeticError):
    """The processor does not compute as the results need it."""


_PACKAGE = os.path.dirname(__file__)


def _call_from_outside() -> Tuple[int, FrameType]:
    """The frame outside the package that called it, and how many frames it lies above the function that asks."""
    level, frame = 1, sys._getframe(2)
    while frame.f_back is not None and os.path.dirname(frame.f_code.co_filename) == _PACKAGE:
        level, frame = level + 1, frame.f_back
    return level, frame


def warn(notes: Iterable[str]) -> None:
    """Warns of what could not be verified, at the line outside the package that called it."""
    level, _ = _call_from_outside()
    for note in notes:
        warnings.warn(note, UnverifiedWarning, stacklevel=level + 1)


def refuse(message: str, pointer: str = "") -> ScenarioError:
    """The exception for an argument that is refused in Python already."""
    text = f"{pointer}: {message}" if pointer else message
    return ScenarioError([Finding("", None, None, pointer, message, text)])


# The words of the package ---------------------------------------------------------------------------------------------------

_ARGUMENTS = {
    "--allow-change": "may_change",
    "--allow-missing": "may_lack_rows=True",
    "--correlation-time": "correlation_time_s",
    "--every": "every_s",
    "--force": "force=True",
    "--free-start": "free_start=True",
    "--keep-going": "keep_going=True",
    "--nuisance": "nuisance",
    "--priors": "priors=True",
    "--repair": "repair=True",
    "--retry-failed": "retry_failed=True",
    "--set": "changes",
    "--sigma": "sigma",
    "--time-offset": "time_offset_s",
    "--until": "until_s",
    "--write-data": "simulate_measurement",
}
_OPTION = re.compile(r"(?<![\w-])--[a-z]+(-[a-z]+)*")
_COMMAND = re.compile(r"(`?)\bearthtop (bench|check|compare|explain|fit|measure|plan|report|run|study)( --[a-z-]+)?\1(?![\w-]|\.\w)")
_STANDARD_INPUT = ", or give '-' for standard input"


def as_arguments(text: str) -> str:
    """A sentence of the program in the words of the package: its options and commands become arguments and functions."""
    text = text.replace(_STANDARD_INPUT, "")
    text = _COMMAND.sub(lambda found: f"{found[1]}earthtop.{found[2]}{found[1]}", text)
    return _OPTION.sub(lambda found: _ARGUMENTS.get(found[0], found[0][2:].replace("-", "_")), text)


def in_python(one: Union[Finding, Tuple[Any, ...]]) -> Finding:
    """A finding in the words of the package. Names of files stay as they are."""
    path, line, column, pointer, message, text = one if isinstance(one, tuple) else (
        one.path, one.line, one.column, one.pointer, one.message, one.text)
    head = text[:-len(message)] if message and text.endswith(message) else ""
    shown, said = as_arguments(pointer), as_arguments(message)
    if pointer.startswith("--"):
        head = head.replace(pointer, shown)
    return Finding(path, line, column, shown, said, head + said if head else as_arguments(text))


def of_scenario(findings: Iterable[Tuple[Any, ...]], has_changes: bool) -> Tuple[Finding, ...]:
    """The findings of a scenario. Those of one with changes made in Python are at the line that asked for them, since the line of its
    file that they would name may say something else."""
    said = tuple(in_python(one) for one in findings)
    if not has_changes:
        return said
    _, frame = _call_from_outside()
    path, line = frame.f_code.co_filename, frame.f_lineno
    kind = re.compile("(error|warning): ")

    def here(one: Finding) -> Finding:
        found = kind.search(one.text)
        return Finding(path, line, None, one.pointer, one.message, f"{path}:{line}: {one.text[found.start():] if found else one.text}")

    return tuple(map(here, said))


_MISSING = re.compile("^there is no such |^holds no results: it has no summary.json|^No such file or directory$")


def refused(findings: Sequence[Tuple[Any, ...]]) -> ScenarioError:
    """The exception for input that the library refuses; a file that is missing is a FileError as well."""
    said = [in_python(one) for one in findings]
    is_missing = len(said) == 1 and said[0].path and not said[0].pointer and _MISSING.match(said[0].message)
    return MissingFileError(said) if is_missing else ScenarioError(said)


def file_failed(path: str, reason: str) -> FileError:
    """The exception for a file that the library could not read or write."""
    if reason == os.strerror(errno.ENOENT):
        return MissingFileError([Finding(path, None, None, "", reason, f"{path}: {reason}")])
    return FileError(path, as_arguments(reason))
