(** Energy on the ground, contact, and the loss of a hop: Lemmas 2 and 3 and Theorem 4 of docs/theory.md. *)

From Coq Require Import Reals Lra List.
From Coquelicot Require Import Coquelicot.
From Hopper Require Import Analysis Model.
Import ListNotations.
Open Scope R_scope.

Definition energy M x V := V ^ 2 + x * (2 + kappa M * x).

Lemma kappa_positive : forall M, 0 < M -> 0 < kappa M.
Proof. intros M HM. unfold kappa. apply Rdiv_lt_0_compat; lra. Qed.

Lemma mu_positive : forall M, 0 < M -> 0 < mu M.
Proof. intros M HM. unfold mu. apply Rdiv_lt_0_compat; [exact HM |]. apply pow_lt. lra. Qed.

Lemma mu_kappa : forall M, 0 < M -> mu M = kappa M * (1 - kappa M).
Proof. intros M HM. unfold mu, kappa. field. lra. Qed.

Lemma sin_cos_squares : forall t, sin t ^ 2 + cos t ^ 2 = 1.
Proof. intro t. rewrite <- !Rsqr_pow2. apply sin2_cos2. Qed.

(** Lemma 2: a flight reduces the energy by [mu] times the square of the closing speed. *)
Theorem energy_of_landing : forall M x V tau, 0 < M -> lands x V tau ->
  energy M (stretch x V tau - 1) (V - tau + kappa M * closing x V tau) =
  energy M x V - mu M * closing x V tau ^ 2.
Proof.
  intros M x V tau HM (_ & _ & HG). rewrite (mu_kappa M HM).
  assert (Es : stretch_rate x V tau ^ 2 + stretch x V tau ^ 2 = (1 + x) ^ 2 + V ^ 2).
  { unfold stretch_rate, stretch. pose proof (sin_cos_squares tau) as H.
    transitivity (((1 + x) ^ 2 + V ^ 2) * (sin tau ^ 2 + cos tau ^ 2)); [ring | rewrite H; ring]. }
  assert (Ep : (V - tau) ^ 2 + 2 * stretch x V tau = V ^ 2 + 2 * (1 + x)).
  { replace (stretch x V tau) with (momentum x V tau) by (unfold G in HG; lra). unfold momentum. field. }
  unfold energy, closing. set (k := kappa M) in *. set (s := stretch x V tau) in *.
  set (d := stretch_rate x V tau) in *. set (p := V - tau) in *.
  transitivity ((1 - k) * (p ^ 2 + 2 * s) + k * (d ^ 2 + s ^ 2) - 2 + k - k * (1 - k) * (d - p) ^ 2); [ring |].
  rewrite Ep, Es. ring.
Qed.

(** Lemma 2: contact conserves the energy. *)
Lemma contact_energy : forall M x V y1 v1, 0 < M -> contact_motion M y1 v1 ->
  y1 0 = 1 + x -> v1 0 = V -> forall t, energy M (y1 t - 1) (v1 t) = energy M x V.
Proof.
  intros M x V y1 v1 HM Hc E1 E2 t.
  rewrite (constant (fun t => energy M (y1 t - 1) (v1 t))).
  - rewrite E1, E2. f_equal. ring.
  - intro s. destruct (Hc s) as [Hy Hv]. unfold energy. auto_derive.
    + repeat split; eexists; [apply Hv | apply Hy | apply Hy].
    + replace (Derive (fun x => y1 x) s) with (v1 s) by (symmetry; now apply is_derive_unique).
      replace (Derive (fun x => v1 x) s) with ((- M * y1 s - 1) / (1 + M))
        by (symmetry; now apply is_derive_unique).
      unfold kappa. field. lra.
Qed.

(** The closed form of contact: an oscillation about [-1/kappa]. *)
Definition contact_position M x V t :=
  1 + (- / kappa M + (x + / kappa M) * cos (sqrt (kappa M) * t) + V / sqrt (kappa M) * sin (sqrt (kappa M) * t)).
Definition contact_velocity M x V t :=
  - sqrt (kappa M) * (x + / kappa M) * sin (sqrt (kappa M) * t) + V * cos (sqrt (kappa M) * t).

