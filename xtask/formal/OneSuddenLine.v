(** The line of the certificate `one-sudden`: its numbers, and Theorem 20 up to its largest mass ratio. *)

From Coq Require Import Reals Lra List.
From Interval Require Import Tactic.
From Hopper Require Import Model Energy FirstLanding Fates OneSudden Traps Signs.
Open Scope R_scope.

(** [alpha*_1] lies between these numbers. They lie between those of the line. *)
Definition low := 44934094579090641753078 / 10000000000000000000000.
Definition high := 44934094579090641753079 / 10000000000000000000000.

Lemma line_encloses : 2529564645032789 / 562949953421312 < low /\ high < 316195580629099 / 70368744177664.
Proof. unfold low, high. lra. Qed.

(** The exact value of the largest mass ratio. *)
Definition largest := 8157091696545725 / 9007199254740992.

Theorem star_between : exists a, low < a < high /\ first_star a.
Proof.
  destruct (fixed_point_between low high) as (a & Ha & _ & E).
  - unfold low, high. lra.
  - assert (H1 : 0 < - u low) by (unfold u, low; interval with (i_prec 90)).
    assert (H2 : 0 < u high) by (unfold u, high; interval with (i_prec 90)).
    assert (0 < - u low * u high) by now apply Rmult_lt_0_compat. lra.
  - exists a. split; [exact Ha |]. split; [| exact E].
    assert (PI < low) by (unfold low; interval with (i_prec 40)).
    assert (high < 3 * PI / 2) by (unfold high; interval with (i_prec 40)). lra.
Qed.

(** The sides of the inequality of Theorem 20. *)
Theorem sides : forall a, low < a < high ->
  1 / a < 0.22254815844566603 /\ 1.8457465164318214 < a ^ 2 / 2 / (a - sin a).
Proof.
  intros a Ha. unfold low, high in Ha. split; interval with (i_prec 90).
Qed.

(** For every mass ratio up to this one, a hop from any speed has at most two landings. *)
Theorem one_sudden : forall M alpha l alpha', 0 < M <= largest -> 0 < alpha ->
  closing_speeds M 0 alpha l alpha' -> (length l <= 2)%nat.
Proof.
  intros M alpha l alpha' HM Halpha Hl. destruct star_between as (a & Ha & Hstar).
  apply (at_most_one_sudden M a alpha l alpha'); [lra | exact Hstar | | exact Halpha | exact Hl].
  assert (largest <= (low ^ 2 - 1) / (low ^ 2 + 1)) by (unfold largest, low; interval with (i_prec 90)).
  assert (Hl2 : low ^ 2 <= a ^ 2) by (apply pow_incr; unfold low in *; lra).
  replace ((a ^ 2 - 1) / (a ^ 2 + 1)) with (1 - 2 / (a ^ 2 + 1)) by (field; nra).
  replace ((low ^ 2 - 1) / (low ^ 2 + 1)) with (1 - 2 / (low ^ 2 + 1)) in H by (field; unfold low; lra).
  assert (/ (a ^ 2 + 1) <= / (low ^ 2 + 1)) by (apply Rinv_le_contravar; unfold low in *; lra).
  unfold Rdiv in *. lra.
Qed.
