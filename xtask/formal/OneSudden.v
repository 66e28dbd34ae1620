(** At most one sudden lift-off for each hop: Lemma 17 and Theorem 20 of docs/theory.md. *)

From Coq Require Import Reals Lra List.
From Coquelicot Require Import Coquelicot.
From Hopper Require Import Analysis Model Energy FirstLanding.
Import ListNotations.
Open Scope R_scope.

(** [a] is the first positive root of [tan a = a], which is called [alpha*_1]. *)
Definition first_star a := PI < a < 3 * PI / 2 /\ sin a = a * cos a.

Lemma u_to_star : forall a t, first_star a -> 0 < t <= a -> u t <= 0.
Proof.
  intros a t [Ha E] Ht. destruct (Rle_or_lt t PI) as [H | H]; [left; apply u_negative; lra |].
  replace 0 with (u a) by (unfold u; lra).
  apply (not_falling u (fun t => - t * sin t)); [lra | intros; apply u_derive |].
  intros s Hs. assert (sin s <= 0) by (apply sin_le_0; lra).
  assert (0 <= s * - sin s) by (apply Rmult_le_pos; lra). lra.
Qed.

(** Lemma 17: a flight that lasts at most [alpha*_1] is not followed by a sudden lift-off. *)
Theorem long_flights : forall a x V tau, first_star a -> 0 <= x -> lands x V tau -> tau <= a ->
  stretch x V tau < 1.
Proof.
  intros a x V tau Ha Hx (Ht & _ & HG) Hta. pose (h := tau / 2).
  assert (Eh : tau = 2 * h) by (unfold h; field).
  assert (Hh : 0 < h < PI). { destruct Ha as [Ha _]. pose proof PI_RGT_0. unfold h. lra. }
  pose proof (D_positive h (proj1 Hh)) as HD. pose proof (u_negative h ltac:(lra)) as Hu.
  pose proof (u_to_star a tau Ha (conj Ht Hta)) as Hut.
  assert (Es : stretch x V tau = momentum x V tau) by (unfold G in HG; lra).
  assert (E : (stretch x V tau - 1) * (2 * D h) = x * u tau + 4 * h * (sin h * u h)).
  { rewrite Es. rewrite Eh, G_half in HG. rewrite Eh. unfold momentum, u at 1. rewrite cos_2a_sin, sin_2a.
    replace ((1 + x + V * (2 * h) - (2 * h) ^ 2 / 2 - 1) * (2 * D h))
      with (2 * x * D h + 2 * h * (2 * V * D h) - 4 * h ^ 2 * D h) by field.
    replace (2 * V * D h) with (2 * h ^ 2 - 2 * (1 + x) * sin h ^ 2) by lra. unfold D, u. ring. }
  assert (H1 : 0 <= x * - u tau) by (apply Rmult_le_pos; lra).
  assert (H2 : 0 < h * (sin h * - u h)).
  { apply Rmult_lt_0_compat; [lra |]. apply Rmult_lt_0_compat; [apply sin_gt_0; lra | lra]. }
  apply Rnot_le_lt. intro Hc. assert (0 <= (stretch x V tau - 1) * (2 * D h)) by (apply Rmult_le_pos; lra). lra.
Qed.

Lemma closing_derive : forall x V t, is_derive (fun t => - closing x V t) t (stretch x V t - 1).
Proof. intros x V t. unfold closing, stretch_rate, stretch. auto_derive; [exact I | ring]. Qed.