Lemma contact_solution : forall M x V, 0 < M -> contact_motion M (contact_position M x V) (contact_velocity M x V).
Proof.
  intros M x V HM t. pose proof (kappa_positive M HM) as Hk.
  assert (Hn : 0 < sqrt (kappa M)) by now apply sqrt_lt_R0.
  assert (Hs : sqrt (kappa M) * sqrt (kappa M) = kappa M) by (apply sqrt_sqrt; lra).
  unfold contact_position, contact_velocity. set (n := sqrt (kappa M)) in *.
  split; auto_derive; try exact I.
  - field. lra.
  - replace ((- M * (1 + (- / kappa M + (x + / kappa M) * cos (n * t) + V / n * sin (n * t))) - 1) / (1 + M))
      with (- (n * n) * ((x + / kappa M) * cos (n * t) + V / n * sin (n * t))).
    + field. lra.
    + rewrite Hs. unfold kappa. field. lra.
Qed.

Lemma pow2_inj : forall u v, 0 <= u -> 0 <= v -> u ^ 2 = v ^ 2 -> u = v.
Proof. intros u v Hu Hv H. apply Rsqr_inj; try assumption. now rewrite !Rsqr_pow2. Qed.

Lemma pow2_le : forall u v, 0 <= v -> u ^ 2 <= v ^ 2 -> u <= v.
Proof. intros u v Hv H. apply Rsqr_incr_0_var; [now rewrite !Rsqr_pow2 | exact Hv]. Qed.

(** An angle of each point of a circle. *)
Lemma angle : forall p b A, 0 < A -> p ^ 2 + b ^ 2 = A ^ 2 -> exists t, 0 <= t /\ p = A * cos t /\ b = A * sin t.
Proof.
  intros p b A HA E.
  assert (Hb : 0 <= b ^ 2) by apply pow2_ge_0.
  assert (Hpa : p² <= A²) by (rewrite !Rsqr_pow2; lra).
  assert (Hp : -1 <= p / A <= 1).
  { assert (- A <= p <= A) by (apply Rabs_le_between; apply Rsqr_le_abs_0 in Hpa; now rewrite (Rabs_right A) in Hpa by lra).
    split; apply Rmult_le_reg_r with A; try exact HA; unfold Rdiv; rewrite Rmult_assoc, Rinv_l; lra. }
  pose proof (acos_bound (p / A)) as Ht. pose proof (cos_acos (p / A) Hp) as Hc.
  assert (Hs : 0 <= sin (acos (p / A))) by (apply sin_ge_0; lra).
  assert (Hbs : b ^ 2 = (A * sin (acos (p / A))) ^ 2).
  { assert (p = A * cos (acos (p / A))) by (rewrite Hc; field; lra).
    pose proof (sin_cos_squares (acos (p / A))). nra. }
  destruct (Rle_or_lt 0 b) as [H | H].
  - exists (acos (p / A)). repeat split; [lra | rewrite Hc; field; lra |].
    apply pow2_inj; [exact H | apply Rmult_le_pos; lra | exact Hbs].
  - exists (2 * PI - acos (p / A)). split; [lra |].
    replace (2 * PI - acos (p / A)) with (- acos (p / A) + 2 * PI) by ring.
    rewrite cos_plus, sin_plus, cos_2PI, sin_2PI, cos_neg, sin_neg, Hc.
    split; [field; lra |].
    assert (- b = A * sin (acos (p / A))); [| lra].
    apply pow2_inj; [lra | apply Rmult_le_pos; lra | rewrite <- Hbs; ring].
Qed.

(** Lemma 3: contact ends with a gradual lift-off if and only if the energy is positive; its speed is the root of it. *)
Theorem contact_ends : forall M x V a, 0 < M -> contact x V ->
  (gradual_lift_off M x V a <-> 0 < energy M x V /\ a = sqrt (energy M x V)).
