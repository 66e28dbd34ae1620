(** A hop has finitely many sudden lift-offs, for every mass ratio: Theorem 18 of docs/theory.md with a bound that is linear in
    the losses, and Theorem 4 without a condition. *)

From Coq Require Import Reals Lra Lia List.
From Coquelicot Require Import Coquelicot.
From Hopper Require Import Analysis Model Energy FirstLanding Windows OneSudden Losses.
Import ListNotations.
Open Scope R_scope.

(** Every flight from a take-off lands. *)
Theorem take_off_lands : forall x V, take_off x V -> exists tau, lands x V tau.
Proof.
  intros x V [Hx | [-> HV]].
  - pose (v := Rabs V). pose (k := 2 + x + v). assert (Hv : 0 <= v) by apply Rabs_pos.
    assert (Ek : k = 2 + x + v) by reflexivity.
    destruct (lands_before x V (2 * k)) as (tau & Ht & _); [exact Hx | lra | | now exists tau].
    assert (HV : - v <= V <= v). { unfold v, Rabs. destruct (Rcase_abs V); lra. }
    pose proof (COS_bound (2 * k)) as Hc. pose proof (SIN_bound (2 * k)) as Hs.
    assert (0 <= (1 + x) * (1 + cos (2 * k))) by (apply Rmult_le_pos; lra).
    assert (- v <= V * sin (2 * k)).
    { assert (Rabs (V * sin (2 * k)) <= v * 1).
      { rewrite Rabs_mult. apply Rmult_le_compat; try apply Rabs_pos; [unfold v; lra | apply Rabs_le; lra]. }
      pose proof (Rle_abs (- (V * sin (2 * k)))). rewrite Rabs_Ropp in *. lra. }
    clearbody k. assert (0 <= (v - V) * k) by (apply Rmult_le_pos; lra).
    assert (0 <= x * k) by (apply Rmult_le_pos; lra).
    assert (E : k * k = 2 * k + x * k + v * k) by (rewrite Ek at 2; ring).
    unfold G, momentum, stretch. replace ((2 * k) ^ 2 / 2) with (2 * (k * k)) by field. rewrite E. lra.
  - destruct (half_time V HV) as (h & Hh & <-). exists (2 * h). now apply lands_half.
Qed.

(** [n] sudden landings in a row, with their whole time, the sum of their closing speeds, and that of the squares. *)
Inductive sudden_landings M alpha : nat -> R -> R -> R -> R -> R -> Prop :=
| no_landing : sudden_landings M alpha 0 0 0 0 0 alpha
| next_landing : forall n T g s x V tau (c := closing x V tau) (x' := stretch x V tau - 1) (V' := V - tau + kappa M * c),
    sudden_landings M alpha n T g s x V -> lands x V tau -> take_off x' V' ->
    sudden_landings M alpha (S n) (T + tau) (g + c) (s + c ^ 2) x' V'.

Lemma sudden_invariants : forall M a alpha n T g s x V, 0 < M -> 0 < alpha -> first_star a ->
  sudden_landings M alpha n T g s x V ->
  take_off x V /\ V = alpha - T + kappa M * g /\ energy M x V = alpha ^ 2 - mu M * s /\ 0 <= s /\ INR n * a <= T /\
  kappa M * g <= INR n * a / 2 + kappa M ^ 2 * s / (2 * a).
