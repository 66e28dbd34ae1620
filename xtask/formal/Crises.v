(** How the next speed changes with the mass ratio, and crises: Corollary 30 and Theorem 29 of docs/theory.md. *)

From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Hopper Require Import Analysis Model Energy FirstLanding Fates Traps.
Open Scope R_scope.

(** The constant [mu] rises up to [M = 1], and is largest there. *)
Lemma mu_rises : forall M N, 0 < M <= N -> N <= 1 -> mu M <= mu N.
Proof.
  intros M N HM HN. unfold mu.
  assert (E : N / (1 + N) ^ 2 - M / (1 + M) ^ 2 = (N - M) * (1 - M * N) / ((1 + N) ^ 2 * (1 + M) ^ 2)) by (field; lra).
  assert (0 <= (N - M) * (1 - M * N) / ((1 + N) ^ 2 * (1 + M) ^ 2)); [| lra].
  apply Rdiv_le_0_compat; [| apply Rmult_lt_0_compat; apply pow_lt; lra].
  assert (M * N <= 1 * 1) by (apply Rmult_le_compat; lra). apply Rmult_le_pos; lra.
Qed.

Lemma mu_slope : forall M N, 0 < M <= N -> N <= 1 -> mu N - mu M <= N - M.
Proof.
  intros M N HM HN. unfold mu.
  assert (E : N - M - (N / (1 + N) ^ 2 - M / (1 + M) ^ 2) =
      (N - M) * ((1 + N) ^ 2 * (1 + M) ^ 2 - (1 - M * N)) / ((1 + N) ^ 2 * (1 + M) ^ 2)) by (field; lra).
  assert (0 <= (N - M) * ((1 + N) ^ 2 * (1 + M) ^ 2 - (1 - M * N)) / ((1 + N) ^ 2 * (1 + M) ^ 2)); [| lra].
  apply Rdiv_le_0_compat; [| apply Rmult_lt_0_compat; apply pow_lt; lra]. apply Rmult_le_pos; [lra |].
  assert (1 <= (1 + N) ^ 2) by nra. assert (1 <= (1 + M) ^ 2) by nra.
  assert (1 * 1 <= (1 + N) ^ 2 * (1 + M) ^ 2) by (apply Rmult_le_compat; lra).
  assert (0 <= M * N) by (apply Rmult_le_pos; lra). lra.
Qed.

(** Corollary 10: where the first landing is not sudden, [M] and [1/M] have the same next speed. *)
Theorem inverse_mass_ratio : forall M h a, 0 < M -> 0 < h -> sin h * u h < 0 \/ u h = 0 ->
  (hop M (A h) a <-> hop (/ M) (A h) a).
Proof.
  intros M h a HM Hh Hsu. assert (Hi : 0 < / M) by now apply Rinv_0_lt_compat.
  assert (E : mu (/ M) = mu M) by (unfold mu; field; lra).
  rewrite (hop_with_one_landing M h a HM Hh) by tauto. rewrite (hop_with_one_landing (/ M) h a Hi Hh) by tauto.
  now rewrite E.
Qed.

Lemma mu_largest : forall M, 0 < M -> mu M <= mu 1.
Proof.
  intros M HM. assert (E : mu 1 - mu M = (1 - M) ^ 2 / (4 * (1 + M) ^ 2)) by (unfold mu; field; lra).
  assert (0 <= (1 - M) ^ 2 / (4 * (1 + M) ^ 2)); [| lra].
  apply Rdiv_le_0_compat; [apply pow2_ge_0 |]. apply Rmult_lt_0_compat; [lra | apply pow_lt; lra].
Qed.

Lemma square_mu : forall M N h, mu M <= mu N -> square N h <= square M h.
Proof.
  intros M N h H. unfold square. pose proof (pow2_ge_0 (Gam h)).
  assert (mu M * Gam h ^ 2 <= mu N * Gam h ^ 2) by (apply Rmult_le_compat_r; lra). lra.
