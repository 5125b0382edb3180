"""What goes wrong, as Python says it."""

from __future__ import annotations

import json
import re
from typing import List, NamedTuple, Optional

_SETTING = r"--set (?:'([^']+)'|([^\s,;`'\"]*[^\s,;:.)`'\"]))"
_SETTINGS = re.compile(rf"{_SETTING}(?: {_SETTING})*")


def in_python(message: str) -> str:
    """What the command line advises, as arguments: `--set step=null --set method=rk4` is step=None, method="rk4"; with keys of sections
    in set={"video.fps": 120}."""
    def replaced(found: "re.Match[str]") -> str:
        pairs = [(quoted or plain).partition("=")[::2] for quoted, plain in re.findall(_SETTING, found.group())]
        if all(key.isidentifier() for key, _ in pairs):
            return ", ".join(f"{key}={_literal(value)}" for key, value in pairs)
        return "set={" + ", ".join(f"{json.dumps(key)}: {_literal(value)}" for key, value in pairs) + "}"

    return _SETTINGS.sub(replaced, re.sub(r"^-o ", "", message))


def _literal(text: str) -> str:
    if text in ("", "null"):
        return "None"
    try:
        value = json.loads(text)
    except ValueError:
        return json.dumps(text)
    return repr(value)


class Problem(NamedTuple):
    message: str  # what is wrong and what to do about it
    file: str  # "" where it is in no file
    line: int  # from 1; 0 where unknown
    column: int


class Error(Exception):
    """What the command line would end with.

    code: its exit code: 2 usage, 3 bad input, 4 no renderer or codec, 5 numerical failure, 6 file, 7 limit exceeded.
    problems: every problem that was found, a Problem each. file, line: of the first one.
    """

    def __init__(self, code: int, problems: List[Problem]):
        self.code = code
        self.problems = [problem._replace(message=in_python(problem.message)) for problem in map(Problem._make, problems)]
        super().__init__("\n".join(_text(problem) for problem in self.problems))

    def __reduce__(self):
        return (type(self), (self.code, self.problems))

    @property
    def file(self) -> str:
        """Of the first problem; "" where it is in no file."""
        return self.problems[0].file if self.problems else ""

    @property
    def line(self) -> int:
        """Of the first problem, from 1; 0 where unknown."""
        return self.problems[0].line if self.problems else 0

    def without_lines_of(self, file: str) -> "Error":
        """The same, where `file` is a text that its caller never saw."""
        return Error(self.code, [problem._replace(line=0, column=0) if problem.file == file else problem
                                 for problem in self.problems])


class RunWarning(UserWarning):
    """What speaks against a run that came to its end, was changed of its scene, or is not shown of it; or that a file which is not
    there was taken for the one of that name that comes with chainreel."""


def _place(file: str) -> str:
    """A file, or the argument that the command line calls --set key=value."""
    if not file.startswith("--set "):
        return file
    key, _, value = file[len("--set "):].partition("=")
    return f"{key}={_literal(value)}"


def _text(problem: Problem) -> str:
    place: Optional[str] = _place(problem.file)
    for number in (problem.line, problem.column):
        if number:
            place = f"{place}:{number}"
    return f"{place}: {problem.message}" if place else problem.message