Proof.
  intros M x V a HM Hc. split.
  - intros (y1 & v1 & th & Hm & E1 & E2 & Hth & _ & Ey & Ev & Ha).
    pose proof (contact_energy M x V y1 v1 HM Hm E1 E2 th) as E.
    rewrite Ey, Ev in E. unfold energy in E at 1.
    assert (E' : energy M x V = a ^ 2) by lra. rewrite E'. split; [now apply pow_lt |].
    symmetry. apply sqrt_pow2. lra.
  - intros [He ->]. pose proof (kappa_positive M HM) as Hk.
    pose (y := contact_position M x V). pose (v := contact_velocity M x V).
    assert (Hn : 0 < sqrt (kappa M)) by now apply sqrt_lt_R0.
    assert (Hs : sqrt (kappa M) * sqrt (kappa M) = kappa M) by (apply sqrt_sqrt; lra).
    assert (Hm : contact_motion M y v) by now apply contact_solution.
    assert (Ey : y 0 = 1 + x).
    { unfold y, contact_position. rewrite Rmult_0_r, cos_0, sin_0. field. lra. }
    assert (Ev : v 0 = V).
    { unfold v, contact_velocity. rewrite Rmult_0_r, cos_0, sin_0. ring. }
    pose proof (contact_energy M x V y v HM Hm Ey Ev) as Econs.
    (* The largest position is above 1. *)
    pose (p := x + / kappa M). pose (b := V / sqrt (kappa M)). pose (A := sqrt (p ^ 2 + b ^ 2)).
    assert (Hc0 : 0 < / kappa M) by now apply Rinv_0_lt_compat.
    assert (Ebig : p ^ 2 + b ^ 2 = (/ kappa M) ^ 2 + energy M x V / kappa M).
    { replace (b ^ 2) with (V ^ 2 / kappa M) by (unfold b; rewrite <- Hs at 1; field; lra).
      unfold p, energy. field. lra. }
    assert (Hbig : (/ kappa M) ^ 2 < p ^ 2 + b ^ 2).
    { rewrite Ebig. assert (0 < energy M x V / kappa M) by now apply Rdiv_lt_0_compat. lra. }
    assert (HA2 : A ^ 2 = p ^ 2 + b ^ 2) by (unfold A; rewrite pow2_sqrt; nra).
    assert (HA : / kappa M < A).
    { assert (0 <= A) by apply sqrt_pos. nra. }
    destruct (angle p b A) as (t & Ht & Ep & Eb); [lra | lra |].
    pose (T := t / sqrt (kappa M)).
    assert (HT : 0 < y T - 1).
    { unfold y, contact_position, T. replace (sqrt (kappa M) * (t / sqrt (kappa M))) with t by (field; lra).
      fold p b. rewrite Ep, Eb. pose proof (sin_cos_squares t). nra. }
    assert (Hx : x <= 0) by (destruct Hc as [? | [? _]]; lra).
    assert (HT0 : 0 < T).
    { assert (0 <= T) by (unfold T; apply Rdiv_le_0_compat; lra).
      destruct (Req_dec T 0) as [E0 | ?]; [rewrite E0, Ey in HT; lra | lra]. }
    assert (Hd : forall s, is_derive (fun s => y s - 1) s (v s)).
    { intro s. destruct (Hm s) as [Hy _]. replace (v s) with (v s - 0) by ring.
      apply (is_derive_minus (V := R_NormedModule) y (fun _ => 1)); [exact Hy |]. apply @is_derive_const. }
    destruct (first_crossing (fun s => y s - 1) 0 T HT0) as (th & Hth & Hz & Hin & Hafter).
    { intros s _. apply derive_continuity with (v s). apply Hd. }
    { rewrite Ey. lra. }
    { exact HT. }
    assert (Hv : v th = sqrt (energy M x V)).
    { assert (0 <= v th) by now apply (derivative_at_crossing (fun s => y s - 1) th).
      rewrite <- (Econs th), Hz. unfold energy. replace (v th ^ 2 + 0 * (2 + kappa M * 0)) with (v th ^ 2) by ring.
      symmetry. now apply sqrt_pow2. }
    assert (0 < v th) by (rewrite Hv; now apply sqrt_lt_R0).
    exists y, v, th. split; [exact Hm |]. split; [exact Ey |]. split; [exact Ev |]. split.
    + destruct (Req_dec th 0) as [E0 | ?]; [| lra]. rewrite E0, Ev in *. rewrite Ey in Hz.
      destruct Hc as [? | [? ?]]; lra.
    + split; [intros s Hs'; specialize (Hin s Hs'); lra |]. split; [lra |]. split; [exact Hv |]. lra.
Qed.

(** The closing speeds of the landings of a motion, in their order. *)
Inductive closing_speeds M : R -> R -> list R -> R -> Prop :=
| last_landing : forall x V tau a (x' := stretch x V tau - 1) (V' := V - tau + kappa M * closing x V tau),
    lands x V tau -> contact x' V' -> gradual_lift_off M x' V' a -> closing_speeds M x V [closing x V tau] a
