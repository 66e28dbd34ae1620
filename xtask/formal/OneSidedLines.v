(** Certificate lines, proved from signs by the [interval] tactic. Written by generate_traps.py. *)

From Coq Require Import Reals Lra Lia.
From Interval Require Import Tactic.
From Hopper Require Import Analysis Model Energy FirstLanding Fates Traps Crises Signs.
Open Scope R_scope.

Ltac signs := unfold u, W_rate, W, square, A, Gam, D, mu; interval with (i_prec 90).

Notation lo_1 := (4493409457909064175207881 / 1000000000000000000000000).
Notation hi_1 := (4493409457909064175407881 / 1000000000000000000000000).
Notation top_1 := (544 / 100).

(** [alpha*_1] lies between two rational numbers. *)
Lemma star_1 : exists c, lo_1 < c < hi_1 /\ fixed_speed c.
Proof.
  apply fixed_point_between; [lra |].
  assert (H1 : 0 < - u lo_1) by signs. assert (H2 : - u hi_1 < 0) by signs. nra.
Qed.

Lemma rate_1 : forall t, lo_1 <= t <= top_1 -> 0 < W_rate t.
Proof. intros t Ht. unfold W_rate. interval with (i_prec 40, i_bisect t). Qed.

(** Line 1: n = 1, M = 1.0. *)
Notation M_1_1 := 1.
Notation right_1_1 := (5077052161193885 / 1125899906842624).
Notation r_1_1 := (4787564813827827246446592 / 1000000000000000000000000).

Lemma square_1_1 : hi_1 ^ 2 <= square M_1_1 r_1_1.
Proof. signs. Qed.

Lemma reach_1_1 : right_1_1 <= A r_1_1.
Proof. signs. Qed.

Theorem trap_1_1 : forall M, 0 < M -> exists c, lo_1 < c < hi_1 /\ fixed_speed c /\
  forall a, c <= a <= right_1_1 -> converges M a c.
Proof.
  intros M HM. destruct star_1 as (c & Hc & Hf). exists c. split; [exact Hc |]. split; [exact Hf |]. intros a Ha.
  pose proof square_1_1 as Hs. pose proof reach_1_1 as Hr.
  apply (trap_of_smaller_mu 1 M c r_1_1); [exact HM | lra | exact Hf | now apply mu_largest | | | lra].
  - intros t Ht. apply rate_1. lra.
  - apply Rle_trans with (2 := Hs). apply pow_incr. lra.
Qed.

Notation lo_2 := (7725251836937707164095069 / 1000000000000000000000000).
Notation hi_2 := (7725251836937707164295069 / 1000000000000000000000000).
Notation top_2 := (860 / 100).

(** [alpha*_2] lies between two rational numbers. *)
Lemma star_2 : exists c, lo_2 < c < hi_2 /\ fixed_speed c.
Proof.
  apply fixed_point_between; [lra |].
  assert (H1 : 0 < u lo_2) by signs. assert (H2 : u hi_2 < 0) by signs. nra.
Qed.

Lemma rate_2 : forall t, lo_2 <= t <= top_2 -> 0 < W_rate t.
Proof. intros t Ht. unfold W_rate. interval with (i_prec 40, i_bisect t). Qed.

(** Line 2: n = 2, M = 1.0. *)
Notation M_2_2 := 1.
Notation right_2_2 := (1087700207574317 / 140737488355328).
Notation r_2_2 := (7897348193553688625254243 / 1000000000000000000000000).

Lemma square_2_2 : hi_2 ^ 2 <= square M_2_2 r_2_2.
Proof. signs. Qed.

Lemma reach_2_2 : right_2_2 <= A r_2_2.
Proof. signs. Qed.

Theorem trap_2_2 : forall M, 0 < M -> exists c, lo_2 < c < hi_2 /\ fixed_speed c /\
  forall a, c <= a <= right_2_2 -> converges M a c.
