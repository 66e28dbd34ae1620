(** Orbits converge to fixed points or are grounded, and the induction over intervals: Theorem 24 of docs/theory.md and the
    rule by which docs/certificates.md confirms intervals of one fate. *)

From Coq Require Import Reals Lra Lia List.
From Coquelicot Require Import Coquelicot.
From Hopper Require Import Analysis Model Energy FirstLanding.
Import ListNotations.
Open Scope R_scope.

(** The next gradual lift-off speed is unique. *)
Lemma moves_unique : forall M x V a b, 0 < M -> moves M x V a -> moves M x V b -> a = b.
Proof.
  intros M x V a b HM Ha. revert b.
  assert (U : forall x V x1 V1 x2 V2, landing M x V x1 V1 -> landing M x V x2 V2 -> x1 = x2 /\ V1 = V2).
  { intros x0 V0 x1 V1 x2 V2 H1 H2. apply landing_closed in H1, H2; try exact HM.
    destruct H1 as (t1 & L1 & -> & ->), H2 as (t2 & L2 & -> & ->).
    now rewrite (lands_unique x0 V0 t1 t2 L1 L2). }
  induction Ha as [x V x' V' a Hl Hc Hg | x V x' V' a Hl Ht Hm IH]; intros b Hb;
    inversion Hb as [y W y' W' b' Hl2 Hc2 Hg2 | y W y' W' b' Hl2 Ht2 Hm2]; subst;
    destruct (U _ _ _ _ _ _ Hl Hl2) as [<- <-].
  - apply contact_ends in Hg, Hg2; try assumption. destruct Hg as [_ ->], Hg2 as [_ ->]. reflexivity.
  - unfold take_off, contact in *. lra.
  - unfold take_off, contact in *. lra.
  - now apply IH.
Qed.

(** [n] hops lead from the speed [a] to [b]. *)
Fixpoint hops M n a b := match n with
  | O => a = b
  | S m => exists c, hops M m a c /\ hop M c b
  end.

(** The fixed points: [alpha*_0 = 0], and the roots of [tan c = c]. *)
Definition fixed_speed c := 0 <= c /\ sin c = c * cos c.

(** The orbit of [a] goes on for ever and converges to [c] from above. *)
Definition converges M a c := forall e, 0 < e -> exists N, forall n, (N <= n)%nat -> exists b, hops M n a b /\ c <= b < c + e.
(** The orbit of [a] ends on the ground. *)
Definition ends_grounded M a := exists n b, hops M n a b /\ grounded M b.

Lemma hops_positive : forall M n a b, 0 < M -> 0 < a -> hops M n a b -> 0 < b <= a.
Proof.
  intros M n a. induction n as [| n IH]; intros b HM Ha H; simpl in H; [subst; lra |].
  destruct H as (c & Hc & Hb). specialize (IH c HM Ha Hc). pose proof (hop_not_above M c b HM (proj1 IH) Hb). lra.
Qed.

Lemma hops_unique : forall M n a b c, 0 < M -> hops M n a b -> hops M n a c -> b = c.
Proof.
  intros M n a. induction n as [| n IH]; intros b c HM Hb Hc; simpl in *; [congruence |].
  destruct Hb as (d & Hd & Hb), Hc as (d' & Hd' & Hc). rewrite (IH d' d HM Hd' Hd) in Hc.
  now apply (moves_unique M 0 d).
Qed.

(** Later speeds of an orbit are not above earlier ones. *)
Lemma hops_decrease : forall M n m a b c, 0 < M -> 0 < a -> (n <= m)%nat -> hops M n a b -> hops M m a c -> c <= b.
Proof.
  intros M n m a b c HM Ha Hnm Hb. revert c. induction Hnm as [| m Hnm IH]; intros c Hc.
  - rewrite (hops_unique M n a c b); lra || assumption.
  - destruct Hc as (d & Hd & Hc). specialize (IH d Hd). pose proof (hops_positive M m a d HM Ha Hd) as Hp.
    pose proof (hop_not_above M d c HM (proj1 Hp) Hc). lra.
Qed.

(** The closing speed depends continuously on half the time of flight. *)
Lemma Gam_continuous : forall h, 0 < h -> continuity_pt Gam h.
Proof.
  intros h Hh. pose proof (D_positive h Hh). apply continuity_pt_filterlim.
  apply (ex_derive_continuous (V := R_NormedModule)). unfold Gam, u, D in *. auto_derive. lra.