Qed.

(** Corollary 30: a trap at one mass ratio is one at each with a smaller [mu]. *)
Theorem trap_of_smaller_mu : forall N M c r, 0 < M -> 0 < c < r -> fixed_speed c -> mu M <= mu N ->
  (forall t, c <= t <= r -> 0 < W_rate t) -> c ^ 2 <= square N r -> forall a, c <= a <= A r -> converges M a c.
Proof.
  intros N M c r HM Hcr Hc Hmu HW Hr. apply trap; try assumption. pose proof (square_mu M N r Hmu). lra.
Qed.

(** A speed whose time of flight lies between [2 h1] and [2 h2] hops to below [c], or is grounded: at [N] and each mass ratio
    with a larger [mu]. *)
Theorem falls_below : forall N M a h1 h2 c, 0 < M -> mu N <= mu M -> 0 <= c -> 0 < h1 < h2 -> A h1 < a < A h2 ->
  (forall h, h1 <= h <= h2 -> 0 < W h /\ a ^ 2 - mu N * Gam h ^ 2 < c ^ 2) -> forall a', hop M a a' -> a' < c.
Proof.
  intros N M a h1 h2 c HM Hmu Hc0 Hh Ha Hc a' Hhop.
  destruct (half_time a) as (h & Hh0 & E); [pose proof (A_positive h1); lra |].
  assert (Hin : h1 <= h <= h2).
  { split; apply Rnot_lt_le; intro H; [pose proof (A_increases h h1) | pose proof (A_increases h2 h)]; lra. }
  destruct (Hc h Hin) as [Hw Hs]. rewrite W_u in Hw. subst a.
  apply hop_with_one_landing in Hhop; [| exact HM | exact Hh0 | lra]. destruct Hhop as [Hp ->].
  rewrite <- (sqrt_pow2 c) by exact Hc0. apply sqrt_lt_1_alt.
  pose proof (square_mu N M h Hmu) as Hle. unfold square in Hle. lra.
Qed.

(** The speeds of the contact part of a hump that ends at [n pi] hop with one landing, where [W > 0]. *)
Definition contact_part n c := (1 <= n)%nat /\ 0 < c < INR n * PI /\ fixed_speed c /\ forall h, c < h < INR n * PI -> 0 < W h.

(** Theorem 29.1: the whole contact part is a trap. *)
Theorem whole_trap : forall M n c, 0 < M -> contact_part n c ->
  (forall h, c < h < INR n * PI -> c ^ 2 <= square M h) -> forall a, c <= a < INR n * PI -> converges M a c.
Proof.
  intros M n c HM (Hn & Hcn & Hc & HW) Hsq a Ha. destruct (half_time a ltac:(lra)) as (h & Hh & Eh).
  assert (Hhn : h < INR n * PI).
  { apply Rnot_le_lt. intro H. pose proof (A_not_falling (INR n * PI) h) as HA. rewrite A_multiple in HA by exact Hn. lra. }
  pose (m := (c + INR n * PI) / 2). pose (r := Rmax h m). pose proof (Rmax_l h m). pose proof (Rmax_r h m).
  assert (Hm : c < m < INR n * PI) by (unfold m; lra).
  assert (Hr : r < INR n * PI) by (apply Rmax_lub_lt; lra). fold r in H, H0.
  apply (trap_of_squares M c r HM); [lra | exact Hc | intros; apply HW; lra | intros; apply Hsq; lra |].
  split; [lra |]. rewrite <- Eh. apply A_not_falling. lra.
Qed.

(** The squares of the next speeds on a contact part from signs. [W] rises up to [p1], [4 mu W >= 1] from there to [p2], [W]
    falls from [p2] on, and the square of the next speed has its minimum between [q1] and [q2]. *)
