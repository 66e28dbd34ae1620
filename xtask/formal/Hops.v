(** Hops of whole intervals of speeds, from signs of [G]: Theorem 7 for the first flight, Lemma 15 for the second one. *)

From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Hopper Require Import Analysis Model Energy FirstLanding OneSudden.
Open Scope R_scope.

(** [G] rises with [x] and with [V]. *)
Lemma G_monotone : forall x y V W t, 0 < t -> x <= y -> V <= W -> G x V t <= G y W t.
Proof.
  intros x y V W t Ht Hx HV.
  assert (E : G y W t - G x V t = (y - x) * (1 - cos t) + (W - V) * (t - sin t)).
  { unfold G, momentum, stretch. ring. }
  pose proof (COS_bound t). pose proof (sin_lt_x t Ht).
  assert (0 <= (y - x) * (1 - cos t)) by (apply Rmult_le_pos; lra).
  assert (0 <= (W - V) * (t - sin t)) by (apply Rmult_le_pos; lra). lra.
Qed.

(** Two signs enclose the first landing of all speeds of an interval. *)
Theorem first_flight : forall a1 a2 t1 t2 a, 0 < a1 -> a1 <= a <= a2 -> 0 < t1 < t2 ->
  0 < G 0 a1 t1 -> G 0 a2 t2 < 0 -> exists tau, t1 < tau < t2 /\ lands 0 a tau.
Proof.
  intros a1 a2 t1 t2 a Ha1 Ha Ht H1 H2. destruct (half_time a ltac:(lra)) as (h & Hh & E).
  assert (HL : lands 0 a (2 * h)). { rewrite <- E. apply lands_half; [exact Hh | lra]. }
  exists (2 * h). split; [| exact HL].
  pose proof (G_monotone 0 0 a1 a t1 ltac:(lra) ltac:(lra) ltac:(lra)) as G1.
  pose proof (G_monotone 0 0 a a2 t2 ltac:(lra) ltac:(lra) ltac:(lra)) as G2.
  replace t1 with (2 * (t1 / 2)) in G1, H1 by field. replace t2 with (2 * (t2 / 2)) in G2, H2 by field.
  rewrite (G_ground a) in G1 by lra. rewrite (G_ground a) in G2 by lra.
  pose proof (D_positive (t1 / 2) ltac:(lra)). pose proof (D_positive (t2 / 2) ltac:(lra)).
  split; apply Rnot_le_lt; intro Hc.
  - pose proof (A_not_falling h (t1 / 2)). assert (0 <= D (t1 / 2) * (A (t1 / 2) - a)) by (apply Rmult_le_pos; lra). lra.
  - pose proof (A_not_falling (t2 / 2) h). assert (0 <= D (t2 / 2) * (a - A (t2 / 2))) by (apply Rmult_le_pos; lra). lra.
Qed.

(** Lemma 15, concave part: while [s <= 1], a height that is positive at both ends is positive between. *)
Lemma concave_part : forall x V l r, l < r -> (forall t, l <= t <= r -> stretch x V t <= 1) ->
  0 < G x V l -> 0 < G x V r -> forall t, l <= t <= r -> 0 < G x V t.
Proof.
  intros x V l r Hlr Hs Hl Hr t Ht.
  destruct (Rle_or_lt (closing x V t) 0) as [Hc | Hc].
  - (* The height does not fall up to [t]. *)
    apply Rlt_le_trans with (1 := Hl). apply (not_falling (G x V) (fun s => - closing x V s));
      [lra | intros; apply G_derive |]. intros s Hs'.
    assert (- closing x V t <= - closing x V s); [| lra].
    apply (not_rising (fun s => - closing x V s) (fun s => stretch x V s - 1)); [lra | intros; apply closing_derive |].
    intros q Hq. specialize (Hs q). lra.
  - (* The height does not rise from [t] on. *)
    apply Rlt_le_trans with (1 := Hr). apply (not_rising (G x V) (fun s => - closing x V s));
      [lra | intros; apply G_derive |]. intros s Hs'.
    assert (- closing x V s <= - closing x V t); [| lra].
    apply (not_rising (fun s => - closing x V s) (fun s => stretch x V s - 1)); [lra | intros; apply closing_derive |].
    intros q Hq. specialize (Hs q). lra.
Qed.

(** Lemma 15, convex part: while [s >= 1] after a lift-off with [x > 0], the lower mass is in the air. *)
Lemma convex_part : forall x V r, 0 < x -> (forall t, 0 <= t <= r -> 1 <= stretch x V t) ->
  forall t, 0 < t <= r -> 0 < G x V t.
