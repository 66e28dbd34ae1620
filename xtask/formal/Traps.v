(** Traps and crises from a few signs: Lemma 26, parts of Theorem 29, and Corollary 30 of docs/theory.md. *)

From Coq Require Import Reals Lra Lia List.
From Coquelicot Require Import Coquelicot.
From Hopper Require Import Analysis Model Energy FirstLanding Fates.
Import ListNotations.
Open Scope R_scope.

(** The square of the next speed after one landing at the half time [h], and what decides whether it rises. *)
Definition square M h := A h ^ 2 - mu M * Gam h ^ 2.
Definition W h := sin h * (sin h - h * cos h).
Definition W_rate h := sin h * cos h - h * (cos h ^ 2 - sin h ^ 2).

Lemma W_derive : forall h, is_derive W h (W_rate h).
Proof. intro h. unfold W, W_rate. auto_derive; [exact I | ring]. Qed.

Lemma W_u : forall h, W h = - (sin h * u h).
Proof. intro h. unfold W, u. ring. Qed.

Lemma Gam_derive : forall h, 0 < h -> is_derive Gam h (- 4 * u h * sin h * A h / D h).
Proof.
  intros h Hh. pose proof (D_positive h Hh) as HD.
  assert (E : - 4 * u h * sin h * A h / D h =
      (2 * (2 * u h * (- h * sin h)) * D h - 2 * u h ^ 2 * (2 * sin h ^ 2)) / D h ^ 2).
  { unfold A. field_simplify; [| lra | lra]. unfold D, u. field. unfold D in HD. lra. }
  rewrite E. apply (is_derive_div (fun h => 2 * u h ^ 2) D); [| apply D_derive | lra].
  unfold u. auto_derive; [exact I | ring].
Qed.

(** Lemma 26. *)
Lemma square_derive : forall M h, 0 < h ->
  is_derive (square M) h (4 * A h * u h ^ 2 / D h ^ 2 * (1 - 4 * mu M * W h)).
Proof.
  intros M h Hh. pose proof (D_positive h Hh) as HD.
  pose proof (A_derive h Hh) as HA. pose proof (Gam_derive h Hh) as HG.
  unfold square. auto_derive.
  - repeat split; eexists; [exact HA | exact HG].
  - replace (Derive (fun x => A x) h) with (2 * u h ^ 2 / D h ^ 2) by (symmetry; now apply is_derive_unique).
    replace (Derive (fun x => Gam x) h) with (- 4 * u h * sin h * A h / D h) by (symmetry; now apply is_derive_unique).
    rewrite W_u. unfold Gam. field. lra.
Qed.

Lemma slope_factor : forall h, 0 < h -> 0 <= 4 * A h * u h ^ 2 / D h ^ 2.
Proof.
  intros h Hh. pose proof (D_positive h Hh). pose proof (A_positive h Hh).
  apply Rdiv_le_0_compat; [| apply pow_lt; lra]. apply Rmult_le_pos; [lra | apply pow2_ge_0].
Qed.

(** The square does not fall where [4 mu W <= 1], and does not rise where [4 mu W >= 1]. *)
Lemma square_up : forall M a b, 0 < a <= b -> (forall t, a <= t <= b -> 4 * mu M * W t <= 1) -> square M a <= square M b.
Proof.
  intros M a b Hab HW. eapply not_falling; [apply Hab | intros t Ht; apply square_derive; lra |].
  intros t Ht. specialize (HW t Ht). apply Rmult_le_pos; [apply slope_factor |]; lra.
Qed.

Lemma square_down : forall M a b, 0 < a <= b -> (forall t, a <= t <= b -> 1 <= 4 * mu M * W t) -> square M b <= square M a.
Proof.
  intros M a b Hab HW. eapply not_rising; [apply Hab | intros t Ht; apply square_derive; lra |].
  intros t Ht. specialize (HW t Ht). pose proof (slope_factor t ltac:(lra)) as Hs.
  assert (0 <= 4 * A t * u t ^ 2 / D t ^ 2 * - (1 - 4 * mu M * W t)) by (apply Rmult_le_pos; lra). lra.
Qed.

