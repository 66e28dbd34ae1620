"""The map on its contact intervals (alpha*_n, (n+1) pi), by half the flight time h, and the edge of a trap there.

    D = h - sin h cos h,   u = h cos h - sin h,   A = (h^2 - sin^2 h)/D = alpha,   Gamma = 2 u^2/D
    alpha'^2 = A^2 - mu Gamma^2,     alpha alpha' slope = alpha (1 - 4 mu W),     W = sin h (sin h - h cos h)
W has one maximum on the interval, at 2h = alpha*_{2n+1}. So alpha' rises, falls and rises again, and falls only
between the two places of 4 mu W = 1. A trap ends where alpha' falls through alpha*_n, if it does.
"""

from mpmath import cos_sin, mp, mpf, sqrt

from hop import alpha_star


def star(n):
    """alpha*_n, with alpha*_0 = 0."""
    return alpha_star(n) if n else mpf(0)


def speed_and_loss(h):
    """A and Gamma."""
    c, s = cos_sin(h)
    d, u = h - s * c, h * c - s
    return (h * h - s * s) / d, 2 * u * u / d


def bump(h):
    """W."""
    c, s = cos_sin(h)
    return s * (s - h * c)


def zero(function, left, right):
    """The place where `function` changes sign, by the Illinois method; the bracket shrinks from both ends."""
    f_left, f_right = function(left), function(right)
    if f_left == 0:
        return left
    if f_right == 0:
        return right
    if (f_left > 0) == (f_right > 0):
        raise ValueError("no change of sign")
    side = 0
    for _ in range(10 * mp.prec):
        middle = (left * f_right - right * f_left) / (f_right - f_left)
        if not left < middle < right:
            middle = (left + right) / 2
        f_middle = function(middle)
        if f_middle == 0 or abs(right - left) <= 4 * mp.eps * abs(right):
            return middle
        if (f_middle > 0) == (f_right > 0):
            right, f_right = middle, f_middle
            f_left = f_left / 2 if side == 1 else f_left
            side = 1
        else:
            left, f_left = middle, f_middle
            f_right = f_right / 2 if side == -1 else f_right
            side = -1
    return (left + right) / 2


def falling_lap(n, mu):
    """The ends in h of the lap on which alpha' falls, or None."""
    top = alpha_star(2 * n + 1) / 2

    def excess(h):
        return 4 * mu * bump(h) - 1

    if excess(top) <= 0:
        return None
    first = star(n) if n else mp.mpf(10) ** -3  # at h = 10^-3 W is 3e-13: before the lap for every mu <= 1/4
    return zero(excess, first, top), zero(excess, top, (n + 1) * mp.pi)


def trap_edge(n, mass_ratio):
    """The speed where the trap of alpha*_n ends on its contact interval; None where all of the interval belongs to
    it."""
    m = mpf(mass_ratio)
    mu = m / (1 + m) ** 2
    lap = falling_lap(n, mu)
    if lap is None:
        return None
    target = star(n) ** 2

    def surplus(h):
        a, gamma = speed_and_loss(h)
        return a * a - mu * gamma * gamma - target

    if surplus(lap[1]) >= 0:
        return None
    return speed_and_loss(zero(surplus, *lap))[0]


def touch(n, of_ground=False):
    """mu_c(n) and the speed where the hump touches alpha*_n, or 0: the minimum of (A^2 - alpha*_n^2)/Gamma^2, or of
    A^2/Gamma^2.

    There Gamma^2 = 4 W (A^2 - alpha*_n^2), behind the maximum of W.
    """
    target = 0 if of_ground else star(n) ** 2

    def slope(h):
        a, gamma = speed_and_loss(h)
        return gamma * gamma - 4 * bump(h) * (a * a - target)

    a, gamma = speed_and_loss(zero(slope, alpha_star(2 * n + 1) / 2, (n + 1) * mp.pi))
    return (a * a - target) / (gamma * gamma), a


def smaller_mass_ratio(mu):
    """The M <= 1 with M/(1+M)^2 = mu."""
    return (1 - 2 * mu - sqrt(1 - 4 * mu)) / (2 * mu)
