(** The first landing by half its time of flight: Lemmas 5 and 6, Theorems 7 and 8, Corollary 9 of docs/theory.md. *)

From Coq Require Import Reals Lra Lia.
From Coquelicot Require Import Coquelicot.
From Hopper Require Import Analysis Model Energy.
Open Scope R_scope.

Definition D h := h - sin h * cos h.
Definition u h := h * cos h - sin h.
(** The speed of the lift-off from the ground whose flight lasts [2 h], and its closing speed. *)
Definition A h := (h ^ 2 - sin h ^ 2) / D h.
Definition Gam h := 2 * u h ^ 2 / D h.

Lemma D_positive : forall h, 0 < h -> 0 < D h.
Proof.
  intros h Hh. unfold D. pose proof (sin_lt_x (2 * h)) as H. rewrite sin_2a in H. lra.
Qed.

Lemma cos_squared : forall h, cos h ^ 2 = 1 - sin h ^ 2.
Proof. intro h. pose proof (sin_cos_squares h). lra. Qed.

Lemma D_derive : forall h, is_derive D h (2 * sin h ^ 2).
Proof.
  intro h. unfold D. auto_derive; [exact I |]. pose proof (cos_squared h). simpl in *. lra.
Qed.

Lemma u_derive : forall h, is_derive u h (- h * sin h).
Proof. intro h. unfold u. auto_derive; [exact I | ring]. Qed.

(** Lemma 5: the height and the closing speed after the time [2 h]. *)
Lemma G_half : forall x V h, G x V (2 * h) = 2 * (1 + x) * sin h ^ 2 + 2 * V * D h - 2 * h ^ 2.
Proof.
  intros x V h. unfold G, momentum, stretch, D. rewrite cos_2a_sin, sin_2a. field.
Qed.

Lemma closing_half : forall x V h, 0 < h -> G x V (2 * h) = 0 ->
  closing x V (2 * h) = 2 * u h * (h * cos h - (1 + x) * sin h) / D h.
Proof.
  intros x V h Hh HG. pose proof (D_positive h Hh) as HD. rewrite G_half in HG.
  assert (EV : V = (h ^ 2 - (1 + x) * sin h ^ 2) / D h).
  { apply Rmult_eq_reg_r with (D h); [| lra]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra. }
  apply Rmult_eq_reg_r with (D h); [| lra]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra.
  unfold closing, stretch_rate. rewrite cos_2a_sin, sin_2a.
  replace ((- (1 + x) * (2 * sin h * cos h) + V * (1 - 2 * sin h * sin h) - (V - 2 * h)) * D h)
    with (- 2 * (1 + x) * sin h * cos h * D h - 2 * sin h ^ 2 * (V * D h) + 2 * h * D h) by ring.
  replace (V * D h) with (h ^ 2 - (1 + x) * sin h ^ 2) by lra.
  unfold D, u. pose proof (cos_squared h) as Ec.
  assert (E : 2 * h ^ 2 * (1 - sin h ^ 2) = 2 * h ^ 2 * cos h ^ 2) by (rewrite Ec; ring).
  assert (E2 : 2 * (1 + x) * sin h ^ 2 * cos h ^ 2 = 2 * (1 + x) * sin h ^ 2 * (1 - sin h ^ 2)) by (rewrite Ec; ring).
  lra.
Qed.

(** From the ground the height has the sign of [a - A h]. *)
Lemma G_ground : forall a h, 0 < h -> G 0 a (2 * h) = 2 * D h * (a - A h).
Proof. intros a h Hh. pose proof (D_positive h Hh). rewrite G_half. unfold A. field. lra. Qed.

Lemma closing_ground : forall h, 0 < h -> closing 0 (A h) (2 * h) = Gam h.
Proof.
  intros h Hh. rewrite closing_half; [| exact Hh | rewrite G_ground by exact Hh; ring].
  unfold Gam. pose proof (D_positive h Hh). unfold u. field. lra.
Qed.

