(** Composition: a hop with a sudden lift-off, then a trap. All speeds of an interval of window 2 converge to alpha*_1. *)

From Coq Require Import Reals Lra.
From Hopper Require Import Model Fates TrapLines HopSudden.
Open Scope R_scope.

Theorem basin : exists c, lo_1 < c < hi_1 /\ fixed_speed c /\
  forall a, 6.771 <= a <= 6.7711 -> converges (5093863088713741 / 18014398509481984) a c.
Proof.
  destruct trap_1_200 as (c & Hc & Hf & Htrap). exists c. split; [exact Hc |]. split; [exact Hf |]. intros a Ha.
  destruct (hop_0 a ltac:(lra)) as (a' & Hhop & Ha'). apply (converges_after_hop _ a a' c Hhop). apply Htrap. lra.
Qed.
