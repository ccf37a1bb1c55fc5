#!/usr/bin/env python3
"""A model of its own of the balls of a 218 that skid, in numpy and scipy: what tests/spatial/skidding.rs is held against.

    skidding.py AXIAL_LOAD [LAW] [DENSITY] [TIME]

All balls do the same, so one ball and an axial place of the ring are enough. LAW of rolling resistance: bh (Biboulet-Houpert) or
h (Houpert); DENSITY of the mixture of air and oil, kg/m^3, 0 for none; TIME, s. It prints the orbit speed over that of the ring, and
contact angles and loads, at quarters of the time. Each ball starts at the speeds of rolling at the contact angle of the bearing at
rest, where centrifugal and contact forces hold it.
"""

import sys
from math import atan2, cos, degrees, exp, pi, radians, sin, sqrt

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, fsolve
from scipy.special import ellipe, ellipk

R, R_P, Z, MASS, RING_MASS = 11.115e-3, 62.63e-3, 16, 0.04504, 2.0
GROOVE = 0.5232 * 2 * R
L, R_D = GROOVE - R, 2 * GROOVE * R / (GROOVE + R)
ANGLE, OMEGA, INERTIA = radians(40), 10000 * pi / 30, 0.4 * MASS * R**2
MODULUS = 206e9 / (1 - 0.3**2)
ETA, ALPHA, BETA, K_OIL, TAU, G_L = 0.03, 2e-8, 0.04, 0.13, 5e6, 3e8
STEEL = 46 * 7830 * 460.0
STRIPS, PLACES = 16, 2
OUTER, INNER = 0, 1


class Race:
    """Hertz's constants of one race at the free contact angle."""

    def __init__(self, side):
        along = cos(ANGLE) / (R_P - R * cos(ANGLE)) if side == INNER else -cos(ANGLE) / (R_P + R * cos(ANGLE))
        self.r_x, self.r_y = 1 / (1 / R + along), 1 / (1 / R - 1 / GROOVE)
        total = 1 / self.r_x + 1 / self.r_y

        def off(k):
            m = 1 - 1 / k**2
            return ((k * k + 1) * ellipe(m) - 2 * ellipk(m)) / ((k * k - 1) * ellipe(m)) - (1 / self.r_x - 1 / self.r_y) / total

        self.k = brentq(off, 1.0001, 100)
        m = 1 - 1 / self.k**2
        e, f, c = ellipe(m), ellipk(m), 3 / (2 * total) * 2 / MODULUS
        self.long = (2 * self.k**2 * e * c / pi) ** (1 / 3)
        self.short = self.long / self.k
        self.stiffness = ((2 * f / pi) * (pi / (2 * self.k**2 * e)) ** (1 / 3) * c ** (2 / 3) * total / 2) ** -1.5
        self.centre = np.array([sin(ANGLE), cos(ANGLE)]) * (L if side == OUTER else -L)
        self.sign = 1 if side == OUTER else -1


RACES = [Race(OUTER), Race(INNER)]
J = np.arange(1, STRIPS + 1) * pi / (STRIPS + 1)
T, WEIGHT, C = np.cos(J), pi / (STRIPS + 1) * np.sin(J) ** 2, np.sin(J)
S, W_S = np.polynomial.legendre.leggauss(PLACES)


def traction(load, a, b, u, u1, u2, h, slip, turning):
    """F_t, F_l, M_t, M_l, M_n of an ellipse."""
    (dt, dl), (wt, wl, wn) = slip, turning
    pressure = pi / 4 * 1.5 * load / (pi * a * b) * C
    y = (a * T)[:, None]
    height = y * y / (R_D + np.sqrt(R_D**2 - y * y))
    x = b * np.outer(C, S)
    along, across = dt - wn * y - wl * height + 0 * x, dl + wn * x + wt * height
    d = np.sqrt(along**2 + across**2 + 1e-24)
    area = a * b * np.outer(WEIGHT, W_S)
    share = u * TAU * h / (G_L * b * C[:, None] * d)

    def stress(rise):
        arc = np.arcsinh(ETA * np.exp(ALPHA * pressure - BETA * rise)[:, None] * d / (TAU * h))
        return np.where(share * arc >= 2, 1 / share, arc * (1 - share * arc / 4))

    resistance = h / (12 * K_OIL) + 4 / 3 / sum(sqrt(pi * STEEL * v / (2 * b)) for v in (u1, u2))
    per_power = resistance * TAU / (pi * a * b)
    missing = lambda rise: per_power * np.sum(stress(rise) * d * area) - rise
    rise = brentq(missing, 0.0, missing(0.0) + 1e-9, xtol=1e-7, rtol=1e-9)
    g = TAU * stress(rise) / d * area
    f_t, f_l = -np.sum(g * along), -np.sum(g * across)
    return f_t, f_l, -np.sum(g * across * height), np.sum(g * along * height), np.sum(g * (along * y - across * x))