Proof.
  intros M HM. destruct star_2 as (c & Hc & Hf). exists c. split; [exact Hc |]. split; [exact Hf |]. intros a Ha.
  pose proof square_2_2 as Hs. pose proof reach_2_2 as Hr.
  apply (trap_of_smaller_mu 1 M c r_2_2); [exact HM | lra | exact Hf | now apply mu_largest | | | lra].
  - intros t Ht. apply rate_2. lra.
  - apply Rle_trans with (2 := Hs). apply pow_incr. lra.
Qed.

Notation lo_3 := (10904121659428899827048703 / 1000000000000000000000000).
Notation hi_3 := (10904121659428899827248703 / 1000000000000000000000000).
Notation top_3 := (1174 / 100).

(** [alpha*_3] lies between two rational numbers. *)
Lemma star_3 : exists c, lo_3 < c < hi_3 /\ fixed_speed c.
Proof.
  apply fixed_point_between; [lra |].
  assert (H1 : 0 < - u lo_3) by signs. assert (H2 : - u hi_3 < 0) by signs. nra.
Qed.

Lemma rate_3 : forall t, lo_3 <= t <= top_3 -> 0 < W_rate t.
Proof. intros t Ht. unfold W_rate. interval with (i_prec 40, i_bisect t). Qed.

(** Line 3: n = 3, M = 1.0. *)
Notation M_3_3 := 1.
Notation right_3_3 := (6139150296631475 / 562949953421312).
Notation r_3_3 := (11026223447765434596961084 / 1000000000000000000000000).

Lemma square_3_3 : hi_3 ^ 2 <= square M_3_3 r_3_3.
Proof. signs. Qed.

Lemma reach_3_3 : right_3_3 <= A r_3_3.
Proof. signs. Qed.

Theorem trap_3_3 : forall M, 0 < M -> exists c, lo_3 < c < hi_3 /\ fixed_speed c /\
  forall a, c <= a <= right_3_3 -> converges M a c.
Proof.
  intros M HM. destruct star_3 as (c & Hc & Hf). exists c. split; [exact Hc |]. split; [exact Hf |]. intros a Ha.
  pose proof square_3_3 as Hs. pose proof reach_3_3 as Hr.
  apply (trap_of_smaller_mu 1 M c r_3_3); [exact HM | lra | exact Hf | now apply mu_largest | | | lra].
  - intros t Ht. apply rate_3. lra.
  - apply Rle_trans with (2 := Hs). apply pow_incr. lra.
Qed.

Notation lo_4 := (14066193912831473479878966 / 1000000000000000000000000).
Notation hi_4 := (14066193912831473480078966 / 1000000000000000000000000).
Notation top_4 := (1489 / 100).

(** [alpha*_4] lies between two rational numbers. *)
Lemma star_4 : exists c, lo_4 < c < hi_4 /\ fixed_speed c.
Proof.
  apply fixed_point_between; [lra |].
  assert (H1 : 0 < u lo_4) by signs. assert (H2 : u hi_4 < 0) by signs. nra.
Qed.

Lemma rate_4 : forall t, lo_4 <= t <= top_4 -> 0 < W_rate t.
Proof. intros t Ht. unfold W_rate. interval with (i_prec 40, i_bisect t). Qed.

(** Line 4: n = 4, M = 1.0. *)
Notation M_4_4 := 1.
Notation right_4_4 := (989859982210359 / 70368744177664).
Notation r_4_4 := (14160901947297752277456833 / 1000000000000000000000000).

Lemma square_4_4 : hi_4 ^ 2 <= square M_4_4 r_4_4.
Proof. signs. Qed.

Lemma reach_4_4 : right_4_4 <= A r_4_4.
Proof. signs. Qed.

Theorem trap_4_4 : forall M, 0 < M -> exists c, lo_4 < c < hi_4 /\ fixed_speed c /\
  forall a, c <= a <= right_4_4 -> converges M a c.
Proof.
  intros M HM. destruct star_4 as (c & Hc & Hf). exists c. split; [exact Hc |]. split; [exact Hf |]. intros a Ha.
  pose proof square_4_4 as Hs. pose proof reach_4_4 as Hr.
  apply (trap_of_smaller_mu 1 M c r_4_4); [exact HM | lra | exact Hf | now apply mu_largest | | | lra].
  - intros t Ht. apply rate_4. lra.
  - apply Rle_trans with (2 := Hs). apply pow_incr. lra.
