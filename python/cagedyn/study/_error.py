"""What is wrong with a study as a whole. What is wrong with one of its points is in the row of that point."""

from __future__ import annotations


class StudyError(Exception):
    """A study that cannot begin or go on: a one-line message that names what is wrong, and what was kept."""
