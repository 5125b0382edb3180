"""Keys and values of scenes, from Python to the text that the reader takes."""

from __future__ import annotations

import json
import os
import warnings
from typing import Any, List, Mapping

from . import _native
from ._errors import RunWarning


def found(named: str, level: int = 3) -> str:
    """The file of that name, or that which comes with chainreel: what looks like a file here and is none is said to who called us."""
    file = _native.found_file(named)
    note = _native.found_elsewhere(named, file)
    if note:
        warnings.warn(note, RunWarning, stacklevel=level)
    return file


def _plain(value: Any) -> Any:
    if hasattr(value, "tolist"):  # numpy's arrays and numbers
        return value.tolist()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, (set, frozenset)):
        raise TypeError("a set has no order: give a list")
    raise TypeError(f"a scene takes numbers, texts, lists and dicts, not {type(value).__name__}")


def text_of(value: Any) -> str:
    """The value as JSON, which YAML reads, too."""
    try:
        return json.dumps(value, default=_plain, allow_nan=False, ensure_ascii=False)
    except ValueError as error:
        raise ValueError("a scene takes finite numbers only") from error


def overrides_of(keys: Mapping[str, Any]) -> List[str]:
    """`duration=2`, as --set takes it; None takes a key away."""
    overrides = []
    for key, value in keys.items():
        try:
            overrides.append(f"{key}=" if value is None else f"{key}={text_of(value)}")
        except (TypeError, ValueError) as error:
            raise type(error)(f"{key}: {error}") from None
    return overrides