(** Lemma 5: [A' = 2 u^2 / D^2]. *)
Lemma A_derive : forall h, 0 < h -> is_derive A h (2 * u h ^ 2 / D h ^ 2).
Proof.
  intros h Hh. pose proof (D_positive h Hh) as HD. unfold A, D in *. auto_derive; [lra |].
  pose proof (cos_squared h) as Ec. unfold u. field_simplify; [| lra | lra]. f_equal.
  replace (sin h ^ 4) with (sin h ^ 2 * sin h ^ 2) by ring.
  replace (cos h ^ 3) with (cos h * cos h ^ 2) by ring. rewrite Ec. ring.
Qed.

(** [A h - h = S u / D]. *)
Lemma A_minus : forall h, 0 < h -> A h - h = sin h * u h / D h.
Proof. intros h Hh. pose proof (D_positive h Hh). unfold A, u, D in *. field. lra. Qed.

Lemma A_not_falling : forall h k, 0 < h <= k -> A h <= A k.
Proof.
  intros h k [Hh Hk]. apply (not_falling A (fun h => 2 * u h ^ 2 / D h ^ 2)); [exact Hk | |].
  - intros t Ht. apply A_derive. lra.
  - intros t Ht. pose proof (D_positive t). apply Rdiv_le_0_compat; [| apply pow_lt; lra].
    pose proof (pow2_ge_0 (u t)). lra.
Qed.

(** A function that is constant between two points has the derivative 0 there. *)
Lemma derivative_of_constant : forall (f : R -> R) a b l t, a < t < b ->
  (forall s, a < s < b -> f s = f t) -> is_derive f t l -> l = 0.
Proof.
  intros f a b l t Ht Hc Hd. assert (H0 : is_derive f t 0).
  { apply (is_derive_ext_loc (fun _ => f t)); [| apply @is_derive_const].
    assert (Hp : 0 < Rmin (t - a) (b - t)) by (apply Rmin_pos; lra).
    exists (mkposreal _ Hp). intros s Hs. unfold ball in Hs. simpl in Hs.
    unfold AbsRing_ball, abs, minus, plus, opp in Hs.
    simpl in Hs. symmetry. apply Hc. apply Rabs_def2 in Hs.
    pose proof (Rmin_l (t - a) (b - t)). pose proof (Rmin_r (t - a) (b - t)). lra. }
  apply is_derive_unique in Hd. apply is_derive_unique in H0. lra.
Qed.

(** Theorem 7: [A] increases strictly. *)
Theorem A_increases : forall h k, 0 < h < k -> A h < A k.
Proof.
  intros h k [Hh Hk]. destruct (A_not_falling h k) as [H | E]; [lra | exact H |]. exfalso.
  assert (Hc : forall t, h <= t <= k -> A t = A h).
  { intros t Ht. apply Rle_antisym.
    - rewrite E. apply A_not_falling. lra.
    - apply A_not_falling. lra. }
  assert (Hu : forall t, h < t < k -> u t = 0).
  { intros t Ht. assert (H : 2 * u t ^ 2 / D t ^ 2 = 0).
    { apply (derivative_of_constant A h k _ t Ht); [| apply A_derive; lra].
      intros s Hs. now rewrite (Hc s), (Hc t) by lra. }
    pose proof (D_positive t ltac:(lra)) as HD. apply Rmult_integral in H. destruct H as [H | H].
    - apply Rsqr_0_uniq. rewrite Rsqr_pow2. lra.
    - apply Rinv_neq_0_compat in H; [contradiction |]. apply pow_nonzero. lra. }
  assert (Hs : forall t, h < t < k -> sin t = 0).
  { intros t Ht. assert (H : - t * sin t = 0).
    { apply (derivative_of_constant u h k _ t Ht); [| apply u_derive]. intros s Hs. now rewrite (Hu s), (Hu t). }
    apply Rmult_integral in H. destruct H; lra. }
  pose (t := (h + k) / 2). assert (Ht : h < t < k) by (unfold t; lra).
  pose proof (Hs t Ht) as E1. pose proof (Hu t Ht) as E2. unfold u in E2. rewrite E1 in E2.
  pose proof (sin_cos_squares t) as E3. rewrite E1 in E3.
  assert (E4 : t * cos t = 0) by lra. apply Rmult_integral in E4. destruct E4 as [E4 | E4]; [lra |].
  rewrite E4 in E3. lra.
Qed.

(** Lemma 6: [u] is negative up to [pi]. *)
Lemma u_negative : forall h, 0 < h <= PI -> u h < 0.
Proof.
  intros h Hh. assert (H : forall k, 0 <= k <= PI -> u k <= 0).
  { intros k Hk. replace 0 with (u 0) by (unfold u; rewrite sin_0; ring).
    apply (not_rising u (fun k => - k * sin k)); [lra | intros; apply u_derive |].
    intros t Ht. pose proof (sin_ge_0 t). assert (0 <= t * sin t) by (apply Rmult_le_pos; lra). lra. }
  destruct (H h) as [Hl | E]; [lra | exact Hl |]. exfalso.
  (* Else it would vanish on all of [0, h]. *)
  assert (Hc : forall k, 0 <= k <= h -> u k = 0).
  { intros k Hk. apply Rle_antisym; [apply H; lra |]. rewrite <- E.
    apply (not_rising u (fun k => - k * sin k)); [lra | intros; apply u_derive |].
    intros t Ht. pose proof (sin_ge_0 t). assert (0 <= t * sin t) by (apply Rmult_le_pos; lra). lra. }
  assert (Hd : - (h / 2) * sin (h / 2) = 0).
  { apply (derivative_of_constant u 0 h _ (h / 2)); [lra | | apply u_derive]. intros s Hs.
    now rewrite (Hc s), (Hc (h / 2)) by lra. }
  assert (0 < sin (h / 2)) by (apply sin_gt_0; lra).
  apply Rmult_integral in Hd. destruct Hd; lra.
Qed.

Lemma A_below : forall h, 0 < h <= PI -> A h <= h.
Proof.
  intros h Hh. pose proof (A_minus h) as E. pose proof (D_positive h) as HD. pose proof (u_negative h Hh).
  assert (0 <= sin h) by (apply sin_ge_0; lra).
  assert (0 <= sin h * - u h / D h). { apply Rdiv_le_0_compat; [apply Rmult_le_pos |]; lra. }
  unfold Rdiv in *. lra.
Qed.

Lemma sin_multiple : forall n, sin (INR n * PI) = 0.
Proof.
  intro n. apply sin_eq_0_1. exists (Z.of_nat n). now rewrite <- INR_IZR_INZ.
Qed.

(** Theorem 7: [A (n pi) = n pi]. *)
Lemma A_multiple : forall n, (1 <= n)%nat -> A (INR n * PI) = INR n * PI.
Proof.
  intros n Hn. pose proof PI_RGT_0. assert (0 < INR n) by (apply lt_0_INR; lia).
  assert (0 < INR n * PI) by (apply Rmult_lt_0_compat; lra).
  pose proof (A_minus (INR n * PI)) as E. rewrite sin_multiple in E. unfold Rdiv in E. lra.
Qed.

(** Theorem 7: each speed has exactly one half time of flight. *)
Theorem half_time : forall a, 0 < a -> exists h, 0 < h /\ A h = a.
Proof.
  intros a Ha. pose proof PI_RGT_0 as Hpi.
  pose (l := Rmin (a / 2) PI).
  assert (Hl : 0 < l /\ l <= a / 2 /\ l <= PI).
  { unfold l, Rmin. destruct (Rle_dec (a / 2) PI); lra. }
  destruct (nfloor_ex (a / PI)) as [m [_ Hm]]; [apply Rdiv_le_0_compat; lra |].
  pose (n := S m). rewrite <- S_INR in Hm. fold n in Hm.
  assert (Hr : a < INR n * PI).
  { replace a with (a / PI * PI) by (field; lra). now apply Rmult_lt_compat_r. }
  assert (Hn1 : (1 <= n)%nat) by (unfold n; lia).
  destruct (first_crossing (fun h => A h - a) l (INR n * PI)) as (h & Hh & E & _).
  - lra.
  - intros t Ht. apply derive_continuity with (2 * u t ^ 2 / D t ^ 2 - 0).
    apply (is_derive_minus (V := R_NormedModule) A (fun _ => a)); [apply A_derive; lra | apply @is_derive_const].
  - pose proof (A_below l). lra.
  - rewrite A_multiple by exact Hn1. lra.
  - exists h. split; lra.
Qed.

(** Theorem 7: the first landing from the ground. *)
Theorem first_landing : forall a tau, 0 < a -> (lands 0 a tau <-> 0 < tau /\ A (tau / 2) = a).
Proof.
  intros a tau Ha.
  assert (E : forall t, 0 < t -> G 0 a t = 2 * D (t / 2) * (a - A (t / 2))).
  { intros t Ht. rewrite <- G_ground by lra. f_equal. field. }
  split.
  - intros (Ht & _ & Hz). split; [exact Ht |]. rewrite E in Hz by exact Ht.
    pose proof (D_positive (tau / 2)). apply Rmult_integral in Hz. lra.
  - intros [Ht EA]. split; [exact Ht |]. split.
    + intros t Hs. rewrite E by lra. pose proof (D_positive (t / 2)).
      pose proof (A_increases (t / 2) (tau / 2)). apply Rmult_lt_0_compat; lra.
    + rewrite E by exact Ht. rewrite EA. ring.
Qed.

Lemma lands_half : forall h, 0 < h -> 0 < A h -> lands 0 (A h) (2 * h).
Proof. intros h Hh Ha. apply first_landing; [exact Ha |]. split; [lra |]. f_equal. field. Qed.

(** [A] is positive. *)
Lemma A_positive : forall h, 0 < h -> 0 < A h.
Proof.
  intros h Hh. unfold A. apply Rdiv_lt_0_compat; [| now apply D_positive].
  pose proof (sin_lt_x h Hh). destruct (Rle_or_lt 1 h) as [H1 | H1].
  - pose proof (SIN_bound h) as Hb. destruct (Req_dec h 1) as [-> | Hne].
    + pose proof (sin_gt_0 1). pose proof PI_RGT_0. pose proof PI2_1. nra.
    + assert (sin h ^ 2 <= 1) by nra. nra.
  - pose proof PI2_1. pose proof (sin_gt_0 h). nra.
Qed.

(** Theorem 7: the time of flight depends continuously on the speed. *)
Theorem half_time_continuous : forall h e, 0 < h -> 0 < e -> exists d, 0 < d /\
  forall k, 0 < k -> Rabs (A k - A h) < d -> Rabs (k - h) < e.
Proof.
  intros h e Hh He. pose (l := Rmax (h / 2) (h - e / 2)). pose (r := h + e / 2).
  assert (Hl : 0 < l < h /\ h - e < l). { unfold l, Rmax. destruct (Rle_dec (h / 2) (h - e / 2)); lra. }
  pose proof (A_increases l h ltac:(lra)) as H1.
  pose proof (A_increases h r ltac:(unfold r; lra)) as H2.
  exists (Rmin (A h - A l) (A r - A h)). split; [apply Rmin_pos; lra |].
  intros k Hk HA. pose proof (Rmin_l (A h - A l) (A r - A h)). pose proof (Rmin_r (A h - A l) (A r - A h)).
  apply Rabs_def2 in HA. apply Rabs_def1; apply Rnot_le_lt; intro Hc.
  - pose proof (A_not_falling r k). unfold r in *. lra.
  - pose proof (A_not_falling k l). lra.
Qed.

(** Theorem 8: the state after the first landing. *)
Lemma first_state : forall M h, 0 < M -> 0 < h ->
  stretch 0 (A h) (2 * h) - 1 = 2 * h * (sin h * u h) / D h /\
  A h - 2 * h + kappa M * closing 0 (A h) (2 * h) = - ((1 - 2 * kappa M) * u h ^ 2 + h ^ 2 * sin h ^ 2) / D h.
Proof.
  intros M h HM Hh. pose proof (D_positive h Hh) as HD. rewrite closing_ground by exact Hh.
  pose proof (A_minus h Hh) as EA. split.
  - assert (EG : G 0 (A h) (2 * h) = 0) by (rewrite G_ground by exact Hh; ring).
    replace (stretch 0 (A h) (2 * h)) with (momentum 0 (A h) (2 * h)) by (unfold G in EG; lra).
    replace (2 * h * (sin h * u h) / D h) with (2 * h * (sin h * u h / D h)) by (field; lra).
    rewrite <- EA. unfold momentum. field.
  - replace (A h - 2 * h) with (sin h * u h / D h - h) by lra. unfold Gam.
    apply Rmult_eq_reg_r with (D h); [| lra]. field_simplify; [| lra | lra].
    unfold D, u. pose proof (cos_squared h) as Ec.
    assert (E : h ^ 2 * cos h ^ 2 = h ^ 2 * (1 - sin h ^ 2)) by (rewrite Ec; ring). lra.
Qed.

(** Theorem 8: where the first landing is followed by contact, the hop has this one landing. *)
Theorem hop_with_one_landing : forall M h a, 0 < M -> 0 < h ->
  sin h * u h < 0 \/ u h = 0 \/ (sin h = 0 /\ M <= 1) ->
  (hop M (A h) a <-> 0 < A h ^ 2 - mu M * Gam h ^ 2 /\ a = sqrt (A h ^ 2 - mu M * Gam h ^ 2)).
Proof.
  intros M h a HM Hh Hsu. pose proof (D_positive h Hh) as HD. pose proof (A_positive h Hh) as HA.
  pose proof (lands_half h Hh HA) as HL. destruct (first_state M h HM Hh) as [Ex Ev].
  pose proof (energy_of_landing M 0 (A h) (2 * h) HM HL) as Ee.
  replace (energy M 0 (A h)) with (A h ^ 2) in Ee by (unfold energy; ring).
  rewrite (closing_ground h Hh) in Ee at 2.
  set (x' := stretch 0 (A h) (2 * h) - 1) in *. set (V' := A h - 2 * h + kappa M * closing 0 (A h) (2 * h)) in *.
  assert (Hc : contact x' V').
  { rewrite Ex, Ev. destruct Hsu as [H | H].
    - left. assert (0 < 2 * h * - (sin h * u h) / D h); [| unfold Rdiv in *; lra].
      apply Rdiv_lt_0_compat; [apply Rmult_lt_0_compat |]; lra.
    - right. split; [destruct H as [-> | [-> _]]; field; lra |].
      assert (0 <= ((1 - 2 * kappa M) * u h ^ 2 + h ^ 2 * sin h ^ 2) / D h); [| unfold Rdiv in *; lra].
      apply Rdiv_le_0_compat; [| exact HD].
      assert (0 <= h ^ 2 * sin h ^ 2) by (apply Rmult_le_pos; apply pow2_ge_0).
      destruct H as [-> | [_ H]]; [lra |].
      assert (H1 : 0 <= 1 - 2 * kappa M).
      { replace (1 - 2 * kappa M) with ((1 - M) / (1 + M)) by (unfold kappa; field; lra). apply Rdiv_le_0_compat; lra. }
      pose proof (Rmult_le_pos _ _ H1 (pow2_ge_0 (u h))). lra. }
  assert (Hno : ~ take_off x' V') by (unfold take_off, contact in *; lra).
  rewrite <- Ee. rewrite <- (contact_ends M x' V' a HM Hc). split; intro H.
  - inversion H; subst.
    + apply landing_closed in H0; [| exact HM]. destruct H0 as (tau & Hl & -> & ->).
      now rewrite (lands_unique 0 (A h) tau (2 * h) Hl HL) in *.
    + apply landing_closed in H0; [| exact HM]. destruct H0 as (tau & Hl & -> & ->).
      rewrite (lands_unique 0 (A h) tau (2 * h) Hl HL) in *. contradiction.
  - apply ends_gradually with x' V'; [| exact Hc | exact H].
    apply landing_closed; [exact HM |]. exists (2 * h). now repeat split; try apply HL.
Qed.

(** Corollary 9: the fixed points are the roots of [tan a = a]. *)
Theorem fixed_points : forall M a, 0 < M -> 0 < a -> (hop M a a <-> sin a = a * cos a).
Proof.
  intros M a HM Ha. split.
  - intro H. destruct (hop_first_loss M a a HM H) as (_ & tau & Hl & HE).
    pose proof (mu_positive M HM) as Hmu.
    assert (Hsq : closing 0 a tau ^ 2 = 0).
    { pose proof (pow2_ge_0 (closing 0 a tau)). apply Rle_antisym; [| lra].
      apply Rmult_le_reg_l with (mu M); [exact Hmu | lra]. }
    apply first_landing in Hl; [| exact Ha]. destruct Hl as [Ht EA].
    pose proof (D_positive (tau / 2) ltac:(lra)) as HD.
    assert (Eu : u (tau / 2) = 0).
    { replace tau with (2 * (tau / 2)) in Hsq by field. rewrite <- EA, closing_ground in Hsq by lra.
      unfold Gam in Hsq. apply Rsqr_0_uniq. rewrite Rsqr_pow2.
      rewrite <- Rsqr_pow2 in Hsq. apply Rsqr_0_uniq in Hsq. apply Rmult_integral in Hsq.
      destruct Hsq as [E | E]; [lra |]. exfalso. apply Rinv_neq_0_compat in E; lra. }
    pose proof (A_minus (tau / 2) ltac:(lra)) as Em. rewrite Eu, EA, Rmult_0_r in Em.
    unfold Rdiv at 2 in Em. rewrite Rmult_0_l in Em.
    assert (Ea : a = tau / 2) by lra. rewrite Ea. unfold u in Eu. lra.
  - intro E. assert (Eu : u a = 0) by (unfold u; lra).
    assert (EA : A a = a). { pose proof (A_minus a Ha) as Em. rewrite Eu, Rmult_0_r in Em. unfold Rdiv in Em. lra. }
    rewrite <- EA at 1. apply hop_with_one_landing; [exact HM | exact Ha | tauto |].
    rewrite EA. unfold Gam. rewrite Eu.
    replace (a ^ 2 - mu M * (2 * 0 ^ 2 / D a) ^ 2) with (a ^ 2) by (unfold Rdiv; ring).
    split; [now apply pow_lt | symmetry; apply sqrt_pow2; lra].
Qed.