Lemma W_rises : forall a b, a < b -> (forall t, a <= t <= b -> 0 < W_rate t) -> W a < W b.
Proof.
  intros a b Hab H. destruct (mean_value W W_rate a b Hab) as (c & Hc & E); [intros; apply W_derive |].
  specialize (H c Hc). assert (0 < W_rate c * (b - a)) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

Lemma W_falls : forall a b, a < b -> (forall t, a <= t <= b -> W_rate t < 0) -> W b < W a.
Proof.
  intros a b Hab H. destruct (mean_value W W_rate a b Hab) as (c & Hc & E); [intros; apply W_derive |].
  specialize (H c Hc). assert (0 < - W_rate c * (b - a)) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

(** A fixed point between two times at which [u] has opposite signs. *)
Lemma fixed_point_between : forall l r, 0 < l < r -> u l * u r < 0 -> exists c, l < c < r /\ fixed_speed c.
Proof.
  intros l r Hlr Hs.
  assert (Hr : forall s, (forall t, is_derive (fun t => s * u t) t (s * (- t * sin t)))).
  { intros s t. apply (is_derive_scal u). apply u_derive. }
  destruct (first_zero (fun t => u l * u t) l r) as (c & Hc & E & _).
  - lra.
  - intros t _. eapply derive_continuity. apply Hr.
  - assert (u l <> 0) by (intro E; rewrite E in Hs; lra). now apply Rsqr_pos_lt.
  - exact Hs.
  - exists c. split; [exact Hc |]. split; [lra |].
    apply Rmult_integral in E. destruct E as [E | E]; [rewrite E in Hs; lra | unfold u in E; lra].
Qed.

Lemma A_fixed : forall c, 0 < c -> fixed_speed c -> u c = 0 /\ A c = c /\ W c = 0 /\ forall M, square M c = c ^ 2.
Proof.
  intros c Hc [_ E]. assert (Eu : u c = 0) by (unfold u; lra).
  assert (EA : A c = c).
  { pose proof (A_minus c Hc) as Em. rewrite Eu, Rmult_0_r in Em. unfold Rdiv in Em. lra. }
  repeat split; [exact Eu | exact EA | rewrite W_u, Eu; ring |].
  intro M. unfold square, Gam. rewrite EA, Eu. unfold Rdiv. ring.
Qed.

(** While [W] rises from a fixed point, the square of the next speed is not below both its ends. *)
Lemma above_while_rising : forall M c r, 0 < M -> 0 < c < r -> fixed_speed c ->
  (forall t, c <= t <= r -> 0 < W_rate t) -> c ^ 2 <= square M r -> forall h, c <= h <= r -> c ^ 2 <= square M h.
Proof.
  intros M c r HM Hcr Hc HW Hr h Hh. pose proof (mu_positive M HM) as Hm.
  destruct (A_fixed c (proj1 Hcr) Hc) as (_ & _ & _ & Esq).
  assert (Hmono : forall s t, c <= s <= t -> t <= r -> mu M * W s <= mu M * W t).
  { intros s t Hs Ht. apply Rmult_le_compat_l; [lra |]. destruct (Req_dec s t) as [-> | Hn]; [lra |].
    left. apply W_rises; [lra | intros; apply HW; lra]. }
  destruct (Rle_or_lt (4 * mu M * W h) 1) as [Hle | Hgt].
  - rewrite <- (Esq M). apply square_up; [lra |]. intros t Ht. specialize (Hmono t h). lra.
  - apply Rle_trans with (1 := Hr). apply square_down; [lra |]. intros t Ht. specialize (Hmono h t). lra.
Qed.

(** Where the square of the next speed is not below that of a fixed point, the speeds up to [A r] converge to it. *)
Theorem trap_of_squares : forall M c r, 0 < M -> 0 < c < r -> fixed_speed c ->
  (forall h, c < h <= r -> 0 < W h) -> (forall h, c < h <= r -> c ^ 2 <= square M h) ->
  forall a, c <= a <= A r -> converges M a c.
