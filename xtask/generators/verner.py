"""Verner's Runge-Kutta pairs 9(8) and 6(5) with interpolants, polished on the order conditions.

verner_published.json has the digits of Verner's pages, rounded to doubles. Published numbers of at most EXACT digits
are parameters of the families and are kept. Newton's method moves all others to a solution next to them. The result is
written as a Rust expression.
"""

import json
import multiprocessing
from operator import mul
from pathlib import Path
from typing import NamedTuple

import gmpy2
from gmpy2 import mpfr

from order_conditions import elementary_weights, trees

# Numbers of at most this many digits are exact: all others are published with 15 digits and more.
EXACT = 12
# Bits of all numbers: 60 digits, and as many for the normal equations, which square the condition of the Jacobian.
BITS = 400
# Every residual is below this in the end, and every number of the tables is known to more digits than a double has.
SOLVED = mpfr("1e-50")
# A step of a difference quotient, relative: half of the bits are right.
STEP = mpfr(2) ** -(BITS // 2)
# Published digits meet the conditions of a row to this, relative to the integral, or not at all.
VANISHES = mpfr("1e-11")
# A step gains ten digits and more, or else the Jacobian is too old.
FEW = mpfr("1e-10")
# More steps mean that the method does not converge.
MOST_STEPS = 12
# The degree of the quadrature that a step over a kink is compared with, and its first stage after that at the start:
# the stages before have lower orders.
ROBUST = 3
FIRST_ROBUST = 3
# The interpolants are tabulated at this many Chebyshev nodes of the step (ode/chebyshev.rs).
NODES = 16
ROOT = Path(__file__).resolve().parents[2]
SOURCES = ROOT / "crates" / "any-system" / "hybrid-system" / "src" / "ode" / "schemes"
OUT = ROOT / "target" / "regenerate"
# Published name, the higher order, the order of the interpolant, `kink_ratio` (schemes/scheme.rs; a test compares it
# with the weights), the file.
PAIRS = (("9(8)", 9, 8, 5, "nine.in"), ("6(5)", 6, 6, 8, "six.in"))
HEADER = """\
// J. H. Verner's "efficient" pair of orders {orders}: {stages} stages, and {more} more for its interpolant \
of order {inside}.
//
// Made by `xtask/generators/verner.py` (`cargo xtask regenerate --only verner`); not edited by hand.
Scheme {{
"""


class Pair(NamedTuple):
    """Where the nodes, rows and weights of a method stand in one list of numbers. -1 stands for zero."""

    order: int
    stages: int
    nodes: list
    rows: list
    weights: list
    lower: list
    inside: list
    values: list
    # The indices that Newton's method may move, of the pair and of the interpolant.
    of_pair: list
    of_inside: list


def is_exact(text):
    digits = text.lower().split("e")[0].replace("-", "").replace(".", "").strip("0")
    return len(digits) <= EXACT


def read(name, order):
    """The published pair. The first row at the end of the step is the weights: the same numbers.

    That row is the first of the interpolant, or the last of the pair ("first same as last").
    """
    published = json.loads(Path(__file__).with_name("verner_published.json").read_text(encoding="utf-8"))[name]
    values, free = [], []

    def place(text):
        if float(text) == 0:
            return -1
        values.append(mpfr(text))
        if not is_exact(text):
            free.append(len(values) - 1)
        return len(values) - 1

    def row(texts):
        return [(j, place(text)) for j, text in enumerate(texts) if float(text) != 0]

    stages = len(published["b"])
    nodes = [place(text) for text in published["c"][:stages]]
    # Row S, without the zero of its own stage.
    same = published["a"][stages - 1] == published["b"][: stages - 1]
    rows = [row(texts) for texts in published["a"][: stages - same]]
    weights, lower = row(published["b"]), row(published["lower"])
    rows += [weights] if same else []
    of_pair, free = free, []
    nodes += [place(text) for text in published["c"][stages:]]
    rows += [] if same else [weights]
    rows += [row(texts) for texts in published["a"][len(rows) :]]
    inside = [[place(text) for text in texts] for texts in published["inside"]]
    return Pair(order, stages, nodes, rows, weights, lower, inside, values, of_pair, free)


def method(pair, values, stages):
    """The rows with their numbers."""
    return [[(j, values[k]) for j, k in row] for row in pair.rows[:stages]]


def node(pair, values, stage):
    return values[pair.nodes[stage]] if pair.nodes[stage] >= 0 else mpfr(0)


def row_residual(pair, values, stage, power):
    """sum_j a_ij c_j^power - c_i^(power+1)/(power+1): the integral of a power up to the node."""
    terms = (values[k] * node(pair, values, j) ** power for j, k in pair.rows[stage])
    return sum(terms, -node(pair, values, stage) ** (power + 1) / (power + 1))


def row_conditions(pair, stages):
    """The (stage, power) whose residual vanishes for the published digits.

    The conditions of the trees leave one parameter of a pair free, a node of many digits. The orders of the stages
    determine it.
    """
    return [
        (stage, power)
        for stage in stages
        if stage > 0
        for power in range(pair.order)
        if abs(row_residual(pair, pair.values, stage, power))
        < VANISHES * node(pair, pair.values, stage) ** (power + 1) / (power + 1)
    ]


def pair_residuals(pair, values, found, conditions):
    """The conditions of the rows, then both weights on all trees of their orders."""
    phi = elementary_weights(found, method(pair, values, pair.stages), mpfr(1))
    residuals = [row_residual(pair, values, *row) for row in conditions]
    for tree, phi in zip(found, phi):
        value = mpfr(tree.value)
        residuals.append(sum((values[k] * phi[j] for j, k in pair.weights), -value))
        if tree.nodes < pair.order:
            residuals.append(sum((values[k] * phi[j] for j, k in pair.lower), -value))
    return residuals


def inside_residuals(pair, values, found, conditions):
    """The conditions of the rows, then for each tree the difference of the polynomials in s, by powers."""
    phi = elementary_weights(found, method(pair, values, len(pair.rows)), mpfr(1))
    powers = max(map(len, pair.inside))
    residuals = [row_residual(pair, values, *row) for row in conditions]
    for tree, phi in zip(found, phi):
        for power in range(powers):
            sum_ = mpfr(-tree.value) if power + 1 == tree.nodes else mpfr(0)
            for stage, row in enumerate(pair.inside):
                if row and row[power] >= 0:
                    sum_ += values[row[power]] * phi[stage]
            residuals.append(sum_)
    return residuals


def factor(matrix):
    """The lower triangle L with L L' = the symmetric matrix (Cholesky)."""
    lower = []
    for i in range(len(matrix)):
        row = []
        for j in range(i):
            row.append((matrix[i][j] - sum(map(mul, row, lower[j]), mpfr(0))) / lower[j][j])
        row.append(gmpy2.sqrt(matrix[i][i] - sum(map(mul, row, row), mpfr(0))))
        lower.append(row)
    return lower


def solve(lower, right):
    """x with L L' x = right."""
    size = len(right)
    y = []
    for row, value in zip(lower, right):
        y.append((value - sum(map(mul, row, y), mpfr(0))) / row[-1])
    x = [mpfr(0)] * size
    for i in reversed(range(size)):
        x[i] = (y[i] - sum((lower[k][i] * x[k] for k in range(i + 1, size)), mpfr(0))) / lower[i][i]
    return x


def jacobian(values, free, residuals, now):
    """Its columns, each number in units of its size: all entries, and the places of those that are not zero."""
    columns = []
    for k in free:
        kept = values[k]
        values[k] = kept + kept * STEP
        column = [(after - before) / STEP for after, before in zip(residuals(values), now)]
        columns.append((column, [i for i, x in enumerate(column) if x]))
        values[k] = kept
    return columns


def product(a, b):
    (a, places), (b, others) = (a, b) if len(a[1]) < len(b[1]) else (b, a)
    if 2 * len(places) > len(a):
        return sum(map(mul, a, b), mpfr(0))
    return sum((a[i] * b[i] for i in places), mpfr(0))


def polish(values, free, residuals):
    """Newton's method to a near solution: (J'J + |F|^2) d = -J'F, each number in units of its size.

    The damping |F|^2 (Levenberg, Marquardt) is far below the squares of the singular values of conditions. It is far
    above those of directions along which solutions form a family: there the numbers keep their published digits. J
    is made anew after a step that gained few digits. Returns the largest residual after each step.
    """
    now = residuals(values)
    sizes, lower = [max(map(abs, now))], None
    while sizes[-1] > SOLVED:
        if len(sizes) > MOST_STEPS:
            raise ArithmeticError(f"Newton's method does not converge: {[float(x) for x in sizes]}")
        if lower is None:
            units, columns = [values[k] for k in free], jacobian(values, free, residuals, now)
            damping = sum(map(mul, now, now))
            lower = factor(
                [[product(a, b) + (damping if a is b else 0) for b in columns[: i + 1]] for i, a in enumerate(columns)]
            )
        right = [-sum(map(mul, column, now), mpfr(0)) for column, _ in columns]
        for k, unit, step in zip(free, units, solve(lower, right)):
            values[k] += unit * step
        now = residuals(values)
        sizes.append(max(map(abs, now)))
        if sizes[-1] > FEW * sizes[-2]:
            lower = None
    return sizes


def polished(name, order, inside):
    """A pair with all residuals below SOLVED, and the residuals on the way."""
    gmpy2.get_context().precision = BITS
    pair = read(name, order)
    found, inner = trees(order), trees(inside)
    of_stages = row_conditions(pair, range(pair.stages))
    sizes = polish(pair.values, pair.of_pair, lambda values: pair_residuals(pair, values, found, of_stages))
    of_inside = row_conditions(pair, range(pair.stages, len(pair.rows)))
    more = polish(pair.values, pair.of_inside, lambda values: inside_residuals(pair, values, inner, of_inside))
    return pair, sizes, more


def with_first(terms, total):
    """The rounded factors of a sum over slopes k_j, written as total k_0 + sum of others (k_j - k_0)."""
    return [(0, float(total)), *((j, float(x)) for j, x in terms if j > 0)] if terms else []


def dense(terms, length):
    terms = dict(terms)
    return [terms.get(j, 0.0) for j in range(length)]


def number(x):
    text = repr(x)
    return text if "." in text or "e" in text else text + ".0"


def lines(items, indent):
    """Comma-separated items, in lines of at most 100 characters."""
    text, line = [], " " * indent
    for item in items:
        if len(line) + len(item) + 2 > 100:
            text.append(line.rstrip())
            line = " " * indent
        line += item + ", "
    return "\n".join([*text, line.rstrip()]) + "\n"


def robust(nodes, stages):
    """The weights of least squares of a quadrature at these stages that is exact up to degree ROBUST."""
    powers = [[nodes[i] ** k for i in stages] for k in range(ROBUST + 1)]
    gram = factor([[sum(map(mul, a, b), mpfr(0)) for b in powers[: k + 1]] for k, a in enumerate(powers)])
    multipliers = solve(gram, [mpfr(1) / (k + 1) for k in range(ROBUST + 1)])
    return {i: sum((x * row[j] for x, row in zip(multipliers, powers)), mpfr(0)) for j, i in enumerate(stages)}


def source(name, inside, kink_ratio, pair):
    """The expression of a pair, which Rust includes."""
    values, stages, total = pair.values, pair.stages, len(pair.rows)
    numbers = lambda terms: [(j, values[k]) for j, k in terms]
    weights = dense(with_first(numbers(pair.weights), 1), stages)
    lower = dict(numbers(pair.lower))
    higher = dict(numbers(pair.weights))
    errors = [(j, higher.get(j, mpfr(0)) - lower.get(j, mpfr(0))) for j in range(stages) if j in higher or j in lower]
    errors = dense(with_first(errors, mpfr(0)), stages)
    text = HEADER.format(orders=name, order=pair.order, stages=stages, more=total - stages, inside=inside)
    same = pair.rows[stages - 1] == pair.weights
    text += f"    order: {pair.order},\n    stages: {stages},\n    kink_ratio: {number(float(kink_ratio))},\n"
    text += f"    first_same_as_last: {str(same).lower()},\n"
    text += f"    degree: {max(map(len, pair.inside))},\n"
    text += "    weights: &[\n" + lines(map(number, weights), 8) + "    ],\n"
    text += "    errors: &[\n" + lines(map(number, errors), 8) + "    ],\n"
    nodes = [node(pair, values, i) for i in range(stages)]
    low = robust(nodes, [0, *range(FIRST_ROBUST, stages)])
    kinks = [(j, higher.get(j, mpfr(0)) - low.get(j, mpfr(0))) for j in range(stages)]
    text += "    kinks: &[\n" + lines(map(number, dense(with_first(kinks, mpfr(0)), stages)), 8) + "    ],\n"
    text += "    times: &[\n" + lines((number(float(node(pair, values, i))) for i in range(total)), 8) + "    ],\n"
    text += "    rows: &[\n"
    for i, row in enumerate(pair.rows):
        terms = with_first(numbers(row), node(pair, values, i))
        terms += [(0, 0.0)] * (len(terms) % 2)
        pairs = [f"[({a}, {number(x)}), ({b}, {number(y)})]" for (a, x), (b, y) in zip(terms[::2], terms[1::2])]
        text += "        &[],\n" if not pairs else "        &[\n" + lines(pairs, 12) + "        ],\n"
    text += "    ],\n    nodes: &[\n"
    nodes = [(1 + gmpy2.cos(gmpy2.const_pi() * (2 * j + 1) / (2 * NODES))) / 2 for j in range(NODES)]
    columns = []
    for s in nodes:
        terms = [
            (i, sum((values[k] * s ** (power + 1) for power, k in enumerate(row) if k >= 0), mpfr(0)))
            for i, row in enumerate(pair.inside)
            if row
        ]
        columns.append(dense(with_first(terms, s), total))
    for row in zip(*columns):
        text += "        [\n" + lines(map(number, row), 12) + "        ],\n" if any(row) else "        [0.0; 16],\n"
    return text + "    ],\n}\n"


def made(job):
    name, order, inside, kink_ratio, file = job
    pair, sizes, more = polished(name, order, inside)
    return file, sizes, more, source(name, inside, kink_ratio, pair)


def verify(_check):
    wrong = 0
    # Two processes of their own: this function runs in the parent of the workers for records.
    with multiprocessing.Pool(2) as pool:
        for file, sizes, more, text in pool.imap(made, PAIRS):
            steps = "; ".join(" ".join(f"{float(x):.0e}" for x in run) for run in (sizes, more))
            committed = (SOURCES / file).read_text(encoding="utf-8") if (SOURCES / file).exists() else ""
            equal = committed == text
            print(f"  {file}: largest residuals {steps}: {'equal' if equal else 'DIFFERS'}", flush=True)
            if not equal:
                OUT.mkdir(parents=True, exist_ok=True)
                (OUT / file).write_text(text, encoding="utf-8")
                print(f"  {OUT / file} is the file that was made")
            wrong += not equal
    return wrong
