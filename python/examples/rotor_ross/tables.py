"""Tables of cases: what ROSS has beside what the co-simulation has."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

import cagedyn
import numpy as np
import ross_rotor
from case import LOAD, MODES, SCENE, UNBALANCE, Case, case, radians
from rotor import Array, Tangent, over_pitch, static_place

Cases = dict[str, Case]


def table(head: str, rows: Iterable[str]) -> str:
    """A table of a page; cells are divided by bars."""
    return "\n".join([f"| {head} |", "|---|" + "---:|" * head.count("|"), *(f"| {row} |" for row in rows)])


def places(found: Case) -> Iterator[tuple[str, Array, Array]]:
    """Name of every disc and bearing with its direction, and what of ROSS's coordinates and of those of the run moves it."""
    full = ross_rotor.free(found.rotor.speed, UNBALANCE)
    for kind, whole, reduced in (("disc", full.discs, found.rotor.discs), ("bearing", full.ends, found.rotor.ends)):
        for i in range(2):
            for k, direction in enumerate("yz"):
                yield f"{kind} {i + 1}, {direction}", whole[i, k], reduced[i, k]


def bearings(speed: float) -> str:
    """Rotor and bearings at a speed in rad/s, under the load of the belt."""
    bare, load = ross_rotor.free(speed, UNBALANCE), np.array([0.0, LOAD])
    place, stiffness = over_pitch(SCENE, speed, load)
    low, high = 1e-6 * stiffness.min(axis=0), 1e-6 * stiffness.max(axis=0)
    rows = [
        f"mass of the rotor, kg | {ross_rotor.mass():.2f}",
        f"its weight on bearings 1 and 2, N | {-bare.end_loads[0, 1]:.1f}, {-bare.end_loads[1, 1]:.1f}",
        f"load of each bearing with the belt, N | {-LOAD:.0f}",
        f"place z of an inner ring, mean over a pitch of the rollers, µm | {1e6 * place[:, 1].mean():.2f}",
        f"rms about it, µm | {1e6 * place[:, 1].std():.3f}",
    ]
    for name, i, j in (("yy", 0, 0), ("zz", 1, 1), ("yz", 0, 1)):
        rows.append(f"stiffness {name} over a pitch, N/µm | {low[i, j]:.0f} to {high[i, j]:.0f}")
    return table("NU2310, 3000 rev/min | ", rows)


def linearizations(found: Case) -> str:
    """What the linear response at the first bearing is with other stiffnesses of both bearings, beside that of the run."""
    _, stiffness = over_pitch(SCENE, found.rotor.speed, found.tangent.load[0])
    (first,) = over_pitch(SCENE, found.rotor.speed, found.tangent.load[0], [0.0])[1]
    chosen = {
        "a roller under the load, as the scene starts": first,
        "mean of stiffnesses over a pitch": stiffness.mean(axis=0),
        "mean of compliances over a pitch": found.tangent.stiffness[0],
    }
    full = ross_rotor.free(found.rotor.speed, found.unbalance)
    ours = found.rotor.ends[0] @ found.synchronous

    def rows() -> Iterator[str]:
        for name, matrix in chosen.items():
            tangent = replace(found.tangent, stiffness=np.array([matrix, matrix]))
            linear = full.ends[0] @ ross_rotor.unbalance_response(tangent, found.rotor.speed, found.unbalance)
            apart = 100.0 * np.abs(ours - linear) / np.abs(linear)
            yield (
                f"{name} | {1e-6 * matrix[0, 0]:.1f} | {1e-6 * matrix[1, 1]:.1f} | {1e6 * abs(linear[0]):.3f} | "
                f"{1e6 * abs(ours[0]):.3f} | {apart[0]:.1f} | {apart[1]:.1f}"
            )

    return table("stiffness | yy, N/µm | zz, N/µm | ROSS, y, µm | run, y, µm | y apart, % | z apart, %", rows())


def campbell(tangent: Tangent, speeds: Iterable[int]) -> str:
    """Natural frequencies at speeds in rev/min, and critical speeds."""
    chosen = list(speeds)
    found = 30.0 / np.pi * ross_rotor.campbell(tangent, np.array([radians(rpm) for rpm in chosen]))
    critical = 30.0 / np.pi * ross_rotor.critical_speeds(tangent, 2)
    rows = [f"{rpm} | " + " | ".join(f"{w:.0f}" for w in line) for rpm, line in zip(chosen, found, strict=True)]
    rows.append("critical speeds | " + " | ".join(f"{w:.0f}" for w in critical) + " | | ")
    return table("rev/min | first | second | third | fourth", rows)


