"""Writes Coq proofs of lines of a `crisis` certificate: python generate_crisis.py FILE.jsonl N[,N...] > Crisis.v"""

import json
import sys

from mpmath import cos, mp, mpf, pi, sin

from numbers_for_coq import DIGITS, HEAD, PRECISION, STAR, decimal, exact, half_time, named, star

FACTS = """
Lemma rising_{n} : forall t, {lo} <= t <= {p1} -> 0 < W_rate t.
Proof. intros t Ht. unfold W_rate. interval with (i_prec 40, i_bisect t). Qed.

Lemma middle_{n} : forall t, {p1} <= t <= {p2} -> 1 <= 4 * mu {low} * W t.
Proof. intros t Ht. unfold mu, W. interval with (i_prec 40, i_bisect t). Qed.

Lemma order_{n} : {q2} < INR {next} * PI < {end} /\\ {h2} < INR {next} * PI.
Proof. replace (INR {next}) with {next} by (simpl; ring). split; [split |]; interval with (i_prec 40). Qed.

Lemma falling_{n} : forall t, {p2} <= t <= {end} -> W_rate t < 0.
Proof. intros t Ht. unfold W_rate. interval with (i_prec 40, i_bisect t). Qed.

Lemma minimum_{n} : 1 <= 4 * mu {low} * W {q1} /\\ 4 * mu {low} * W {q2} <= 1 /\\
  forall t, {q1} <= t <= {q2} -> {hi} ^ 2 <= square {low} t.
Proof. split; [| split; [| intros t Ht]]; signs. Qed.

Lemma fall_{n} : A {h1} < {speed} < A {h2} /\\
  forall h, {h1} <= h <= {h2} -> 0 < W h /\\ {speed} ^ 2 - mu {high} * Gam h ^ 2 < {lo} ^ 2.
Proof. split; [split | intros h Hh; split]; signs. Qed.

(** There is one mass ratio M_c up to 1, and it lies between the two numbers: up to it the whole contact part converges to
    alpha*_{n}, and above it a speed falls below. At the upper number it is the speed of the line. *)
Theorem crisis_{n} : exists c M0, {lo} < c < {hi} /\\ fixed_speed c /\\ {low} <= M0 <= {high} /\\
  (forall M, 0 < M <= 1 ->
    (M <= M0 -> forall a, c <= a < INR {next} * PI -> converges M a c) /\\
    (M0 < M -> exists a, c < a < INR {next} * PI /\\ forall a', hop M a a' -> a' < c)) /\\
  forall a', hop {high} {speed} a' -> a' < c.
Proof.
  destruct star_{n} as (c & Hc & Hf). pose proof order_{n} as He.
  destruct minimum_{n} as (H1 & H2 & H3). destruct fall_{n} as [Hs Hh].
  destruct (part_by_signs {low} {next} c {p1} {p2} {q1} {q2}) as [Hpart Hsq]; try lra; try lia; try exact Hf.
  - intros t Ht. apply rising_{n}. lra.
  - apply middle_{n}.
  - intros t Ht. apply falling_{n}. lra.
  - intros t Ht. apply Rle_trans with (2 := H3 t Ht). apply pow_incr. lra.
  - destruct (half_time {speed} ltac:(lra)) as (h & Hpos & Eh).
    assert (Hin : {h1} <= h <= {h2}).
    {{ split; apply Rnot_lt_le; intro H; [pose proof (A_increases h {h1}) | pose proof (A_increases {h2} h)]; lra. }}
    destruct (Hh h Hin) as [_ Hfall]. rewrite <- Eh in Hfall.
    assert (Hlo : {lo} ^ 2 <= c ^ 2) by (apply pow_incr; lra).
    destruct (one_crisis {next} c {low} {high} h) as (M0 & HM0 & Hall); try assumption; try lra; [unfold square; lra |].
    exists c, M0. repeat (split; [assumption |]). intros a' Hhop. apply Rlt_trans with {lo}; [| lra].
    apply (falls_below {high} {high} {speed} {h1} {h2}); try lra; assumption.
Qed.
"""


def weight(h):
    return sin(h) * (sin(h) - h * cos(h))


def main(path, wanted):
    print(HEAD.format(bits=PRECISION, program="generate_crisis.py"), end="")
    with open(path, encoding="utf-8") as lines:
        next(lines)
        for line in map(json.loads, lines):
            n, (low, high) = line["n"], line["mass_ratio"]
            if n not in wanted:
                continue
            a, step = star(n), mpf(10) ** (5 - DIGITS)
            peak = star(2 * n + 1) / 2
            p1 = mpf(int(100 * peak - 1)) / 100
            left, right = peak, (n + 1) * pi
            mu = mpf(low) / (1 + mpf(low)) ** 2
            for _ in range(4 * DIGITS + 20):
                middle = (left + right) / 2
                left, right = (middle, right) if 4 * mu * weight(middle) > 1 else (left, middle)
            h = half_time(line["speed"], n)
            print(f"\n(** Line {n}. *)")
            names = named(
                n,
                dict(
                    low=exact(low), high=exact(high), speed=exact(line["speed"]), lo=decimal(a - step), hi=decimal(a + step),
                    p1=decimal(p1, 2), p2=decimal(p1 + mpf("0.03"), 2), end=decimal((n + 1) * pi + mpf("0.01"), 3),
                    q1=decimal(left - step), q2=decimal(left + step), h1=decimal(h - step), h2=decimal(h + step),
                ),
            )
            print((STAR + FACTS).format(n=n, next=n + 1, sign="- " if n % 2 else "", **names), end="")


main(sys.argv[1], set(map(int, sys.argv[2].split(","))))
