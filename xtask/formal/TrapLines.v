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

(** Line 100: n = 1, M = 0.19311197980252442. *)
Notation M_1_100 := (3478796161117711 / 18014398509481984).
Notation right_1_100 := (2581933268394573 / 562949953421312).
Notation r_1_100 := (5043154760183132066088000 / 1000000000000000000000000).
Notation beyond_1_100 := (2581933268394581 / 562949953421312).
Notation h1_1_100 := (5043154760183162536648534 / 1000000000000000000000000).
Notation h2_1_100 := (5043154760183162536848534 / 1000000000000000000000000).

Lemma square_1_100 : hi_1 ^ 2 <= square M_1_100 r_1_100.
Proof. signs. Qed.

Lemma reach_1_100 : right_1_100 <= A r_1_100.
Proof. signs. Qed.

Theorem trap_1_100 : exists c, lo_1 < c < hi_1 /\ fixed_speed c /\
  forall a, c <= a <= right_1_100 -> converges M_1_100 a c.
Proof.
  destruct star_1 as (c & Hc & Hf). exists c. split; [exact Hc |]. split; [exact Hf |]. intros a Ha.
  pose proof square_1_100 as Hs. pose proof reach_1_100 as Hr.
  apply (trap M_1_100 c r_1_100); [lra | lra | exact Hf | | | lra].
  - intros t Ht. apply rate_1. lra.
  - apply Rle_trans with (2 := Hs). apply pow_incr. lra.
Qed.

Lemma past_end_1_100 : A h1_1_100 < beyond_1_100 < A h2_1_100 /\
  forall h, h1_1_100 <= h <= h2_1_100 -> 0 < W h /\ beyond_1_100 ^ 2 - mu M_1_100 * Gam h ^ 2 < lo_1 ^ 2.
Proof. split; [split | intros h Hh; split]; signs. Qed.

Theorem falls_1_100 : forall a', hop M_1_100 beyond_1_100 a' -> a' < lo_1.
Proof. apply (falls_below M_1_100 M_1_100 beyond_1_100 h1_1_100 h2_1_100); try apply past_end_1_100; lra. Qed.

(** Line 200: n = 1, M = 0.2827662042689106. *)
Notation M_1_200 := (5093863088713741 / 18014398509481984).
Notation right_1_200 := (319454516857077 / 70368744177664).
Notation r_1_200 := (4921408708091125151302112 / 1000000000000000000000000).
Notation beyond_1_200 := (2555636134856621 / 562949953421312).
Notation h1_1_200 := (4921408708091154321458677 / 1000000000000000000000000).
Notation h2_1_200 := (4921408708091154321658677 / 1000000000000000000000000).

Lemma square_1_200 : hi_1 ^ 2 <= square M_1_200 r_1_200.
Proof. signs. Qed.

Lemma reach_1_200 : right_1_200 <= A r_1_200.
Proof. signs. Qed.

Theorem trap_1_200 : exists c, lo_1 < c < hi_1 /\ fixed_speed c /\
  forall a, c <= a <= right_1_200 -> converges M_1_200 a c.
Proof.
  destruct star_1 as (c & Hc & Hf). exists c. split; [exact Hc |]. split; [exact Hf |]. intros a Ha.
  pose proof square_1_200 as Hs. pose proof reach_1_200 as Hr.
  apply (trap M_1_200 c r_1_200); [lra | lra | exact Hf | | | lra].
  - intros t Ht. apply rate_1. lra.
  - apply Rle_trans with (2 := Hs). apply pow_incr. lra.
Qed.

Lemma past_end_1_200 : A h1_1_200 < beyond_1_200 < A h2_1_200 /\
  forall h, h1_1_200 <= h <= h2_1_200 -> 0 < W h /\ beyond_1_200 ^ 2 - mu M_1_200 * Gam h ^ 2 < lo_1 ^ 2.
Proof. split; [split | intros h Hh; split]; signs. Qed.

Theorem falls_1_200 : forall a', hop M_1_200 beyond_1_200 a' -> a' < lo_1.
Proof. apply (falls_below M_1_200 M_1_200 beyond_1_200 h1_1_200 h2_1_200); try apply past_end_1_200; lra. Qed.