Theorem part_by_signs : forall M n c p1 p2 q1 q2, 0 < M -> (1 <= n)%nat ->
  0 < c < p1 -> p1 <= p2 -> p2 <= q1 -> q1 <= q2 -> q2 < INR n * PI -> fixed_speed c ->
  (forall t, c <= t <= p1 -> 0 < W_rate t) ->
  (forall t, p1 <= t <= p2 -> 1 <= 4 * mu M * W t) ->
  (forall t, p2 <= t <= INR n * PI -> W_rate t < 0) ->
  1 <= 4 * mu M * W q1 -> 4 * mu M * W q2 <= 1 ->
  (forall t, q1 <= t <= q2 -> c ^ 2 <= square M t) ->
  contact_part n c /\ forall h, c < h < INR n * PI -> c ^ 2 <= square M h.
Proof.
  intros M n c p1 p2 q1 q2 HM Hn Hcp Hp Hpq Hq Hqn Hc Hup Hmid Hdown Hq1 Hq2 Hmin.
  pose proof (mu_positive M HM) as Hm.
  assert (Hmono : forall s t, p2 <= s <= t -> t <= INR n * PI -> mu M * W t <= mu M * W s).
  { intros s t Hs Ht. apply Rmult_le_compat_l; [lra |]. destruct (Req_dec s t) as [-> | Hne]; [lra |].
    left. apply W_falls; [lra | intros; apply Hdown; lra]. }
  (* The square falls up to [q1], and rises from [q2] on. *)
  assert (Hfall : forall t, p1 <= t <= q1 -> 1 <= 4 * mu M * W t).
  { intros t Ht. destruct (Rle_or_lt t p2); [apply Hmid; lra |]. specialize (Hmono t q1). lra. }
  assert (Hsq : forall t, p1 <= t <= INR n * PI -> c ^ 2 <= square M t).
  { intros t Ht. destruct (Rle_or_lt t q1) as [H1 | H1].
    - apply Rle_trans with (1 := Hmin q1 ltac:(lra)). apply square_down; [lra |]. intros s Hs. apply Hfall. lra.
    - destruct (Rle_or_lt t q2) as [H2 | H2]; [apply Hmin; lra |].
      apply Rle_trans with (1 := Hmin q2 ltac:(lra)). apply square_up; [lra |].
      intros s Hs. specialize (Hmono q2 s). lra. }
  split.
  - split; [exact Hn |]. split; [lra |]. split; [exact Hc |]. intros t Ht. destruct (Rle_or_lt t p1) as [H1 | H1].
    + destruct (A_fixed c (proj1 Hcp) Hc) as (_ & _ & <- & _). apply W_rises; [lra | intros; apply Hup; lra].
    + destruct (Rle_or_lt t q1) as [H2 | H2].
      * specialize (Hfall t ltac:(lra)). apply Rnot_le_lt. intro Hle.
        assert (0 <= mu M * - W t) by (apply Rmult_le_pos; lra). lra.
      * replace 0 with (W (INR n * PI)) by (unfold W; rewrite sin_multiple; ring).
        apply W_falls; [lra | intros; apply Hdown; lra].
  - intros t Ht. destruct (Rle_or_lt t p1); [| apply Hsq; lra].
    apply (above_while_rising M c p1); try assumption; [| lra]. apply Hsq. lra.
Qed.

(** Theorem 29: there is exactly one mass ratio up to 1 at which the map begins to fall through [c], if it does so at [high]
    and not at [low]. *)