Proof.
  intros x V r Hx Hs t Ht. destruct (rises_at_once x V Hx) as (d & Hd & Hup).
  pose (s := Rmin t (d / 2)).
  assert (Hst : 0 < s <= t /\ s < d). { unfold s, Rmin. destruct (Rle_dec t (d / 2)); lra. }
  apply Rlt_le_trans with (1 := Hup s ltac:(lra)).
  apply (not_falling (G x V) (fun s => - closing x V s)); [lra | intros; apply G_derive |]. intros q Hq.
  replace 0 with (- closing x V 0) by (unfold closing, stretch_rate; rewrite cos_0, sin_0; ring).
  apply (not_falling (fun s => - closing x V s) (fun s => stretch x V s - 1)); [lra | intros; apply closing_derive |].
  intros p Hp. specialize (Hs p). lra.
Qed.

(** A flight after a sudden lift-off lands between two signs, for all states of a box: [s >= 1] up to [p], [s <= 1] from [q]
    to [t1] for the lowest state. *)
Theorem second_flight_between : forall x1 x2 V1 V2 p q t1 t2 x V, 0 < x1 -> x1 <= x <= x2 -> V1 <= V <= V2 ->
  0 < p <= q -> q < t1 < t2 ->
  (forall t, 0 <= t <= p -> 1 <= stretch x1 V1 t) -> (forall t, p <= t <= q -> 0 < G x1 V1 t) ->
  (forall t, q <= t <= t1 -> stretch x1 V1 t <= 1) -> 0 < G x1 V1 t1 -> G x2 V2 t2 < 0 ->
  exists tau, t1 < tau < t2 /\ lands x V tau.
Proof.
  intros x1 x2 V1 V2 p q t1 t2 x V Hx1 Hx HV Hp Hq Hconvex Hbetween Hconcave H1 H2.
  assert (Hup : forall t, 0 < t <= t1 -> 0 < G x V t).
  { intros t Ht. apply Rlt_le_trans with (G x1 V1 t); [| apply G_monotone; lra].
    destruct (Rle_or_lt t p); [apply (convex_part x1 V1 p); try assumption; lra |].
    destruct (Rle_or_lt t q); [apply Hbetween; lra |].
    apply (concave_part x1 V1 q t1); try assumption; [lra | apply Hbetween; lra | lra]. }
  pose proof (G_monotone x x2 V V2 t2 ltac:(lra) ltac:(lra) ltac:(lra)).
  destruct (lands_before x V t2) as (tau & Htau & Hlt); [lra | lra | lra |].
  exists tau. split; [| exact Htau]. split; [| exact Hlt]. destruct Htau as (Hpos & _ & Hz).
  apply Rnot_le_lt. intro Hc. specialize (Hup tau). lra.
Qed.

(** A hop with one sudden lift-off: its landings after [tau] and [sigma], the states after them, and the next speed. *)
Theorem hop_with_two_landings : forall M a tau sigma
  (x := stretch 0 a tau - 1) (V := a - tau + kappa M * closing 0 a tau)
  (x' := stretch x V sigma - 1) (V' := V - sigma + kappa M * closing x V sigma),
  0 < M -> lands 0 a tau -> take_off x V -> lands x V sigma -> contact x' V' -> 0 < energy M x' V' ->
  hop M a (sqrt (energy M x' V')).
Proof.
  intros M a tau sigma x V x' V' HM HL Hto HL' Hc He. apply lifts_off_suddenly with x V; [| exact Hto |].
  - apply landing_closed; [exact HM |]. now exists tau.
  - apply ends_gradually with x' V'; [| exact Hc |].
    + apply landing_closed; [exact HM |]. now exists sigma.
    + apply contact_ends; [exact HM | exact Hc |]. now split.
Qed.

(** A hop of all speeds of an interval, from signs and enclosures: both flights, the box of states between them, and the
    energy at the end. *)
