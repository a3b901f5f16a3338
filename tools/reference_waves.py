#!/usr/bin/env python3
"""Waves in closed form that motions in time are compared with (`ligament-verify motion`).

This is not part of the program, and shares no code with it.
    - Dispersion: a plane wave along a row of a square lattice of bonds, omega^2 = sum w (1 - cos(k x))/m over the bonds
      of a point, over that of a long wave; w is the stiffness of the bond along the wave.
    - Lamb's problem (1904): displacements of the edge of a half-plane under a force on it, by Cagniard's method.  With
      the slownesses a = 1/c_P and b = 1/c_S, and p = t/x, the response to an impulse of 1 N s/m is
          u_y = Im[b^2 alpha/R]/(pi mu x),    u_x = Im[p (b^2 - 2 p^2 - 2 alpha beta)/R]/(pi mu x),
          alpha = sqrt(a^2 - p^2), beta = sqrt(b^2 - p^2), R = (b^2 - 2 p^2)^2 + 4 p^2 alpha beta,
      on the upper side of the real axis.  The convolution with the wavelet runs along a line above this axis, so that
      it passes the pole of the Rayleigh wave.

    python tools/reference_waves.py        # prints the tables (half a minute)
"""
import cmath
import math


def dispersion(law, horizon, points, poisson):
    """Phase speed over that of a long wave for the number of points per wavelength."""
    k, wave, long_wave = 2 * math.pi / points, 0.0, 0.0
    shear = (1 - 3 * poisson) / (1 + poisson)
    for i in range(-int(horizon), int(horizon) + 1):
        for j in range(-int(horizon), int(horizon) + 1):
            length = math.hypot(i, j)
            if not 0 < length <= horizon + 1e-9:
                continue
            if law == "nhpd":
                factor = math.exp((1 - length) / (horizon - 1))
                tangential = shear * horizon**2 / (3 * length**2)
            else:
                factor = min(1, horizon + 0.5 - length)
                tangential = 0 if law == "bbpd" else shear
            weight = factor / length * (i * i + tangential * j * j) / length**2
            wave += weight * 2 * (1 - math.cos(k * i))
            long_wave += weight * (k * i) ** 2
    return math.sqrt(wave / long_wave)


YOUNG, POISSON, DENSITY = 60e9, 0.25, 2650.0
MU = YOUNG / 2 / (1 + POISSON)
A = math.sqrt(DENSITY / (MU * (2 - 2 * POISSON) / (1 - 2 * POISSON)))
B = math.sqrt(DENSITY / MU)
FORCE, FREQUENCY, PEAK = 1e3, 80e3, 15e-6
RAYLEIGH = math.sqrt(2 - 2 / math.sqrt(3)) / B


def response(p):
    """Both responses, without 1/(pi mu x)."""
    alpha, beta = cmath.sqrt(A * A - p * p), cmath.sqrt(B * B - p * p)
    r = (B * B - 2 * p * p) ** 2 + 4 * p * p * alpha * beta
    return p * (B * B - 2 * p * p - 2 * alpha * beta) / r, B * B * alpha / r


def ricker(time):
    a = (math.pi * FREQUENCY * (time - PEAK)) ** 2
    return (1 - 2 * a) * cmath.exp(-a)


def edge(x, time, count=1500):
    """u_x, away from the force, and u_y, along it, m."""
    first, last = max(0, time - 2 * PEAK), time + 2 * PEAK
    step, above = (last - first) / count, 0.05j / FREQUENCY
    sums = [0, 0]
    for place in range(count):
        tau = first + (place + 0.5) * step + above
        force = FORCE * ricker(time - tau)
        for axis, value in enumerate(response(tau / x)):
            sums[axis] += force * value
    return [(it * step).imag / (math.pi * MU * x) for it in sums]


def extremum(times, values, sign):
    place = max(range(1, len(times) - 1), key=lambda it: sign * values[it])
    before, at, after = values[place - 1 : place + 2]
    shift = 0.5 * (before - after) / (before - 2 * at + after)
    return times[place] + shift * (times[1] - times[0]), at - 0.25 * (before - after) * shift


def main():
    # The step of the force: u_x behind the Rayleigh wave is -(1 - 2 nu)/(4 mu).
    count, end = 200000, 5 * B
    step = sum(response((it + 0.5) * end / count + 1e-3j * B)[0] * end / count for it in range(count)).imag / math.pi
    assert abs(step + (1 - 2 * POISSON) / 4) < 1e-4, step
    print("law,points,c/c_0")
    for law, poisson in [("nhpd", 0.25), ("bbpd", 1 / 3), ("pds", 0.25), ("mppd", 0.25)]:
        for points in (40, 30, 20, 16, 12, 10, 8, 6, 5, 4):
            print(f"{law},{points},{dispersion(law, 3, points, poisson):.4f}")
    print('"x, mm",wave,extremum,"t, us","u, nm"')
    period = 1 / FREQUENCY
    for x in (0.04, 0.06, 0.08):
        windows = [("P", x * A, 1.2, 0.8, [("u_x", 0, -1)])] if x > 0.07 else []
        windows.append(("R", x / RAYLEIGH, 1.1, 1.1, [("u_x", 0, -1), ("u_y", 1, 1), ("u_y", 1, -1)]))
        for wave, arrival, before, after, features in windows:
            start = PEAK + arrival - before * period
            times = [start + 0.1e-6 * it for it in range(int((before + after) * period / 0.1e-6) + 1)]
            motions = [edge(x, time) for time in times]
            for name, axis, sign in features:
                time, size = extremum(times, [it[axis] for it in motions], sign)
                word = "largest" if sign > 0 else "smallest"
                print(f"{1e3 * x:.0f},{wave},{word} {name},{1e6 * (time - PEAK):.3f},{1e9 * size:.3f}")


main()
