(** Theorem 4 with the condition of grounding, hops for mass ratios up to M_1, and Lemma 32 of docs/theory.md. *)

From Coq Require Import Reals Lra List.
From Coquelicot Require Import Coquelicot.
From Hopper Require Import Analysis Model Energy FirstLanding OneSudden.
Import ListNotations.
Open Scope R_scope.

(** Flights with these closing speeds lead from a take-off to the state [(x', V')], in which contact begins. *)
Inductive flights M : R -> R -> list R -> R -> R -> Prop :=
| last_flight : forall x V tau (x' := stretch x V tau - 1) (V' := V - tau + kappa M * closing x V tau),
    lands x V tau -> contact x' V' -> flights M x V [closing x V tau] x' V'
| sudden_flight : forall x V tau l y W (x' := stretch x V tau - 1) (V' := V - tau + kappa M * closing x V tau),
    lands x V tau -> take_off x' V' -> flights M x' V' l y W -> flights M x V (closing x V tau :: l) y W.

Lemma flights_energy : forall M x V l y W, 0 < M -> flights M x V l y W ->
  contact y W /\ energy M y W = energy M x V - mu M * sum_of_squares l.
Proof.
  intros M x V l y W HM H. induction H as [x V tau x' V' Hl Hc | x V tau l y W x' V' Hl Ht Hf [Hc IH]];
    unfold sum_of_squares in *; cbn [fold_right].
  - split; [exact Hc |]. unfold x', V'. rewrite energy_of_landing by assumption. ring.
  - split; [exact Hc |]. rewrite IH. unfold x', V'. rewrite energy_of_landing by assumption. ring.
Qed.

Lemma flights_decide : forall M x V l y W a, 0 < M -> flights M x V l y W ->
  (moves M x V a <-> 0 < energy M y W /\ a = sqrt (energy M y W)).
Proof.
  intros M x V l y W a HM H. induction H as [x V tau x' V' Hl Hc | x V tau l y W x' V' Hl Ht Hf IH].
  - rewrite <- (contact_ends M x' V' a HM Hc).
    assert (HL : landing M x V x' V') by (apply landing_closed; [exact HM | now exists tau]).
    split; intro Hm; [| now apply ends_gradually with x' V'].
    inversion Hm as [? ? p q ? HL2 Hc2 Hg | ? ? p q ? HL2 Ht2 Hm2]; subst;
      apply landing_closed in HL2; try exact HM; destruct HL2 as (t & Hlt & -> & ->);
      rewrite (lands_unique x V t tau Hlt Hl) in *; [exact Hg |].
    fold x' V' in Ht2. unfold contact, take_off in *. lra.
  - assert (HL : landing M x V x' V') by (apply landing_closed; [exact HM | now exists tau]).
    rewrite <- IH. split; intro Hm; [| now apply lifts_off_suddenly with x' V'].
    inversion Hm as [? ? p q ? HL2 Hc2 Hg | ? ? p q ? HL2 Ht2 Hm2]; subst;
      apply landing_closed in HL2; try exact HM; destruct HL2 as (t & Hlt & -> & ->);
      rewrite (lands_unique x V t tau Hlt Hl) in *; [| exact Hm2].
    fold x' V' in Hc2. unfold contact, take_off in *. lra.
Qed.

(** Theorem 4: the next speed is the root of [F = a^2 - mu (sum of squares)], and the hopper is grounded if and only if [F] is
    not positive. That the flights are finitely many is Theorem 18; for mass ratios up to M_1 it is Theorem 20 below. *)
Theorem next_speed : forall M a l y W a', 0 < M -> flights M 0 a l y W ->
  (hop M a a' <-> 0 < a ^ 2 - mu M * sum_of_squares l /\ a' = sqrt (a ^ 2 - mu M * sum_of_squares l)).
Proof.
  intros M a l y W a' HM Hf. destruct (flights_energy M 0 a l y W HM Hf) as [_ E].
  replace (energy M 0 a) with (a ^ 2) in E by (unfold energy; ring). rewrite <- E. now apply flights_decide with l.
Qed.

Theorem grounded_exactly : forall M a l y W, 0 < M -> flights M 0 a l y W ->
  (grounded M a <-> a ^ 2 - mu M * sum_of_squares l <= 0).
Proof.
  intros M a l y W HM Hf. split.
  - intro Hg. apply Rnot_lt_le. intro Hp. apply Hg. eexists. apply (next_speed M a l y W); [exact HM | exact Hf |]. eauto.
  - intros Hle [a' Ha']. apply (next_speed M a l y W) in Ha'; [lra | exact HM | exact Hf].
Qed.

(** Theorem 20: up to M_1 each speed has one flight or two, and then contact. *)
Theorem one_or_two_flights : forall M a alpha, 0 < M -> first_star a -> M <= (a ^ 2 - 1) / (a ^ 2 + 1) -> 0 < alpha ->
  exists l y W, (length l <= 2)%nat /\ flights M 0 alpha l y W.
