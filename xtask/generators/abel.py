"""The map at a fixed point as a power series in x = |delta|^(1/3), and Abel's equation for it.

On either side of alpha*_n the offset is delta = +-x^3, and a hop takes x to x' = x + a x^2 + b x^3 + ... The phase P is
the solution of P(x') = P(x) - 1 with
    P = 1/(a x) + c ln x + d_1 x + d_2 x^2 + ...        c = (b - a^2)/a^2
On the left a = 10 lambda/3 > 0, and P counts the hops until the orbit has left. On the right a = -lambda/3 < 0, and
-P = 3/(lambda x) + c_R ln x - ... grows by 1 in a hop, with c_R = -c.

The series are found without any expansion on paper. The flight time 2 alpha*_n + t of the first flight is the
parameter: delta = N(t)/Q(t) exactly (docs/theory.md, Lemma 34). On the left the second flight has the time that
solves its own landing equation, as a power series in t.
"""

from mpmath import cbrt, cos_sin, factorial, ln, mp, mpf, sqrt

from hop import Hop, alpha_star

# A series is a list of coefficients; all of one calculation have the same length.


def times(p, q):
    size = len(p)
    return [mp.fdot(p[: k + 1], q[k::-1]) for k in range(size)]


def plus(p, q):
    return [x + y for x, y in zip(p, q)]


def scaled(p, factor):
    return [x * factor for x in p]


def quotient(p, q):
    made = []
    for k, x in enumerate(p):
        made.append((x - mp.fdot(made, q[k:0:-1])) / q[0])
    return made


def power(p, exponent):
    """p^exponent for p[0] > 0: the recurrence from p * (p^e)' = e * p' * p^e."""
    made = [p[0] ** exponent]
    for k in range(1, len(p)):
        total = mp.fsum(((exponent + 1) * j - k) * p[j] * made[k - j] for j in range(1, k + 1))
        made.append(total / (k * p[0]))
    return made


def composed(outer, inner):
    """outer(inner) for inner[0] = 0, by Horner's rule."""
    made = [mpf(0)] * len(inner)
    for x in reversed(outer):
        made = times(made, inner)
        made[0] += x
    return made


def inverse(p):
    """The inverse of p = p_1 w + p_2 w^2 + ... (Lagrange): k q_k is the coefficient of w^(k-1) in (w/p)^k."""
    size = len(p)
    base = quotient([mpf(1)] + [mpf(0)] * (size - 1), p[1:] + [mpf(0)])
    made, raised = [mpf(0)], [mpf(1)] + [mpf(0)] * (size - 1)
    for k in range(1, size):
        raised = times(raised, base)
        made.append(raised[k - 1] / k)
    return made


def lowered(p, by):
    """p divided by w^by. The first coefficients are zero but for rounding."""
    return p[by:] + [mpf(0)] * by