Qed.

Notation lo_5 := (17220755271930768739473719 / 1000000000000000000000000).
Notation hi_5 := (17220755271930768739673719 / 1000000000000000000000000).
Notation top_5 := (1804 / 100).

(** [alpha*_5] lies between two rational numbers. *)
Lemma star_5 : exists c, lo_5 < c < hi_5 /\ fixed_speed c.
Proof.
  apply fixed_point_between; [lra |].
  assert (H1 : 0 < - u lo_5) by signs. assert (H2 : - u hi_5 < 0) by signs. nra.
Qed.

Lemma rate_5 : forall t, lo_5 <= t <= top_5 -> 0 < W_rate t.
Proof. intros t Ht. unfold W_rate. interval with (i_prec 40, i_bisect t). Qed.

(** Line 5: n = 5, M = 1.0. *)
Notation M_5_5 := 1.
Notation right_5_5 := (4847298241592649 / 281474976710656).
Notation r_5_5 := (17298136645769262926650878 / 1000000000000000000000000).

Lemma square_5_5 : hi_5 ^ 2 <= square M_5_5 r_5_5.
Proof. signs. Qed.

Lemma reach_5_5 : right_5_5 <= A r_5_5.
Proof. signs. Qed.

Theorem trap_5_5 : forall M, 0 < M -> exists c, lo_5 < c < hi_5 /\ fixed_speed c /\
  forall a, c <= a <= right_5_5 -> converges M a c.
Proof.
  intros M HM. destruct star_5 as (c & Hc & Hf). exists c. split; [exact Hc |]. split; [exact Hf |]. intros a Ha.
  pose proof square_5_5 as Hs. pose proof reach_5_5 as Hr.
  apply (trap_of_smaller_mu 1 M c r_5_5); [exact HM | lra | exact Hf | now apply mu_largest | | | lra].
  - intros t Ht. apply rate_5. lra.
  - apply Rle_trans with (2 := Hs). apply pow_incr. lra.
Qed.

Notation lo_6 := (20371302959287562844991004 / 1000000000000000000000000).
Notation hi_6 := (20371302959287562845191004 / 1000000000000000000000000).
Notation top_6 := (2118 / 100).

(** [alpha*_6] lies between two rational numbers. *)
Lemma star_6 : exists c, lo_6 < c < hi_6 /\ fixed_speed c.
Proof.
  apply fixed_point_between; [lra |].
  assert (H1 : 0 < u lo_6) by signs. assert (H2 : u hi_6 < 0) by signs. nra.
Qed.

Lemma rate_6 : forall t, lo_6 <= t <= top_6 -> 0 < W_rate t.
Proof. intros t Ht. unfold W_rate. interval with (i_prec 40, i_bisect t). Qed.

(** Line 6: n = 6, M = 1.0. *)
Notation M_6_6 := 1.
Notation right_6_6 := (5734064405055741 / 281474976710656).
Notation r_6_6 := (20436727596727086871392118 / 1000000000000000000000000).

Lemma square_6_6 : hi_6 ^ 2 <= square M_6_6 r_6_6.
Proof. signs. Qed.

Lemma reach_6_6 : right_6_6 <= A r_6_6.
Proof. signs. Qed.

Theorem trap_6_6 : forall M, 0 < M -> exists c, lo_6 < c < hi_6 /\ fixed_speed c /\
  forall a, c <= a <= right_6_6 -> converges M a c.
Proof.
  intros M HM. destruct star_6 as (c & Hc & Hf). exists c. split; [exact Hc |]. split; [exact Hf |]. intros a Ha.
  pose proof square_6_6 as Hs. pose proof reach_6_6 as Hr.
  apply (trap_of_smaller_mu 1 M c r_6_6); [exact HM | lra | exact Hf | now apply mu_largest | | | lra].
  - intros t Ht. apply rate_6. lra.
  - apply Rle_trans with (2 := Hs). apply pow_incr. lra.
