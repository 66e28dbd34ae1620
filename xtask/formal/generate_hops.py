"""Writes Coq proofs of hops with one sudden lift-off of intervals of speeds: python generate_hops.py M LOW HIGH PARTS > Hop.v"""

import sys

from mpmath import cos, findroot, iv, mp, mpf, sin

from numbers_for_coq import decimal, exact

mp.dps = iv.dps = 30
DIGITS = 12

HEAD = """(** Hops with a sudden lift-off, proved from signs by the [interval] tactic. Written by generate_hops.py. *)

From Coq Require Import Reals Lra.
From Interval Require Import Tactic.
From Hopper Require Import Model Energy Hops Signs.
Open Scope R_scope.

Ltac names := unfold G, momentum, stretch, closing, stretch_rate, energy, kappa.
Ltac signs := names; interval with (i_prec 60).
"""

HOP = """
Lemma hop_{name} : forall a, {a1} <= a <= {a2} -> exists a', hop {M} a a' /\\ {b1} <= a' <= {b2}.
Proof.
  apply (sudden_hop {M} {a1} {a2} {t1} {t2} {x1} {x2} {v1} {v2} {p} {q} {t3} {t4}); try lra; try signs.
  - intros a t Ha Ht. names. split; split; interval with (i_prec 60).
  - intros t Ht. names. interval with (i_prec 60, i_bisect t, i_autodiff t).
  - intros t Ht. names. interval with (i_prec 60, i_bisect t, i_autodiff t).
  - intros t Ht. names. interval with (i_prec 60, i_bisect t, i_autodiff t).
  - intros x V t Hx HV Ht. names. split; [| split]; interval with (i_prec 60).
Qed.
"""


def height(x, v, t):
    return 1 + x + v * t - t * t / 2 - (1 + x) * cos(t) - v * sin(t)


def closing(x, v, t):
    return -(1 + x) * sin(t) + v * cos(t) - v + t


def landing(x, v, first, step):
    t = first
    while height(x, v, t) > 0:
        t += step
    return findroot(lambda s: height(x, v, s), (t - step, t), solver="anderson", tol=1e-24)


def wide(f, t):
    """An enclosure of a sine or cosine that is not narrower than that of the tactic."""
    low, high = mpf(t.a), mpf(t.b)
    return iv.mpf(f((low + high) / 2)) + iv.mpf([low - high, high - low]) + iv.mpf([-1, 1]) * mpf(10) ** -12


def down(value, digits=DIGITS):
    return decimal(mp.floor(value * mpf(10) ** digits) / mpf(10) ** digits, digits)


def up(value, digits=DIGITS):
    return decimal(mp.ceil(value * mpf(10) ** digits) / mpf(10) ** digits, digits)


def hop(name, m, a1, a2):
    literal, m = exact(m), mpf(m)
    kappa = m / (1 + m)
    t1, t2 = (landing(mpf(0), a, mpf("0.1"), mpf("0.01")) for a in (a1, a2))
    spare = mpf(10) ** (4 - DIGITS)
    t1, t2 = t1 - spare, t2 + spare
    # Boxes by the same interval expressions that the tactic evaluates.
    a, t, k = iv.mpf([a1, a2]), iv.mpf([t1, t2]), iv.mpf(kappa)
    x = a * t - t**2 / 2
    v = a - t + k * ((-wide(sin, t) + a * wide(cos, t)) - (a - t))
    x1, x2, v1, v2 = mpf(x.a) - spare, mpf(x.b) + spare, mpf(v.a) - spare, mpf(v.b) + spare
    t3 = landing(x1, v1, mpf("0.001"), mpf("0.001")) - spare
    t4 = landing(x2, v2, mpf("0.001"), mpf("0.001")) + spare
    # The time at which the stretch of the lowest state falls through 1.
    cross, step = mpf(0), mpf("0.0001")
    while (1 + x1) * cos(cross + step) + v1 * sin(cross + step) > 1:
        cross += step
    p, q = cross - mpf("0.01") * cross, cross + mpf("0.01") * cross
    x, v, t = iv.mpf([x1, x2]), iv.mpf([v1, v2]), iv.mpf([t3, t4])
    y = (1 + x) * wide(cos, t) + v * wide(sin, t) - 1
    w = v - t + k * ((-(1 + x) * wide(sin, t) + v * wide(cos, t)) - (v - t))
    end = w**2 + y * (2 + k * y)
    b1, b2 = mp.sqrt(mpf(end.a)) - spare, mp.sqrt(mpf(end.b)) + spare
    return HOP.format(
        name=name, M=literal, a1=decimal(a1, DIGITS), a2=decimal(a2, DIGITS), t1=down(t1), t2=up(t2), x1=down(x1), x2=up(x2),
        v1=down(v1), v2=up(v2), p=down(p, 6), q=up(q, 6), t3=down(t3), t4=up(t4), b1=down(b1), b2=up(b2),
    )


def main(m, low, high, parts):
    print(HEAD, end="")
    for at in range(parts):
        print(hop(at, m, low + (high - low) * at / parts, low + (high - low) * (at + 1) / parts), end="")


main(float(sys.argv[1]), mpf(sys.argv[2]), mpf(sys.argv[3]), int(sys.argv[4]))
