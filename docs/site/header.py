"""The directive `c-header`: sections of all that a header of cbindgen declares, with the words of its comments."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.domains.c import CDomain
from sphinx.util.docutils import SphinxDirective

#: A comment and what it is about.
ITEM = re.compile(r"^/\*(?P<words>(?:(?!\*/).)*)\*/\s*(?P<code>#define [^\n]+|[^#/;]+;)", re.DOTALL | re.MULTILINE)
#: What else such a header has.
REST = re.compile(
    r"#include <stdint\.h>|#(ifndef|define|endif)[^\n]* CAGEDYN_H\b[^\n]*|#ifdef __cplusplus.*?#endif[^\n]*", re.DOTALL
)
#: A convention at the top of the header: its subject and the first line about it.
CONVENTION = re.compile(r"^(\w+)  +(\S.*)$")

#: Titles of the sections of functions, with the words after `cagedyn_` or `cagedyn_find_` of those in it.
SECTIONS = {
    "Version and errors": "version error status",
    "Models": "model",
    "Simulations": "sim canceller energy interval statistic law balance",
    "Batches": "batch monitor progress",
    "Equilibrium": "equilibrium",
    "Steady whirl": "whirl",
    "Heat": "heat",
    "Watched searches": "watch",
    "Statistics of a motion": "cage motion over",
}


class Item(NamedTuple):
    """A constant, handle or function: its name, its directive of Sphinx's C domain, what that shows, its comment."""

    name: str
    directive: str
    code: str
    words: str


def words_of(comment: str) -> str:
    """A comment without its stars."""
    return "\n".join(re.sub(r"^ ?\* ?", "", line) for line in comment.strip().split("\n"))


def item(match: re.Match[str]) -> Item:
    code, words = " ".join(match["code"].rstrip(";").split()), words_of(match["words"])
    if define := re.fullmatch(r"#define (\w+) (-?\d+)", code):
        return Item(define[1], "c:macro", define[1], f"{words} Its value is {define[2]}.")
    if opaque := re.fullmatch(r"typedef struct (\w+) \1", code):
        return Item(opaque[1], "c:type", opaque[1], words)
    if function := re.search(r"(\w+)\(", code):
        return Item(function[1], "c:function", code.replace("(void)", "()"), words)
    raise ValueError(f"neither a constant, a handle nor a function: {code}")


def items(header: str) -> list[Item]:
    """All that a header declares, in its order. Raises ValueError for what has no comment or is of no known kind."""
    start = header.index("#ifndef CAGEDYN_H")
    found = [item(match) for match in ITEM.finditer(header, start)]
    left = REST.sub("", ITEM.sub("", header[start:])).strip()
    if left:
        raise ValueError(f"without a comment or not known: {left}")
    return found


def section_of(entry: Item) -> str:
    """Title of the section in which it stands. Raises ValueError for a function of which `SECTIONS` knows nothing."""
    if entry.directive != "c:function":
        return "Constants" if entry.directive == "c:macro" else "Handles"
    subject = entry.name.removeprefix("cagedyn_").removeprefix("find_").split("_")[0]
    for title, subjects in SECTIONS.items():
        if subject in subjects.split():
            return title
    raise ValueError(f"{entry.name}: no section of SECTIONS has {subject!r}")


def markdown(words: str, names: set[str]) -> str:
    """Words of a comment, with links from the names in it. What stands between backticks stays as it is."""

    def linked(found: re.Match[str]) -> str:
        name = found["name"].replace("\\", "")
        return f"{{c:{'func' if found['call'] else 'macro'}}}`{name}`" if name in names else found[0]

    spans = re.split(r"(`[^`]*`)", words)
    for place in range(0, len(spans), 2):
        plain = re.sub(r"[_*<]", r"\\\g<0>", spans[place])
        spans[place] = re.sub(r"(?P<name>cagedyn\\_[\w\\]+)(?P<call>\(\))?", linked, plain, flags=re.IGNORECASE)
    return "".join(spans)


def conventions(header: str, names: set[str]) -> str:
    """What opens the header, with the subjects in bold."""
    text = markdown(words_of(header[header.index("CONVENTIONS") + len("CONVENTIONS") : header.index("*/")]), names)
    return "\n".join(CONVENTION.sub(r"**\1.** \2", line.rstrip()).strip() for line in text.split("\n"))


class Header(SphinxDirective):
    """Sections with all that the header at the path of the argument, relative to the page, declares."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        name, path = self.env.relfn2path(self.arguments[0])
        self.env.note_dependency(name)
        header = Path(path).read_text(encoding="utf-8")
        parts: dict[str, list[str]] = {title: [] for title in ("Constants", "Handles", *SECTIONS)}
        try:
            entries = items(header)
            names = {entry.name for entry in entries}
            for entry in entries:
                words = markdown(entry.words, names)
                parts[section_of(entry)].append(f"`````{{{entry.directive}}} {entry.code}\n{words}\n`````")
        except ValueError as wrong:
            raise self.error(f"{name}: {wrong}") from None
        texts = {"Conventions": conventions(header, names)} | {title: "\n".join(part) for title, part in parts.items()}
        return [self.section(title, text) for title, text in texts.items()]

    def section(self, title: str, content: str) -> nodes.section:
        section = nodes.section("", nodes.title("", title), ids=[nodes.make_id(title)], names=[title.lower()])
        section += self.parse_text_to_nodes(content)
        return section


class Declared(CDomain):
    """What the search finds of C: all that is declared, but not the parameters, whose names are everywhere."""

    def get_objects(self) -> Iterator[tuple[str, str, str, str, str, int]]:
        return (found for found in super().get_objects() if found[2] != "functionParam")


def setup(app: Sphinx) -> dict[str, bool]:
    app.add_domain(Declared, override=True)
    app.add_directive("c-header", Header)
    return {"parallel_read_safe": True}