(** Line 300: n = 1, M = 0.37242042873529674. *)
Notation M_1_300 := (6708930016309771 / 18014398509481984).
Notation right_1_300 := (2546999863367141 / 562949953421312).
Notation r_1_300 := (4864643841648139846372555 / 1000000000000000000000000).
Notation beyond_1_300 := (5093999726734289 / 1125899906842624).
Notation h1_1_300 := (4864643841648166078178673 / 1000000000000000000000000).
Notation h2_1_300 := (4864643841648166078378673 / 1000000000000000000000000).

Lemma square_1_300 : hi_1 ^ 2 <= square M_1_300 r_1_300.
Proof. signs. Qed.

Lemma reach_1_300 : right_1_300 <= A r_1_300.
Proof. signs. Qed.

Theorem trap_1_300 : exists c, lo_1 < c < hi_1 /\ fixed_speed c /\
  forall a, c <= a <= right_1_300 -> converges M_1_300 a c.
Proof.
  destruct star_1 as (c & Hc & Hf). exists c. split; [exact Hc |]. split; [exact Hf |]. intros a Ha.
  pose proof square_1_300 as Hs. pose proof reach_1_300 as Hr.
  apply (trap M_1_300 c r_1_300); [lra | lra | exact Hf | | | lra].
  - intros t Ht. apply rate_1. lra.
  - apply Rle_trans with (2 := Hs). apply pow_incr. lra.
Qed.

Lemma past_end_1_300 : A h1_1_300 < beyond_1_300 < A h2_1_300 /\
  forall h, h1_1_300 <= h <= h2_1_300 -> 0 < W h /\ beyond_1_300 ^ 2 - mu M_1_300 * Gam h ^ 2 < lo_1 ^ 2.
Proof. split; [split | intros h Hh; split]; signs. Qed.

Theorem falls_1_300 : forall a', hop M_1_300 beyond_1_300 a' -> a' < lo_1.
Proof. apply (falls_below M_1_300 M_1_300 beyond_1_300 h1_1_300 h2_1_300); try apply past_end_1_300; lra. Qed.

(** Line 400: n = 1, M = 0.46207465320168295. *)
Notation M_1_400 := (4161998471952901 / 9007199254740992).
Notation right_1_400 := (635773708846879 / 140737488355328).
Notation r_1_400 := (4833025621258596576698458 / 1000000000000000000000000).
Notation beyond_1_400 := (2543094835387519 / 562949953421312).
Notation h1_1_400 := (4833025621258622943578494 / 1000000000000000000000000).
Notation h2_1_400 := (4833025621258622943778494 / 1000000000000000000000000).

Lemma square_1_400 : hi_1 ^ 2 <= square M_1_400 r_1_400.
Proof. signs. Qed.

Lemma reach_1_400 : right_1_400 <= A r_1_400.
Proof. signs. Qed.

Theorem trap_1_400 : exists c, lo_1 < c < hi_1 /\ fixed_speed c /\
  forall a, c <= a <= right_1_400 -> converges M_1_400 a c.
Proof.
  destruct star_1 as (c & Hc & Hf). exists c. split; [exact Hc |]. split; [exact Hf |]. intros a Ha.
  pose proof square_1_400 as Hs. pose proof reach_1_400 as Hr.
  apply (trap M_1_400 c r_1_400); [lra | lra | exact Hf | | | lra].
  - intros t Ht. apply rate_1. lra.
  - apply Rle_trans with (2 := Hs). apply pow_incr. lra.
Qed.

Lemma past_end_1_400 : A h1_1_400 < beyond_1_400 < A h2_1_400 /\
  forall h, h1_1_400 <= h <= h2_1_400 -> 0 < W h /\ beyond_1_400 ^ 2 - mu M_1_400 * Gam h ^ 2 < lo_1 ^ 2.
Proof. split; [split | intros h Hh; split]; signs. Qed.

Theorem falls_1_400 : forall a', hop M_1_400 beyond_1_400 a' -> a' < lo_1.
Proof. apply (falls_below M_1_400 M_1_400 beyond_1_400 h1_1_400 h2_1_400); try apply past_end_1_400; lra. Qed.