Theorem sudden_hop : forall M a1 a2 t1 t2 x1 x2 V1 V2 p q t3 t4 b1 b2, 0 < M -> 0 < a1 -> 0 < b1 <= b2 ->
  0 < t1 < t2 -> 0 < G 0 a1 t1 -> G 0 a2 t2 < 0 -> 0 < x1 ->
  (forall a t, a1 <= a <= a2 -> t1 <= t <= t2 ->
     x1 <= a * t - t ^ 2 / 2 <= x2 /\ V1 <= a - t + kappa M * closing 0 a t <= V2) ->
  0 < p <= q -> q < t3 < t4 ->
  (forall t, 0 <= t <= p -> 1 <= stretch x1 V1 t) -> (forall t, p <= t <= q -> 0 < G x1 V1 t) ->
  (forall t, q <= t <= t3 -> stretch x1 V1 t <= 1) -> 0 < G x1 V1 t3 -> G x2 V2 t4 < 0 ->
  (forall x V t, x1 <= x <= x2 -> V1 <= V <= V2 -> t3 <= t <= t4 ->
     stretch x V t < 1 /\ b1 ^ 2 <= energy M (stretch x V t - 1) (V - t + kappa M * closing x V t) <= b2 ^ 2) ->
  forall a, a1 <= a <= a2 -> exists a', hop M a a' /\ b1 <= a' <= b2.
Proof.
  intros M a1 a2 t1 t2 x1 x2 V1 V2 p q t3 t4 b1 b2 HM Ha1 Hb1 Ht H1 H2 Hx1 Hbox Hp Hq Hconvex Hbetween Hconcave H3 H4
    Hend a Ha.
  destruct (first_flight a1 a2 t1 t2 a Ha1 Ha Ht H1 H2) as (tau & Htau & HL).
  destruct (Hbox a tau Ha ltac:(lra)) as [Hx HV].
  assert (Ex : stretch 0 a tau - 1 = a * tau - tau ^ 2 / 2).
  { destruct HL as (_ & _ & Hz). unfold G, momentum in Hz. lra. }
  rewrite <- Ex in Hx. set (x := stretch 0 a tau - 1) in *. set (V := a - tau + kappa M * closing 0 a tau) in *.
  destruct (second_flight_between x1 x2 V1 V2 p q t3 t4 x V) as (sigma & Hs & HL'); try assumption.
  destruct (Hend x V sigma Hx HV ltac:(lra)) as [Hst He]. pose proof (pow_lt b1 2 (proj1 Hb1)).
  exists (sqrt (energy M (stretch x V sigma - 1) (V - sigma + kappa M * closing x V sigma))). split.
  - apply hop_with_two_landings; [exact HM | exact HL | left; fold x; lra | exact HL' | left; fold x V; lra | fold x V; lra].
  - split.
    + rewrite <- (sqrt_pow2 b1) by lra. apply sqrt_le_1_alt. lra.
    + rewrite <- (sqrt_pow2 b2) by lra. apply sqrt_le_1_alt. lra.
Qed.

(** A hop of all speeds of an interval with one landing. *)
Theorem contact_hop : forall M a1 a2 t1 t2 b1 b2, 0 < M -> 0 < a1 -> 0 < b1 <= b2 -> 0 < t1 < t2 ->
  0 < G 0 a1 t1 -> G 0 a2 t2 < 0 ->
  (forall a t, a1 <= a <= a2 -> t1 <= t <= t2 -> a * t - t ^ 2 / 2 < 0 /\
     b1 ^ 2 <= a ^ 2 - mu M * closing 0 a t ^ 2 <= b2 ^ 2) ->
  forall a, a1 <= a <= a2 -> exists a', hop M a a' /\ b1 <= a' <= b2.
Proof.
  intros M a1 a2 t1 t2 b1 b2 HM Ha1 Hb1 Ht H1 H2 Hend a Ha.
  destruct (first_flight a1 a2 t1 t2 a Ha1 Ha Ht H1 H2) as (tau & Htau & HL).
  destruct (Hend a tau Ha ltac:(lra)) as [Hx He]. pose proof (pow_lt b1 2 (proj1 Hb1)).
  assert (Ex : stretch 0 a tau - 1 = a * tau - tau ^ 2 / 2).
  { destruct HL as (_ & _ & Hz). unfold G, momentum in Hz. lra. }
  pose proof (energy_of_landing M 0 a tau HM HL) as Ee.
  replace (energy M 0 a) with (a ^ 2) in Ee by (unfold energy; ring). rewrite <- Ee in He.
  exists (sqrt (energy M (stretch 0 a tau - 1) (a - tau + kappa M * closing 0 a tau))). split.
  - apply ends_gradually with (stretch 0 a tau - 1) (a - tau + kappa M * closing 0 a tau); [| left; lra |].
    + apply landing_closed; [exact HM |]. now exists tau.
    + apply contact_ends; [exact HM | left; lra |]. split; [lra | reflexivity].
  - split.
    + rewrite <- (sqrt_pow2 b1) by lra. apply sqrt_le_1_alt. lra.
    + rewrite <- (sqrt_pow2 b2) by lra. apply sqrt_le_1_alt. lra.
Qed.