| sudden_landing : forall x V tau l a (x' := stretch x V tau - 1) (V' := V - tau + kappa M * closing x V tau),
    lands x V tau -> take_off x' V' -> closing_speeds M x' V' l a -> closing_speeds M x V (closing x V tau :: l) a.

Lemma moves_closing : forall M x V a, 0 < M -> moves M x V a -> exists l, closing_speeds M x V l a.
Proof.
  intros M x V a HM H. induction H as [x V x' V' a Hl Hc Hg | x V x' V' a Hl Ht Hm [l IH]];
    apply landing_closed in Hl; try exact HM; destruct Hl as (tau & Hl & -> & ->).
  - exists [closing x V tau]. now apply last_landing.
  - exists (closing x V tau :: l). now apply sudden_landing.
Qed.

Definition sum_of_squares := fold_right (fun g total => g ^ 2 + total) 0.

Lemma energy_of_motion : forall M x V l a, 0 < M -> closing_speeds M x V l a ->
  a ^ 2 = energy M x V - mu M * sum_of_squares l /\ 0 < a.
Proof.
  intros M x V l a HM H.
  induction H as [x V tau a x' V' Hl Hc Hg | x V tau l a x' V' Hl Ht Hm [IH IHa]];
    unfold sum_of_squares in *; cbn [fold_right].
  - apply contact_ends in Hg; [| exact HM | exact Hc]. destruct Hg as [He ->].
    split; [| now apply sqrt_lt_R0]. rewrite pow2_sqrt by lra. unfold x', V'.
    rewrite energy_of_landing by assumption. ring.
  - split; [| exact IHa]. rewrite IH. unfold x', V'. rewrite energy_of_landing by assumption. ring.
Qed.

(** Theorem 4: the square of the next speed is that of the speed less [mu] times the squares of all closing speeds. *)
Theorem hop_loss : forall M a a', 0 < M -> hop M a a' ->
  exists l, closing_speeds M 0 a l a' /\ a' ^ 2 = a ^ 2 - mu M * sum_of_squares l.
Proof.
  intros M a a' HM H. destruct (moves_closing M 0 a a' HM H) as [l Hl].
  exists l. split; [exact Hl |]. destruct (energy_of_motion M 0 a l a' HM Hl) as [-> _].
  unfold energy. ring.
Qed.

Lemma sum_of_squares_pos : forall l, 0 <= sum_of_squares l.
Proof. induction l as [| g l IH]; simpl; [lra |]. pose proof (pow2_ge_0 g). simpl in *. lra. Qed.

(** Theorem 4: the loss is at least that of the first landing. *)
Theorem hop_first_loss : forall M a a', 0 < M -> hop M a a' -> 0 < a' /\
  exists tau, lands 0 a tau /\ a' ^ 2 <= a ^ 2 - mu M * closing 0 a tau ^ 2.
Proof.
  intros M a a' HM H. pose proof (mu_positive M HM) as Hm.
  destruct (moves_closing M 0 a a' HM H) as [l Hl].
  destruct (energy_of_motion M 0 a l a' HM Hl) as [E Ha]. split; [exact Ha |].
  replace (energy M 0 a) with (a ^ 2) in E by (unfold energy; ring).
  inversion Hl; subst; exists tau; (split; [assumption |]); unfold sum_of_squares in E; cbn [fold_right] in E.
  - lra.
  - pose proof (Rmult_le_pos _ _ (Rlt_le _ _ Hm) (sum_of_squares_pos l0)) as Hs. unfold sum_of_squares in Hs. lra.
Qed.

(** Theorem 4: no hop ends above its speed. *)
Theorem hop_not_above : forall M a a', 0 < M -> 0 < a -> hop M a a' -> 0 < a' <= a.
Proof.
  intros M a a' HM Ha H. destruct (hop_first_loss M a a' HM H) as (Ha' & tau & _ & HE).
  split; [exact Ha' |]. pose proof (mu_positive M HM). apply pow2_le; [lra |].
  pose proof (Rmult_le_pos (mu M) (closing 0 a tau ^ 2)) as Hp. pose proof (pow2_ge_0 (closing 0 a tau)). lra.
Qed.