(** Line 500: n = 1, M = 0.5517288776680691. *)
Notation M_1_500 := (1242382983937729 / 2251799813685248).
Notation right_1_500 := (5082066037127307 / 1125899906842624).
Notation r_1_500 := (4813952759577507041205720 / 1000000000000000000000000).
Notation beyond_1_500 := (5082066037127313 / 1125899906842624).
Notation h1_1_500 := (4813952759577536309161366 / 1000000000000000000000000).
Notation h2_1_500 := (4813952759577536309361366 / 1000000000000000000000000).

Lemma square_1_500 : hi_1 ^ 2 <= square M_1_500 r_1_500.
Proof. signs. Qed.

Lemma reach_1_500 : right_1_500 <= A r_1_500.
Proof. signs. Qed.

Theorem trap_1_500 : exists c, lo_1 < c < hi_1 /\ fixed_speed c /\
  forall a, c <= a <= right_1_500 -> converges M_1_500 a c.
Proof.
  destruct star_1 as (c & Hc & Hf). exists c. split; [exact Hc |]. split; [exact Hf |]. intros a Ha.
  pose proof square_1_500 as Hs. pose proof reach_1_500 as Hr.
  apply (trap M_1_500 c r_1_500); [lra | lra | exact Hf | | | lra].
  - intros t Ht. apply rate_1. lra.
  - apply Rle_trans with (2 := Hs). apply pow_incr. lra.
Qed.

Lemma past_end_1_500 : A h1_1_500 < beyond_1_500 < A h2_1_500 /\
  forall h, h1_1_500 <= h <= h2_1_500 -> 0 < W h /\ beyond_1_500 ^ 2 - mu M_1_500 * Gam h ^ 2 < lo_1 ^ 2.
Proof. split; [split | intros h Hh; split]; signs. Qed.

Theorem falls_1_500 : forall a', hop M_1_500 beyond_1_500 a' -> a' < lo_1.
Proof. apply (falls_below M_1_500 M_1_500 beyond_1_500 h1_1_500 h2_1_500); try apply past_end_1_500; lra. Qed.

(** Line 600: n = 1, M = 0.6413831021344553. *)
Notation M_1_600 := (5777065399548931 / 9007199254740992).
Notation right_1_600 := (5079712507325521 / 1125899906842624).
Notation r_1_600 := (4802076960328284633364196 / 1000000000000000000000000).
Notation beyond_1_600 := (5079712507325533 / 1125899906842624).
Notation h1_1_600 := (4802076960328347323729917 / 1000000000000000000000000).
Notation h2_1_600 := (4802076960328347323929917 / 1000000000000000000000000).

Lemma square_1_600 : hi_1 ^ 2 <= square M_1_600 r_1_600.
Proof. signs. Qed.

Lemma reach_1_600 : right_1_600 <= A r_1_600.
Proof. signs. Qed.

Theorem trap_1_600 : exists c, lo_1 < c < hi_1 /\ fixed_speed c /\
  forall a, c <= a <= right_1_600 -> converges M_1_600 a c.
Proof.
  destruct star_1 as (c & Hc & Hf). exists c. split; [exact Hc |]. split; [exact Hf |]. intros a Ha.
  pose proof square_1_600 as Hs. pose proof reach_1_600 as Hr.
  apply (trap M_1_600 c r_1_600); [lra | lra | exact Hf | | | lra].
  - intros t Ht. apply rate_1. lra.
  - apply Rle_trans with (2 := Hs). apply pow_incr. lra.
Qed.

Lemma past_end_1_600 : A h1_1_600 < beyond_1_600 < A h2_1_600 /\
  forall h, h1_1_600 <= h <= h2_1_600 -> 0 < W h /\ beyond_1_600 ^ 2 - mu M_1_600 * Gam h ^ 2 < lo_1 ^ 2.
Proof. split; [split | intros h Hh; split]; signs. Qed.

Theorem falls_1_600 : forall a', hop M_1_600 beyond_1_600 a' -> a' < lo_1.
Proof. apply (falls_below M_1_600 M_1_600 beyond_1_600 h1_1_600 h2_1_600); try apply past_end_1_600; lra. Qed.

