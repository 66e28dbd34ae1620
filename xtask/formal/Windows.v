(** Humps, windows and contact parts: Lemma 6, the signs in Theorem 7, and Theorem 8 of docs/theory.md. *)

From Coq Require Import Reals Lra Lia.
From Coquelicot Require Import Coquelicot.
From Hopper Require Import Analysis Model Energy FirstLanding.
Open Scope R_scope.

(** The interval between the multiples [n] and [n+1] of pi, and the root [alpha*_n] of [tan a = a] in it. *)
Definition between_multiples n h := INR n * PI < h < INR (S n) * PI.
Definition star n a := between_multiples n a /\ u a = 0.

Lemma sin_between : forall n h, between_multiples n h -> sin h <> 0.
Proof.
  intros n h [H1 H2] E. pose proof PI_RGT_0 as Hpi. destruct (sin_eq_0_0 h E) as [k ->].
  apply Rmult_lt_reg_r in H1, H2; try exact Hpi. rewrite INR_IZR_INZ in H1, H2.
  apply lt_IZR in H1, H2. rewrite Nat2Z.inj_succ in H2. lia.
Qed.

Lemma between_positive : forall n h, between_multiples n h -> 0 < h.
Proof.
  intros n h [H _]. pose proof PI_RGT_0. pose proof (pos_INR n).
  assert (0 <= INR n * PI) by (apply Rmult_le_pos; lra). lra.
Qed.

(** [u / sin] falls between two multiples of pi. *)
Lemma ratio_falls : forall n h k, between_multiples n h -> between_multiples n k -> h < k -> u k / sin k < u h / sin h.
Proof.
  intros n h k Hh Hk Hhk.
  assert (Hin : forall t, h <= t <= k -> between_multiples n t) by (intros t Ht; unfold between_multiples in *; lra).
  destruct (mean_value (fun t => u t / sin t) (fun t => - (D t / sin t ^ 2)) h k Hhk) as (c & Hc & E).
  - intros t Ht. pose proof (sin_between n t (Hin t Ht)) as Hs. unfold u, D. auto_derive; [exact Hs |].
    transitivity ((- t * (sin t ^ 2 + cos t ^ 2) + sin t * cos t) / sin t ^ 2); [field; exact Hs |].
    rewrite sin_cos_squares. field. exact Hs.
  - pose proof (sin_between n c (Hin c Hc)) as Hs. pose proof (D_positive c (between_positive n c (Hin c Hc))).
    pose proof (pow2_gt_0 (sin c) Hs). assert (0 < D c / sin c ^ 2) by (apply Rdiv_lt_0_compat; lra).
    assert (0 < D c / sin c ^ 2 * (k - h)) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

(** Lemma 6: [sin h * u h] is positive before the root and negative after it. *)
Theorem sign_before : forall n a h, star n a -> INR n * PI < h < a -> 0 < sin h * u h.
Proof.
  intros n a h [Ha Ea] Hh.
  assert (Hb : between_multiples n h) by (unfold between_multiples in *; lra).
  pose proof (ratio_falls n h a Hb Ha (proj2 Hh)) as H. rewrite Ea in H. unfold Rdiv in H at 1. rewrite Rmult_0_l in H.
  pose proof (sin_between n h Hb) as Hs. replace (sin h * u h) with (sin h ^ 2 * (u h / sin h)) by (field; exact Hs).
  apply Rmult_lt_0_compat; [now apply pow2_gt_0 | exact H].
Qed.

Theorem sign_after : forall n a h, star n a -> a < h < INR (S n) * PI -> sin h * u h < 0.
Proof.
  intros n a h [Ha Ea] Hh.
  assert (Hb : between_multiples n h) by (unfold between_multiples in *; lra).
  pose proof (ratio_falls n a h Ha Hb (proj1 Hh)) as H. rewrite Ea in H. unfold Rdiv in H at 2. rewrite Rmult_0_l in H.
  pose proof (sin_between n h Hb) as Hs. replace (sin h * u h) with (- (sin h ^ 2 * - (u h / sin h))) by (field; exact Hs).
  assert (0 < sin h ^ 2 * - (u h / sin h)); [| lra]. apply Rmult_lt_0_compat; [now apply pow2_gt_0 | lra].
Qed.

(** Lemma 6: there is exactly one root for each [n >= 1], in the first half. *)
Theorem star_unique : forall n a b, star n a -> star n b -> a = b.
Proof.
  intros n a b Ha Hb. pose proof (proj1 Ha) as [H1 H2]. pose proof (proj1 Hb) as [H3 H4].
  destruct (Rtotal_order a b) as [H | [H | H]]; [| exact H |].
  - pose proof (sign_after n a b Ha (conj H H4)) as Hs. rewrite (proj2 Hb) in Hs. lra.
  - pose proof (sign_after n b a Hb (conj H H2)) as Hs. rewrite (proj2 Ha) in Hs. lra.