Proof.
  intros M a alpha n T g s x V HM Halpha Ha H. pose proof PI_RGT_0.
  assert (Ha0 : 0 < a) by (destruct Ha; lra).
  induction H as [| n T g s x V tau c x' V' H IH Hl Ht].
  - simpl. split; [now right |]. split; [ring |]. split; [unfold energy; ring |]. split; [lra |]. split; [lra |].
    right. field. lra.
  - destruct IH as (Hto & EV & Ee & Hs & HT & Hg). split; [exact Ht |]. split; [unfold V'; rewrite EV at 1; ring |]. split.
    { unfold x', V', c. rewrite energy_of_landing by assumption. rewrite Ee. ring. }
    split; [pose proof (pow2_ge_0 c); lra |]. rewrite S_INR. split.
    + assert (a < tau); [| lra]. apply Rnot_le_lt. intro Hle.
      assert (Hx : 0 <= x) by (unfold take_off in Hto; lra).
      pose proof (long_flights a x V tau Ha Hx Hl Hle). unfold take_off, x' in Ht. lra.
    + assert (Hsq : 0 <= (kappa M * c - a) ^ 2 / (2 * a)) by (apply Rdiv_le_0_compat; [apply pow2_ge_0 | lra]).
      replace ((kappa M * c - a) ^ 2 / (2 * a)) with (kappa M ^ 2 * c ^ 2 / (2 * a) - kappa M * c + a / 2) in Hsq by (field; lra).
      replace (kappa M ^ 2 * (s + c ^ 2) / (2 * a)) with (kappa M ^ 2 * s / (2 * a) + kappa M ^ 2 * c ^ 2 / (2 * a))
        by (field; lra). lra.
Qed.

(** Theorem 18: the number of sudden landings in a row is bounded. *)
Theorem finitely_many : forall M a alpha n T g s x V, 0 < M -> 0 < alpha -> first_star a ->
  sudden_landings M alpha n T g s x V -> INR n * a <= 4 * alpha + M * alpha ^ 2 / a.
Proof.
  intros M a alpha n T g s x V HM Halpha Ha H.
  destruct (sudden_invariants M a alpha n T g s x V HM Halpha Ha H) as (Hto & EV & Ee & Hs & HT & Hg).
  pose proof PI_RGT_0. assert (Ha0 : 0 < a) by (destruct Ha; lra).
  pose proof (mu_positive M HM) as Hmu. pose proof (kappa_positive M HM) as Hk.
  assert (Hx : 0 <= x) by (unfold take_off in Hto; lra).
  assert (He : V ^ 2 <= energy M x V).
  { unfold energy. assert (0 <= x * (2 + kappa M * x)); [| lra].
    apply Rmult_le_pos; [exact Hx |]. pose proof (Rmult_le_pos _ _ (Rlt_le _ _ Hk) Hx). lra. }
  pose proof (Rmult_le_pos _ _ (Rlt_le _ _ Hmu) Hs) as Hms.
  assert (HV : - alpha <= V).
  { apply Ropp_le_cancel. rewrite Ropp_involutive. apply pow2_le; [lra |]. replace ((- V) ^ 2) with (V ^ 2) by ring. lra. }
  assert (Hks : kappa M ^ 2 * s / (2 * a) <= M * alpha ^ 2 / (2 * a)).
  { replace (kappa M ^ 2 * s) with (M * (mu M * s)) by (unfold kappa, mu; field; lra).
    apply Rmult_le_compat_r; [left; apply Rinv_0_lt_compat; lra |]. apply Rmult_le_compat_l; [lra |].
    pose proof (pow2_ge_0 V). lra. }
  replace (M * alpha ^ 2 / a) with (2 * (M * alpha ^ 2 / (2 * a))) by (field; lra). lra.
Qed.

(** Flights after sudden landings are flights from the start. *)
Lemma flights_after : forall M alpha n T g s x V l y W, sudden_landings M alpha n T g s x V -> flights M x V l y W ->
  exists l', flights M 0 alpha l' y W.
Proof.
  intros M alpha n T g s x V l y W H. revert l. induction H as [| n T g s x V tau c x' V' H IH Hl Ht]; intros l Hf.
  - now exists l.
  - apply (IH (c :: l)). now apply sudden_flight.
Qed.

(** Theorem 18: from every speed finitely many flights lead to a contact. *)
Theorem flights_end : forall M alpha, 0 < M -> 0 < alpha -> exists l y W, flights M 0 alpha l y W.
Proof.
  intros M alpha HM Halpha. apply Classical_Prop.NNPP. intro Hno.
  destruct (star_exists 1 ltac:(lia)) as (a & Ha & Hhalf).
  assert (Hstar : first_star a).
  { destruct Ha as [[H1 _] E]. simpl in H1, Hhalf. split; [lra | unfold u in E; lra]. }
  assert (Hall : forall n, exists T g s x V, sudden_landings M alpha n T g s x V).
  { induction n as [| n (T & g & s & x & V & H)]; [do 5 eexists; apply no_landing |].
    destruct (sudden_invariants M a alpha n T g s x V HM Halpha Hstar H) as (Hto & _).
    destruct (take_off_lands x V Hto) as (tau & Hl).
    destruct (Classical_Prop.classic (take_off (stretch x V tau - 1) (V - tau + kappa M * closing x V tau))) as [Ht | Hn].
    - do 5 eexists. apply next_landing; [exact H | exact Hl | exact Ht].
    - exfalso. assert (Hf : flights M x V [closing x V tau] (stretch x V tau - 1) (V - tau + kappa M * closing x V tau)).
      { apply last_flight; [exact Hl |]. set (y := stretch x V tau - 1) in *. clearbody y.
        set (W := V - tau + kappa M * closing x V tau) in *. clearbody W. unfold take_off, contact in *.
        destruct (Rtotal_order y 0) as [H0 | [H0 | H0]]; [now left | right | exfalso; auto].
        split; [exact H0 |]. apply Rnot_lt_le. auto. }
      destruct (flights_after M alpha n T g s x V _ _ _ H Hf) as (l & Hl'). apply Hno. eauto. }
  pose proof PI_RGT_0. assert (Ha0 : 0 < a) by (destruct Hstar; lra).
  destruct (nfloor_ex ((4 * alpha + M * alpha ^ 2 / a) / a)) as [n [_ Hn]].
  { apply Rdiv_le_0_compat; [| exact Ha0]. assert (0 <= M * alpha ^ 2 / a); [| lra].
    apply Rdiv_le_0_compat; [| exact Ha0]. apply Rmult_le_pos; [lra | apply pow2_ge_0]. }
  destruct (Hall (S n)) as (T & g & s & x & V & H1).
  pose proof (finitely_many M a alpha (S n) T g s x V HM Halpha Hstar H1) as Hb. rewrite S_INR in Hb.
  apply (Rmult_lt_compat_r a) in Hn; [| exact Ha0]. unfold Rdiv in Hn at 1. rewrite Rmult_assoc, Rinv_l in Hn by lra. lra.
Qed.

(** Theorem 4: each speed has the closing speeds of its landings; the next speed is the root of [F], and the hopper is
    grounded if and only if [F] is not positive. *)
Theorem every_hop : forall M a, 0 < M -> 0 < a -> exists l,
  (exists y W, flights M 0 a l y W) /\ let F := a ^ 2 - mu M * sum_of_squares l in
  (grounded M a <-> F <= 0) /\ forall a', hop M a a' <-> 0 < F /\ a' = sqrt F.
Proof.
  intros M a HM Ha. destruct (flights_end M a HM Ha) as (l & y & W & Hf). exists l.
  split; [eauto |]. split; [now apply grounded_exactly with y W |]. intro a'. now apply next_speed with y W.
Qed.
