(** Certificate lines, proved from signs by the [interval] tactic. Written by generate_crisis.py. *)

From Coq Require Import Reals Lra Lia.
From Interval Require Import Tactic.
From Hopper Require Import Analysis Model Energy FirstLanding Fates Traps Crises Signs.
Open Scope R_scope.

Ltac signs := unfold u, W_rate, W, square, A, Gam, D, mu; interval with (i_prec 90).

(** Line 1. *)
Notation low_1 := (1863729233521609 / 18014398509481984).
Notation high_1 := (7454916934086721 / 72057594037927936).
Notation speed_1 := (5871422191936203 / 1125899906842624).
Notation lo_1 := (4493409457909064175207881 / 1000000000000000000000000).
Notation hi_1 := (4493409457909064175407881 / 1000000000000000000000000).
Notation p1_1 := (544 / 100).
Notation p2_1 := (547 / 100).
Notation end_1 := (6293 / 1000).
Notation q1_1 := (5692882801385326269581256 / 1000000000000000000000000).
Notation q2_1 := (5692882801385326269781256 / 1000000000000000000000000).
Notation h1_1 := (5692882801385350142876249 / 1000000000000000000000000).
Notation h2_1 := (5692882801385350143076249 / 1000000000000000000000000).

(** [alpha*_1] lies between two rational numbers. *)
Lemma star_1 : exists c, lo_1 < c < hi_1 /\ fixed_speed c.
Proof.
  apply fixed_point_between; [lra |].
  assert (H1 : 0 < - u lo_1) by signs. assert (H2 : - u hi_1 < 0) by signs. nra.
Qed.

Lemma rising_1 : forall t, lo_1 <= t <= p1_1 -> 0 < W_rate t.
Proof. intros t Ht. unfold W_rate. interval with (i_prec 40, i_bisect t). Qed.

Lemma middle_1 : forall t, p1_1 <= t <= p2_1 -> 1 <= 4 * mu low_1 * W t.
Proof. intros t Ht. unfold mu, W. interval with (i_prec 40, i_bisect t). Qed.

Lemma order_1 : q2_1 < INR 2 * PI < end_1 /\ h2_1 < INR 2 * PI.
Proof. replace (INR 2) with 2 by (simpl; ring). split; [split |]; interval with (i_prec 40). Qed.

Lemma falling_1 : forall t, p2_1 <= t <= end_1 -> W_rate t < 0.
Proof. intros t Ht. unfold W_rate. interval with (i_prec 40, i_bisect t). Qed.

Lemma minimum_1 : 1 <= 4 * mu low_1 * W q1_1 /\ 4 * mu low_1 * W q2_1 <= 1 /\
  forall t, q1_1 <= t <= q2_1 -> hi_1 ^ 2 <= square low_1 t.
Proof. split; [| split; [| intros t Ht]]; signs. Qed.

Lemma fall_1 : A h1_1 < speed_1 < A h2_1 /\
  forall h, h1_1 <= h <= h2_1 -> 0 < W h /\ speed_1 ^ 2 - mu high_1 * Gam h ^ 2 < lo_1 ^ 2.
Proof. split; [split | intros h Hh; split]; signs. Qed.

(** There is one mass ratio M_c up to 1, and it lies between the two numbers: up to it the whole contact part converges to
    alpha*_1, and above it a speed falls below. At the upper number it is the speed of the line. *)