Qed.

Theorem star_exists : forall n, (1 <= n)%nat -> exists a, star n a /\ a < (INR n + 1 / 2) * PI.
Proof.
  intros n Hn. pose proof PI_RGT_0 as Hpi. pose (m := INR n * PI).
  assert (Hm : 0 < m) by (apply Rmult_lt_0_compat; [apply lt_0_INR; lia | exact Hpi]).
  assert (Hc : cos m ^ 2 = 1) by (rewrite cos_squared; unfold m; rewrite sin_multiple; ring).
  destruct (first_zero (fun h => cos m * u h) m (m + PI / 2)) as (a & Ha & E & _).
  - lra.
  - intros t _. eapply derive_continuity. apply (is_derive_scal u). apply u_derive.
  - unfold u. replace (sin m) with 0 by (symmetry; apply sin_multiple).
    replace (cos m * (m * cos m - 0)) with (m * cos m ^ 2) by ring. rewrite Hc. lra.
  - unfold u. rewrite cos_plus, sin_plus, cos_PI2, sin_PI2. replace (sin m) with 0 by (symmetry; apply sin_multiple).
    replace (cos m * ((m + PI / 2) * (cos m * 0 - 0 * 1) - (0 * 0 + cos m * 1))) with (- cos m ^ 2) by ring. lra.
  - exists a. split; [split |].
    + unfold between_multiples. rewrite S_INR. replace ((INR n + 1) * PI) with (m + PI) by (unfold m; ring). fold m. lra.
    + apply Rmult_integral in E. destruct E as [E | E]; [rewrite E in Hc; lra | exact E].
    + unfold m in Ha. lra.
Qed.

(** Theorem 7: before [alpha*_n] half the time of flight is less than the speed, and after it greater. *)
Theorem times_before : forall n a h, (1 <= n)%nat -> star n a -> 0 < h ->
  (INR n * PI < A h < a <-> INR n * PI < h < a) /\ (INR n * PI < h < a -> h < A h).
Proof.
  intros n a h Hn Ha Hh. pose proof (between_positive n a (proj1 Ha)) as Hpos.
  assert (EA : A a = a). { pose proof (A_minus a Hpos) as E. rewrite (proj2 Ha), Rmult_0_r in E. unfold Rdiv in E. lra. }
  pose proof (A_multiple n Hn) as Em. pose proof PI_RGT_0 as Hpi.
  assert (Hm : 0 < INR n * PI) by (apply Rmult_lt_0_compat; [apply lt_0_INR; lia | exact Hpi]).
  split; [split; intros [H1 H2]; split |].
  - apply Rnot_le_lt. intro H. pose proof (A_not_falling h (INR n * PI)). lra.
  - apply Rnot_le_lt. intro H. pose proof (A_not_falling a h). lra.
  - rewrite <- Em. apply A_increases. lra.
  - rewrite <- EA. apply A_increases. lra.
  - intro H. pose proof (A_minus h Hh) as E. pose proof (sign_before n a h Ha H). pose proof (D_positive h Hh).
    assert (0 < sin h * u h / D h) by (apply Rdiv_lt_0_compat; lra). lra.
Qed.

Theorem times_after : forall n a h, star n a -> 0 < h ->
  (a < A h < INR (S n) * PI <-> a < h < INR (S n) * PI) /\ (a < h < INR (S n) * PI -> A h < h).
Proof.
  intros n a h Ha Hh. pose proof (between_positive n a (proj1 Ha)) as Hpos.
  assert (EA : A a = a). { pose proof (A_minus a Hpos) as E. rewrite (proj2 Ha), Rmult_0_r in E. unfold Rdiv in E. lra. }
  pose proof (A_multiple (S n) ltac:(lia)) as Em. pose proof (proj2 (proj1 Ha)) as Hm.
  split; [split; intros [H1 H2]; split |].
  - apply Rnot_le_lt. intro H. pose proof (A_not_falling h a). lra.
  - apply Rnot_le_lt. intro H. pose proof (A_not_falling (INR (S n) * PI) h). lra.
  - rewrite <- EA. apply A_increases. lra.
  - rewrite <- Em. apply A_increases. lra.
  - intro H. pose proof (A_minus h Hh) as E. pose proof (sign_after n a h Ha H). pose proof (D_positive h Hh).
    assert (0 < - (sin h * u h) / D h) by (apply Rdiv_lt_0_compat; lra). unfold Rdiv in *. lra.
Qed.

(** Theorem 8: the first landing is followed by a sudden lift-off exactly in the windows, and at [n pi] if [M > 1]. *)
Theorem sudden_exactly : forall M h, 0 < M -> 0 < h ->
  (take_off (stretch 0 (A h) (2 * h) - 1) (A h - 2 * h + kappa M * closing 0 (A h) (2 * h)) <->
   exists n, (1 <= n)%nat /\ ((exists a, star n a /\ INR n * PI < h < a) \/ (h = INR n * PI /\ 1 < M))).
