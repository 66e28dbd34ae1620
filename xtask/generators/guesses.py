"""The polynomials that guess where a later flight lands: 45 coefficients of six decimals, of which 5 are zero.

The fit is a weighted least-squares fit of the error in h over the later flights of the FITTED hops. The weight of a
flight is |error|^(p - 2) of the pass before, with p = 2.75: large errors count more than in least squares, because a
guess that is far from the landing costs another search. A larger p makes the largest error smaller and the rms error
larger. All arithmetic has 40 digits and is rounded once, at the end, so that every machine finds the same
coefficients. The fit is measured on other hops.
"""

import multiprocessing
import os

from mpmath import floor, lu_solve, matrix, mp, mpf, nstr, sqrt

from hop import Hop
from rust import numbers

# The hops: M log-uniform and alpha uniform, by two irrational steps. The smallest M and alpha, the ratio of the largest
# M to the smallest, and the range of alpha: a little more than the paper's window, and the other speeds of the kernel.
STEPS = ("0.618033988749895", "0.754877666246693")
WINDOW, FAST = ("0.05", 400, "4.5", 16), ("0.05", 4000, "20", 80)
# Of each kind: the first hop and the count.
FITTED = ((WINDOW, 10000, 5000), (FAST, 501, 500))
MEASURED = ((WINDOW, 0, 4000), (FAST, 1, 500))
DIGITS = 40
# Flights are solved with this number of digits.
FLIGHT_DIGITS = 30
DECIMALS = 6
# A guess this close to h needs one step of order four.
CLOSE = mpf("0.03")
# Bounds of the Rust test: the largest error, and the share of guesses farther than CLOSE, below and from pi. The last
# largest error is that of the coefficients before, whose sample is lost.
LARGEST = (mpf("0.04"), mpf("0.107"))
FAR = (mpf("0.005"), mpf("0.05"))
# The kernel's limit of a radicand, and its scale of h.
RADICAND, SCALE = "SMALLEST_RADICAND", 4
# p - 2 over two, since the weight is a power of the squared error.
POWER = mpf("0.375")
PASSES = 8
# Below this error the weight is constant: a weight of zero would make the equations singular.
SMALL = mpf("0.01")

PAIRS = [(i, j) for i in range(5) for j in range(5 - i)]
CUBIC = [(i, j) for i in range(4) for j in range(4 - i)]


def flights(job):
    """(x, V, h) of each later flight of a hop of the sample."""
    (mass_ratio, ratio, alpha, width), k = job
    with mp.workdps(FLIGHT_DIGITS):
        u, w = (k * mpf(step) % 1 for step in STEPS)
        hop = Hop(mpf(mass_ratio) * mpf(ratio) ** u, mpf(alpha) + width * w)
        return [(y - 1, v, t / 2) for y, v, t in zip(hop.stretches, hop.velocities, hop.times[1:])]


def jobs(parts, share=1):
    """The hops of a sample, or of its first part."""
    return [(kind, k) for kind, first, count in parts for k in range(first, first + count // share)]


def below_pi(x, v):
    """The terms of a guess of h for V < pi: h = sum of coefficient times term."""
    root = sqrt(v * v + 3 * x)
    a = 3 * x / (SCALE * (root - v) + 3 * x)
    q = v / root
    return [a * a**i * q**j for i, j in PAIRS]


def from_pi(x, v, h, radicand):
    """The terms of a guess of e for V >= pi, and e: h = B - sign e, with B the end of the bracket."""
    m, sign = floor(v / mp.pi), (1 if h > v else -1)
    end = (m + 1 if sign > 0 else m) * mp.pi
    distance, b = sign * (end - v), sign / end
    big = (1 + x) * b
    a = distance / (1 + sqrt(max(1 + big * distance, radicand)))
    q = big / (1 + abs(big))
    return [a * a**i * q**j for i, j in PAIRS] + [a * b * a**i * q**j for i, j in CUBIC], sign * (end - h)


def equations(sample):
    """Terms and aims: below pi, and from pi."""
    radicand = mpf(str(numbers(RADICAND)[0]))
    below = [(below_pi(x, v), h) for x, v, h in sample if v < mp.pi]
    above = [from_pi(x, v, h, radicand) for x, v, h in sample if v >= mp.pi]
    return below, above


def errors(rows, coefficients):
    return [abs(mp.fdot(coefficients, terms) - aim) for terms, aim in rows]


def fit(rows):
    """Coefficients by least squares with weights that follow the errors, rounded to DECIMALS."""
    count = len(rows[0][0])
    columns = [[terms[k] for terms, _ in rows] for k in range(count)]
    aims = [aim for _, aim in rows]
    weights = [mpf(1)] * len(rows)
    for _ in range(PASSES):
        normal, right = matrix(count, count), matrix(count, 1)
        for i in range(count):
            weighted = [w * t for w, t in zip(weights, columns[i])]
            for j in range(i, count):
                normal[i, j] = normal[j, i] = mp.fdot(weighted, columns[j])
            right[i] = mp.fdot(weighted, aims)
        found = list(lu_solve(normal, right))
        weights = [(SMALL**2 + error * error) ** POWER for error in errors(rows, found)]
    return [mp.nint(c * 10**DECIMALS) / mpf(10) ** DECIMALS for c in found]


def committed():
    quartic = numbers("BELOW_PI", "Quartic")
    above, factor = numbers("FROM_PI", "Quartic"), numbers("FROM_PI_TIMES_B", "Quartic")
    # The factor of b has degree 3: the last coefficient of each row is zero.
    cubic = [factor[k] for k, (i, j) in enumerate(PAIRS) if i + j < 4]
    if any(factor[k] for k, (i, j) in enumerate(PAIRS) if i + j == 4):
        raise ValueError("the factor of b has terms of degree 4")
    return quartic, above + cubic


def verify(check):
    tests, fits = jobs(MEASURED, 5 if check else 1), jobs(FITTED)
    with multiprocessing.Pool(os.cpu_count()) as pool:
        found = pool.map(flights, tests + fits, chunksize=50)
    wrong = 0
    with mp.workdps(DIGITS):
        measured, fitted = (
            equations([f for hop in part for f in hop]) for part in (found[: len(tests)], found[len(tests) :])
        )
        for which, ours in enumerate(committed()):
            made = fit(fitted[which])
            differ = sum(float(a) != b for a, b in zip(made, ours)) + abs(len(made) - len(ours))
            wrong += differ
            distances = errors(measured[which], made)
            rms, far = sqrt(mp.fsum(e * e for e in distances) / len(distances)), sum(e > CLOSE for e in distances)
            name = ("V < pi", "V >= pi")[which]
            print(
                f"  {name}: {len(made) - differ} of {len(made)} coefficients equal; on {len(distances)} other flights "
                f"rms {nstr(rms, 3)}, largest {nstr(max(distances), 3)}, "
                f"farther than {nstr(CLOSE, 2)}: {100 * far / len(distances):.2f} %"
            )
            if differ:
                print("    " + ", ".join(nstr(c, 9) for c in made))
            wrong += (max(distances) > LARGEST[which]) + (far > FAR[which] * len(distances))
    return wrong
