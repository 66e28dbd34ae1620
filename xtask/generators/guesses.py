"""The polynomials that guess where a later flight lands: 45 coefficients of six decimals.

The coefficients in the sources were fitted to solved landings of a sample that is not kept. The fit here is a new
one with the same terms: least squares of the error in h over the later flights of FITTED hops, with weights that
bring the many large errors down. Both are measured on other hops.
"""

from mpmath import floor, lu_solve, matrix, mp, mpf

from hop import Hop
from rust import numbers

# The sample: M from 0.05 to 20, log-uniform, and alpha from 4.5 to 20.5, by two irrational steps.
STEPS = ("0.618033988749895", "0.754877666246693")
FITTED = (10000, 2500)
MEASURED = (0, 4000)
# A guess this close to h needs one step of order four.
CLOSE = 0.03
# Shares of guesses that may be farther, below and from pi: the bounds of the Rust test.
FAR = (0.02, 0.125)
# The kernel's limit of a radicand, and its scale of h.
RADICAND, SCALE = 0.02, 4.0
# Passes of the fit; the weight of a flight is |error|^(p-2) of the pass before, with p = 4.
PASSES = 3

PAIRS = [(i, j) for i in range(5) for j in range(5 - i)]
CUBIC = [(i, j) for i in range(4) for j in range(4 - i)]


def flights(first, count):
    """(x, V, h) of each later flight of the hops of the sample."""
    with mp.workdps(30):
        found = []
        for k in range(first, first + count):
            u, w = (k * mpf(step) % 1 for step in STEPS)
            m, alpha = mpf("0.05") * mpf(400) ** u, mpf("4.5") + 16 * w
            hop = Hop(m, alpha)
            for y, v, t in zip(hop.stretches, hop.velocities, hop.times[1:]):
                found.append((float(y - 1), float(v), float(t / 2)))
        return found


def below_pi(x, v):
    """The terms of a guess of h for V < pi, and zero: h = sum of coefficient times term."""
    root = (v * v + 3 * x) ** 0.5
    a = 3 * x / (SCALE * (root - v) + 3 * x)
    q = v / root
    return [a * a**i * q**j for i, j in PAIRS]


def from_pi(x, v, h):
    """The terms of a guess of e for V >= pi, and the end B and sign: h = B - sign e."""
    pi = float(mp.pi)
    m, sign = floor(v / pi), (1.0 if h > v else -1.0)
    end = float(m + 1 if sign > 0 else m) * pi
    distance, b = sign * (end - v), sign / end
    big = (1 + x) * b
    a = distance / (1 + max(1 + big * distance, RADICAND) ** 0.5)
    q = big / (1 + abs(big))
    return [a * a**i * q**j for i, j in PAIRS] + [a * b * a**i * q**j for i, j in CUBIC], sign * (end - h)


def rows(sample):
    """Terms and aims: below pi, and from pi."""
    below = [(below_pi(x, v), h) for x, v, h in sample if v < float(mp.pi)]
    above = [from_pi(x, v, h) for x, v, h in sample if v >= float(mp.pi)]
    return below, above


def errors(equations, coefficients):
    return [abs(sum(c * t for c, t in zip(coefficients, terms)) - aim) for terms, aim in equations]


def fit(equations):
    """Coefficients by weighted least squares, rounded to six decimals."""
    count = len(equations[0][0])
    weights = [1.0] * len(equations)
    with mp.workdps(40):
        for _ in range(PASSES):
            normal, right = matrix(count, count), matrix(count, 1)
            scaled = [[w**0.5 * t for t in terms] + [w**0.5 * aim] for (terms, aim), w in zip(equations, weights)]
            columns = [[mpf(row[k]) for row in scaled] for k in range(count + 1)]
            for i in range(count):
                for j in range(i, count):
                    normal[i, j] = normal[j, i] = mp.fdot(columns[i], columns[j])
                right[i] = mp.fdot(columns[i], columns[count])
            found = [round(float(c), 6) for c in lu_solve(normal, right)]
            residuals = errors(equations, found)
            weights = [0.01**2 + r * r for r in residuals]
    return found


def committed():
    quartic = numbers("BELOW_PI", "Quartic")
    above, factor = numbers("FROM_PI", "Quartic"), numbers("FROM_PI_TIMES_B", "Quartic")
    # The factor of b has degree 3: the last coefficient of each row is zero.
    cubic = [factor[k] for k, (i, j) in enumerate(PAIRS) if i + j < 4]
    if any(factor[k] for k, (i, j) in enumerate(PAIRS) if i + j == 4):
        raise ValueError("the factor of b has terms of degree 4")
    return quartic, above + cubic


def verify(check):
    first, count = FITTED
    fitted = (None, None) if check else rows(flights(first, count))
    measured = rows(flights(MEASURED[0], MEASURED[1] // 5 if check else MEASURED[1]))
    wrong = 0
    for name, train, test, ours, allowed in zip(("V < pi", "V >= pi"), fitted, measured, committed(), FAR):
        made = None if check else fit(train)
        for label, coefficients in (("committed", ours), ("made", made)):
            if coefficients is None:
                continue
            found = errors(test, coefficients)
            far = sum(e > CLOSE for e in found) / len(found)
            rms = (sum(e * e for e in found) / len(found)) ** 0.5
            print(f"  {name}, {label}: {len(found)} guesses, rms {rms:.4f}, largest {max(found):.3f}, "
                  f"farther than {CLOSE}: {100 * far:.2f} %")
            wrong += label == "committed" and far > allowed
        if not check:
            print(f"  {name}, made: " + " ".join(f"{c:.6f}" for c in made))
    return wrong