Proof.
  intros M h HM Hh. destruct (first_state M h HM Hh) as [Ex Ev].
  pose proof (D_positive h Hh) as HD. pose proof PI_RGT_0 as Hpi.
  assert (Ek : 1 - 2 * kappa M = (1 - M) / (1 + M)) by (unfold kappa; field; lra).
  assert (Hx : 0 < stretch 0 (A h) (2 * h) - 1 <-> 0 < sin h * u h).
  { rewrite Ex. split; intro H.
    - apply Rnot_le_lt. intro Hle. assert (0 <= 2 * h * - (sin h * u h) / D h); [| unfold Rdiv in *; lra].
      apply Rdiv_le_0_compat; [apply Rmult_le_pos |]; lra.
    - apply Rdiv_lt_0_compat; [apply Rmult_lt_0_compat |]; lra. }
  assert (Hzero : sin h = 0 -> u h ^ 2 = h ^ 2).
  { intro E. unfold u. rewrite E. transitivity (h ^ 2 * cos h ^ 2); [ring | rewrite cos_squared, E; ring]. }
  split.
  - destruct (nfloor_ex (h / PI)) as [n [Hn1 Hn2]]; [apply Rdiv_le_0_compat; lra |].
    assert (Hn : INR n * PI <= h < INR (S n) * PI).
    { rewrite S_INR. split; [apply Rmult_le_reg_r with (/ PI) | apply Rmult_lt_reg_r with (/ PI)];
        try (now apply Rinv_0_lt_compat); rewrite Rmult_assoc, Rinv_r, Rmult_1_r by lra; unfold Rdiv in *; lra. }
    intros [H | [H HV]].
    + apply Hx in H. exists n. assert (Hn0 : (1 <= n)%nat).
      { destruct n; [| lia]. exfalso. simpl in Hn. pose proof (u_negative h ltac:(lra)).
        assert (0 <= sin h * - u h) by (apply Rmult_le_pos; [apply sin_ge_0; lra | lra]). lra. }
      split; [exact Hn0 | left]. destruct (star_exists n Hn0) as (a & Ha & _). exists a. split; [exact Ha |]. split.
      * destruct (proj1 Hn) as [Hl | E]; [exact Hl |]. rewrite <- E, sin_multiple in H. lra.
      * apply Rnot_le_lt. intros [Hlt | E]; [pose proof (sign_after n a h Ha (conj Hlt (proj2 Hn))); lra |].
        rewrite <- E, (proj2 Ha) in H. lra.
    + assert (Hsu : sin h * u h = 0).
      { rewrite Ex in H. apply Rmult_integral in H. destruct H as [H | H].
        - apply Rmult_integral in H. lra.
        - pose proof (Rinv_0_lt_compat _ HD). lra. }
      rewrite Ev in HV. assert (Hq : (1 - 2 * kappa M) * u h ^ 2 + h ^ 2 * sin h ^ 2 < 0).
      { apply Rnot_le_lt. intro Hle. pose proof (Rdiv_le_0_compat _ _ Hle HD). unfold Rdiv in *. lra. }
      apply Rmult_integral in Hsu. destruct Hsu as [E | E].
      * rewrite Hzero, E, Ek in Hq by exact E. exists n.
        assert (Ehn : h = INR n * PI).
        { destruct (proj1 Hn) as [Hl | ?]; [| lra]. exfalso. now apply (sin_between n h (conj Hl (proj2 Hn))). }
        assert (Hn0 : (1 <= n)%nat) by (destruct n; [simpl in Ehn; lra | lia]).
        split; [exact Hn0 | right]. split; [exact Ehn |]. apply Rnot_le_lt. intro Hle.
        assert (0 <= (1 - M) / (1 + M) * h ^ 2); [| lra].
        apply Rmult_le_pos; [apply Rdiv_le_0_compat; lra | apply pow2_ge_0].
      * rewrite E in Hq. assert (0 <= h ^ 2 * sin h ^ 2) by (apply Rmult_le_pos; apply pow2_ge_0). lra.
  - intros (n & Hn & [(a & Ha & Hh2) | [E HM1]]).
    + left. apply Hx. now apply (sign_before n a).
    + assert (Es : sin h = 0) by (rewrite E; apply sin_multiple). right.
      rewrite Ex, Ev, Es, Ek, Hzero by exact Es. split; [field; lra |].
      replace (- ((1 - M) / (1 + M) * h ^ 2 + h ^ 2 * 0 ^ 2) / D h) with ((M - 1) * h ^ 2 / ((1 + M) * D h))
        by (field; lra).
      apply Rdiv_lt_0_compat; [apply Rmult_lt_0_compat; [lra | now apply pow_lt] | apply Rmult_lt_0_compat; lra].
Qed.
