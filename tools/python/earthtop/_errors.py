# SPDX-License-Identifier: GPL-3.0-or-later
"""The exceptions of the package."""

from __future__ import annotations

import builtins
import warnings
from dataclasses import dataclass
from typing import Any, Iterable, Optional, Tuple, Union


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


class UnverifiedWarning(UserWarning):
    """What was read has no checksums, as what earthtop 1.0 wrote may have none: damage to it would go unnoticed."""


class ArithmeticError(Error, builtins.ArithmeticError):
    """The processor does not compute as the results need it."""


def warn(notes: Iterable[str]) -> None:
    """Warns the caller of the package's function of what could not be verified."""
    for note in notes:
        warnings.warn(note, UnverifiedWarning, stacklevel=3)


def refuse(message: str, pointer: str = "") -> ScenarioError:
    """The exception for an argument that is refused in Python already."""
    text = f"{pointer}: {message}" if pointer else message
    return ScenarioError([Finding("", None, None, pointer, message, text)])