Theorem one_crisis : forall n c low high h, contact_part n c -> 0 < low <= high -> high <= 1 ->
  (forall h, c < h < INR n * PI -> c ^ 2 <= square low h) -> c < h < INR n * PI -> square high h < c ^ 2 ->
  exists M0, low <= M0 <= high /\ forall M, 0 < M <= 1 ->
    (M <= M0 -> forall a, c <= a < INR n * PI -> converges M a c) /\
    (M0 < M -> exists a, c < a < INR n * PI /\ forall a', hop M a a' -> a' < c).
Proof.
  intros n c low high h Hpart Hlow Hhigh Hsq Hh Hfall.
  pose (E := fun M => 0 < M <= 1 /\ forall h, c < h < INR n * PI -> c ^ 2 <= square M h).
  assert (Hdown : forall M N, 0 < M <= N -> E N -> E M).
  { intros M N HM [HN HE]. split; [lra |]. intros t Ht.
    apply Rle_trans with (1 := HE t Ht). apply square_mu. apply mu_rises; lra. }
  assert (Habove : forall M, E M -> M < high).
  { intros M HM. apply Rnot_le_lt. intro Hle. destruct (Hdown high M ltac:(lra) HM) as [_ HE].
    specialize (HE h Hh). lra. }
  destruct (completeness E) as [M0 [Hub Hlub]].
  { exists high. intros M HM. specialize (Habove M HM). lra. }
  { exists low. split; [lra | exact Hsq]. }
  assert (HM0 : low <= M0 <= high).
  { split; [apply Hub; split; [lra | exact Hsq] |]. apply Hlub. intros M HM. specialize (Habove M HM). lra. }
  assert (HE0 : E M0).
  { split; [lra |]. intros t Ht. apply Rnot_lt_le. intro Hlt.
    (* The square changes with [M] no faster than by the square of the closing speed. *)
    pose (g := Gam t ^ 2 + 1). assert (Hg : 1 <= g) by (unfold g; pose proof (pow2_ge_0 (Gam t)); lra).
    pose (d := (c ^ 2 - square M0 t) / g). assert (Hd : 0 < d) by (apply Rdiv_lt_0_compat; lra).
    assert (Hex : exists M, E M /\ M0 - d < M).
    { apply Classical_Prop.NNPP. intro Hn. assert (M0 <= M0 - d); [| lra].
      apply Hlub. intros M HM. apply Rnot_lt_le. intro H. apply Hn. now exists M. }
    destruct Hex as (M & HM & HMd). pose proof (Hub M HM) as Hle. destruct HM as [HM HE]. specialize (HE t Ht).
    pose proof (mu_slope M M0 ltac:(lra) ltac:(lra)) as Hs.
    assert (Hmu : (mu M0 - mu M) * Gam t ^ 2 <= (M0 - M) * Gam t ^ 2) by (apply Rmult_le_compat_r; [apply pow2_ge_0 | lra]).
    assert (Hgg : (M0 - M) * g < d * g) by (apply Rmult_lt_compat_r; lra).
    replace (d * g) with (c ^ 2 - square M0 t) in Hgg by (unfold d; field; lra).
    assert (0 <= (M0 - M) * 1) by lra. unfold g in Hgg. unfold square in *. lra. }
  exists M0. split; [exact HM0 |]. intros M HM. split.
  - intro Hle. apply whole_trap; [lra | exact Hpart |]. now apply (Hdown M M0 ltac:(lra) HE0).
  - intro Hlt. assert (Hn : ~ E M) by (intro HE; specialize (Hub M HE); lra).
    assert (Hex : exists t, c < t < INR n * PI /\ square M t < c ^ 2).
    { apply Classical_Prop.NNPP. intro H. apply Hn. split; [exact HM |]. intros t Ht. apply Rnot_lt_le. intro H2.
      apply H. now exists t. }
    destruct Hex as (t & Ht & Hsqt). destruct Hpart as (Hn1 & Hcn & Hc & HW).
    destruct (A_fixed c (proj1 Hcn) Hc) as (_ & EA & _ & _).
    exists (A t). split.
    + pose proof (A_increases c t). pose proof (A_increases t (INR n * PI)) as H2. rewrite A_multiple in H2 by exact Hn1. lra.
    + intros a' Hhop. specialize (HW t Ht). rewrite W_u in HW.
      apply hop_with_one_landing in Hhop; [| lra | lra | lra]. destruct Hhop as [Hp ->].
      rewrite <- (sqrt_pow2 c) by lra. apply sqrt_lt_1_alt. unfold square in Hsqt. lra.
Qed.