Theorem crisis_1 : exists c M0, lo_1 < c < hi_1 /\ fixed_speed c /\ low_1 <= M0 <= high_1 /\
  (forall M, 0 < M <= 1 ->
    (M <= M0 -> forall a, c <= a < INR 2 * PI -> converges M a c) /\
    (M0 < M -> exists a, c < a < INR 2 * PI /\ forall a', hop M a a' -> a' < c)) /\
  forall a', hop high_1 speed_1 a' -> a' < c.
Proof.
  destruct star_1 as (c & Hc & Hf). pose proof order_1 as He.
  destruct minimum_1 as (H1 & H2 & H3). destruct fall_1 as [Hs Hh].
  destruct (part_by_signs low_1 2 c p1_1 p2_1 q1_1 q2_1) as [Hpart Hsq]; try lra; try lia; try exact Hf.
  - intros t Ht. apply rising_1. lra.
  - apply middle_1.
  - intros t Ht. apply falling_1. lra.
  - intros t Ht. apply Rle_trans with (2 := H3 t Ht). apply pow_incr. lra.
  - destruct (half_time speed_1 ltac:(lra)) as (h & Hpos & Eh).
    assert (Hin : h1_1 <= h <= h2_1).
    { split; apply Rnot_lt_le; intro H; [pose proof (A_increases h h1_1) | pose proof (A_increases h2_1 h)]; lra. }
    destruct (Hh h Hin) as [_ Hfall]. rewrite <- Eh in Hfall.
    assert (Hlo : lo_1 ^ 2 <= c ^ 2) by (apply pow_incr; lra).
    destruct (one_crisis 2 c low_1 high_1 h) as (M0 & HM0 & Hall); try assumption; try lra; [unfold square; lra |].
    exists c, M0. repeat (split; [assumption |]). intros a' Hhop. apply Rlt_trans with lo_1; [| lra].
    apply (falls_below high_1 high_1 speed_1 h1_1 h2_1); try lra; assumption.
Qed.

(** Line 2. *)
Notation low_2 := (4647319404263047 / 72057594037927936).
Notation high_2 := (4647319404263233 / 72057594037927936).
Notation speed_2 := (588474046708359 / 70368744177664).
Notation lo_2 := (7725251836937707164095069 / 1000000000000000000000000).
Notation hi_2 := (7725251836937707164295069 / 1000000000000000000000000).
Notation p1_2 := (860 / 100).
Notation p2_2 := (863 / 100).
Notation end_2 := (9435 / 1000).
Notation q1_2 := (8835158976611141889754426 / 1000000000000000000000000).
Notation q2_2 := (8835158976611141889954426 / 1000000000000000000000000).
Notation h1_2 := (8835158976611167535315397 / 1000000000000000000000000).
Notation h2_2 := (8835158976611167535515397 / 1000000000000000000000000).

(** [alpha*_2] lies between two rational numbers. *)
Lemma star_2 : exists c, lo_2 < c < hi_2 /\ fixed_speed c.
Proof.
  apply fixed_point_between; [lra |].
  assert (H1 : 0 < u lo_2) by signs. assert (H2 : u hi_2 < 0) by signs. nra.
Qed.

Lemma rising_2 : forall t, lo_2 <= t <= p1_2 -> 0 < W_rate t.
Proof. intros t Ht. unfold W_rate. interval with (i_prec 40, i_bisect t). Qed.

Lemma middle_2 : forall t, p1_2 <= t <= p2_2 -> 1 <= 4 * mu low_2 * W t.
Proof. intros t Ht. unfold mu, W. interval with (i_prec 40, i_bisect t). Qed.

Lemma order_2 : q2_2 < INR 3 * PI < end_2 /\ h2_2 < INR 3 * PI.
Proof. replace (INR 3) with 3 by (simpl; ring). split; [split |]; interval with (i_prec 40). Qed.

Lemma falling_2 : forall t, p2_2 <= t <= end_2 -> W_rate t < 0.
Proof. intros t Ht. unfold W_rate. interval with (i_prec 40, i_bisect t). Qed.

Lemma minimum_2 : 1 <= 4 * mu low_2 * W q1_2 /\ 4 * mu low_2 * W q2_2 <= 1 /\
  forall t, q1_2 <= t <= q2_2 -> hi_2 ^ 2 <= square low_2 t.
Proof. split; [| split; [| intros t Ht]]; signs. Qed.

Lemma fall_2 : A h1_2 < speed_2 < A h2_2 /\
  forall h, h1_2 <= h <= h2_2 -> 0 < W h /\ speed_2 ^ 2 - mu high_2 * Gam h ^ 2 < lo_2 ^ 2.
Proof. split; [split | intros h Hh; split]; signs. Qed.

(** There is one mass ratio M_c up to 1, and it lies between the two numbers: up to it the whole contact part converges to
    alpha*_2, and above it a speed falls below. At the upper number it is the speed of the line. *)
Theorem crisis_2 : exists c M0, lo_2 < c < hi_2 /\ fixed_speed c /\ low_2 <= M0 <= high_2 /\
  (forall M, 0 < M <= 1 ->
    (M <= M0 -> forall a, c <= a < INR 3 * PI -> converges M a c) /\
    (M0 < M -> exists a, c < a < INR 3 * PI /\ forall a', hop M a a' -> a' < c)) /\
  forall a', hop high_2 speed_2 a' -> a' < c.
Proof.
  destruct star_2 as (c & Hc & Hf). pose proof order_2 as He.
  destruct minimum_2 as (H1 & H2 & H3). destruct fall_2 as [Hs Hh].
  destruct (part_by_signs low_2 3 c p1_2 p2_2 q1_2 q2_2) as [Hpart Hsq]; try lra; try lia; try exact Hf.
  - intros t Ht. apply rising_2. lra.
  - apply middle_2.
  - intros t Ht. apply falling_2. lra.
  - intros t Ht. apply Rle_trans with (2 := H3 t Ht). apply pow_incr. lra.
  - destruct (half_time speed_2 ltac:(lra)) as (h & Hpos & Eh).
    assert (Hin : h1_2 <= h <= h2_2).
    { split; apply Rnot_lt_le; intro H; [pose proof (A_increases h h1_2) | pose proof (A_increases h2_2 h)]; lra. }
    destruct (Hh h Hin) as [_ Hfall]. rewrite <- Eh in Hfall.
    assert (Hlo : lo_2 ^ 2 <= c ^ 2) by (apply pow_incr; lra).
    destruct (one_crisis 3 c low_2 high_2 h) as (M0 & HM0 & Hall); try assumption; try lra; [unfold square; lra |].
    exists c, M0. repeat (split; [assumption |]). intros a' Hhop. apply Rlt_trans with lo_2; [| lra].
    apply (falls_below high_2 high_2 speed_2 h1_2 h2_2); try lra; assumption.
Qed.

(** Line 3. *)
Notation low_3 := (6763535951675191 / 144115188075855872).
Notation high_3 := (6763535951675695 / 144115188075855872).
Notation speed_3 := (6478719865940047 / 562949953421312).
Notation lo_3 := (10904121659428899827048703 / 1000000000000000000000000).
Notation hi_3 := (10904121659428899827248703 / 1000000000000000000000000).
Notation p1_3 := (1174 / 100).
Notation p2_3 := (1177 / 100).
Notation end_3 := (12576 / 1000).
Notation q1_3 := (11977878128528599592473815 / 1000000000000000000000000).
Notation q2_3 := (11977878128528599592673815 / 1000000000000000000000000).
Notation h1_3 := (11977878128528660002967875 / 1000000000000000000000000).
Notation h2_3 := (11977878128528660003167875 / 1000000000000000000000000).

(** [alpha*_3] lies between two rational numbers. *)
Lemma star_3 : exists c, lo_3 < c < hi_3 /\ fixed_speed c.
Proof.
  apply fixed_point_between; [lra |].
  assert (H1 : 0 < - u lo_3) by signs. assert (H2 : - u hi_3 < 0) by signs. nra.
Qed.

Lemma rising_3 : forall t, lo_3 <= t <= p1_3 -> 0 < W_rate t.
Proof. intros t Ht. unfold W_rate. interval with (i_prec 40, i_bisect t). Qed.

Lemma middle_3 : forall t, p1_3 <= t <= p2_3 -> 1 <= 4 * mu low_3 * W t.
Proof. intros t Ht. unfold mu, W. interval with (i_prec 40, i_bisect t). Qed.

Lemma order_3 : q2_3 < INR 4 * PI < end_3 /\ h2_3 < INR 4 * PI.
Proof. replace (INR 4) with 4 by (simpl; ring). split; [split |]; interval with (i_prec 40). Qed.

Lemma falling_3 : forall t, p2_3 <= t <= end_3 -> W_rate t < 0.
Proof. intros t Ht. unfold W_rate. interval with (i_prec 40, i_bisect t). Qed.

Lemma minimum_3 : 1 <= 4 * mu low_3 * W q1_3 /\ 4 * mu low_3 * W q2_3 <= 1 /\
  forall t, q1_3 <= t <= q2_3 -> hi_3 ^ 2 <= square low_3 t.
Proof. split; [| split; [| intros t Ht]]; signs. Qed.

Lemma fall_3 : A h1_3 < speed_3 < A h2_3 /\
  forall h, h1_3 <= h <= h2_3 -> 0 < W h /\ speed_3 ^ 2 - mu high_3 * Gam h ^ 2 < lo_3 ^ 2.
Proof. split; [split | intros h Hh; split]; signs. Qed.

(** There is one mass ratio M_c up to 1, and it lies between the two numbers: up to it the whole contact part converges to
    alpha*_3, and above it a speed falls below. At the upper number it is the speed of the line. *)
Theorem crisis_3 : exists c M0, lo_3 < c < hi_3 /\ fixed_speed c /\ low_3 <= M0 <= high_3 /\
  (forall M, 0 < M <= 1 ->
    (M <= M0 -> forall a, c <= a < INR 4 * PI -> converges M a c) /\
    (M0 < M -> exists a, c < a < INR 4 * PI /\ forall a', hop M a a' -> a' < c)) /\
  forall a', hop high_3 speed_3 a' -> a' < c.
Proof.
  destruct star_3 as (c & Hc & Hf). pose proof order_3 as He.
  destruct minimum_3 as (H1 & H2 & H3). destruct fall_3 as [Hs Hh].
  destruct (part_by_signs low_3 4 c p1_3 p2_3 q1_3 q2_3) as [Hpart Hsq]; try lra; try lia; try exact Hf.
  - intros t Ht. apply rising_3. lra.
  - apply middle_3.
  - intros t Ht. apply falling_3. lra.
  - intros t Ht. apply Rle_trans with (2 := H3 t Ht). apply pow_incr. lra.
  - destruct (half_time speed_3 ltac:(lra)) as (h & Hpos & Eh).
    assert (Hin : h1_3 <= h <= h2_3).
    { split; apply Rnot_lt_le; intro H; [pose proof (A_increases h h1_3) | pose proof (A_increases h2_3 h)]; lra. }
    destruct (Hh h Hin) as [_ Hfall]. rewrite <- Eh in Hfall.
    assert (Hlo : lo_3 ^ 2 <= c ^ 2) by (apply pow_incr; lra).
    destruct (one_crisis 4 c low_3 high_3 h) as (M0 & HM0 & Hall); try assumption; try lra; [unfold square; lra |].
    exists c, M0. repeat (split; [assumption |]). intros a' Hhop. apply Rlt_trans with lo_3; [| lra].
    apply (falls_below high_3 high_3 speed_3 h1_3 h2_3); try lra; assumption.
Qed.

(** Line 4. *)
Notation low_4 := (2659075707455255 / 72057594037927936).
Notation high_4 := (332384463431933 / 9007199254740992).
Notation speed_4 := (4124410565980959 / 281474976710656).
Notation lo_4 := (14066193912831473479878966 / 1000000000000000000000000).
Notation hi_4 := (14066193912831473480078966 / 1000000000000000000000000).
Notation p1_4 := (1489 / 100).
Notation p2_4 := (1492 / 100).
Notation end_4 := (15718 / 1000).
Notation q1_4 := (15120314993930957126517319 / 1000000000000000000000000).
Notation q2_4 := (15120314993930957126717319 / 1000000000000000000000000).
Notation h1_4 := (15120314993931018040357181 / 1000000000000000000000000).
Notation h2_4 := (15120314993931018040557181 / 1000000000000000000000000).

(** [alpha*_4] lies between two rational numbers. *)
Lemma star_4 : exists c, lo_4 < c < hi_4 /\ fixed_speed c.
Proof.
  apply fixed_point_between; [lra |].
  assert (H1 : 0 < u lo_4) by signs. assert (H2 : u hi_4 < 0) by signs. nra.
Qed.

Lemma rising_4 : forall t, lo_4 <= t <= p1_4 -> 0 < W_rate t.
Proof. intros t Ht. unfold W_rate. interval with (i_prec 40, i_bisect t). Qed.

Lemma middle_4 : forall t, p1_4 <= t <= p2_4 -> 1 <= 4 * mu low_4 * W t.
Proof. intros t Ht. unfold mu, W. interval with (i_prec 40, i_bisect t). Qed.

Lemma order_4 : q2_4 < INR 5 * PI < end_4 /\ h2_4 < INR 5 * PI.
Proof. replace (INR 5) with 5 by (simpl; ring). split; [split |]; interval with (i_prec 40). Qed.

Lemma falling_4 : forall t, p2_4 <= t <= end_4 -> W_rate t < 0.
Proof. intros t Ht. unfold W_rate. interval with (i_prec 40, i_bisect t). Qed.

Lemma minimum_4 : 1 <= 4 * mu low_4 * W q1_4 /\ 4 * mu low_4 * W q2_4 <= 1 /\
  forall t, q1_4 <= t <= q2_4 -> hi_4 ^ 2 <= square low_4 t.
Proof. split; [| split; [| intros t Ht]]; signs. Qed.

Lemma fall_4 : A h1_4 < speed_4 < A h2_4 /\
  forall h, h1_4 <= h <= h2_4 -> 0 < W h /\ speed_4 ^ 2 - mu high_4 * Gam h ^ 2 < lo_4 ^ 2.
Proof. split; [split | intros h Hh; split]; signs. Qed.

(** There is one mass ratio M_c up to 1, and it lies between the two numbers: up to it the whole contact part converges to
    alpha*_4, and above it a speed falls below. At the upper number it is the speed of the line. *)
Theorem crisis_4 : exists c M0, lo_4 < c < hi_4 /\ fixed_speed c /\ low_4 <= M0 <= high_4 /\
  (forall M, 0 < M <= 1 ->
    (M <= M0 -> forall a, c <= a < INR 5 * PI -> converges M a c) /\
    (M0 < M -> exists a, c < a < INR 5 * PI /\ forall a', hop M a a' -> a' < c)) /\
  forall a', hop high_4 speed_4 a' -> a' < c.
Proof.
  destruct star_4 as (c & Hc & Hf). pose proof order_4 as He.
  destruct minimum_4 as (H1 & H2 & H3). destruct fall_4 as [Hs Hh].
  destruct (part_by_signs low_4 5 c p1_4 p2_4 q1_4 q2_4) as [Hpart Hsq]; try lra; try lia; try exact Hf.
  - intros t Ht. apply rising_4. lra.
  - apply middle_4.
  - intros t Ht. apply falling_4. lra.
  - intros t Ht. apply Rle_trans with (2 := H3 t Ht). apply pow_incr. lra.
  - destruct (half_time speed_4 ltac:(lra)) as (h & Hpos & Eh).
    assert (Hin : h1_4 <= h <= h2_4).
    { split; apply Rnot_lt_le; intro H; [pose proof (A_increases h h1_4) | pose proof (A_increases h2_4 h)]; lra. }
    destruct (Hh h Hin) as [_ Hfall]. rewrite <- Eh in Hfall.
    assert (Hlo : lo_4 ^ 2 <= c ^ 2) by (apply pow_incr; lra).
    destruct (one_crisis 5 c low_4 high_4 h) as (M0 & HM0 & Hall); try assumption; try lra; [unfold square; lra |].
    exists c, M0. repeat (split; [assumption |]). intros a' Hhop. apply Rlt_trans with lo_4; [| lra].
    apply (falls_below high_4 high_4 speed_4 h1_4 h2_4); try lra; assumption.
Qed.

(** Line 5. *)
Notation low_5 := (8764859361527115 / 288230376151711744).
Notation high_5 := (8764859361527723 / 288230376151711744).
Notation speed_5 := (2504611842680627 / 140737488355328).
Notation lo_5 := (17220755271930768739473719 / 1000000000000000000000000).
Notation hi_5 := (17220755271930768739673719 / 1000000000000000000000000).
Notation p1_5 := (1804 / 100).
Notation p2_5 := (1807 / 100).
Notation end_5 := (18860 / 1000).
Notation q1_5 := (18262527367472868564436858 / 1000000000000000000000000).
Notation q2_5 := (18262527367472868564636858 / 1000000000000000000000000).
Notation h1_5 := (18262527367472918316166910 / 1000000000000000000000000).
Notation h2_5 := (18262527367472918316366910 / 1000000000000000000000000).

(** [alpha*_5] lies between two rational numbers. *)
Lemma star_5 : exists c, lo_5 < c < hi_5 /\ fixed_speed c.
Proof.
  apply fixed_point_between; [lra |].
  assert (H1 : 0 < - u lo_5) by signs. assert (H2 : - u hi_5 < 0) by signs. nra.
Qed.

Lemma rising_5 : forall t, lo_5 <= t <= p1_5 -> 0 < W_rate t.
Proof. intros t Ht. unfold W_rate. interval with (i_prec 40, i_bisect t). Qed.

Lemma middle_5 : forall t, p1_5 <= t <= p2_5 -> 1 <= 4 * mu low_5 * W t.
Proof. intros t Ht. unfold mu, W. interval with (i_prec 40, i_bisect t). Qed.

Lemma order_5 : q2_5 < INR 6 * PI < end_5 /\ h2_5 < INR 6 * PI.
Proof. replace (INR 6) with 6 by (simpl; ring). split; [split |]; interval with (i_prec 40). Qed.

Lemma falling_5 : forall t, p2_5 <= t <= end_5 -> W_rate t < 0.
Proof. intros t Ht. unfold W_rate. interval with (i_prec 40, i_bisect t). Qed.

Lemma minimum_5 : 1 <= 4 * mu low_5 * W q1_5 /\ 4 * mu low_5 * W q2_5 <= 1 /\
  forall t, q1_5 <= t <= q2_5 -> hi_5 ^ 2 <= square low_5 t.
Proof. split; [| split; [| intros t Ht]]; signs. Qed.

Lemma fall_5 : A h1_5 < speed_5 < A h2_5 /\
  forall h, h1_5 <= h <= h2_5 -> 0 < W h /\ speed_5 ^ 2 - mu high_5 * Gam h ^ 2 < lo_5 ^ 2.
Proof. split; [split | intros h Hh; split]; signs. Qed.

(** There is one mass ratio M_c up to 1, and it lies between the two numbers: up to it the whole contact part converges to
    alpha*_5, and above it a speed falls below. At the upper number it is the speed of the line. *)
Theorem crisis_5 : exists c M0, lo_5 < c < hi_5 /\ fixed_speed c /\ low_5 <= M0 <= high_5 /\
  (forall M, 0 < M <= 1 ->
    (M <= M0 -> forall a, c <= a < INR 6 * PI -> converges M a c) /\
    (M0 < M -> exists a, c < a < INR 6 * PI /\ forall a', hop M a a' -> a' < c)) /\
  forall a', hop high_5 speed_5 a' -> a' < c.
Proof.
  destruct star_5 as (c & Hc & Hf). pose proof order_5 as He.
  destruct minimum_5 as (H1 & H2 & H3). destruct fall_5 as [Hs Hh].
  destruct (part_by_signs low_5 6 c p1_5 p2_5 q1_5 q2_5) as [Hpart Hsq]; try lra; try lia; try exact Hf.
  - intros t Ht. apply rising_5. lra.
  - apply middle_5.
  - intros t Ht. apply falling_5. lra.
  - intros t Ht. apply Rle_trans with (2 := H3 t Ht). apply pow_incr. lra.
  - destruct (half_time speed_5 ltac:(lra)) as (h & Hpos & Eh).
    assert (Hin : h1_5 <= h <= h2_5).
    { split; apply Rnot_lt_le; intro H; [pose proof (A_increases h h1_5) | pose proof (A_increases h2_5 h)]; lra. }
    destruct (Hh h Hin) as [_ Hfall]. rewrite <- Eh in Hfall.
    assert (Hlo : lo_5 ^ 2 <= c ^ 2) by (apply pow_incr; lra).
    destruct (one_crisis 6 c low_5 high_5 h) as (M0 & HM0 & Hall); try assumption; try lra; [unfold square; lra |].
    exists c, M0. repeat (split; [assumption |]). intros a' Hhop. apply Rlt_trans with lo_5; [| lra].
    apply (falls_below high_5 high_5 speed_5 h1_5 h2_5); try lra; assumption.
Qed.