Proof.
  intros M a alpha HM Ha HMa Halpha. destruct (half_time alpha Halpha) as (h & Hh & <-).
  pose proof (lands_half h Hh Halpha) as HL.
  set (x := stretch 0 (A h) (2 * h) - 1). set (V := A h - 2 * h + kappa M * closing 0 (A h) (2 * h)).
  destruct (Classical_Prop.classic (take_off x V)) as [Ht | Hn].
  - destruct (second_flight M a h HM Ha HMa Hh Ht) as (Hx & _ & tau & HL2 & Hlt). fold x V in HL2, Hx.
    do 3 eexists. split; [| apply sudden_flight; [exact HL | exact Ht |]; apply last_flight; [exact HL2 |]]; [simpl; auto |].
    left. fold x V. pose proof (long_flights a x V tau Ha (Rlt_le _ _ Hx) HL2 ltac:(lra)). lra.
  - do 3 eexists. split; [| apply last_flight; [exact HL |]]; [simpl; auto |].
    fold x V. unfold take_off, contact in *. destruct (Rtotal_order x 0) as [H | [H | H]]; [now left | right | exfalso; auto].
    split; [exact H |]. apply Rnot_lt_le. auto.
Qed.

(** Lemma 32: bounds of a landing by the state before the flight. *)
Theorem bounds_of_landing : forall M x V tau (y := 1 + x) (R0 := sqrt (y ^ 2 + V ^ 2)) (B := sqrt (V ^ 2 + 2 * (y + R0))),
  0 < M -> lands x V tau -> 0 <= y ->
  0 <= closing x V tau <= R0 + B /\ stretch x V tau <= R0 /\ Rabs (V - tau + kappa M * closing x V tau) <= Rmax R0 B.
Proof.
  intros M x V tau y R0 B HM HL Hy. pose proof (lands_closing x V tau HL) as Hc. destruct HL as (Ht & _ & Hz).
  assert (HR : 0 <= R0) by apply sqrt_pos. assert (HB : 0 <= B) by apply sqrt_pos.
  assert (ER : R0 ^ 2 = y ^ 2 + V ^ 2).
  { apply pow2_sqrt. pose proof (pow2_ge_0 y). pose proof (pow2_ge_0 V). lra. }
  assert (EB : B ^ 2 = V ^ 2 + 2 * (y + R0)) by (apply pow2_sqrt; pose proof (pow2_ge_0 V); lra).
  assert (Es : stretch_rate x V tau ^ 2 + stretch x V tau ^ 2 = R0 ^ 2).
  { rewrite ER. unfold stretch_rate, stretch, y. pose proof (sin_cos_squares tau) as H.
    transitivity (((1 + x) ^ 2 + V ^ 2) * (sin tau ^ 2 + cos tau ^ 2)); [ring | rewrite H; ring]. }
  assert (Ep : (V - tau) ^ 2 = V ^ 2 + 2 * (y - stretch x V tau)).
  { replace (stretch x V tau) with (momentum x V tau) by (unfold G in Hz; lra). unfold momentum, y. field. }
  pose proof (pow2_ge_0 (stretch_rate x V tau)) as Hq. pose proof (pow2_ge_0 (stretch x V tau)) as Hq2.
  assert (Hs : - R0 <= stretch x V tau <= R0).
  { split; [apply Ropp_le_cancel; rewrite Ropp_involutive |]; apply pow2_le; try exact HR; [| lra].
    replace ((- stretch x V tau) ^ 2) with (stretch x V tau ^ 2) by ring. lra. }
  assert (Hd : - R0 <= stretch_rate x V tau <= R0).
  { split; [apply Ropp_le_cancel; rewrite Ropp_involutive |]; apply pow2_le; try exact HR; [| lra].
    replace ((- stretch_rate x V tau) ^ 2) with (stretch_rate x V tau ^ 2) by ring. lra. }
  assert (Hp : - B <= V - tau <= B).
  { split; [apply Ropp_le_cancel; rewrite Ropp_involutive |]; apply pow2_le; try exact HB; [| lra].
    replace ((- (V - tau)) ^ 2) with ((V - tau) ^ 2) by ring. lra. }
  split; [unfold closing in *; lra |]. split; [lra |].
  assert (Hk : 0 < kappa M < 1).
  { split; [now apply kappa_positive |]. unfold kappa. apply Rmult_lt_reg_r with (1 + M); [lra |]. field_simplify; lra. }
  replace (V - tau + kappa M * closing x V tau) with ((1 - kappa M) * (V - tau) + kappa M * stretch_rate x V tau)
    by (unfold closing; ring).
  pose proof (Rmax_l R0 B) as H1. pose proof (Rmax_r R0 B) as H2. set (m := Rmax R0 B) in *.
  assert (0 <= (1 - kappa M) * (m - (V - tau))) by (apply Rmult_le_pos; lra).
  assert (0 <= (1 - kappa M) * (m + (V - tau))) by (apply Rmult_le_pos; lra).
  assert (0 <= kappa M * (m - stretch_rate x V tau)) by (apply Rmult_le_pos; lra).
  assert (0 <= kappa M * (m + stretch_rate x V tau)) by (apply Rmult_le_pos; lra).
  apply Rabs_le. lra.
Qed.