(** After a lift-off with [x > 0] the lower mass rises at once. *)
Lemma rises_at_once : forall x V, 0 < x -> exists d, 0 < d /\ forall t, 0 < t < d -> 0 < G x V t.
Proof.
  intros x V Hx.
  assert (Hcont : continuity_pt (stretch x V) 0).
  { apply derive_continuity with (stretch_rate x V 0). unfold stretch, stretch_rate.
    auto_derive; [exact I | ring]. }
  assert (E0 : stretch x V 0 = 1 + x) by (unfold stretch; rewrite cos_0, sin_0; ring).
  destruct (Hcont x Hx) as [d [Hd Hd']].
  assert (Hnear : forall t, 0 <= t < d -> 0 < stretch x V t - 1).
  { intros t Ht. destruct (Req_dec t 0) as [-> | Hn]; [lra |].
    assert (H : Rabs (stretch x V t - stretch x V 0) < x).
    { apply (Hd' t). split; [split; [exact I | now apply not_eq_sym] |].
      simpl. unfold R_dist. rewrite Rminus_0_r, Rabs_right; lra. }
    apply Rabs_def2 in H. lra. }
  assert (Hrate : forall t, 0 < t < d -> 0 < - closing x V t).
  { intros t Ht. destruct (mean_value (fun t => - closing x V t) (fun t => stretch x V t - 1) 0 t) as (c & Hc & E);
      [lra | intros; apply closing_derive |].
    assert (E1 : closing x V 0 = 0) by (unfold closing, stretch_rate; rewrite cos_0, sin_0; ring).
    assert (0 < (stretch x V c - 1) * (t - 0)) by (apply Rmult_lt_0_compat; [apply Hnear |]; lra). lra. }
  assert (HG0 : G x V 0 = 0) by (unfold G, momentum, stretch; rewrite cos_0, sin_0; field).
  exists d. split; [exact Hd |]. intros t Ht.
  assert (H1 : G x V 0 <= G x V (t / 2)).
  { apply (not_falling (G x V) (fun s => - closing x V s)); [lra | intros; apply G_derive |].
    intros s Hs'. destruct (Req_dec s 0) as [-> | Hn]; [| left; apply Hrate; lra].
    unfold closing, stretch_rate. rewrite cos_0, sin_0. lra. }
  destruct (mean_value (G x V) (fun s => - closing x V s) (t / 2) t) as (c & Hc & E);
    [lra | intros; apply G_derive |].
  assert (0 < - closing x V c * (t - t / 2)) by (apply Rmult_lt_0_compat; [apply Hrate |]; lra). lra.
Qed.

(** It comes down before any time at which it would be too low. *)
Lemma lands_before : forall x V b, 0 < x -> 0 < b -> G x V b < 0 -> exists tau, lands x V tau /\ tau < b.
Proof.
  intros x V b Hx Hb HG. destruct (rises_at_once x V Hx) as (d & Hd & Hup).
  pose (l := Rmin (b / 2) (d / 2)).
  assert (Hl : 0 < l < b /\ l < d). { unfold l, Rmin. destruct (Rle_dec (b / 2) (d / 2)); lra. }
  destruct (first_zero (G x V) l b) as (tau & Ht & Ez & Hin).
  - lra.
  - intros t _. apply derive_continuity with (- closing x V t). apply G_derive.
  - apply Hup. lra.
  - exact HG.
  - exists tau. split; [| lra]. split; [lra |]. split; [| exact Ez].
    intros t Htt. destruct (Rlt_le_dec t l); [apply Hup | apply Hin]; lra.
Qed.

(** Theorem 20, the inequality: after a sudden first landing the flight lasts less than [alpha*_1]. *)
Lemma second_flight : forall M a h (x := stretch 0 (A h) (2 * h) - 1)
  (V := A h - 2 * h + kappa M * closing 0 (A h) (2 * h)),
  0 < M -> first_star a -> M <= (a ^ 2 - 1) / (a ^ 2 + 1) -> 0 < h -> take_off x V ->
  0 < x /\ V < 0 /\ exists tau, lands x V tau /\ tau < a.
Proof.
  intros M a h x V HM Ha HMa Hh Hto. destruct (first_state M h HM Hh) as [Ex Ev]. fold x in Ex. fold V in Ev.
  pose proof (D_positive h Hh) as HD. destruct Ha as [Hpi Es]. pose proof PI_RGT_0. pose proof PI2_1.
  assert (Ha0 : 0 < a ^ 2) by (apply pow_lt; lra).
  assert (Hk : 1 / a ^ 2 <= 1 - 2 * kappa M).
  { apply Rmult_le_reg_r with (a ^ 2 * (1 + M)); [apply Rmult_lt_0_compat; lra |].
    unfold kappa. field_simplify; [| lra | lra].
    assert (M * (a ^ 2 + 1) <= a ^ 2 - 1); [| lra].
    replace (a ^ 2 - 1) with ((a ^ 2 - 1) / (a ^ 2 + 1) * (a ^ 2 + 1)) by (field; lra).
    apply Rmult_le_compat_r; lra. }
  assert (Hk0 : 0 < 1 / a ^ 2) by (apply Rdiv_lt_0_compat; lra).
  assert (Hform : forall q, 0 < q -> q <= 1 - 2 * kappa M -> 0 < (1 - 2 * kappa M) * u h ^ 2 + h ^ 2 * sin h ^ 2).
  { intros q Hq Hq'. pose proof (pow2_ge_0 (u h)) as Hu. pose proof (pow2_ge_0 (sin h)) as Hs.
    assert (0 <= h ^ 2 * sin h ^ 2) by (apply Rmult_le_pos; [apply pow2_ge_0 | lra]).
    assert (0 <= (1 - 2 * kappa M) * u h ^ 2) by (apply Rmult_le_pos; lra).
    destruct (Req_dec (sin h) 0) as [E0 | Hn].
    - assert (Hc : cos h ^ 2 = 1) by (rewrite cos_squared, E0; ring).
      assert (u h ^ 2 = h ^ 2). { unfold u. rewrite E0. transitivity (h ^ 2 * cos h ^ 2); [ring | rewrite Hc; ring]. }
      assert (0 < (1 - 2 * kappa M) * u h ^ 2); [| lra]. rewrite H3. apply Rmult_lt_0_compat; [lra | now apply pow_lt].
    - pose proof (pow2_gt_0 _ Hn). assert (0 < h ^ 2 * sin h ^ 2); [| lra].
      apply Rmult_lt_0_compat; [now apply pow_lt | lra]. }
  assert (HV : V < 0).
  { rewrite Ev. assert (0 < ((1 - 2 * kappa M) * u h ^ 2 + h ^ 2 * sin h ^ 2) / D h); [| unfold Rdiv in *; lra].
    apply Rdiv_lt_0_compat; [now apply (Hform (1 / a ^ 2)) | exact HD]. }
  assert (Hx : 0 < x) by (unfold take_off in Hto; lra).
  split; [exact Hx |]. split; [exact HV |].
  assert (Hsum : x + a * V <= 0).
  { rewrite Ex, Ev.
    assert (0 <= a * ((1 - 2 * kappa M - 1 / a ^ 2) * u h ^ 2 + (u h / a - h * sin h) ^ 2) / D h).
    { apply Rdiv_le_0_compat; [| exact HD]. apply Rmult_le_pos; [lra |]. apply Rplus_le_le_0_compat; [| apply pow2_ge_0].
      apply Rmult_le_pos; [lra | apply pow2_ge_0]. }
    assert (2 * h * (sin h * u h) / D h + a * (- ((1 - 2 * kappa M) * u h ^ 2 + h ^ 2 * sin h ^ 2) / D h) =
      - (a * ((1 - 2 * kappa M - 1 / a ^ 2) * u h ^ 2 + (u h / a - h * sin h) ^ 2) / D h)) by (field; lra). lra. }
  apply lands_before; [exact Hx | lra |].
  unfold G, momentum, stretch. rewrite Es.
  pose proof (COS_bound a) as Hc.
  assert (0 <= (1 - cos a) * - (x + a * V)) by (apply Rmult_le_pos; lra).
  assert (2 * 2 < a * a) by (apply Rmult_gt_0_lt_compat; lra). lra.
Qed.

(** Theorem 20: for these mass ratios a hop has at most one sudden lift-off, hence at most two landings. *)
Theorem at_most_one_sudden : forall M a alpha l alpha', 0 < M -> first_star a -> M <= (a ^ 2 - 1) / (a ^ 2 + 1) ->
  0 < alpha -> closing_speeds M 0 alpha l alpha' -> (length l <= 2)%nat.
Proof.
  intros M a alpha l alpha' HM Ha HMa Halpha Hl.
  inversion Hl as [? ? tau ? ? ? HL | ? ? tau l2 ? x1 V1 HL Hto Hrest]; subst; simpl; [auto |].
  assert (HL' := HL). apply first_landing in HL'; [| exact Halpha]. destruct HL' as [Ht EA].
  assert (Et : tau = 2 * (tau / 2)) by field.
  set (h := tau / 2) in *. clearbody h. subst alpha tau.
  destruct (second_flight M a h HM Ha HMa ltac:(lra) Hto) as (Hx & _ & tau & Htau & Hlt).
  inversion Hrest as [? ? t2 ? ? ? HL2 | ? ? t2 l3 ? x2 V2 HL2 Hto2 _]; subst; simpl; [auto |]. exfalso.
  assert (Et : t2 = tau) by exact (lands_unique _ _ _ _ HL2 Htau).
  assert (Hs : stretch x1 V1 t2 < 1) by (apply (long_flights a _ _ _ Ha (Rlt_le _ _ Hx) HL2); lra).
  assert (x2 < 0) by (unfold x2; lra). unfold take_off in Hto2. lra.
Qed.
