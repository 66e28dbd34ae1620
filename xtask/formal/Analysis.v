(** Facts of real analysis that the model needs: constants, monotone functions, first crossings, oscillators. *)

From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
Open Scope R_scope.

(** A function with a derivative is continuous. *)
Lemma derive_continuity : forall (f : R -> R) t l, is_derive f t l -> continuity_pt f t.
Proof.
  intros f t l H. apply continuity_pt_filterlim.
  apply (ex_derive_continuous (V := R_NormedModule)). now exists l.
Qed.

(** The mean value theorem between two ordered points. *)
Lemma mean_value : forall (f df : R -> R) a b, a < b ->
  (forall t, a <= t <= b -> is_derive f t (df t)) ->
  exists c, a <= c <= b /\ f b - f a = df c * (b - a).
Proof.
  intros f df a b Hab H.
  destruct (MVT_gen f a b df) as [c [Hc E]].
  - intros t Ht. rewrite Rmin_left, Rmax_right in Ht by lra. apply H. lra.
  - intros t Ht. rewrite Rmin_left, Rmax_right in Ht by lra.
    apply derive_continuity with (df t). now apply H.
  - rewrite Rmin_left, Rmax_right in Hc by lra. now exists c.
Qed.

(** A function whose derivative vanishes is constant. *)
Lemma constant : forall (f : R -> R), (forall t, is_derive f t 0) -> forall t, f t = f 0.
Proof.
  intros f H t. destruct (Rtotal_order t 0) as [Ht | [-> | Ht]]; [| reflexivity |].
  - destruct (mean_value f (fun _ => 0) t 0 Ht) as [c [_ E]]; [now intros |]. lra.
  - destruct (mean_value f (fun _ => 0) 0 t Ht) as [c [_ E]]; [now intros |]. lra.
Qed.

(** A function whose derivative is not negative does not fall. *)
Lemma not_falling : forall (f df : R -> R) a b, a <= b ->
  (forall t, a <= t <= b -> is_derive f t (df t)) ->
  (forall t, a <= t <= b -> 0 <= df t) -> f a <= f b.
Proof.
  intros f df a b Hab H Hp. destruct (Req_dec a b) as [-> | Hne]; [lra |].
  destruct (mean_value f df a b) as [c [Hc E]]; [lra | exact H |].
  assert (0 <= df c * (b - a)) by (apply Rmult_le_pos; [now apply Hp | lra]). lra.
Qed.

(** A function whose derivative is not positive does not rise. *)
Lemma not_rising : forall (f df : R -> R) a b, a <= b ->
  (forall t, a <= t <= b -> is_derive f t (df t)) ->
  (forall t, a <= t <= b -> df t <= 0) -> f b <= f a.
Proof.
  intros f df a b Hab H Hp.
  assert (- f a <= - f b); [| lra].
  apply (not_falling (fun t => - f t) (fun t => - df t)); [exact Hab | |].
  - intros t Ht. apply (is_derive_opp (V := R_NormedModule)). now apply H.
  - intros t Ht. specialize (Hp t Ht). lra.
Qed.

(** An oscillator that starts at rest in its centre stays there. *)
Lemma oscillator_rests : forall k (d v : R -> R), 0 < k ->
  (forall t, is_derive d t (v t)) -> (forall t, is_derive v t (- k * d t)) ->
  d 0 = 0 -> v 0 = 0 -> forall t, d t = 0 /\ v t = 0.
Proof.
  intros k d v Hk Hd Hv d0 v0 t.
  assert (E : k * (d t * d t) + v t * v t = 0).
  { rewrite (constant (fun t => k * (d t * d t) + v t * v t)).
    - rewrite d0, v0. ring.
    - intro s. auto_derive.
      + repeat split; eexists; [apply Hd | apply Hd | apply Hv | apply Hv].
      + replace (Derive (fun x => d x) s) with (v s) by (symmetry; apply is_derive_unique; apply Hd).
        replace (Derive (fun x => v x) s) with (- k * d s) by (symmetry; apply is_derive_unique; apply Hv).
        ring. }
  assert (Hs : 0 <= d t * d t) by apply Rle_0_sqr.
  assert (Hw : 0 <= v t * v t) by apply Rle_0_sqr.
  assert (Hp : 0 <= k * (d t * d t)) by (apply Rmult_le_pos; lra).
  assert (Ed : k * (d t * d t) = 0) by lra.
  assert (Ev : v t * v t = 0) by lra.
  split; [| now apply Rsqr_0_uniq].
  apply Rmult_integral in Ed. destruct Ed as [Ek | Ed]; [lra | now apply Rsqr_0_uniq].
Qed.

(** A motion without acceleration that starts at rest at 0 stays there. *)
Lemma free_motion_rests : forall (d v : R -> R),
  (forall t, is_derive d t (v t)) -> (forall t, is_derive v t 0) ->
  d 0 = 0 -> v 0 = 0 -> forall t, d t = 0 /\ v t = 0.
