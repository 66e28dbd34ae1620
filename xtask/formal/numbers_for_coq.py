"""Numbers and texts that the generators of Coq proofs share."""

from fractions import Fraction

from mpmath import cos, findroot, mp, mpf, pi, sin

mp.dps = 60
DIGITS = 24
PRECISION = 90


def decimal(value, digits=DIGITS):
    """A rational literal near a number: an integer over a power of ten."""
    return f"({int(mp.nint(value * mpf(10) ** digits))} / {10**digits})"


def exact(value):
    """The exact value of a double."""
    f = Fraction(value)
    return f"({f.numerator} / {f.denominator})" if f.denominator > 1 else f"{f.numerator}"


def speed(h):
    return (h * h - sin(h) ** 2) / (h - sin(h) * cos(h))


def star(n):
    return findroot(lambda h: h * cos(h) - sin(h), (n + mpf("0.5")) * pi - 1 / ((n + mpf("0.5")) * pi))


def half_time(a, n):
    """By bisection: it lies between the speed and (n+1) pi on a contact part."""
    low, high = mpf(a), (n + 1) * pi
    for _ in range(4 * DIGITS + 20):
        middle = (low + high) / 2
        low, high = (middle, high) if speed(middle) < a else (low, middle)
    return low


def named(name, values):
    """Prints a notation for each number, and returns the names."""
    names = {key: f"{key}_{name}" for key in values}
    for key, value in values.items():
        print(f"Notation {names[key]} := {value}.")
    return names


HEAD = """(** Certificate lines, proved from signs by the [interval] tactic. Written by {program}. *)

From Coq Require Import Reals Lra Lia.
From Interval Require Import Tactic.
From Hopper Require Import Analysis Model Energy FirstLanding Fates Traps Crises Signs.
Open Scope R_scope.

Ltac signs := unfold u, W_rate, W, square, A, Gam, D, mu; interval with (i_prec {bits}).
"""

STAR = """
(** [alpha*_{n}] lies between two rational numbers. *)
Lemma star_{n} : exists c, {lo} < c < {hi} /\\ fixed_speed c.
Proof.
  apply fixed_point_between; [lra |].
  assert (H1 : 0 < {sign}u {lo}) by signs. assert (H2 : {sign}u {hi} < 0) by signs. nra.
Qed.
"""
