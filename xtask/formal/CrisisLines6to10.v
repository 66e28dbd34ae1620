(** Certificate lines, proved from signs by the [interval] tactic. Written by generate_crisis.py. *)

From Coq Require Import Reals Lra Lia.
From Interval Require Import Tactic.
From Hopper Require Import Analysis Model Energy FirstLanding Fates Traps Crises Signs.
Open Scope R_scope.

Ltac signs := unfold u, W_rate, W, square, A, Gam, D, mu; interval with (i_prec 90).

(** Line 6. *)
Notation low_6 := (1863487950314403 / 72057594037927936).
Notation high_6 := (3726975900629239 / 144115188075855872).
Notation speed_6 := (1473473113854361 / 70368744177664).
Notation lo_6 := (20371302959287562844991004 / 1000000000000000000000000).
Notation hi_6 := (20371302959287562845191004 / 1000000000000000000000000).
Notation p1_6 := (2118 / 100).
Notation p2_6 := (2121 / 100).
Notation end_6 := (22001 / 1000).
Notation q1_6 := (21404587116519619724075308 / 1000000000000000000000000).
Notation q2_6 := (21404587116519619724275308 / 1000000000000000000000000).
Notation h1_6 := (21404587116519710455890027 / 1000000000000000000000000).
Notation h2_6 := (21404587116519710456090027 / 1000000000000000000000000).

(** [alpha*_6] lies between two rational numbers. *)
Lemma star_6 : exists c, lo_6 < c < hi_6 /\ fixed_speed c.
Proof.
  apply fixed_point_between; [lra |].
  assert (H1 : 0 < u lo_6) by signs. assert (H2 : u hi_6 < 0) by signs. nra.
Qed.

Lemma rising_6 : forall t, lo_6 <= t <= p1_6 -> 0 < W_rate t.
Proof. intros t Ht. unfold W_rate. interval with (i_prec 40, i_bisect t). Qed.

Lemma middle_6 : forall t, p1_6 <= t <= p2_6 -> 1 <= 4 * mu low_6 * W t.
Proof. intros t Ht. unfold mu, W. interval with (i_prec 40, i_bisect t). Qed.

Lemma order_6 : q2_6 < INR 7 * PI < end_6 /\ h2_6 < INR 7 * PI.
Proof. replace (INR 7) with 7 by (simpl; ring). split; [split |]; interval with (i_prec 40). Qed.

Lemma falling_6 : forall t, p2_6 <= t <= end_6 -> W_rate t < 0.
Proof. intros t Ht. unfold W_rate. interval with (i_prec 40, i_bisect t). Qed.

Lemma minimum_6 : 1 <= 4 * mu low_6 * W q1_6 /\ 4 * mu low_6 * W q2_6 <= 1 /\
  forall t, q1_6 <= t <= q2_6 -> hi_6 ^ 2 <= square low_6 t.
Proof. split; [| split; [| intros t Ht]]; signs. Qed.

Lemma fall_6 : A h1_6 < speed_6 < A h2_6 /\
  forall h, h1_6 <= h <= h2_6 -> 0 < W h /\ speed_6 ^ 2 - mu high_6 * Gam h ^ 2 < lo_6 ^ 2.
Proof. split; [split | intros h Hh; split]; signs. Qed.

(** There is one mass ratio M_c up to 1, and it lies between the two numbers: up to it the whole contact part converges to
    alpha*_6, and above it a speed falls below. At the upper number it is the speed of the line. *)