def contact(side, at, velocity, spin, law):
    """Force and moment on the ball, axial force on the ring, load and angle; axes x, outwards, ahead."""
    race = RACES[side]
    (x, rho, ring), (vx, vr, v_ring, orbit) = at, velocity
    (ring, v_ring, omega) = (ring, v_ring, OMEGA) if side == INNER else (0.0, 0.0, 0.0)
    move = np.array([x - ring, rho])
    v = race.centre + move
    size = np.linalg.norm(v)
    delta = (2 * race.centre @ move + move @ move) / (size + L)
    n_a, n_r = v / size
    angle = atan2(race.sign * n_a, race.sign * n_r)
    nothing = np.zeros(3), np.zeros(3), 0.0, 0.0, angle
    normal, ahead = np.array([n_a, n_r, 0.0]), np.array([0.0, 0.0, 1.0])
    aside = np.cross(normal, ahead)
    of_ball, of_ring, turn = np.array([vx, vr, (R_P + rho) * orbit]), np.array([v_ring, 0, 0]), np.array([omega, 0, 0])
    lever = np.array([x - ring, R_P + rho, 0.0]) + R * normal
    if delta <= 0:
        return nothing
    closing = normal @ (of_ball - of_ring - np.cross(turn, lever))
    load = race.stiffness * delta**1.5 + 5e-7 * 1.5 * race.stiffness * sqrt(delta) * delta / (delta + 1e-8) * closing
    if load <= 0:
        return nothing
    a, b = race.long * load ** (1 / 3), race.short * load ** (1 / 3)
    from_axis = R_P + rho + R * n_r
    u1 = R * (spin - np.array([orbit, 0, 0])) @ aside
    u2 = (omega - orbit) * from_axis
    u = 0.5 * (u1 + u2)
    slip = u1 - u2, (of_ball + np.cross(spin, R * normal) - of_ring - np.cross(turn, lever)) @ aside
    turning = [(spin - turn) @ axis for axis in (ahead, aside, normal)]
    size = lambda speed: sqrt(speed**2 + 1e-12)
    speed, p0 = size(u), 1.5 * load / (pi * a * b)
    w, drive, material = load / (MODULUS * race.r_x**2), ETA * speed / (MODULUS * race.r_x), ALPHA * MODULUS
    heat, rolling = BETA * ETA * speed**2 / K_OIL, sqrt((slip[0] ** 2 + slip[1] ** 2) / speed**2 + 1e-6)
    phi = (1 - 13.2 * p0 / MODULUS * heat**0.42) / (1 + 0.213 * (1 + 2.23 * rolling**0.83) * heat**0.64)
    phi = max(1e-3, phi)
    h = phi * 2.69 * race.r_x * drive**0.67 * material**0.53 * w**-0.067 * (1 - 0.61 * exp(-0.73 * race.k))
    f_t, f_l, m_t, m_l, m_n = traction(load, a, b, speed, size(u1), size(u2), h, slip, turning)
    k_g, scale = race.r_y / race.r_x, MODULUS * race.r_x**2
    if law == "h":
        rolled = 2.86 * scale * k_g**0.348 * material**0.022 * drive**0.66 * w**0.47
    else:
        light = 2.9766 * scale * k_g**0.3316 * w ** (1 / 3) * drive ** (2 / 3)
        heavy = 7.5826 * scale * k_g**0.4055 * w ** (1 / 3) * drive**0.75
        rolled = heavy + (light - heavy) / (1 + w * k_g**0.25 * drive**-0.75 / 6.6)
    rolled *= phi * u / sqrt(u * u + 1e-6)
    curved = -R * n_r / from_axis
    pushed = f_t * ahead + f_l * aside - load * normal
    force = pushed - rolled * ahead + 2 * rolled / (1 + curved) * ahead
    moment = np.cross(R * normal, pushed - rolled * ahead) + m_t * ahead + m_l * aside + m_n * normal
    return force, moment, -pushed[0], load, angle