def shape(size):
    """(1 - cos w)/w^2, (w - sin w)/w^3, cos w and sin w."""
    zero = mpf(0)
    cosine = [(-1) ** (k // 2) / factorial(k) if k % 2 == 0 else zero for k in range(size + 3)]
    sine = [(-1) ** (k // 2) / factorial(k) if k % 2 else zero for k in range(size + 3)]
    return [-x for x in cosine[2 : size + 2]], [-x for x in sine[3 : size + 3]], cosine[:size], sine[:size]


def map_series(side, n, mass_ratio, size):
    """x'(x) as a series: the coefficients of x^0 ... x^size."""
    work = size + 6
    m = mpf(mass_ratio)
    kappa, mu = m / (1 + m), m / (1 + m) ** 2
    star = alpha_star(n)
    square = 1 + star * star
    # cos 2 alpha* and sin 2 alpha*, from tan alpha* = alpha*.
    c2, s2 = (1 - star * star) / square, 2 * star / square
    one_minus_cos, w_minus_sin, cosine, sine = shape(work)
    zero = [mpf(0)] * work
    t = list(zero)
    t[1] = mpf(1)
    # cos and sin of the flight time 2 alpha* + t.
    c = plus(scaled(cosine, c2), scaled(sine, -s2))
    s = plus(scaled(cosine, s2), scaled(sine, c2))
    # N = alpha* (t - sin t) + (t^2/2 - 1 + cos t), Q = 2 alpha* + t - sin(2 alpha* + t).
    top = scaled([mpf(0)] * 3 + w_minus_sin[: work - 3], star)
    top = plus(top, [mpf(0)] * 3 + [(-1) ** (k // 2) / factorial(k) if k % 2 == 0 else mpf(0) for k in range(3, work)])
    q = plus(t, scaled(s, -1))
    q[0] += 2 * star
    delta = quotient(top, q)
    alpha = list(delta)
    alpha[0] += star
    # First landing: stretch, closing speed, speed of the upper mass.
    time = list(t)
    time[0] += 2 * star
    stretch = plus(c, times(alpha, s))
    one_minus_c = scaled(c, -1)
    one_minus_c[0] += 1
    closing = plus(plus(times(alpha, one_minus_c), scaled(time, -1)), s)
    closing[0] = closing[1] = mpf(0)
    squares = times(closing, closing)
    if side == "left":
        velocity = plus(plus(alpha, scaled(time, -1)), scaled(closing, -kappa))
        stretch[0] = mpf(1)
        # Second landing: G/w^2 = Y (1 - cos w)/w^2 - 1/2 + V w (w - sin w)/w^3 = 0 for its time w = -3 t + ...
        w = list(zero)
        w[1] = mpf(-3)
        correct = 2
        while correct < work:
            correct = min(2 * correct, work)
            part = w[:correct]
            lift, drop = composed(one_minus_cos[:correct], part), composed(w_minus_sin[:correct], part)
            y, v = stretch[:correct], velocity[:correct]
            value = plus(times(y, lift), times(v, times(part, drop)))
            value[0] -= mpf(1) / 2
            slope_lift = [k * x for k, x in enumerate(one_minus_cos[: correct + 1])][1:]
            slope_drop = [(k + 1) * x for k, x in enumerate(w_minus_sin[:correct])]
            slope = plus(times(y, composed(slope_lift, part)), times(v, composed(slope_drop, part)))
            part = plus(part, scaled(quotient(value, slope), -1))
            w[:correct] = part
        cw, sw = composed(cosine, w), composed(sine, w)
        lift = scaled(cw, -1)
        lift[0] += 1
        second = plus(plus(times(velocity, lift), scaled(w, -1)), times(stretch, sw))
        second[0] = second[1] = mpf(0)
        squares = plus(squares, times(second, second))
    # delta' = delta - mu sum/(alpha + alpha').
    radicand = plus(times(alpha, alpha), scaled(squares, -mu))
    following = plus(delta, scaled(quotient(scaled(squares, mu), plus(alpha, power(radicand, mpf(1) / 2))), -1))
    # t = -w on the left, w > 0 on both sides.
    sign = -1 if side == "left" else 1

    def cube_root(p):
        turned = [x * sign ** (k + 1) for k, x in enumerate(p)]
        root = power(lowered(turned, 3)[: work - 3], mpf(1) / 3)
        return ([mpf(0)] + root)[: size + 1]

    return composed(cube_root(following), inverse(cube_root(delta)))


def leading(side, n, mass_ratio):
    """a and c in closed form: they suffice far below every other term, at the precision in force."""
    m = mpf(mass_ratio)
    star = alpha_star(n)
    beta = cbrt(12 * star * star / (1 + star * star))
    strength = m / (1 + m) ** 2 * star * beta**4 / 8
    if side == "left":
        return 10 * strength / 3, -2 - 3 * beta / (10 * strength * star)
    return -strength / 3, -2 - 3 * beta / (strength * star)


def abel(series):
    """a, c and d_1, d_2, ... from the series of x'."""
    # x' = x (1 + u). The equation divided by 1: (1/(1+u) - 1)/(a x) + c ln(1+u) + sum d_k x^k ((1+u)^k - 1) = -1.
    size = len(series) - 1
    ratio = series[1:]
    ratio[0] = mpf(1)
    a, b = ratio[1], ratio[2]
    c = (b - a * a) / (a * a)
    first = quotient([mpf(1)] + [mpf(0)] * (size - 1), ratio)
    u = [mpf(0)] + ratio[1:]
    # ln(1+u) by its derivative u'/(1+u).
    slope = quotient([k * x for k, x in enumerate(u)][1:] + [mpf(0)], ratio)
    logarithm = [mpf(0)] + [x / (k + 1) for k, x in enumerate(slope[:-1])]
    # The left side times x: first[1] x / a is the 1.
    rest = [first[k + 1] / a + c * logarithm[k] for k in range(size - 1)]
    made, raised = [], list(ratio)
    for k in range(1, size - 2):
        # Order x^(k+1): d_k k a + rest = 0.
        d = -rest[k + 1] / (k * a)
        made.append(d)
        for j in range(1, size - 1 - k):
            rest[k + j] += d * raised[j]
        raised = times(raised, ratio)
    return a, c, made


_solutions = {}


def solution(side, n, mass_ratio, terms):
    """(a, c, d_1 ... d_terms) at twice the precision of the result."""
    key = (side, n, mass_ratio, terms, mp.prec)
    if key not in _solutions:
        with mp.workprec(2 * mp.prec + 64):
            a, c, d = abel(map_series(side, n, mass_ratio, terms + 4))
            closed = leading(side, n, mass_ratio)
            if abs(closed[0] / a - 1) + abs(closed[1] / c - 1) > mpf(2) ** -(mp.prec // 2):
                raise ArithmeticError("the series contradicts a and c in closed form")
        _solutions[key] = (a, c, d[:terms])
    return _solutions[key]


def sum_of_series(x, a, c, d):
    """P from its expansion."""
    return 1 / (a * x) + c * ln(x) + x * mp.polyval(d[::-1], x)