Qed.

Notation lo_7 := (23519452498689006546351102 / 1000000000000000000000000).
Notation hi_7 := (23519452498689006546551102 / 1000000000000000000000000).
Notation top_7 := (2432 / 100).

(** [alpha*_7] lies between two rational numbers. *)
Lemma star_7 : exists c, lo_7 < c < hi_7 /\ fixed_speed c.
Proof.
  apply fixed_point_between; [lra |].
  assert (H1 : 0 < - u lo_7) by signs. assert (H2 : - u hi_7 < 0) by signs. nra.
Qed.

Lemma rate_7 : forall t, lo_7 <= t <= top_7 -> 0 < W_rate t.
Proof. intros t Ht. unfold W_rate. interval with (i_prec 40, i_bisect t). Qed.

(** Line 7: n = 7, M = 1.0. *)
Notation M_7_7 := 1.
Notation right_7_7 := (6620171417995775 / 281474976710656).
Notation r_7_7 := (23576125680457054505457884 / 1000000000000000000000000).

Lemma square_7_7 : hi_7 ^ 2 <= square M_7_7 r_7_7.
Proof. signs. Qed.

Lemma reach_7_7 : right_7_7 <= A r_7_7.
Proof. signs. Qed.

Theorem trap_7_7 : forall M, 0 < M -> exists c, lo_7 < c < hi_7 /\ fixed_speed c /\
  forall a, c <= a <= right_7_7 -> converges M a c.
Proof.
  intros M HM. destruct star_7 as (c & Hc & Hf). exists c. split; [exact Hc |]. split; [exact Hf |]. intros a Ha.
  pose proof square_7_7 as Hs. pose proof reach_7_7 as Hr.
  apply (trap_of_smaller_mu 1 M c r_7_7); [exact HM | lra | exact Hf | now apply mu_largest | | | lra].
  - intros t Ht. apply rate_7. lra.
  - apply Rle_trans with (2 := Hs). apply pow_incr. lra.
Qed.

Notation lo_8 := (26666054258812673528294144 / 1000000000000000000000000).
Notation hi_8 := (26666054258812673528494144 / 1000000000000000000000000).
Notation top_8 := (2746 / 100).

(** [alpha*_8] lies between two rational numbers. *)
Lemma star_8 : exists c, lo_8 < c < hi_8 /\ fixed_speed c.
Proof.
  apply fixed_point_between; [lra |].
  assert (H1 : 0 < u lo_8) by signs. assert (H2 : u hi_8 < 0) by signs. nra.
Qed.

Lemma rate_8 : forall t, lo_8 <= t <= top_8 -> 0 < W_rate t.
Proof. intros t Ht. unfold W_rate. interval with (i_prec 40, i_bisect t). Qed.

(** Line 8: n = 8, M = 1.0. *)
Notation M_8_8 := 1.
Notation right_8_8 := (3752925198938543 / 140737488355328).
Notation r_8_8 := (26716043416423879115679962 / 1000000000000000000000000).

Lemma square_8_8 : hi_8 ^ 2 <= square M_8_8 r_8_8.
Proof. signs. Qed.

Lemma reach_8_8 : right_8_8 <= A r_8_8.
Proof. signs. Qed.

Theorem trap_8_8 : forall M, 0 < M -> exists c, lo_8 < c < hi_8 /\ fixed_speed c /\
  forall a, c <= a <= right_8_8 -> converges M a c.
Proof.
  intros M HM. destruct star_8 as (c & Hc & Hf). exists c. split; [exact Hc |]. split; [exact Hf |]. intros a Ha.
  pose proof square_8_8 as Hs. pose proof reach_8_8 as Hr.
  apply (trap_of_smaller_mu 1 M c r_8_8); [exact HM | lra | exact Hf | now apply mu_largest | | | lra].
  - intros t Ht. apply rate_8. lra.
  - apply Rle_trans with (2 := Hs). apply pow_incr. lra.
Qed.