Qed.

(** Near a speed that is no fixed point, every hop loses at least a fixed amount. *)
Lemma loss_near : forall M a, 0 < M -> 0 < a -> sin a <> a * cos a -> exists d, 0 < d /\
  forall b b', Rabs (b - a) < d -> 0 < b -> hop M b b' -> b' ^ 2 <= b ^ 2 - d.
Proof.
  intros M a HM Ha Hne. destruct (half_time a Ha) as (h & Hh & EA).
  pose proof (mu_positive M HM) as Hmu.
  assert (Hu : u h <> 0).
  { intro Eu. apply Hne. pose proof (A_minus h Hh) as Em. rewrite Eu, Rmult_0_r in Em.
    unfold Rdiv in Em. rewrite Rmult_0_l in Em. replace a with h by lra. unfold u in Eu. lra. }
  assert (Hg : 0 < Gam h).
  { unfold Gam. apply Rdiv_lt_0_compat; [| now apply D_positive].
    pose proof (pow2_gt_0 (u h) Hu). lra. }
  destruct (Gam_continuous h Hh (Gam h / 2)) as [e [He He']]; [lra |].
  destruct (half_time_continuous h e Hh He) as (d1 & Hd1 & Hd1').
  pose (loss := mu M * (Gam h / 2) ^ 2).
  assert (Hl : 0 < loss) by (apply Rmult_lt_0_compat; [exact Hmu | apply pow_lt; lra]).
  exists (Rmin d1 loss). split; [now apply Rmin_pos |].
  intros b b' Hb Hb0 H. pose proof (Rmin_l d1 loss). pose proof (Rmin_r d1 loss).
  destruct (hop_first_loss M b b' HM H) as (_ & tau & HL & HE).
  apply first_landing in HL; [| exact Hb0]. destruct HL as [Ht EB].
  assert (Hk : Rabs (tau / 2 - h) < e) by (apply Hd1'; [lra | rewrite EB, EA; lra]).
  assert (EG : closing 0 b tau = Gam (tau / 2)).
  { rewrite <- (closing_ground (tau / 2)) by lra. rewrite EB. f_equal. field. }
  rewrite EG in HE.
  assert (HG : Gam h / 2 <= Gam (tau / 2)).
  { destruct (Req_dec (tau / 2) h) as [-> | Hn]; [lra |].
    specialize (He' (tau / 2)). simpl in He'. unfold R_dist, D_x, no_cond in He'.
    assert (Habs : Rabs (Gam (tau / 2) - Gam h) < Gam h / 2).
    { apply He'. split; [split; [exact I | now apply not_eq_sym] | exact Hk]. }
    apply Rabs_def2 in Habs. lra. }
  assert (loss <= mu M * Gam (tau / 2) ^ 2); [| lra].
  apply Rmult_le_compat_l; [lra |]. apply pow_incr. lra.
Qed.

(** Theorem 24: every orbit ends on the ground or converges from above to a fixed point. *)
Theorem fates : forall M a, 0 < M -> 0 < a -> ends_grounded M a \/ exists c, fixed_speed c /\ converges M a c.
Proof.
  intros M a HM Ha. destruct (Classical_Prop.classic (ends_grounded M a)) as [Hg | Hg]; [now left | right].
  assert (Hall : forall n, exists b, hops M n a b).
  { induction n as [| n [b Hb]]; [now exists a |].
    destruct (Classical_Prop.classic (exists c, hop M b c)) as [[c Hc] | Hn]; [exists c; now exists b |].
    exfalso. apply Hg. now exists n, b. }
  (* The limit is the greatest lower bound of the orbit. *)
  destruct (completeness (fun m => exists n b, hops M n a b /\ m = - b)) as [m [Hub Hlub]].
  { exists 0. intros x (n & b & Hb & ->). pose proof (hops_positive M n a b HM Ha Hb). lra. }
  { exists (- a), O, a. now split. }
  pose (c := - m).
  assert (Hlow : forall n b, hops M n a b -> c <= b).
  { intros n b Hb. assert (- b <= m); [| unfold c; lra]. apply Hub. now exists n, b. }
  assert (Hnear : forall e, 0 < e -> exists n b, hops M n a b /\ b < c + e).
  { intros e He. apply Classical_Prop.NNPP. intro Hn. assert (m <= m - e); [| lra].
    apply Hlub. intros x (n & b & Hb & ->). apply Rnot_lt_le. intro Hlt. apply Hn.
    exists n, b. split; [exact Hb |]. unfold c. lra. }
  assert (Hc : 0 <= c).
  { apply Rnot_lt_le. intro Hlt. destruct (Hnear (- c)) as (n & b & Hb & Hbc); [lra |].
    pose proof (hops_positive M n a b HM Ha Hb). lra. }
  exists c. split.
  - split; [exact Hc |]. destruct Hc as [Hc | <-]; [| rewrite sin_0; ring].
    apply Classical_Prop.NNPP. intro Hne. destruct (loss_near M c HM Hc Hne) as (d & Hd & Hloss).
    pose (e := Rmin d (Rmin 1 (d / (2 * c + 2)))).
    assert (He : 0 < e /\ e <= d /\ e <= 1 /\ e * (2 * c + 2) <= d).
    { assert (0 < d / (2 * c + 2)) by (apply Rdiv_lt_0_compat; lra).
      pose proof (Rmin_l d (Rmin 1 (d / (2 * c + 2)))). pose proof (Rmin_r d (Rmin 1 (d / (2 * c + 2)))).
      pose proof (Rmin_l 1 (d / (2 * c + 2))). pose proof (Rmin_r 1 (d / (2 * c + 2))).
      split; [repeat apply Rmin_pos; lra |]. fold e in H0, H1. split; [lra |]. split; [lra |].
      apply Rle_trans with (d / (2 * c + 2) * (2 * c + 2)); [apply Rmult_le_compat_r; lra |].
      right. field. lra. }
    destruct (Hnear e (proj1 He)) as (n & b & Hb & Hbe). destruct (Hall (S n)) as (b' & Hb').
    pose proof (Hlow n b Hb) as H1. pose proof (Hlow (S n) b' Hb') as H2.
    destruct Hb' as (b2 & Hb2 & Hhop). rewrite (hops_unique M n a b2 b HM Hb2 Hb) in Hhop.
    assert (Hq : b' ^ 2 <= b ^ 2 - d).
    { apply Hloss; [rewrite Rabs_right; lra | lra | exact Hhop]. }
    assert (c ^ 2 <= b' ^ 2) by (apply pow_incr; lra).
    assert (b ^ 2 <= (c + e) ^ 2) by (apply pow_incr; lra).
    assert (0 <= e * (1 - e)) by (apply Rmult_le_pos; lra). lra.
  - intros e He. destruct (Hnear e He) as (N & bN & HbN & HNe). exists N. intros n Hn.
    destruct (Hall n) as (b & Hb). exists b. split; [exact Hb |].
    pose proof (Hlow n b Hb). pose proof (hops_decrease M N n a bN b HM Ha Hn HbN Hb). lra.
Qed.

(** * Intervals of one fate *)

Inductive fate := Grounded | To (c : R).

Definition has_fate M a f := match f with Grounded => ends_grounded M a | To c => converges M a c end.

(** A list has intervals [(left, right, fate)]. The speed [a] lies in one of this fate. *)
Definition inside (l : list (R * R * fate)) f a := exists left right, In (left, right, f) l /\ left <= a <= right.

(** One hop leads from the speed [a] into an interval of its fate, or to the ground if that is its fate. *)
Definition hops_inside M l f a := match f with
  | Grounded => forall a', hop M a a' -> inside l f a'
  | To _ => exists a', hop M a a' /\ inside l f a'
  end.

(** A speed that is in no interval has a neighbourhood to its right that meets none. *)
Lemma separated : forall (l : list (R * R * fate)) f c, ~ inside l f c ->
  exists e, 0 < e /\ forall b, c <= b < c + e -> ~ inside l f b.
Proof.
  induction l as [| [[p q] g] l IH]; intros f c Hc.
  - exists 1. split; [lra |]. intros b _ (p & q & [] & _).
  - destruct (IH f c) as (e & He & Hb).
    { intros (p' & q' & Hin & H). apply Hc. exists p', q'. split; [now right | exact H]. }
    assert (Hfirst : exists e', 0 < e' /\ forall b, c <= b < c + e' -> g = f -> ~ p <= b <= q).
    { destruct (Classical_Prop.classic (g = f)) as [-> | Hg]; [| exists 1; split; [lra | now intros]].
      destruct (Rlt_le_dec c p) as [Hp | Hp]; [exists (p - c); split; [lra | intros; lra] |].
      exists 1. split; [lra |]. intros b Hcb _ Hpq. apply Hc. exists p, q. split; [now left | lra]. }
    destruct Hfirst as (e' & He' & Hb').
    exists (Rmin e e'). split; [now apply Rmin_pos |]. intros b Hcb (p' & q' & Hin & H).
    pose proof (Rmin_l e e'). pose proof (Rmin_r e e'). destruct Hin as [E | Hin].
    + injection E as -> -> ->. apply (Hb' b); [lra | reflexivity | exact H].
    + apply (Hb b); [lra |]. now exists p', q'.
Qed.

(** The induction over intervals: if each speed of each interval hops into an interval of its own fate, and if an interval
    contains no fixed point but that of its fate, then every speed has the fate of its interval. *)
Theorem intervals_have_fates : forall M (l : list (R * R * fate)), 0 < M ->
  (forall f a, 0 < a -> inside l f a -> hops_inside M l f a) ->
  (forall f c, fixed_speed c -> inside l f c -> f = To c) ->
  forall f a, 0 < a -> inside l f a -> has_fate M a f.
Proof.
  intros M l HM Hhop Hfix f a Ha Hin.
  assert (Hstay : forall n b, hops M n a b -> inside l f b).
  { induction n as [| n IH]; intros b Hb; simpl in Hb; [now subst |].
    destruct Hb as (c & Hc & Hb). pose proof (hops_positive M n a c HM Ha Hc) as Hpos.
    specialize (Hhop f c (proj1 Hpos) (IH c Hc)). destruct f as [| d]; [now apply Hhop |].
    destruct Hhop as (b' & Hb' & Hi). now rewrite (moves_unique M 0 c b b' HM Hb Hb'). }
  destruct (fates M a HM Ha) as [Hg | (c & Hc & Hconv)].
  - destruct f as [| d]; [exact Hg |]. exfalso. destruct Hg as (n & b & Hb & Hg). apply Hg.
    pose proof (hops_positive M n a b HM Ha Hb) as Hpos.
    destruct (Hhop (To d) b (proj1 Hpos) (Hstay n b Hb)) as (b' & Hb' & _). now exists b'.
  - assert (Hci : inside l f c).
    { apply Classical_Prop.NNPP. intro Hn. destruct (separated l f c Hn) as (e & He & Hsep).
      destruct (Hconv e He) as (N & HN). destruct (HN N (le_n N)) as (b & Hb & Hcb).
      apply (Hsep b Hcb). now apply (Hstay N). }
    rewrite (Hfix f c Hc Hci). exact Hconv.
Qed.

(** An orbit from below a speed stays below it, and does not converge to it. *)
Theorem stays_below : forall M a c, 0 < M -> 0 < a < c -> ~ converges M a c.
Proof.
  intros M a c HM Ha Hc. destruct (Hc 1) as (N & HN); [lra |]. destruct (HN N (le_n N)) as (b & Hb & Hbc).
  pose proof (hops_positive M N a b HM (proj1 Ha) Hb). lra.
Qed.

Lemma hops_after : forall M n a c b, hop M a c -> hops M n c b -> hops M (S n) a b.
Proof.
  intros M n a c. induction n as [| n IH]; intros b Hhop Hb.
  - simpl in Hb. subst. now exists a.
  - destruct Hb as (d & Hd & Hb). exists d. split; [now apply IH | exact Hb].
Qed.

(** A hop does not change the fate. *)
Theorem converges_after_hop : forall M a a' c, hop M a a' -> converges M a' c -> converges M a c.
Proof.
  intros M a a' c Hhop Hc e He. destruct (Hc e He) as (N & HN). exists (S N). intros n Hn.
  destruct n as [| n]; [lia |]. destruct (HN n ltac:(lia)) as (b & Hb & Hbc).
  exists b. split; [now apply hops_after with a' | exact Hbc].
Qed.