Proof.
  intros d v Hd Hv d0 v0.
  assert (Ev : forall t, v t = 0) by (intro t; rewrite (constant v Hv t); exact v0).
  intro t. split; [| apply Ev].
  rewrite (constant d); [exact d0 |]. intro s. rewrite <- (Ev s). apply Hd.
Qed.

(** A continuous function that is positive at [b] and not at [a] has a last time up to which it is not positive. *)
Lemma first_crossing : forall (f : R -> R) a b, a < b ->
  (forall t, a <= t <= b -> continuity_pt f t) -> f a <= 0 -> 0 < f b ->
  exists c, a <= c < b /\ f c = 0 /\ (forall t, a <= t <= c -> f t <= 0) /\
    (forall e, 0 < e -> exists t, c < t < c + e /\ 0 < f t).
Proof.
  intros f a b Hab Hf Ha Hb.
  pose (E := fun s => a <= s <= b /\ forall t, a <= t <= s -> f t <= 0).
  assert (Ea : E a). { split; [lra |]. intros t Ht. replace t with a by lra. exact Ha. }
  destruct (completeness E) as [c [Hub Hlub]].
  { exists b. intros s [Hs _]. lra. }
  { now exists a. }
  assert (Hac : a <= c) by now apply Hub.
  assert (Hcb : c <= b). { apply Hlub. intros s [Hs _]. lra. }
  assert (Hbelow : forall t, a <= t < c -> f t <= 0).
  { intros t Ht. destruct (Rle_or_lt (f t) 0) as [H | H]; [exact H |]. exfalso.
    assert (c <= t); [| lra]. apply Hlub. intros s [Hs Hs']. apply Rnot_lt_le. intro Hts.
    specialize (Hs' t). lra. }
  assert (Hnear : forall l, l <> f c -> exists d, 0 < d /\ forall t, Rabs (t - c) < d -> Rabs (f t - f c) < Rabs (l - f c)).
  { intros l Hl. destruct (Hf c (conj Hac Hcb) (Rabs (l - f c))) as [d [Hd Hd']].
    { apply Rabs_pos_lt. lra. }
    exists d. split; [exact Hd |]. intros t Ht. destruct (Req_dec t c) as [-> | Hne].
    - rewrite Rminus_eq_0, Rabs_R0. apply Rabs_pos_lt. lra.
    - apply (Hd' t). split; [split; [exact I | now apply not_eq_sym] | exact Ht]. }
  assert (Hc0 : f c <= 0).
  { apply Rnot_lt_le. intro Hpos. destruct (Hnear 0) as [d [Hd Hd']]; [lra |].
    destruct (Req_dec c a) as [-> | Hne]; [lra |].
    pose (t := Rmax a (c - d / 2)).
    assert (Ht : a <= t < c /\ c - t < d). { unfold t, Rmax. destruct (Rle_dec a (c - d/2)); lra. }
    specialize (Hd' t). specialize (Hbelow t (proj1 Ht)).
    assert (H : Rabs (t - c) < d) by (rewrite Rabs_left1; lra). specialize (Hd' H).
    rewrite (Rabs_left1 (0 - f c)) in Hd' by lra. rewrite Rabs_left1 in Hd'; lra. }
  assert (Hcb' : c < b). { destruct (Req_dec c b) as [-> | ?]; lra. }
  assert (Hall : forall t, a <= t <= c -> f t <= 0).
  { intros t Ht. destruct (Req_dec t c) as [-> | Hne]; [exact Hc0 | apply Hbelow; lra]. }
  assert (Hafter : forall e, 0 < e -> exists t, c < t < c + e /\ 0 < f t).
  { intros e He. pose (s := Rmin b (c + e / 2)).
    assert (Hs : c < s < c + e /\ s <= b). { unfold s, Rmin. destruct (Rle_dec b (c + e/2)); lra. }
    destruct (Classical_Prop.classic (exists t, c < t < c + e /\ 0 < f t)) as [H | H]; [exact H |].
    exfalso. assert (s <= c); [| lra]. apply Hub. split; [lra |]. intros t Ht.
    destruct (Rle_or_lt t c) as [Htc | Htc]; [now apply Hall |].
    apply Rnot_lt_le. intro Hp. apply H. exists t. split; [lra | exact Hp]. }
  exists c. split; [lra |]. split; [| now split].
  apply Rle_antisym; [exact Hc0 |]. apply Rnot_lt_le. intro Hneg.
  destruct (Hnear 0) as [d [Hd Hd']]; [lra |].
  destruct (Hafter d Hd) as [t [Ht Hp]]. specialize (Hd' t).
  assert (H : Rabs (t - c) < d) by (rewrite Rabs_right; lra). specialize (Hd' H).
  rewrite (Rabs_right (0 - f c)) in Hd' by lra. rewrite Rabs_right in Hd'; lra.
Qed.

(** Where a function is 0 and positive at times just after, its derivative is not negative. *)
Lemma derivative_at_crossing : forall (f : R -> R) c l, is_derive f c l -> f c = 0 ->
  (forall e, 0 < e -> exists t, c < t < c + e /\ 0 < f t) -> 0 <= l.
Proof.
  intros f c l Hd Hc Hafter. apply Rnot_lt_le. intro Hl.
  apply is_derive_Reals in Hd. destruct (Hd (- l)) as [d Hd']; [lra |].
  destruct (Hafter d (cond_pos d)) as [t [Ht Hp]].
  specialize (Hd' (t - c)). replace (c + (t - c)) with t in Hd' by ring. rewrite Hc in Hd'.
  assert (H : Rabs ((f t - 0) / (t - c) - l) < - l).
  { apply Hd'; [lra |]. rewrite Rabs_right; lra. }
  apply Rabs_def2 in H. assert (0 < (f t - 0) / (t - c)) by (apply Rdiv_lt_0_compat; lra). lra.
Qed.

(** A continuous function that is positive at [a] and negative at [b] has a first zero between. *)
Lemma first_zero : forall (f : R -> R) a b, a < b ->
  (forall t, a <= t <= b -> continuity_pt f t) -> 0 < f a -> f b < 0 ->
  exists c, a < c < b /\ f c = 0 /\ forall t, a <= t < c -> 0 < f t.
Proof.
  intros f a b Hab Hf Ha Hb.
  assert (Hnear : forall c, a <= c <= b -> f c <> 0 ->
      exists d, 0 < d /\ forall t, Rabs (t - c) < d -> Rabs (f t - f c) < Rabs (f c)).
  { intros c Hc Hne. destruct (Hf c Hc (Rabs (f c))) as [d [Hd Hd']]; [now apply Rabs_pos_lt |].
    exists d. split; [exact Hd |]. intros t Ht. destruct (Req_dec t c) as [-> | Hn].
    - rewrite Rminus_eq_0, Rabs_R0. now apply Rabs_pos_lt.
    - apply (Hd' t). split; [split; [exact I | now apply not_eq_sym] | exact Ht]. }
  pose (E := fun s => a <= s <= b /\ forall t, a <= t <= s -> 0 < f t).
  destruct (completeness E) as [c [Hub Hlub]].
  { exists b. intros s [Hs _]. lra. }
  { exists a. split; [lra |]. intros t Ht. now replace t with a by lra. }
  assert (Hac : a <= c). { apply Hub. split; [lra |]. intros t Ht. now replace t with a by lra. }
  assert (Hcb : c <= b). { apply Hlub. intros s [Hs _]. lra. }
  assert (Hbelow : forall t, a <= t < c -> 0 < f t).
  { intros t Ht. apply Rnot_le_lt. intro H. assert (c <= t); [| lra].
    apply Hlub. intros s [Hs Hs']. apply Rnot_lt_le. intro Hts. specialize (Hs' t). lra. }
  assert (Ec : f c = 0).
  { destruct (Req_dec (f c) 0) as [E0 | Hne]; [exact E0 | exfalso].
    destruct (Hnear c (conj Hac Hcb) Hne) as (d & Hd & Hd'). destruct (Rlt_le_dec 0 (f c)) as [Hp | Hp].
    - assert (Hcb' : c < b) by (destruct (Req_dec c b) as [-> | ?]; lra).
      pose (s := Rmin b (c + d / 2)).
      assert (Hs : c < s <= b /\ s < c + d). { unfold s, Rmin. destruct (Rle_dec b (c + d / 2)); lra. }
      assert (s <= c); [| lra]. apply Hub. split; [lra |]. intros t Ht.
      destruct (Rlt_le_dec t c) as [Htc | Htc]; [now apply Hbelow |].
      specialize (Hd' t). rewrite (Rabs_right (f c)) in Hd' by lra.
      assert (H : Rabs (t - c) < d) by (rewrite Rabs_right; lra). specialize (Hd' H).
      apply Rabs_def2 in Hd'. lra.
    - assert (Hac' : a < c) by (destruct (Req_dec a c) as [<- | ?]; lra).
      pose (t := Rmax a (c - d / 2)).
      assert (Ht : a <= t < c /\ c - t < d). { unfold t, Rmax. destruct (Rle_dec a (c - d / 2)); lra. }
      specialize (Hbelow t (proj1 Ht)). specialize (Hd' t). rewrite (Rabs_left1 (f c)) in Hd' by lra.
      assert (H : Rabs (t - c) < d) by (rewrite Rabs_left1; lra). specialize (Hd' H).
      apply Rabs_def2 in Hd'. lra. }
  exists c. split; [| now split].
  split; [destruct (Req_dec a c) as [<- | ?] | destruct (Req_dec c b) as [-> | ?]]; lra.
Qed.