(** Line 700: n = 1, M = 0.7310373266008415. *)
Notation M_1_700 := (6584598863346947 / 9007199254740992).
Notation right_1_700 := (5078335095248145 / 1125899906842624).
Notation r_1_700 := (4794722507178212457266945 / 1000000000000000000000000).
Notation beyond_1_700 := (2539167547624075 / 562949953421312).
Notation h1_1_700 := (4794722507178239751688251 / 1000000000000000000000000).
Notation h2_1_700 := (4794722507178239751888251 / 1000000000000000000000000).

Lemma square_1_700 : hi_1 ^ 2 <= square M_1_700 r_1_700.
Proof. signs. Qed.

Lemma reach_1_700 : right_1_700 <= A r_1_700.
Proof. signs. Qed.

Theorem trap_1_700 : exists c, lo_1 < c < hi_1 /\ fixed_speed c /\
  forall a, c <= a <= right_1_700 -> converges M_1_700 a c.
Proof.
  destruct star_1 as (c & Hc & Hf). exists c. split; [exact Hc |]. split; [exact Hf |]. intros a Ha.
  pose proof square_1_700 as Hs. pose proof reach_1_700 as Hr.
  apply (trap M_1_700 c r_1_700); [lra | lra | exact Hf | | | lra].
  - intros t Ht. apply rate_1. lra.
  - apply Rle_trans with (2 := Hs). apply pow_incr. lra.
Qed.

Lemma past_end_1_700 : A h1_1_700 < beyond_1_700 < A h2_1_700 /\
  forall h, h1_1_700 <= h <= h2_1_700 -> 0 < W h /\ beyond_1_700 ^ 2 - mu M_1_700 * Gam h ^ 2 < lo_1 ^ 2.
Proof. split; [split | intros h Hh; split]; signs. Qed.

Theorem falls_1_700 : forall a', hop M_1_700 beyond_1_700 a' -> a' < lo_1.
Proof. apply (falls_below M_1_700 M_1_700 beyond_1_700 h1_1_700 h2_1_700); try apply past_end_1_700; lra. Qed.

(** Line 800: n = 1, M = 0.8206915510672277. *)
Notation M_1_800 := (3696066163572481 / 4503599627370496).
Notation right_1_800 := (5077553164324731 / 1125899906842624).
Notation r_1_800 := (4790397558924256065199131 / 1000000000000000000000000).
Notation beyond_1_800 := (2538776582162369 / 562949953421312).
Notation h1_1_800 := (4790397558924295299835543 / 1000000000000000000000000).
Notation h2_1_800 := (4790397558924295300035543 / 1000000000000000000000000).

Lemma square_1_800 : hi_1 ^ 2 <= square M_1_800 r_1_800.
Proof. signs. Qed.

Lemma reach_1_800 : right_1_800 <= A r_1_800.
Proof. signs. Qed.

Theorem trap_1_800 : exists c, lo_1 < c < hi_1 /\ fixed_speed c /\
  forall a, c <= a <= right_1_800 -> converges M_1_800 a c.
Proof.
  destruct star_1 as (c & Hc & Hf). exists c. split; [exact Hc |]. split; [exact Hf |]. intros a Ha.
  pose proof square_1_800 as Hs. pose proof reach_1_800 as Hr.
  apply (trap M_1_800 c r_1_800); [lra | lra | exact Hf | | | lra].
  - intros t Ht. apply rate_1. lra.
  - apply Rle_trans with (2 := Hs). apply pow_incr. lra.
Qed.

Lemma past_end_1_800 : A h1_1_800 < beyond_1_800 < A h2_1_800 /\
  forall h, h1_1_800 <= h <= h2_1_800 -> 0 < W h /\ beyond_1_800 ^ 2 - mu M_1_800 * Gam h ^ 2 < lo_1 ^ 2.
Proof. split; [split | intros h Hh; split]; signs. Qed.

Theorem falls_1_800 : forall a', hop M_1_800 beyond_1_800 a' -> a' < lo_1.
Proof. apply (falls_below M_1_800 M_1_800 beyond_1_800 h1_1_800 h2_1_800); try apply past_end_1_800; lra. Qed.