def rates(_, y, axial, law, density):
    x, rho, ring, vx, vr, v_ring, orbit, w_x, w_r, w_t = y
    spin, r = np.array([w_x, w_r, w_t]), R_P + rho
    both = [contact(side, (x, rho, ring), (vx, vr, v_ring, orbit), spin, law) for side in (OUTER, INNER)]
    force, moment = both[0][0] + both[1][0], both[0][1] + both[1][1]
    if density > 0:
        velocity, speed = np.array([vx, vr, r * orbit]), np.linalg.norm(spin)
        force = force - 0.5 * density * 0.5 * pi * R**2 * np.linalg.norm(velocity) * velocity
        re = density * R**2 * speed / ETA
        moment = moment - 0.5 * density * R**5 * (6.45 / sqrt(re) + 32.1 / re) * speed * spin
    return [
        vx, vr, v_ring, force[0] / MASS, force[1] / MASS + r * orbit**2, (axial + Z * both[1][2]) / RING_MASS,
        (force[2] / MASS - 2 * vr * orbit) / r, moment[0] / INERTIA, moment[1] / INERTIA + orbit * w_t,
        moment[2] / INERTIA - orbit * w_r,
    ]  # fmt: skip


def start(axial):
    """At the speeds of rolling at the contact angle at rest, where forces without friction hold the ball."""
    off = lambda a: 2 * L * (cos(ANGLE) / cos(a) - 1) - sum((axial / (Z * sin(a)) / race.stiffness) ** (2 / 3) for race in RACES)
    angle = brentq(off, ANGLE + 1e-9, 1.3)
    gamma = R * cos(angle) / R_P
    orbit, own = 0.5 * OMEGA * (1 - gamma), -0.5 * OMEGA * R_P / R * (1 - gamma**2)

    def rest(place):
        x, rho, ring = np.array(place) * 1e-6
        sums, on_ring = np.zeros(2), 0.0
        for side, race in enumerate(RACES):
            v = race.centre + np.array([x - (ring if side == INNER else 0.0), rho])
            size = np.linalg.norm(v)
            push = race.stiffness * abs(size - L) ** 1.5 * np.sign(size - L) * v / size
            sums, on_ring = sums - push, push[0]
        return [sums[0] / 100, (sums[1] + MASS * (R_P + rho) * orbit**2) / 100, (axial + Z * on_ring) / 1000]

    for guess in ([10, 5, 30], [-100, 10, 20], [-200, 10, 0], [-250, 10, -50], [-300, 12, 0], [-50, 8, 20]):
        place, _, found, _ = fsolve(rest, guess, full_output=True, xtol=1e-12)
        if found == 1 and np.linalg.norm(rest(place)) < 1e-6:
            return [*(place * 1e-6), 0, 0, 0, orbit, orbit + own * cos(angle), -own * sin(angle), 0]
    raise SystemExit("no place where forces hold a ball")


def main():
    axial, law, density, end = (sys.argv[1:] + ["1000", "bh", "0", "0.4"][len(sys.argv) - 1 :])[:4]
    arguments = (float(axial), law, float(density))
    scales = [1e-9] * 3 + [1e-5] * 3 + [1e-3] * 4
    times = [float(end) * k / 4 for k in range(1, 5)]
    found = solve_ivp(rates, (0, times[-1]), start(float(axial)), "BDF", times, args=arguments, rtol=1e-5, atol=scales)
    for t, y in zip(found.t, found.y.T, strict=True):
        both = [contact(side, y[:3], (*y[3:6], y[6]), y[7:], law) for side in (OUTER, INNER)]
        angles, loads = [degrees(b[4]) for b in both], [b[3] for b in both]
        print(f"{t:.3f} s: orbit {y[6] / OMEGA:.5f} of the ring; outer {angles[0]:.2f} deg {loads[0]:.1f} N, inner {angles[1]:.2f} deg {loads[1]:.1f} N")


if __name__ == "__main__":
    main()
