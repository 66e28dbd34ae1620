"""The branch of `cargo bench -p return-map --bench branches -- --points` by SciPy: time, and how far the points are apart.

Run with `python benches/spring_leg_branch.py points.csv TOLERANCE`, with NumPy and SciPy.
"""

import csv
import sys
import time

import numpy as np
from scipy.integrate import solve_ivp

MASS, STIFFNESS, LEG, GRAVITY = 80.0, 2e4, 1.0, 9.81


def stance(_, y):
    length = np.hypot(y[0], y[1])
    push = STIFFNESS / MASS * (LEG / length - 1.0)
    return [y[2], y[3], push * y[0], push * y[1] - GRAVITY]


def take_off(_, y):
    return np.hypot(y[0], y[1]) - LEG


take_off.terminal, take_off.direction = True, 1.0


def apex_after(height, attack, tolerance):
    """The next apex: both flights have closed forms, the stance is integrated."""
    touchdown = LEG * np.sin(attack)
    fall = height - touchdown
    speed = np.sqrt(25.0 + 2.0 * GRAVITY * (1.0 - height))
    start = [-LEG * np.cos(attack), touchdown, speed, -np.sqrt(2.0 * GRAVITY * fall)]
    run = solve_ivp(
        stance, (0.0, 2.0), start, "DOP853", events=take_off, rtol=tolerance, atol=tolerance
    )
    _, y, _, climb = run.y_events[0][0]
    return y + climb * climb / (2.0 * GRAVITY)


def run(height, attack, tolerance):
    """The periodic run by Newton's method, and its multiplier, by central differences of order two and of order six."""
    def difference(step):
        ahead = apex_after(height + step, attack, tolerance)
        behind = apex_after(height - step, attack, tolerance)
        return (ahead - behind) / (2.0 * step)

    for _ in range(20):
        change = (apex_after(height, attack, tolerance) - height) / (1.0 - difference(1e-5))
        height += change
        if abs(change) < 1e-11:
            break
    # The map has a root where the apex is at the height of the touchdown.
    step = 0.02 * (height - LEG * np.sin(attack))
    one, two, three = difference(step), difference(2.0 * step), difference(3.0 * step)
    return height, 1.5 * one - 0.6 * two + 0.1 * three


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        rows = [[float(row[key]) for key in ("attack", "height", "multiplier")] for row in csv.DictReader(file)]
    tolerance = float(sys.argv[2])
    begin, height, off = time.perf_counter(), rows[0][1], np.zeros(2)
    for attack, expected, slope in rows:
        height, multiplier = run(height, np.radians(attack), tolerance)
        off = np.maximum(off, np.abs([height - expected, multiplier - slope]))
    seconds = time.perf_counter() - begin
    print(f"{len(rows)} points, {seconds:.2f} s; apart: heights {off[0]:.1e}, multipliers {off[1]:.1e}")


main()
