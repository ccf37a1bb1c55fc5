"""Which build of the library a process has."""

from __future__ import annotations

import functools
import hashlib
from pathlib import Path

from .._native import _path, version


class WrongBuild(Exception):
    """A worker has another build of the library than the study."""


@functools.cache
def build() -> str:
    """Version and SHA-256 of the library that this process has loaded. Raises OSError where it was not loaded by
    the path of a file."""
    return f"{version()} {hashlib.sha256(Path(_path()).read_bytes()).hexdigest()}"


def check(wanted: str) -> None:
    """Raises WrongBuild where this process has another build."""
    if build() != wanted:
        raise WrongBuild(differs(build(), wanted))


def differs(found: str, wanted: str) -> str:
    """Two builds in words, without the digits that nobody reads."""
    return f"has the library {short(found)}, not {short(wanted)}"


def short(text: str) -> str:
    """A build in a message."""
    number, _, digest = text.partition(" ")
    return f"{number} {digest[:12]}"
