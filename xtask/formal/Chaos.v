(** Covering relations of plane maps with one expanding direction: every allowed sequence of sets is followed by an orbit.
    The proof follows paths across the sets, and needs the intermediate value theorem only. *)

From Coq Require Import Reals Lra Lia.
From Coquelicot Require Import Coquelicot.
From Hopper Require Import Analysis.
Open Scope R_scope.

Definition point := (R * R)%type.

(** A parallelogram: its centre, and the halves of its unstable and of its stable side. *)
Record hset := { cx : R; cy : R; ux : R; uy : R; sx : R; sy : R }.

Definition det N := ux N * sy N - uy N * sx N.
(** The coordinates of a point along the unstable and the stable side. *)
Definition P N (z : point) := ((fst z - cx N) * sy N - (snd z - cy N) * sx N) / det N.
Definition Q N (z : point) := (ux N * (snd z - cy N) - uy N * (fst z - cx N)) / det N.
Definition inside N z := -1 <= P N z <= 1 /\ -1 <= Q N z <= 1.

(** [f] maps [N] across [K]: the two unstable ends leave [K] on opposite sides, and what is between them stays between the
    stable ends of [K]. *)
Definition covers (f : point -> point) N K := exists g, (g = 1 \/ g = -1) /\ forall z, inside N z ->
  (P N z = -1 -> g * P K (f z) < -1) /\ (P N z = 1 -> 1 < g * P K (f z)) /\
  (-1 <= P K (f z) <= 1 -> -1 <= Q K (f z) <= 1).

Definition continuous_path (c : R -> point) := continuity (fun t => fst (c t)) /\ continuity (fun t => snd (c t)).

(** The path crosses [N] from one unstable end to the other one. *)
Definition crosses N (c : R -> point) a b := a < b /\ (forall t, a <= t <= b -> inside N (c t)) /\
  exists g, (g = 1 \/ g = -1) /\ P N (c a) = - g /\ P N (c b) = g.

Lemma P_continuous : forall N c, continuous_path c -> continuity (fun t => P N (c t)).
Proof.
  intros N c [Hx Hy] t. unfold P.
  apply (continuity_pt_mult (fun t => (fst (c t) - cx N) * sy N - (snd (c t) - cy N) * sx N) (fun _ => / det N)).
  - apply (continuity_pt_minus (fun t => (fst (c t) - cx N) * sy N) (fun t => (snd (c t) - cy N) * sx N)).
    + apply (continuity_pt_mult (fun t => fst (c t) - cx N) (fun _ => sy N)); [| apply continuity_pt_const; now intros ? ?].
      apply (continuity_pt_minus (fun t => fst (c t)) (fun _ => cx N)); [apply Hx | apply continuity_pt_const; now intros ? ?].
    + apply (continuity_pt_mult (fun t => snd (c t) - cy N) (fun _ => sx N)); [| apply continuity_pt_const; now intros ? ?].
      apply (continuity_pt_minus (fun t => snd (c t)) (fun _ => cy N)); [apply Hy | apply continuity_pt_const; now intros ? ?].
  - apply continuity_pt_const. now intros ? ?.
Qed.

Lemma Q_continuous : forall N c, continuous_path c -> continuity (fun t => Q N (c t)).
Proof.
  intros N c [Hx Hy].
  (* The second coordinate is the first one of the parallelogram with its sides exchanged. *)
  pose (K := {| cx := cx N; cy := cy N; ux := sx N; uy := sy N; sx := ux N; sy := uy N |}).
  assert (E : forall z, P K z = Q N z).
  { intro z. unfold P, Q, K, det. simpl. replace (sx N * uy N - sy N * ux N) with (- (ux N * sy N - uy N * sx N)) by ring.
    unfold Rdiv. rewrite Rinv_opp. ring. }
  intro t. apply (continuity_pt_locally_ext (fun t => P K (c t)) _ 1); [lra | intros; apply E |].
  now apply P_continuous.
Qed.

(** A part of the way on which a continuous function goes from -1 to 1 and stays between. *)
Lemma crossing_part : forall (g : R -> R) a b, a < b -> continuity g -> g a < -1 -> 1 < g b ->
  exists a' b', a <= a' /\ a' < b' /\ b' <= b /\ g a' = -1 /\ g b' = 1 /\ forall t, a' <= t <= b' -> -1 <= g t <= 1.