def response(cases: Cases) -> str:
    """Synchronous motion, and what is beside it."""

    def rows() -> Iterator[str]:
        for name, found in cases.items():
            for spot, whole, reduced in places(found):
                linear, ours, before = whole @ found.linear, reduced @ found.synchronous, reduced @ found.before
                yield (
                    f"{name} | {spot} | {1e6 * abs(linear):.3f} | {1e6 * abs(ours):.3f} | "
                    f"{np.degrees(np.angle(linear)):.1f} | {np.degrees(np.angle(ours)):.1f} | "
                    f"{100.0 * abs(ours - linear) / abs(linear):.1f} | {100.0 * abs(ours - before) / abs(ours):.1f} | "
                    f"{1e6 * found.beside(reduced):.3f}"
                )

    return table(
        "rev/min | place | ROSS, µm | run, µm | ROSS, ° | run, ° | apart, % | windows apart, % | "
        "rest of the motion, rms, µm",
        rows(),
    )


def rest(cases: Cases) -> str:
    """Mean places of the first disc and bearing."""

    def rows() -> Iterator[str]:
        for name, found in cases.items():
            linear, ours = static_place(found.rotor, found.tangent), found.last(found.run.place).mean(axis=0)
            for kind, at in (("disc 1", found.rotor.discs[0]), ("bearing 1", found.rotor.ends[0])):
                # Adding zero takes the sign from what is rounded to zero.
                pairs = (f"{round(1e6 * row @ linear, 2) + 0.0:.2f} | {1e6 * row @ ours:.2f}" for row in at)
                yield " | ".join((name, kind, *pairs))

    return table("rev/min | place | y, linear, µm | y, run, µm | z, linear, µm | z, run, µm", rows())


def rollers(cases: Cases) -> str:
    """What the rollers do and what they do to the rings."""

    def rows() -> Iterator[str]:
        for name, found in cases.items():
            speed, slip = found.last(found.run.cage).mean(axis=0).T
            force = found.last(found.run.force)[:, :, 1]
            for i in range(2):
                passing = found.rollers * speed[i] / (2.0 * np.pi)
                peak, rms = line(found, found.rotor.ends[i, 1], passing)
                yield (
                    f"{name} | {i + 1} | {speed[i]:.1f} | {100.0 * slip[i]:.2f} | {passing:.1f} | {peak:.1f} | "
                    f"{1e6 * rms:.3f} | {round(force[:, i].min())} to {force[:, i].max():.0f} | "
                    f"{'yes' if found.trusted else 'no'}"
                )

    return table(
        "rev/min | bearing | cage, rad/s | its slip, % | rollers pass, Hz | nearest peak of z, Hz | rms there, µm | "
        "force along z, N | power balance kept",
        rows(),
    )


def line(found: Case, row: Array, frequency: float) -> tuple[float, float]:
    """Highest peak of a coordinate's spectrum within 4 % of a frequency in Hz, and the rms of what is within 4 %, in m."""
    motion = found.last(found.run.place) @ row
    window = np.hanning(len(motion))
    power = 2.0 * np.abs(np.fft.rfft(window * (motion - motion.mean()))) ** 2 / (len(motion) * np.sum(window**2))
    at = np.fft.rfftfreq(len(motion), found.run.time[0])
    near = np.abs(at - frequency) < 0.04 * frequency
    return float(at[near][np.argmax(power[near])]), float(np.sqrt(power[near].sum()))


def steps(rpm: int, periods: Iterable[int], finest: int) -> str:
    """How far the synchronous motion with other steps is from that with the finest, over its largest at discs or at bearings: in
    few coordinates and in all, with and without the tangent."""
    reference = case(rpm, period=finest)

    def apart(found: Case, at: str) -> float:
        known = getattr(reference.rotor, at) @ reference.synchronous
        ours = getattr(found.rotor, at) @ found.synchronous
        return float(100.0 * np.abs(ours - known).max() / np.abs(known).max())

    def cells(period: int) -> Iterator[str]:
        yield f"{period} | {1e6 * 60.0 / (rpm * period):.1f}"
        for modes in (MODES, 4 * ross_rotor.ELEMENTS):
            for predicts in (True, False):
                try:
                    found = case(rpm, period=period, modes=modes, predicts=predicts)
                    yield f"{apart(found, 'discs'):.2f}, {apart(found, 'ends'):.2f}"
                except cagedyn.Error:
                    yield "breaks off"

    few, all_of_them = len(reference.rotor.mass), 4 * (ross_rotor.ELEMENTS + 1)
    head = "steps per revolution | step, µs | " + " | ".join(
        f"{count} coordinates, {how} tangent, %" for count in (few, all_of_them) for how in ("with", "without")
    )
    return table(head, (" | ".join(cells(period)) for period in periods))