(** Line 900: n = 1, M = 0.9103457755336138. *)
Notation M_1_900 := (8199665790942977 / 9007199254740992).
Notation right_1_900 := (158661384151913 / 35184372088832).
Notation r_1_900 := (4788203152919002317024695 / 1000000000000000000000000).
Notation beyond_1_900 := (2538582146430611 / 562949953421312).
Notation h1_1_900 := (4788203152919036405801412 / 1000000000000000000000000).
Notation h2_1_900 := (4788203152919036406001412 / 1000000000000000000000000).

Lemma square_1_900 : hi_1 ^ 2 <= square M_1_900 r_1_900.
Proof. signs. Qed.

Lemma reach_1_900 : right_1_900 <= A r_1_900.
Proof. signs. Qed.

Theorem trap_1_900 : exists c, lo_1 < c < hi_1 /\ fixed_speed c /\
  forall a, c <= a <= right_1_900 -> converges M_1_900 a c.
Proof.
  destruct star_1 as (c & Hc & Hf). exists c. split; [exact Hc |]. split; [exact Hf |]. intros a Ha.
  pose proof square_1_900 as Hs. pose proof reach_1_900 as Hr.
  apply (trap M_1_900 c r_1_900); [lra | lra | exact Hf | | | lra].
  - intros t Ht. apply rate_1. lra.
  - apply Rle_trans with (2 := Hs). apply pow_incr. lra.
Qed.

Lemma past_end_1_900 : A h1_1_900 < beyond_1_900 < A h2_1_900 /\
  forall h, h1_1_900 <= h <= h2_1_900 -> 0 < W h /\ beyond_1_900 ^ 2 - mu M_1_900 * Gam h ^ 2 < lo_1 ^ 2.
Proof. split; [split | intros h Hh; split]; signs. Qed.

Theorem falls_1_900 : forall a', hop M_1_900 beyond_1_900 a' -> a' < lo_1.
Proof. apply (falls_below M_1_900 M_1_900 beyond_1_900 h1_1_900 h2_1_900); try apply past_end_1_900; lra. Qed.

(** Line 1000: n = 1, M = 1.0. *)
Notation M_1_1000 := 1.
Notation right_1_1000 := (5077052161193885 / 1125899906842624).
Notation r_1_1000 := (4787564813827827246446592 / 1000000000000000000000000).
Notation beyond_1_1000 := (1269263040298473 / 281474976710656).
Notation h1_1_1000 := (4787564813827867174738243 / 1000000000000000000000000).
Notation h2_1_1000 := (4787564813827867174938243 / 1000000000000000000000000).

Lemma square_1_1000 : hi_1 ^ 2 <= square M_1_1000 r_1_1000.
Proof. signs. Qed.

Lemma reach_1_1000 : right_1_1000 <= A r_1_1000.
Proof. signs. Qed.

Theorem trap_1_1000 : exists c, lo_1 < c < hi_1 /\ fixed_speed c /\
  forall a, c <= a <= right_1_1000 -> converges M_1_1000 a c.
Proof.
  destruct star_1 as (c & Hc & Hf). exists c. split; [exact Hc |]. split; [exact Hf |]. intros a Ha.
  pose proof square_1_1000 as Hs. pose proof reach_1_1000 as Hr.
  apply (trap M_1_1000 c r_1_1000); [lra | lra | exact Hf | | | lra].
  - intros t Ht. apply rate_1. lra.
  - apply Rle_trans with (2 := Hs). apply pow_incr. lra.
Qed.

Lemma past_end_1_1000 : A h1_1_1000 < beyond_1_1000 < A h2_1_1000 /\
  forall h, h1_1_1000 <= h <= h2_1_1000 -> 0 < W h /\ beyond_1_1000 ^ 2 - mu M_1_1000 * Gam h ^ 2 < lo_1 ^ 2.
Proof. split; [split | intros h Hh; split]; signs. Qed.

Theorem falls_1_1000 : forall a', hop M_1_1000 beyond_1_1000 a' -> a' < lo_1.
Proof. apply (falls_below M_1_1000 M_1_1000 beyond_1_1000 h1_1_1000 h2_1_1000); try apply past_end_1_1000; lra. Qed.
