(** The passive hopper: its motion by the equations of motion, and their closed solutions (docs/model.md). *)

From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Hopper Require Import Analysis.
Open Scope R_scope.

(** * The model *)

(** The constants of the mass ratio [M]. *)
Definition kappa M := M / (1 + M).
Definition mu M := M / (1 + M) ^ 2.

(** Flight: [y1], [v1] are position and velocity of the upper mass, [y2], [v2] those of the lower mass. *)
Definition upper_acceleration M y1 y2 := (- M * (y1 - y2) - 1) / (1 + M).
Definition lower_acceleration M y1 y2 := ((y1 - y2) - 1) / (1 + M).
Definition flight_motion M (y1 v1 y2 v2 : R -> R) := forall t,
  is_derive y1 t (v1 t) /\ is_derive v1 t (upper_acceleration M (y1 t) (y2 t)) /\
  is_derive y2 t (v2 t) /\ is_derive v2 t (lower_acceleration M (y1 t) (y2 t)).

(** Contact: the lower mass rests on the ground. *)
Definition contact_motion M (y1 v1 : R -> R) := forall t,
  is_derive y1 t (v1 t) /\ is_derive v1 t ((- M * y1 t - 1) / (1 + M)).

(** The flight from [y1 = 1 + x] and the velocity [V], with the lower mass at rest on the ground, comes down at the first
    time at which the lower mass is on the ground again. The collision keeps the upper mass's position [1 + x'] and velocity
    [V'] and stops the lower mass. A touch without speed counts as a landing; it changes nothing. *)
Definition landing M x V x' V' := exists y1 v1 y2 v2 tau,
  flight_motion M y1 v1 y2 v2 /\ y1 0 = 1 + x /\ v1 0 = V /\ y2 0 = 0 /\ v2 0 = 0 /\
  0 < tau /\ (forall t, 0 < t < tau -> 0 < y2 t) /\ y2 tau = 0 /\ x' = y1 tau - 1 /\ V' = v1 tau.

(** The contact from [(x, V)] ends with a gradual lift-off of speed [a]. *)
Definition gradual_lift_off M x V a := exists y1 v1 theta,
  contact_motion M y1 v1 /\ y1 0 = 1 + x /\ v1 0 = V /\
  0 < theta /\ (forall t, 0 <= t <= theta -> y1 t <= 1) /\ y1 theta = 1 /\ v1 theta = a /\ 0 < a.

(** States on the ground from which a flight starts at once, and those from which contact follows. *)
Definition take_off x V := 0 < x \/ (x = 0 /\ 0 < V).
Definition contact x V := x < 0 \/ (x = 0 /\ V <= 0).

(** The motion from a take-off to the next gradual lift-off: landings with sudden lift-offs, and then contact. *)
Inductive moves M : R -> R -> R -> Prop :=
| ends_gradually : forall x V x' V' a,
    landing M x V x' V' -> contact x' V' -> gradual_lift_off M x' V' a -> moves M x V a
| lifts_off_suddenly : forall x V x' V' a,
    landing M x V x' V' -> take_off x' V' -> moves M x' V' a -> moves M x V a.

(** The lift-off map as a relation: from the gradual lift-off speed [a] to the next one. *)
Definition hop M a a' := moves M 0 a a'.

(** The hopper is grounded if no gradual lift-off follows. *)
Definition grounded M a := ~ exists a', hop M a a'.

(** * The closed form of a flight *)

Definition stretch x V t := (1 + x) * cos t + V * sin t.
Definition stretch_rate x V t := - (1 + x) * sin t + V * cos t.
Definition momentum x V t := 1 + x + V * t - t ^ 2 / 2.
(** [1 + M] times the height of the lower mass. *)
Definition G x V t := momentum x V t - stretch x V t.
(** The closing speed [- G']. *)
Definition closing x V t := stretch_rate x V t - (V - t).

Definition upper M x V t := (momentum x V t + M * stretch x V t) / (1 + M).
Definition upper_rate M x V t := ((V - t) + M * stretch_rate x V t) / (1 + M).
Definition lower M x V t := G x V t / (1 + M).
Definition lower_rate M x V t := - closing x V t / (1 + M).

Lemma G_derive : forall x V t, is_derive (G x V) t (- closing x V t).
Proof.
  intros. unfold G, momentum, stretch, closing, stretch_rate. auto_derive; [exact I |]. field.
Qed.

(** Lemma 1, first part: the closed form satisfies the equations of flight. *)
Theorem flight_solution : forall M x V, 0 < M ->
  flight_motion M (upper M x V) (upper_rate M x V) (lower M x V) (lower_rate M x V).
Proof.
  intros M x V HM t.
  unfold upper_acceleration, lower_acceleration, upper, upper_rate, lower, lower_rate, G, closing, momentum, stretch,
    stretch_rate.
  split; [| split; [| split]]; auto_derive; try exact I; field; lra.
Qed.

(** Lemma 1, second part: every solution with these initial values is the closed form. *)
Theorem flight_unique : forall M x V y1 v1 y2 v2, 0 < M -> flight_motion M y1 v1 y2 v2 ->
  y1 0 = 1 + x -> v1 0 = V -> y2 0 = 0 -> v2 0 = 0 ->
  forall t, y1 t = upper M x V t /\ v1 t = upper_rate M x V t /\ y2 t = lower M x V t.
Proof.
  intros M x V y1 v1 y2 v2 HM Hf E1 E2 E3 E4.
  assert (D : forall (f df g dg : R -> R) (c d t : R), is_derive f t (df t) -> is_derive g t (dg t) ->
      is_derive (fun t => c * f t + d * g t) t (c * df t + d * dg t)).
  { intros f df g dg c d t Hdf Hdg.
    apply (is_derive_plus (V := R_NormedModule) (fun t => c * f t) (fun t => d * g t)).
    - now apply (is_derive_scal f).
    - now apply (is_derive_scal g). }
  pose (a1 := fun t => upper_acceleration M (y1 t) (y2 t)). pose (a2 := fun t => lower_acceleration M (y1 t) (y2 t)).
  (* Both coordinates are compared with the closed form. *)
  pose (s := fun t => 1 * (1 * y1 t + (-1) * y2 t) + (-1) * stretch x V t).
  pose (ds := fun t => 1 * (1 * v1 t + (-1) * v2 t) + (-1) * stretch_rate x V t).
  pose (p := fun t => 1 * (1 * y1 t + M * y2 t) + (-1) * momentum x V t).
  pose (dp := fun t => 1 * (1 * v1 t + M * v2 t) + (-1) * (V - t)).
  assert (Hs : forall t, s t = 0 /\ ds t = 0).
  { apply (oscillator_rests 1); [lra | | | |].
    - intro t. destruct (Hf t) as (H1 & _ & H2 & _).
      apply (D (fun t => 1 * y1 t + (-1) * y2 t) (fun t => 1 * v1 t + (-1) * v2 t)); [now apply D |].
      unfold stretch, stretch_rate. auto_derive; [exact I | ring].
    - intro t. destruct (Hf t) as (_ & H1 & _ & H2).
      replace (- (1) * s t) with (1 * (1 * a1 t + (-1) * a2 t) + (-1) * - stretch x V t)
        by (unfold s, a1, a2, upper_acceleration, lower_acceleration; field; lra).
      apply (D (fun t => 1 * v1 t + (-1) * v2 t) (fun t => 1 * a1 t + (-1) * a2 t) (stretch_rate x V)
        (fun t => - stretch x V t)); [now apply D |].
      unfold stretch, stretch_rate. auto_derive; [exact I | ring].
    - unfold s, stretch. rewrite E1, E3, cos_0, sin_0. ring.
    - unfold ds, stretch_rate. rewrite E2, E4, cos_0, sin_0. ring. }
  assert (Hp : forall t, p t = 0 /\ dp t = 0).
  { apply free_motion_rests.
    - intro t. destruct (Hf t) as (H1 & _ & H2 & _).
      apply (D (fun t => 1 * y1 t + M * y2 t) (fun t => 1 * v1 t + M * v2 t)); [now apply D |].
      unfold momentum. auto_derive; [exact I | field].
    - intro t. destruct (Hf t) as (_ & H1 & _ & H2).
      replace 0 with (1 * (1 * a1 t + M * a2 t) + (-1) * - (1))
        by (unfold a1, a2, upper_acceleration, lower_acceleration; field; lra).
      apply (D (fun t => 1 * v1 t + M * v2 t) (fun t => 1 * a1 t + M * a2 t) (fun t => V - t) (fun _ => - (1)));
        [now apply D |].
      auto_derive; [exact I | ring].
    - unfold p, momentum. rewrite E1, E3. field.
    - unfold dp. rewrite E2, E4. ring. }
  intro t. destruct (Hs t) as [Hs1 Hs2], (Hp t) as [Hp1 Hp2].
  unfold s in Hs1. unfold ds in Hs2. unfold p in Hp1. unfold dp in Hp2.
  unfold upper, upper_rate, lower, G.
  replace (stretch x V t) with (y1 t - y2 t) by lra.
  replace (stretch_rate x V t) with (v1 t - v2 t) by lra.
  replace (momentum x V t) with (y1 t + M * y2 t) by lra.
  replace (V - t) with (v1 t + M * v2 t) by lra.
  repeat split; field; lra.
Qed.

(** * Landings in closed form *)

(** [tau] is the first positive zero of [G]. *)
Definition lands x V tau := 0 < tau /\ (forall t, 0 < t < tau -> 0 < G x V t) /\ G x V tau = 0.

(** Lemma 1, third part: the state after a landing. *)
Theorem landing_closed : forall M x V x' V', 0 < M ->
  (landing M x V x' V' <-> exists tau, lands x V tau /\
     x' = stretch x V tau - 1 /\ V' = V - tau + kappa M * closing x V tau).
Proof.
  intros M x V x' V' HM.
  assert (E : forall tau, G x V tau = 0 -> upper M x V tau - 1 = stretch x V tau - 1 /\
      upper_rate M x V tau = V - tau + kappa M * closing x V tau).
  { intros tau HG. unfold upper, upper_rate, closing, kappa.
    replace (momentum x V tau) with (stretch x V tau) by (unfold G in HG; lra). split; field; lra. }
  assert (Hpos : forall t, 0 < lower M x V t <-> 0 < G x V t).
  { intro t. unfold lower. split; intro H.
    - replace (G x V t) with (G x V t / (1 + M) * (1 + M)) by (field; lra).
      apply Rmult_lt_0_compat; [exact H | lra].
    - apply Rdiv_lt_0_compat; [exact H | lra]. }
  split.
  - intros (y1 & v1 & y2 & v2 & tau & Hf & E1 & E2 & E3 & E4 & Ht & Hin & Hz & Ex & Ev).
    pose proof (flight_unique M x V y1 v1 y2 v2 HM Hf E1 E2 E3 E4) as U.
    assert (HG : G x V tau = 0).
    { destruct (U tau) as (_ & _ & U2). rewrite Hz in U2. unfold lower in U2.
      replace (G x V tau) with (G x V tau / (1 + M) * (1 + M)) by (field; lra). rewrite <- U2. ring. }
    destruct (E tau HG) as [E5 E6]. exists tau. repeat split; try assumption.
    + intros t Hs. apply Hpos. destruct (U t) as (_ & _ & <-). now apply Hin.
    + rewrite Ex, <- E5. f_equal. apply U.
    + rewrite Ev, <- E6. apply U.
  - intros (tau & (Ht & Hin & HG) & Ex & Ev). destruct (E tau HG) as [E5 E6].
    exists (upper M x V), (upper_rate M x V), (lower M x V), (lower_rate M x V), tau.
    split; [now apply flight_solution |].
    repeat split; try assumption.
    + unfold upper, momentum, stretch. rewrite cos_0, sin_0. field. lra.
    + unfold upper_rate, stretch_rate. rewrite cos_0, sin_0. field. lra.
    + unfold lower, G, momentum, stretch. rewrite cos_0, sin_0. field. lra.
    + unfold lower_rate, closing, stretch_rate. rewrite cos_0, sin_0. field. lra.
    + intros t Hs. apply Hpos. now apply Hin.
    + unfold lower. rewrite HG. field. lra.
    + now rewrite E5.
    + now rewrite E6.
Qed.

(** A flight has at most one first landing. *)
Lemma lands_unique : forall x V t1 t2, lands x V t1 -> lands x V t2 -> t1 = t2.
Proof.
  intros x V t1 t2 (P1 & I1 & Z1) (P2 & I2 & Z2).
  destruct (Rtotal_order t1 t2) as [H | [H | H]]; [| exact H |].
  - specialize (I2 t1). lra.
  - specialize (I1 t2). lra.
Qed.

(** The closing speed at a landing is not negative. *)
Lemma lands_closing : forall x V tau, lands x V tau -> 0 <= closing x V tau.
Proof.
  intros x V tau (Ht & Hin & Hz). apply Rnot_lt_le. intro Hneg.
  destruct (derive_continuity (closing x V) tau (1 - stretch x V tau)) with (eps := - closing x V tau)
    as [d [Hd Hd']]; [| lra |].
  { unfold closing, stretch_rate, stretch. auto_derive; [exact I | ring]. }
  pose (t := Rmax (tau / 2) (tau - d / 2)).
  assert (Hr : 0 < t < tau /\ tau - t < d). { unfold t, Rmax. destruct (Rle_dec (tau/2) (tau - d/2)); lra. }
  assert (Hm : G x V t <= G x V tau); [| specialize (Hin t (proj1 Hr)); lra].
  apply (not_falling (G x V) (fun s => - closing x V s)); [lra | intros; apply G_derive |].
  intros s Hs. destruct (Req_dec s tau) as [-> | Hne]; [lra |].
  specialize (Hd' s). simpl in Hd'. unfold R_dist, D_x, no_cond in Hd'.
  assert (Hc : Rabs (closing x V s - closing x V tau) < - closing x V tau).
  { apply Hd'. split; [split; [exact I | now apply not_eq_sym] |]. rewrite Rabs_left1; lra. }
  apply Rabs_def2 in Hc. lra.
Qed.