Proof.
  intros g a b Hab Hg Ha Hb.
  assert (Hshift : forall (k : R -> R) c, continuity k -> continuity (fun t => c + k t)).
  { intros k c Hk t. apply (continuity_pt_plus (fun _ => c) k); [apply continuity_pt_const; now intros ? ? | apply Hk]. }
  destruct (first_zero (fun t => 1 + - g t) a b Hab) as (b' & Hb' & Eb & Hbelow).
  { intros t _. apply (Hshift (fun t => - g t)). intro s. apply (continuity_pt_opp g). apply Hg. }
  { lra. }
  { lra. }
  destruct (first_zero (fun s => 1 + g (b' - s)) 0 (b' - a)) as (c & Hc & Ec & Habove).
  - lra.
  - intros t _. apply (Hshift (fun s => g (b' - s))). intro s.
    apply (continuity_pt_comp (fun s => b' - s) g); [| apply Hg].
    apply (continuity_pt_minus (fun _ => b') (fun s => s));
      [apply continuity_pt_const; now intros ? ? | apply derivable_continuous_pt, derivable_pt_id].
  - replace (b' - 0) with b' by ring. lra.
  - replace (b' - (b' - a)) with a by ring. lra.
  - exists (b' - c), b'. repeat split; try lra.
    + destruct (Req_dec t (b' - c)) as [-> | Hn]; [lra |].
      specialize (Habove (b' - t) ltac:(lra)). replace (b' - (b' - t)) with t in Habove by ring. lra.
    + destruct (Req_dec t b') as [-> | Hn]; [lra |]. specialize (Hbelow t ltac:(lra)). lra.
Qed.

Section Itineraries.

Variable f : point -> point.
Hypothesis f_continuous : forall c, continuous_path c -> continuous_path (fun t => f (c t)).

(** A path across a set has a part whose image crosses each set that is covered. *)
Lemma cross_next : forall N K c a b, covers f N K -> continuous_path c -> crosses N c a b ->
  exists a' b', a <= a' /\ b' <= b /\ crosses K (fun t => f (c t)) a' b'.
Proof.
  intros N K c a b (g & Hg & Hcov) Hc (Hab & Hin & h & Hh & Ea & Eb).
  assert (Hcont : continuity (fun t => (h * g) * P K (f (c t)))).
  { intro t. apply (continuity_pt_mult (fun _ => h * g) (fun t => P K (f (c t))));
      [apply continuity_pt_const; now intros ? ? |]. apply (P_continuous K). now apply f_continuous. }
  destruct (Hcov _ (Hin a ltac:(lra))) as (Ha1 & Ha2 & _). destruct (Hcov _ (Hin b ltac:(lra))) as (Hb1 & Hb2 & _).
  destruct (crossing_part _ a b Hab Hcont) as (a' & b' & H1 & H2 & H3 & E1 & E2 & Hbetween).
  - destruct Hh as [-> | ->]; [specialize (Ha1 ltac:(lra)) | specialize (Ha2 ltac:(lra))]; lra.
  - destruct Hh as [-> | ->]; [specialize (Hb2 ltac:(lra)) | specialize (Hb1 ltac:(lra))]; lra.
  - exists a', b'. split; [exact H1 |]. split; [exact H3 |]. split; [exact H2 |].
    assert (Hhg : (h * g = 1 /\ (h * g) * (h * g) = 1) \/ (h * g = -1 /\ (h * g) * (h * g) = 1)).
    { destruct Hh as [-> | ->], Hg as [-> | ->]; lra. }
    split.
    + intros t Ht. specialize (Hbetween t Ht).
      assert (HP : -1 <= P K (f (c t)) <= 1). { destruct Hhg as [[E _] | [E _]]; rewrite E in Hbetween; lra. }
      split; [exact HP |]. apply (Hcov _ (Hin t ltac:(lra))). exact HP.
    + exists (h * g). split; [destruct Hhg as [[-> _] | [-> _]]; auto |].
      destruct Hhg as [[E _] | [E _]]; rewrite E in *; lra.
Qed.

Fixpoint iterate n z := match n with O => z | S m => f (iterate m z) end.

Lemma iterate_continuous : forall n c, continuous_path c -> continuous_path (fun t => iterate n (c t)).
Proof. induction n as [| n IH]; intros c Hc; simpl; [exact Hc |]. apply f_continuous. now apply IH. Qed.

(** The straight path across the middle of a set. *)
Definition middle N t : point := (cx N + (2 * t - 1) * ux N, cy N + (2 * t - 1) * uy N).

Lemma middle_crosses : forall N, det N <> 0 -> continuous_path (middle N) /\ crosses N (middle N) 0 1.
Proof.
  intros N Hd.
  assert (E : forall t, P N (middle N t) = 2 * t - 1 /\ Q N (middle N t) = 0).
  { intro t. unfold P, Q, middle, det in *. simpl. split; field; exact Hd. }
  split.
  - split; intro t; simpl; (eapply derive_continuity; auto_derive; [exact I | reflexivity]).
  - split; [lra |]. split.
    + intros t Ht. unfold inside. destruct (E t) as [-> ->]. lra.
    + exists 1. split; [now left |]. rewrite (proj1 (E 0)), (proj1 (E 1)). lra.
Qed.

(** Every sequence of sets of which each covers the next one is followed by an orbit. *)
Theorem itineraries : forall N : nat -> hset, det (N O) <> 0 -> (forall n, covers f (N n) (N (S n))) ->
  exists z, forall n, inside (N n) (iterate n z).
Proof.
  intros N Hd Hcov. destruct (middle_crosses (N O) Hd) as [Hc Hcross]. set (c := middle (N O)) in *.
  pose (good := fun n t => 0 <= t <= 1 /\ forall k, (k <= n)%nat -> inside (N k) (iterate k (c t))).
  assert (Hpart : forall n, exists a b, 0 <= a /\ b <= 1 /\ crosses (N n) (fun t => iterate n (c t)) a b /\
      forall t, a <= t <= b -> good n t).
  { induction n as [| n (a & b & Ha & Hb & Hab & Hgood)].
    - exists 0, 1. split; [lra |]. split; [lra |]. split; [exact Hcross |].
      intros t Ht. split; [exact Ht |]. intros k Hk. replace k with O by lia. now apply Hcross.
    - destruct (cross_next (N n) (N (S n)) _ a b (Hcov n) (iterate_continuous n c Hc) Hab)
        as (a' & b' & Ha' & Hb' & Hab').
      exists a', b'. split; [lra |]. split; [lra |]. split; [exact Hab' |].
      intros t Ht. destruct (Hgood t ltac:(lra)) as [H01 Hk]. split; [exact H01 |].
      intros k Hkn. destruct (Nat.eq_dec k (S n)) as [-> | Hne]; [now apply Hab' | apply Hk; lia]. }
  assert (Hex : forall n, exists t, good n t).
  { intro n. destruct (Hpart n) as (a & b & _ & _ & (Hab & _) & Hg). exists a. apply Hg. lra. }
  (* The largest lower bound of all these sets of times lies in each of them, because they are closed. *)
  destruct (completeness (fun x => exists n, forall t, good n t -> x <= t)) as [m [Hub Hlub]].
  { exists 1. intros x (n & Hn). destruct (Hex n) as [t Ht]. specialize (Hn t Ht). destruct Ht. lra. }
  { exists 0, O. intros t [Ht _]. lra. }
  exists (c m). intro n. apply Classical_Prop.NNPP. intro Hout.
  assert (Hfar : exists e, 0 < e /\ forall t, Rabs (t - m) < e -> ~ inside (N n) (iterate n (c t))).
  { assert (Hsep : forall g : R -> R, continuity g -> ~ -1 <= g m <= 1 ->
        exists e, 0 < e /\ forall t, Rabs (t - m) < e -> ~ -1 <= g t <= 1).
    { intros g Hg Hm. pose (r := Rabs (g m) - 1).
      assert (Hr : 0 < r). { unfold r, Rabs. destruct (Rcase_abs (g m)); lra. }
      destruct (Hg m r Hr) as [e [He He']]. exists e. split; [exact He |]. intros t Ht Hin.
      destruct (Req_dec t m) as [-> | Hne]; [contradiction |].
      assert (H : Rabs (g t - g m) < r).
      { apply (He' t). split; [split; [exact I | now apply not_eq_sym] | exact Ht]. }
      unfold r in H. apply Rabs_def2 in H. unfold Rabs in H. destruct (Rcase_abs (g m)); lra. }
    destruct (Classical_Prop.not_and_or _ _ Hout) as [H | H].
    - destruct (Hsep _ (P_continuous (N n) _ (iterate_continuous n c Hc)) H) as (e & He & Hs).
      exists e. split; [exact He |]. intros t Ht [Hp _]. now apply (Hs t Ht).
    - destruct (Hsep _ (Q_continuous (N n) _ (iterate_continuous n c Hc)) H) as (e & He & Hs).
      exists e. split; [exact He |]. intros t Ht [_ Hp]. now apply (Hs t Ht). }
  destruct Hfar as (e & He & Hfar).
  destruct (Classical_Prop.classic (exists x k, m - e / 2 < x /\ forall t, good k t -> x <= t)) as [(x & k & Hx & Hk) | Hno].
  - assert (m + e / 2 <= m); [| lra]. apply Hub. exists (max n k). intros t [H01 Ht].
    assert (Hkt : x <= t). { apply Hk. split; [exact H01 |]. intros j Hj. apply Ht. lia. }
    apply Rnot_lt_le. intro Hlt. apply (Hfar t); [apply Rabs_def1; lra |]. apply Ht. lia.
  - assert (m <= m - e / 2); [| lra]. apply Hlub. intros x (k & Hk). apply Rnot_lt_le. intro Hlt. apply Hno.
    now exists x, k.
Qed.

End Itineraries.