Proof.
  intros M c r HM Hcr Hc HW Hsq a Ha.
  destruct (A_fixed c (proj1 Hcr) Hc) as (Eu & EA & _ & _).
  assert (Htime : forall b, c < b <= A r -> exists h, c < h <= r /\ A h = b).
  { intros b Hb. destruct (half_time b ltac:(lra)) as (h & Hh & E). exists h. split; [| exact E].
    split; apply Rnot_le_lt || apply Rnot_lt_le; intro H.
    - pose proof (A_not_falling h c). lra.
    - pose proof (A_increases r h). lra. }
  apply (intervals_have_fates M [(c, A r, To c)] HM) with (f := To c); [| | lra | now exists c, (A r); split; [left |]].
  - intros f b Hb (p & q & [E | []] & Hpq). injection E as <- <- <-. unfold hops_inside.
    destruct (Req_dec b c) as [-> | Hne].
    + exists c. split; [apply fixed_points; [exact HM | lra | apply Hc] | exists c, (A r); split; [now left | lra]].
    + destruct (Htime b ltac:(lra)) as (h & Hh & <-). pose proof (Hsq h Hh) as Hs. pose proof (HW h Hh) as Hw.
      rewrite W_u in Hw. pose proof (pow_lt c 2 (proj1 Hcr)) as Hc2.
      assert (Hhop : hop M (A h) (sqrt (square M h))).
      { apply hop_with_one_landing; [exact HM | lra | lra |]. unfold square in *. split; [lra | reflexivity]. }
      exists (sqrt (square M h)). split; [exact Hhop |]. exists c, (A r). split; [now left |].
      pose proof (hop_not_above M _ _ HM Hb Hhop). split; [| lra].
      rewrite <- (sqrt_pow2 c) by lra. now apply sqrt_le_1_alt.
  - intros f d Hd (p & q & [E | []] & Hpq). injection E as <- <- <-. f_equal.
    destruct (Req_dec d c) as [E | Hne]; [now symmetry | exfalso].
    destruct (A_fixed d ltac:(lra) Hd) as (Eud & EAd & EWd & _).
    destruct (Htime d ltac:(lra)) as (h & Hh & Eh).
    assert (h = d). { destruct (Rtotal_order h d) as [H | [H | H]]; [| exact H |].
      - pose proof (A_increases h d). lra.
      - pose proof (A_increases d h). lra. }
    subst h. pose proof (HW d Hh). lra.
Qed.

(** Theorem 29, a trap from the sign of the rate of [W], and the square at one time [r]. *)
Theorem trap : forall M c r, 0 < M -> 0 < c < r -> fixed_speed c ->
  (forall t, c <= t <= r -> 0 < W_rate t) -> c ^ 2 <= square M r -> forall a, c <= a <= A r -> converges M a c.
Proof.
  intros M c r HM Hcr Hc HW Hr. apply trap_of_squares; try assumption.
  - intros h Hh. destruct (A_fixed c (proj1 Hcr) Hc) as (_ & _ & <- & _).
    apply W_rises; [lra | intros; apply HW; lra].
  - intros h Hh. apply above_while_rising with r; try assumption. lra.
Qed.

(** The same, with the end past the maximum of [W], where the square falls from [p] to [r]. *)
Theorem long_trap : forall M c p r, 0 < M -> 0 < c < p -> p <= r -> fixed_speed c ->
  (forall t, c <= t <= p -> 0 < W_rate t) -> (forall t, p <= t <= r -> 1 <= 4 * mu M * W t) ->
  c ^ 2 <= square M r -> forall a, c <= a <= A r -> converges M a c.
Proof.
  intros M c p r HM Hcp Hpr Hc HW Hdown Hr. pose proof (mu_positive M HM) as Hm.
  assert (Hsq : forall h, p <= h <= r -> c ^ 2 <= square M h).
  { intros h Hh. apply Rle_trans with (1 := Hr). apply square_down; [lra |]. intros t Ht. apply Hdown. lra. }
  apply trap_of_squares; [exact HM | lra | exact Hc | |].
  - intros h Hh. destruct (Rle_or_lt h p) as [Hp | Hp].
    + destruct (A_fixed c (proj1 Hcp) Hc) as (_ & _ & <- & _). apply W_rises; [lra | intros; apply HW; lra].
    + specialize (Hdown h ltac:(lra)). apply Rnot_le_lt. intro Hle.
      assert (0 <= mu M * - W h) by (apply Rmult_le_pos; lra). lra.
  - intros h Hh. destruct (Rle_or_lt h p) as [Hp | Hp]; [| apply Hsq; lra].
    apply (above_while_rising M c p); try assumption; [apply Hsq |]; lra.
Qed.
