(** Hops with a sudden lift-off, proved from signs by the [interval] tactic. Written by generate_hops.py. *)

From Coq Require Import Reals Lra.
From Interval Require Import Tactic.
From Hopper Require Import Model Energy Hops Signs.
Open Scope R_scope.

Ltac names := unfold G, momentum, stretch, closing, stretch_rate, energy, kappa.
Ltac signs := names; interval with (i_prec 60).

Lemma hop_0 : forall a, (6771000000000 / 1000000000000) <= a <= (6771100000000 / 1000000000000) -> exists a', hop (5093863088713741 / 18014398509481984) a a' /\ (4508043859597 / 1000000000000) <= a' <= (4524692440698 / 1000000000000).
Proof.
  apply (sudden_hop (5093863088713741 / 18014398509481984) (6771000000000 / 1000000000000) (6771100000000 / 1000000000000) (13064976246754 / 1000000000000) (13065083276879 / 1000000000000) (3114753640887 / 1000000000000) (3118183221949 / 1000000000000) (-3701494386295 / 1000000000000) (-3700855653244 / 1000000000000) (649934 / 1000000) (663065 / 1000000) (1936493468649 / 1000000000000) (1938191085728 / 1000000000000)); try lra; try signs.
  - intros a t Ha Ht. names. split; split; interval with (i_prec 60).
  - intros t Ht. names. interval with (i_prec 60, i_bisect t, i_autodiff t).
  - intros t Ht. names. interval with (i_prec 60, i_bisect t, i_autodiff t).
  - intros t Ht. names. interval with (i_prec 60, i_bisect t, i_autodiff t).
  - intros x V t Hx HV Ht. names. split; [| split]; interval with (i_prec 60).
Qed.
