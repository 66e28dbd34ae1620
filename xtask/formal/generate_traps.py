"""Writes Coq proofs of lines of `traps` and `one-sided` certificates: python generate_traps.py FILE.jsonl N[,N...] > Traps_N.v"""

import json
import sys

from mpmath import mpf

from numbers_for_coq import DIGITS, HEAD, PRECISION, STAR, decimal, exact, half_time, named, star

RATE = """
Lemma rate_{n} : forall t, {lo} <= t <= {top} -> 0 < W_rate t.
Proof. intros t Ht. unfold W_rate. interval with (i_prec 40, i_bisect t). Qed.
"""

TRAP = """
Lemma square_{name} : {hi} ^ 2 <= square {M} {r}.
Proof. signs. Qed.

Lemma reach_{name} : {right} <= A {r}.
Proof. signs. Qed.
{past}
Theorem trap_{name} : {forall}exists c, {lo} < c < {hi} /\\ fixed_speed c /\\
  forall a, c <= a <= {right} -> converges {all} a c.
Proof.
  {intro}destruct star_{n} as (c & Hc & Hf). exists c. split; [exact Hc |]. split; [exact Hf |]. intros a Ha.
  pose proof square_{name} as Hs. pose proof reach_{name} as Hr.
  apply ({rule}); [{positive} | lra | {order}exact Hf | {smaller}| {falls}| lra].
  - intros t Ht. apply rate_{n}. lra.
  - apply Rle_trans with (2 := Hs). apply pow_incr. lra.
Qed.
"""

PAST = """
Lemma falling_{name} : forall t, {top} <= t <= {r} -> 1 <= 4 * mu {M} * W t.
Proof. intros t Ht. unfold mu, W. interval with (i_prec 40, i_bisect t, i_depth 30). Qed.
"""

BEYOND = """
Lemma past_end_{name} : A {h1} < {beyond} < A {h2} /\\
  forall h, {h1} <= h <= {h2} -> 0 < W h /\\ {beyond} ^ 2 - mu {M} * Gam h ^ 2 < {lo} ^ 2.
Proof. split; [split | intros h Hh; split]; signs. Qed.

Theorem falls_{name} : forall a', hop {M} {beyond} a' -> a' < {lo}.
Proof. apply (falls_below {M} {M} {beyond} {h1} {h2}); try apply past_end_{name}; lra. Qed.
"""


def main(path, wanted):
    stars, tops, bounds = {}, {}, {}
    print(HEAD.format(bits=PRECISION, program="generate_traps.py"), end="")
    with open(path, encoding="utf-8") as lines:
        next(lines)
        for at, text in enumerate(lines, 1):
            if at not in wanted:
                continue
            line = json.loads(text)
            n = line["n"]
            step = mpf(10) ** (5 - DIGITS)
            if n not in stars:
                a = stars[n] = star(n)
                top = mpf(int(100 * star(2 * n + 1) / 2 - 1)) / 100
                tops[n] = top
                print()
                bounds[n] = named(n, dict(lo=decimal(a - step), hi=decimal(a + step), top=decimal(top, 2)))
                print((STAR + RATE).format(n=n, **bounds[n], sign="- " if n % 2 else ""), end="")
            a = stars[n]
            r = half_time(line["right"], n) + step
            name = f"{n}_{at}"
            values = dict(M=exact(line["mass_ratio"]), right=exact(line["right"]), r=decimal(r))
            if line["beyond"] is not None:
                h = half_time(line["beyond"], n)
                values.update(beyond=exact(line["beyond"]), h1=decimal(h - step), h2=decimal(h + step))
            print(f"\n(** Line {at}: n = {n}, M = {line['mass_ratio']!r}. *)")
            fill = dict(name=name, n=n, **bounds[n], **named(name, values))
            if r <= tops[n]:
                fill.update(past="", rule="trap {M} c {r}".format(**fill), order="", falls="")
            else:
                fill.update(past=PAST.format(**fill), rule="long_trap {M} c {top} {r}".format(**fill), order="lra | ", falls=f"apply falling_{fill['name']} | ")
            if line["beyond"] is None:
                fill.update(all="M", intro="intros M HM. ", forall="forall M, 0 < M -> ", positive="exact HM", smaller="now apply mu_largest | ", rule="trap_of_smaller_mu 1 M c {r}".format(**fill))
            else:
                fill.update(all=fill["M"], intro="", forall="", positive="lra", smaller="")
            print(TRAP.format(**fill), end="")
            if line["beyond"] is not None:
                print(BEYOND.format(**fill), end="")


main(sys.argv[1], set(map(int, sys.argv[2].split(","))))