Theorem crisis_6 : exists c M0, lo_6 < c < hi_6 /\ fixed_speed c /\ low_6 <= M0 <= high_6 /\
  (forall M, 0 < M <= 1 ->
    (M <= M0 -> forall a, c <= a < INR 7 * PI -> converges M a c) /\
    (M0 < M -> exists a, c < a < INR 7 * PI /\ forall a', hop M a a' -> a' < c)) /\
  forall a', hop high_6 speed_6 a' -> a' < c.
Proof.
  destruct star_6 as (c & Hc & Hf). pose proof order_6 as He.
  destruct minimum_6 as (H1 & H2 & H3). destruct fall_6 as [Hs Hh].
  destruct (part_by_signs low_6 7 c p1_6 p2_6 q1_6 q2_6) as [Hpart Hsq]; try lra; try lia; try exact Hf.
  - intros t Ht. apply rising_6. lra.
  - apply middle_6.
  - intros t Ht. apply falling_6. lra.
  - intros t Ht. apply Rle_trans with (2 := H3 t Ht). apply pow_incr. lra.
  - destruct (half_time speed_6 ltac:(lra)) as (h & Hpos & Eh).
    assert (Hin : h1_6 <= h <= h2_6).
    { split; apply Rnot_lt_le; intro H; [pose proof (A_increases h h1_6) | pose proof (A_increases h2_6 h)]; lra. }
    destruct (Hh h Hin) as [_ Hfall]. rewrite <- Eh in Hfall.
    assert (Hlo : lo_6 ^ 2 <= c ^ 2) by (apply pow_incr; lra).
    destruct (one_crisis 7 c low_6 high_6 h) as (M0 & HM0 & Hall); try assumption; try lra; [unfold square; lra |].
    exists c, M0. repeat (split; [assumption |]). intros a' Hhop. apply Rlt_trans with lo_6; [| lra].
    apply (falls_below high_6 high_6 speed_6 h1_6 h2_6); try lra; assumption.
Qed.

(** Line 7. *)
Notation low_7 := (6484387115358403 / 288230376151711744).
Notation high_7 := (810548389419891 / 36028797018963968).
Notation speed_7 := (6778467866688865 / 281474976710656).
Notation lo_7 := (23519452498689006546351102 / 1000000000000000000000000).
Notation hi_7 := (23519452498689006546551102 / 1000000000000000000000000).
Notation p1_7 := (2432 / 100).
Notation p2_7 := (2435 / 100).
Notation end_7 := (25143 / 1000).
Notation q1_7 := (24546542289410874049786540 / 1000000000000000000000000).
Notation q2_7 := (24546542289410874049986540 / 1000000000000000000000000).
Notation h1_7 := (24546542289410953175421055 / 1000000000000000000000000).
Notation h2_7 := (24546542289410953175621055 / 1000000000000000000000000).

(** [alpha*_7] lies between two rational numbers. *)
Lemma star_7 : exists c, lo_7 < c < hi_7 /\ fixed_speed c.
Proof.
  apply fixed_point_between; [lra |].
  assert (H1 : 0 < - u lo_7) by signs. assert (H2 : - u hi_7 < 0) by signs. nra.
Qed.

Lemma rising_7 : forall t, lo_7 <= t <= p1_7 -> 0 < W_rate t.
Proof. intros t Ht. unfold W_rate. interval with (i_prec 40, i_bisect t). Qed.

Lemma middle_7 : forall t, p1_7 <= t <= p2_7 -> 1 <= 4 * mu low_7 * W t.
Proof. intros t Ht. unfold mu, W. interval with (i_prec 40, i_bisect t). Qed.

Lemma order_7 : q2_7 < INR 8 * PI < end_7 /\ h2_7 < INR 8 * PI.
Proof. replace (INR 8) with 8 by (simpl; ring). split; [split |]; interval with (i_prec 40). Qed.

Lemma falling_7 : forall t, p2_7 <= t <= end_7 -> W_rate t < 0.
Proof. intros t Ht. unfold W_rate. interval with (i_prec 40, i_bisect t). Qed.

Lemma minimum_7 : 1 <= 4 * mu low_7 * W q1_7 /\ 4 * mu low_7 * W q2_7 <= 1 /\
  forall t, q1_7 <= t <= q2_7 -> hi_7 ^ 2 <= square low_7 t.
Proof. split; [| split; [| intros t Ht]]; signs. Qed.

Lemma fall_7 : A h1_7 < speed_7 < A h2_7 /\
  forall h, h1_7 <= h <= h2_7 -> 0 < W h /\ speed_7 ^ 2 - mu high_7 * Gam h ^ 2 < lo_7 ^ 2.
Proof. split; [split | intros h Hh; split]; signs. Qed.

(** There is one mass ratio M_c up to 1, and it lies between the two numbers: up to it the whole contact part converges to
    alpha*_7, and above it a speed falls below. At the upper number it is the speed of the line. *)
Theorem crisis_7 : exists c M0, lo_7 < c < hi_7 /\ fixed_speed c /\ low_7 <= M0 <= high_7 /\
  (forall M, 0 < M <= 1 ->
    (M <= M0 -> forall a, c <= a < INR 8 * PI -> converges M a c) /\
    (M0 < M -> exists a, c < a < INR 8 * PI /\ forall a', hop M a a' -> a' < c)) /\
  forall a', hop high_7 speed_7 a' -> a' < c.
Proof.
  destruct star_7 as (c & Hc & Hf). pose proof order_7 as He.
  destruct minimum_7 as (H1 & H2 & H3). destruct fall_7 as [Hs Hh].
  destruct (part_by_signs low_7 8 c p1_7 p2_7 q1_7 q2_7) as [Hpart Hsq]; try lra; try lia; try exact Hf.
  - intros t Ht. apply rising_7. lra.
  - apply middle_7.
  - intros t Ht. apply falling_7. lra.
  - intros t Ht. apply Rle_trans with (2 := H3 t Ht). apply pow_incr. lra.
  - destruct (half_time speed_7 ltac:(lra)) as (h & Hpos & Eh).
    assert (Hin : h1_7 <= h <= h2_7).
    { split; apply Rnot_lt_le; intro H; [pose proof (A_increases h h1_7) | pose proof (A_increases h2_7 h)]; lra. }
    destruct (Hh h Hin) as [_ Hfall]. rewrite <- Eh in Hfall.
    assert (Hlo : lo_7 ^ 2 <= c ^ 2) by (apply pow_incr; lra).
    destruct (one_crisis 8 c low_7 high_7 h) as (M0 & HM0 & Hall); try assumption; try lra; [unfold square; lra |].
    exists c, M0. repeat (split; [assumption |]). intros a' Hhop. apply Rlt_trans with lo_7; [| lra].
    apply (falls_below high_7 high_7 speed_7 h1_7 h2_7); try lra; assumption.
Qed.

(** Line 8. *)
Notation low_8 := (5738137005300629 / 288230376151711744).
Notation high_8 := (1434534251325327 / 72057594037927936).
Notation speed_8 := (478936230099273 / 17592186044416).
Notation lo_8 := (26666054258812673528294144 / 1000000000000000000000000).
Notation hi_8 := (26666054258812673528494144 / 1000000000000000000000000).
Notation p1_8 := (2746 / 100).
Notation p2_8 := (2749 / 100).
Notation end_8 := (28284 / 1000).
Notation q1_8 := (27688423659278365251519703 / 1000000000000000000000000).
Notation q2_8 := (27688423659278365251719703 / 1000000000000000000000000).
Notation h1_8 := (27688423659278442888029363 / 1000000000000000000000000).
Notation h2_8 := (27688423659278442888229363 / 1000000000000000000000000).

(** [alpha*_8] lies between two rational numbers. *)
Lemma star_8 : exists c, lo_8 < c < hi_8 /\ fixed_speed c.
Proof.
  apply fixed_point_between; [lra |].
  assert (H1 : 0 < u lo_8) by signs. assert (H2 : u hi_8 < 0) by signs. nra.
Qed.

Lemma rising_8 : forall t, lo_8 <= t <= p1_8 -> 0 < W_rate t.
Proof. intros t Ht. unfold W_rate. interval with (i_prec 40, i_bisect t). Qed.

Lemma middle_8 : forall t, p1_8 <= t <= p2_8 -> 1 <= 4 * mu low_8 * W t.
Proof. intros t Ht. unfold mu, W. interval with (i_prec 40, i_bisect t). Qed.

Lemma order_8 : q2_8 < INR 9 * PI < end_8 /\ h2_8 < INR 9 * PI.
Proof. replace (INR 9) with 9 by (simpl; ring). split; [split |]; interval with (i_prec 40). Qed.

Lemma falling_8 : forall t, p2_8 <= t <= end_8 -> W_rate t < 0.
Proof. intros t Ht. unfold W_rate. interval with (i_prec 40, i_bisect t). Qed.

Lemma minimum_8 : 1 <= 4 * mu low_8 * W q1_8 /\ 4 * mu low_8 * W q2_8 <= 1 /\
  forall t, q1_8 <= t <= q2_8 -> hi_8 ^ 2 <= square low_8 t.
Proof. split; [| split; [| intros t Ht]]; signs. Qed.

Lemma fall_8 : A h1_8 < speed_8 < A h2_8 /\
  forall h, h1_8 <= h <= h2_8 -> 0 < W h /\ speed_8 ^ 2 - mu high_8 * Gam h ^ 2 < lo_8 ^ 2.
Proof. split; [split | intros h Hh; split]; signs. Qed.

(** There is one mass ratio M_c up to 1, and it lies between the two numbers: up to it the whole contact part converges to
    alpha*_8, and above it a speed falls below. At the upper number it is the speed of the line. *)
Theorem crisis_8 : exists c M0, lo_8 < c < hi_8 /\ fixed_speed c /\ low_8 <= M0 <= high_8 /\
  (forall M, 0 < M <= 1 ->
    (M <= M0 -> forall a, c <= a < INR 9 * PI -> converges M a c) /\
    (M0 < M -> exists a, c < a < INR 9 * PI /\ forall a', hop M a a' -> a' < c)) /\
  forall a', hop high_8 speed_8 a' -> a' < c.
Proof.
  destruct star_8 as (c & Hc & Hf). pose proof order_8 as He.
  destruct minimum_8 as (H1 & H2 & H3). destruct fall_8 as [Hs Hh].
  destruct (part_by_signs low_8 9 c p1_8 p2_8 q1_8 q2_8) as [Hpart Hsq]; try lra; try lia; try exact Hf.
  - intros t Ht. apply rising_8. lra.
  - apply middle_8.
  - intros t Ht. apply falling_8. lra.
  - intros t Ht. apply Rle_trans with (2 := H3 t Ht). apply pow_incr. lra.
  - destruct (half_time speed_8 ltac:(lra)) as (h & Hpos & Eh).
    assert (Hin : h1_8 <= h <= h2_8).
    { split; apply Rnot_lt_le; intro H; [pose proof (A_increases h h1_8) | pose proof (A_increases h2_8 h)]; lra. }
    destruct (Hh h Hin) as [_ Hfall]. rewrite <- Eh in Hfall.
    assert (Hlo : lo_8 ^ 2 <= c ^ 2) by (apply pow_incr; lra).
    destruct (one_crisis 9 c low_8 high_8 h) as (M0 & HM0 & Hall); try assumption; try lra; [unfold square; lra |].
    exists c, M0. repeat (split; [assumption |]). intros a' Hhop. apply Rlt_trans with lo_8; [| lra].
    apply (falls_below high_8 high_8 speed_8 h1_8 h2_8); try lra; assumption.
Qed.

(** Line 9. *)
Notation low_9 := (643248351427253 / 36028797018963968).
Notation high_9 := (1286496702854653 / 72057594037927936).
Notation speed_9 := (4273723158623265 / 140737488355328).
Notation lo_9 := (29811598790892958836710588 / 1000000000000000000000000).
Notation hi_9 := (29811598790892958836910588 / 1000000000000000000000000).
Notation p1_9 := (3061 / 100).
Notation p2_9 := (3064 / 100).
Notation end_9 := (31426 / 1000).
Notation q1_9 := (30830251327163386598442818 / 1000000000000000000000000).
Notation q2_9 := (30830251327163386598642818 / 1000000000000000000000000).
Notation h1_9 := (30830251327163466469154070 / 1000000000000000000000000).
Notation h2_9 := (30830251327163466469354070 / 1000000000000000000000000).

(** [alpha*_9] lies between two rational numbers. *)
Lemma star_9 : exists c, lo_9 < c < hi_9 /\ fixed_speed c.
Proof.
  apply fixed_point_between; [lra |].
  assert (H1 : 0 < - u lo_9) by signs. assert (H2 : - u hi_9 < 0) by signs. nra.
Qed.

Lemma rising_9 : forall t, lo_9 <= t <= p1_9 -> 0 < W_rate t.
Proof. intros t Ht. unfold W_rate. interval with (i_prec 40, i_bisect t). Qed.

Lemma middle_9 : forall t, p1_9 <= t <= p2_9 -> 1 <= 4 * mu low_9 * W t.
Proof. intros t Ht. unfold mu, W. interval with (i_prec 40, i_bisect t). Qed.

Lemma order_9 : q2_9 < INR 10 * PI < end_9 /\ h2_9 < INR 10 * PI.
Proof. replace (INR 10) with 10 by (simpl; ring). split; [split |]; interval with (i_prec 40). Qed.

Lemma falling_9 : forall t, p2_9 <= t <= end_9 -> W_rate t < 0.
Proof. intros t Ht. unfold W_rate. interval with (i_prec 40, i_bisect t). Qed.

Lemma minimum_9 : 1 <= 4 * mu low_9 * W q1_9 /\ 4 * mu low_9 * W q2_9 <= 1 /\
  forall t, q1_9 <= t <= q2_9 -> hi_9 ^ 2 <= square low_9 t.
Proof. split; [| split; [| intros t Ht]]; signs. Qed.

Lemma fall_9 : A h1_9 < speed_9 < A h2_9 /\
  forall h, h1_9 <= h <= h2_9 -> 0 < W h /\ speed_9 ^ 2 - mu high_9 * Gam h ^ 2 < lo_9 ^ 2.
Proof. split; [split | intros h Hh; split]; signs. Qed.

(** There is one mass ratio M_c up to 1, and it lies between the two numbers: up to it the whole contact part converges to
    alpha*_9, and above it a speed falls below. At the upper number it is the speed of the line. *)
Theorem crisis_9 : exists c M0, lo_9 < c < hi_9 /\ fixed_speed c /\ low_9 <= M0 <= high_9 /\
  (forall M, 0 < M <= 1 ->
    (M <= M0 -> forall a, c <= a < INR 10 * PI -> converges M a c) /\
    (M0 < M -> exists a, c < a < INR 10 * PI /\ forall a', hop M a a' -> a' < c)) /\
  forall a', hop high_9 speed_9 a' -> a' < c.
Proof.
  destruct star_9 as (c & Hc & Hf). pose proof order_9 as He.
  destruct minimum_9 as (H1 & H2 & H3). destruct fall_9 as [Hs Hh].
  destruct (part_by_signs low_9 10 c p1_9 p2_9 q1_9 q2_9) as [Hpart Hsq]; try lra; try lia; try exact Hf.
  - intros t Ht. apply rising_9. lra.
  - apply middle_9.
  - intros t Ht. apply falling_9. lra.
  - intros t Ht. apply Rle_trans with (2 := H3 t Ht). apply pow_incr. lra.
  - destruct (half_time speed_9 ltac:(lra)) as (h & Hpos & Eh).
    assert (Hin : h1_9 <= h <= h2_9).
    { split; apply Rnot_lt_le; intro H; [pose proof (A_increases h h1_9) | pose proof (A_increases h2_9 h)]; lra. }
    destruct (Hh h Hin) as [_ Hfall]. rewrite <- Eh in Hfall.
    assert (Hlo : lo_9 ^ 2 <= c ^ 2) by (apply pow_incr; lra).
    destruct (one_crisis 10 c low_9 high_9 h) as (M0 & HM0 & Hall); try assumption; try lra; [unfold square; lra |].
    exists c, M0. repeat (split; [assumption |]). intros a' Hhop. apply Rlt_trans with lo_9; [| lra].
    apply (falls_below high_9 high_9 speed_9 h1_9 h2_9); try lra; assumption.
Qed.

(** Line 10. *)
Notation low_10 := (4664656295852347 / 288230376151711744).
Notation high_10 := (1166164073963235 / 72057594037927936).
Notation speed_10 := (1178984967776081 / 35184372088832).
Notation lo_10 := (32956389039822476725199056 / 1000000000000000000000000).
Notation hi_10 := (32956389039822476725399056 / 1000000000000000000000000).
Notation p1_10 := (3375 / 100).
Notation p2_10 := (3378 / 100).
Notation end_10 := (34568 / 1000).
Notation q1_10 := (33972038828958401935681900 / 1000000000000000000000000).
Notation q2_10 := (33972038828958401935881900 / 1000000000000000000000000).
Notation h1_10 := (33972038828958503043255383 / 1000000000000000000000000).
Notation h2_10 := (33972038828958503043455383 / 1000000000000000000000000).

(** [alpha*_10] lies between two rational numbers. *)
Lemma star_10 : exists c, lo_10 < c < hi_10 /\ fixed_speed c.
Proof.
  apply fixed_point_between; [lra |].
  assert (H1 : 0 < u lo_10) by signs. assert (H2 : u hi_10 < 0) by signs. nra.
Qed.

Lemma rising_10 : forall t, lo_10 <= t <= p1_10 -> 0 < W_rate t.
Proof. intros t Ht. unfold W_rate. interval with (i_prec 40, i_bisect t). Qed.

Lemma middle_10 : forall t, p1_10 <= t <= p2_10 -> 1 <= 4 * mu low_10 * W t.
Proof. intros t Ht. unfold mu, W. interval with (i_prec 40, i_bisect t). Qed.

Lemma order_10 : q2_10 < INR 11 * PI < end_10 /\ h2_10 < INR 11 * PI.
Proof. replace (INR 11) with 11 by (simpl; ring). split; [split |]; interval with (i_prec 40). Qed.

Lemma falling_10 : forall t, p2_10 <= t <= end_10 -> W_rate t < 0.
Proof. intros t Ht. unfold W_rate. interval with (i_prec 40, i_bisect t). Qed.

Lemma minimum_10 : 1 <= 4 * mu low_10 * W q1_10 /\ 4 * mu low_10 * W q2_10 <= 1 /\
  forall t, q1_10 <= t <= q2_10 -> hi_10 ^ 2 <= square low_10 t.
Proof. split; [| split; [| intros t Ht]]; signs. Qed.

Lemma fall_10 : A h1_10 < speed_10 < A h2_10 /\
  forall h, h1_10 <= h <= h2_10 -> 0 < W h /\ speed_10 ^ 2 - mu high_10 * Gam h ^ 2 < lo_10 ^ 2.
Proof. split; [split | intros h Hh; split]; signs. Qed.

(** There is one mass ratio M_c up to 1, and it lies between the two numbers: up to it the whole contact part converges to
    alpha*_10, and above it a speed falls below. At the upper number it is the speed of the line. *)
Theorem crisis_10 : exists c M0, lo_10 < c < hi_10 /\ fixed_speed c /\ low_10 <= M0 <= high_10 /\
  (forall M, 0 < M <= 1 ->
    (M <= M0 -> forall a, c <= a < INR 11 * PI -> converges M a c) /\
    (M0 < M -> exists a, c < a < INR 11 * PI /\ forall a', hop M a a' -> a' < c)) /\
  forall a', hop high_10 speed_10 a' -> a' < c.
Proof.
  destruct star_10 as (c & Hc & Hf). pose proof order_10 as He.
  destruct minimum_10 as (H1 & H2 & H3). destruct fall_10 as [Hs Hh].
  destruct (part_by_signs low_10 11 c p1_10 p2_10 q1_10 q2_10) as [Hpart Hsq]; try lra; try lia; try exact Hf.
  - intros t Ht. apply rising_10. lra.
  - apply middle_10.
  - intros t Ht. apply falling_10. lra.
  - intros t Ht. apply Rle_trans with (2 := H3 t Ht). apply pow_incr. lra.
  - destruct (half_time speed_10 ltac:(lra)) as (h & Hpos & Eh).
    assert (Hin : h1_10 <= h <= h2_10).
    { split; apply Rnot_lt_le; intro H; [pose proof (A_increases h h1_10) | pose proof (A_increases h2_10 h)]; lra. }
    destruct (Hh h Hin) as [_ Hfall]. rewrite <- Eh in Hfall.
    assert (Hlo : lo_10 ^ 2 <= c ^ 2) by (apply pow_incr; lra).
    destruct (one_crisis 11 c low_10 high_10 h) as (M0 & HM0 & Hall); try assumption; try lra; [unfold square; lra |].
    exists c, M0. repeat (split; [assumption |]). intros a' Hhop. apply Rlt_trans with lo_10; [| lra].
    apply (falls_below high_10 high_10 speed_10 h1_10 h2_10); try lra; assumption.
Qed.
