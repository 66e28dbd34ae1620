(** Each fixed point attracts from one side only, for every mass ratio (the statement of the certificate `one-sided`), and the
    flights of a hop are unique. *)

From Coq Require Import Reals Lra Lia List.
From Coquelicot Require Import Coquelicot.
From Hopper Require Import Analysis Model Energy FirstLanding Windows Fates OneSudden Losses Finite Traps Crises.
Import ListNotations.
Open Scope R_scope.

(** The closing speeds of a hop and the state at its end are unique: the sum of Theorem 4 is a function of the speed. *)
Theorem flights_unique : forall M x V l y W, flights M x V l y W -> forall l' y' W', flights M x V l' y' W' ->
  l = l' /\ y = y' /\ W = W'.
Proof.
  intros M x V l y W H. induction H as [x V tau x' V' L C | x V tau l y W x' V' L T H IH]; intros l2 y2 W2 H2;
    inversion H2 as [a b tau2 c d L2 C2 | a b tau2 l3 e g c d L2 T2 H3]; subst;
    pose proof (lands_unique _ _ _ _ L L2); subst tau2.
  - repeat split; reflexivity.
  - exfalso. unfold contact, take_off, c, d, x', V' in *. lra.
  - exfalso. unfold contact, take_off, c, d, x', V' in *. lra.
  - destruct (IH _ _ _ H3) as (-> & -> & ->). repeat split; reflexivity.
Qed.

(** Every alpha*_n attracts an interval on its right, the same one for all mass ratios. *)
Theorem attracts : forall n c, (1 <= n)%nat -> star n c -> exists d, 0 < d /\ forall M, 0 < M ->
  forall a, c <= a <= c + d -> converges M a c.
Proof.
  intros n c Hn Hs. pose proof Hs as [Hb Hu]. pose proof (between_positive n c Hb) as Hc.
  assert (Hf : fixed_speed c). { unfold fixed_speed, u in *. lra. }
  destruct (A_fixed c Hc Hf) as (_ & EA & EW & Esq).
  destruct (derive_continuity W c (W_rate c) (W_derive c) 1) as [d [Hd Hd']]; [lra |].
  unfold between_multiples in Hb.
  pose (r := Rmin (c + d / 2) ((c + INR (S n) * PI) / 2)).
  assert (Hr : c < r < INR (S n) * PI /\ r <= c + d / 2).
  { unfold r, Rmin. destruct (Rle_dec _ _); lra. }
  assert (HW : forall t, c <= t <= r -> W t <= 1).
  { intros t Ht. destruct (Req_dec t c) as [-> | Hne]; [lra |].
    specialize (Hd' t). simpl in Hd'. unfold R_dist, D_x, no_cond in Hd'.
    assert (Rabs (W t - W c) < 1).
    { apply Hd'. split; [split; [exact I | now apply not_eq_sym] |]. rewrite Rabs_right; lra. }
    apply Rabs_def2 in H. lra. }
  exists (A r - c). split; [pose proof (A_increases c r ltac:(lra)); lra |].
  intros M HM a Ha. apply (trap_of_squares M c r); try lra; try exact Hf.
  - intros h Hh. rewrite W_u. pose proof (sign_after n c h Hs ltac:(lra)). lra.
  - intros h Hh. rewrite <- (Esq M). apply square_up; [lra |]. intros t Ht.
    pose proof (HW t ltac:(lra)). pose proof (mu_positive M HM). pose proof (mu_largest M HM).
    assert (mu 1 = / 4) by (unfold mu; field).
    destruct (Rle_dec 0 (W t)); nra.
Qed.

(** From its left nothing converges to it. *)
Theorem one_sided : forall n c, (1 <= n)%nat -> star n c ->
  (exists d, 0 < d /\ forall M, 0 < M -> forall a, c <= a <= c + d -> converges M a c) /\
  forall M, 0 < M -> forall a, 0 < a < c -> ~ converges M a c.
Proof.
  intros n c Hn Hs. split; [now apply (attracts n) |]. intros M HM a Ha. now apply stays_below.
Qed.
