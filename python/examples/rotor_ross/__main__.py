"""A rotor of ROSS on two bearings of cagedyn: its linear analysis beside co-simulation, as in docs/results/rotor-ross.md.

python python/examples/rotor_ross PAGE.md
"""

from __future__ import annotations

import sys
from pathlib import Path

import tables
from case import UNBALANCE, case

#: Below the critical speeds, next to them and above, rev/min.
SPEEDS, CRITICAL = (3000, 5400, 7000), 5400
#: Steps per revolution that are tried, and those beside which they are held.
PERIODS, FINEST = (50, 100, 200, 400, 800), 1600
#: Times the unbalance where springs are no bearings any more.
LARGE = 20


def write(page: Path, contents: dict[str, str]) -> None:
    """Puts tables into a page, each between the marker of its name and the end marker."""
    text = page.read_text(encoding="utf-8")
    for name, content in contents.items():
        before, marker, rest = text.partition(f"<!-- {name} -->\n")
        _, end, after = rest.partition("<!-- end -->")
        if not end:
            raise SystemExit(f"{page}: there is no <!-- {name} --> with an <!-- end --> behind it")
        text = f"{before}{marker}\n{content}\n\n{end}{after}"
    page.write_text(text, encoding="utf-8")


def main() -> None:
    page = Path(sys.argv[1])
    small = {str(rpm): case(rpm) for rpm in SPEEDS}
    large = {f"{CRITICAL}, {LARGE} times the unbalance": case(CRITICAL, LARGE * UNBALANCE)}
    light = {f"{CRITICAL}, no belt": case(CRITICAL, belt=False)}
    first = small[str(SPEEDS[0])]
    write(
        page,
        {
            "bearings": tables.bearings(first.rotor.speed),
            "linearizations": tables.linearizations(small[str(CRITICAL)]),
            "campbell": tables.campbell(first.tangent, (0, *SPEEDS)),
            "response": tables.response(small),
            "rest": tables.rest(small | large | light),
            "rollers": tables.rollers(small | large | light),
            "beyond": tables.response(large | light),
            "steps": tables.steps(CRITICAL, PERIODS, FINEST),
        },
    )


if __name__ == "__main__":
    main()
