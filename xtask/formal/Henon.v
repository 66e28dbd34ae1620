(** A horseshoe of the Henon map with a = 1.4 and b = 0.3. Seven parallelograms lie around the fixed point and along an
    orbit that leaves it and comes back. Each of eight covering relations is proved from signs by the [interval] tactic. *)

From Coq Require Import Reals Lra Lia.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Tactic.
From Hopper Require Import Analysis Chaos Signs.
Open Scope R_scope.

Definition henon (z : point) : point := (1 - 1.4 * fst z ^ 2 + snd z, 0.3 * fst z).

Lemma henon_continuous : forall c, continuous_path c -> continuous_path (fun t => henon (c t)).
Proof.
  intros c [Hx Hy]. split; intro t; unfold henon; simpl.
  - apply (continuity_pt_plus (fun t => 1 - 1.4 * (fst (c t) * (fst (c t) * 1))) (fun t => snd (c t))); [| apply Hy].
    apply (continuity_pt_minus (fun _ => 1) (fun t => 1.4 * (fst (c t) * (fst (c t) * 1))));
      [apply continuity_pt_const; now intros ? ? |].
    apply (continuity_pt_mult (fun _ => 1.4) (fun t => fst (c t) * (fst (c t) * 1)));
      [apply continuity_pt_const; now intros ? ? |].
    apply (continuity_pt_mult (fun t => fst (c t)) (fun t => fst (c t) * 1)); [apply Hx |].
    apply (continuity_pt_mult (fun t => fst (c t)) (fun _ => 1)); [apply Hx | apply continuity_pt_const; now intros ? ?].
  - apply (continuity_pt_mult (fun _ => 0.3) (fun t => fst (c t))); [apply continuity_pt_const; now intros ? ? | apply Hx].
Qed.

(** The set 0 lies around the fixed point. *)
Definition set i := match i with
  | 0 => {| cx := 0.631354; cy := 0.189406; ux := 0.064224; uy := -0.010015; sx := 0.057653; sy := 0.11091 |}
  | 1 => {| cx := 0.527908; cy := 0.204927; ux := -0.007492; uy := 0.001083; sx := -0.017571; sy := -0.027933 |}
  | 2 => {| cx := 0.814765; cy := 0.158373; ux := 0.010303; uy := -0.001905; sx := -0.00268; sy := -0.007206 |}
  | 3 => {| cx := 0.228994; cy := 0.244429; ux := -0.021533; uy := 0.002619; sx := -0.001622; sy := -0.001195 |}
  | 4 => {| cx := 1.171016; cy := 0.068698; ux := 0.01392; uy := -0.005474; sx := -0.00045; sy := -0.00141 |}
  | 5 => {| cx := -0.851092; cy := 0.351305; ux := -0.043319; uy := 0.003539; sx := 0.000247; sy := -0.000522 |}
  | _ => {| cx := 0.337204; cy := -0.255328; ux := -0.084485; uy := -0.011013; sx := 0.002226; sy := 0.002449 |}
  end%nat.

(** The point of a set with the coordinates [p] and [q]. *)
Definition at_ N p q : point := (cx N + p * ux N + q * sx N, cy N + p * uy N + q * sy N).

Lemma coordinates : forall N z, det N <> 0 -> z = at_ N (P N z) (Q N z).
Proof.
  intros N [x y] Hd. unfold at_, P, Q, det in *. simpl. f_equal; field; exact Hd.
Qed.

Lemma det_set : forall i, det (set i) <> 0.
Proof. do 7 (destruct i as [| i]; [unfold det, set; simpl; lra |]). unfold det, set. simpl. lra. Qed.

(** A covering relation from inequalities in the coordinates. *)
Lemma covers_by_signs : forall N K g, det N <> 0 -> g = 1 \/ g = -1 ->
  (forall q, -1 <= q <= 1 -> g * P K (henon (at_ N (-1) q)) < -1 /\ 1 < g * P K (henon (at_ N 1 q))) ->
  (forall p q, -1 <= p <= 1 -> -1 <= q <= 1 -> -1 <= P K (henon (at_ N p q)) <= 1 ->
     -1 <= Q K (henon (at_ N p q)) <= 1) ->
  covers henon N K.
Proof.
  intros N K g Hd Hg Hends Hbetween. exists g. split; [exact Hg |]. intros z [Hp Hq].
  pose proof (coordinates N z Hd) as E. split; [| split].
  - intro Ep. rewrite E, Ep. now apply Hends.
  - intro Ep. rewrite E, Ep. now apply Hends.
  - rewrite E. now apply Hbetween.
Qed.

Ltac values := unfold P, Q, henon, at_, det, set; simpl.
Ltac ends := intros q Hq; split; values; interval with (i_prec 60, i_bisect q).
Ltac sides := intros p q Hp Hq _; split; values; interval with (i_prec 60, i_bisect p, i_bisect q).

Lemma covers_00 : covers henon (set 0) (set 0).
Proof. apply (covers_by_signs _ _ (-1)); [apply det_set | now right | ends | sides]. Qed.

(** Only a part of the set 0 comes near the set 1. *)
Lemma covers_01 : covers henon (set 0) (set 1).
Proof.
  apply (covers_by_signs _ _ 1); [apply det_set | now left | ends |].
  intros p q Hp Hq Hin. destruct (Rle_or_lt p 0.5) as [H | H].
  - exfalso. revert Hin. assert (P (set 1) (henon (at_ (set 0) p q)) < -1); [| lra].
    values. interval with (i_prec 60, i_bisect p, i_bisect q).
  - split; values; interval with (i_prec 60, i_bisect p, i_bisect q).
Qed.

Lemma covers_12 : covers henon (set 1) (set 2).
Proof. apply (covers_by_signs _ _ 1); [apply det_set | now left | ends | sides]. Qed.

Lemma covers_23 : covers henon (set 2) (set 3).
Proof. apply (covers_by_signs _ _ 1); [apply det_set | now left | ends | sides]. Qed.

Lemma covers_34 : covers henon (set 3) (set 4).
Proof. apply (covers_by_signs _ _ 1); [apply det_set | now left | ends | sides]. Qed.

Lemma covers_45 : covers henon (set 4) (set 5).
Proof. apply (covers_by_signs _ _ 1); [apply det_set | now left | ends | sides]. Qed.

Lemma covers_56 : covers henon (set 5) (set 6).
Proof. apply (covers_by_signs _ _ 1); [apply det_set | now left | ends | sides]. Qed.

Lemma covers_60 : covers henon (set 6) (set 0).
Proof. apply (covers_by_signs _ _ 1); [apply det_set | now left | ends | sides]. Qed.

(** The steps of the graph: from 0 to 0 or 1, from 1 to 6 upwards, from 6 to 0. *)
Definition step i j := match i with
  | 0 => j = 0 \/ j = 1
  | 1 | 2 | 3 | 4 | 5 => j = S i
  | 6 => j = 0
  | _ => False
  end%nat.

Lemma steps_cover : forall i j, step i j -> covers henon (set i) (set j).
Proof.
  intros i j H. destruct i as [| [| [| [| [| [| [| i]]]]]]]; simpl in H; [destruct H | | | | | | | contradiction]; subst j.
  - exact covers_00.
  - exact covers_01.
  - exact covers_12.
  - exact covers_23.
  - exact covers_34.
  - exact covers_45.
  - exact covers_56.
  - exact covers_60.
Qed.

(** Every walk in the graph is followed by an orbit of the Henon map. *)
Theorem walks_are_followed : forall w : nat -> nat, (forall n, step (w n) (w (S n))) ->
  exists z, forall n, inside (set (w n)) (iterate henon n z).
Proof.
  intros w Hw. apply (itineraries henon henon_continuous (fun n => set (w n))); [apply det_set |].
  intro n. now apply steps_cover.
Qed.

(** The sets 0 and 1 have no common point. *)
Lemma disjoint_01 : forall z, inside (set 0) z -> inside (set 1) z -> False.
Proof.
  intros z [H0 _] [Hp Hq]. rewrite (coordinates (set 1) z (det_set 1)) in H0.
  set (p := P (set 1) z) in *. set (q := Q (set 1) z) in *. clearbody p q.
  assert (P (set 0) (at_ (set 1) p q) < -1); [| lra].
  values. interval with (i_prec 60, i_bisect p, i_bisect q).
Qed.

(** Different walks that start in 0 are followed by different orbits. *)
Theorem walks_differ : forall w v : nat -> nat, w O = O -> v O = O ->
  (forall n, step (w n) (w (S n))) -> (forall n, step (v n) (v (S n))) ->
  forall z, (forall n, inside (set (w n)) (iterate henon n z)) -> (forall n, inside (set (v n)) (iterate henon n z)) ->
  forall n, w n = v n.
Proof.
  intros w v Ew Ev Hw Hv z Iw Iv. induction n as [| n IH]; [congruence |].
  specialize (Hw n). specialize (Hv n). rewrite IH in Hw. specialize (Iw (S n)). specialize (Iv (S n)).
  destruct (v n) as [| [| [| [| [| [| [| k]]]]]]]; simpl in Hw, Hv; try congruence; try contradiction.
  destruct Hw as [Hw | Hw], Hv as [Hv | Hv]; rewrite Hw, Hv in *; try reflexivity;
    exfalso; now apply (disjoint_01 (iterate henon (S n) z)).
Qed.

(** A horseshoe of the seventh iterate: each binary sequence is followed. At the times [7 k] the orbit is in the set 0, and
    one step later in the set 0 or 1, as the sequence says. *)
Theorem binary_sequences : forall b : nat -> bool, exists z, forall k,
  inside (set 0) (iterate henon (7 * k) z) /\ inside (set (if b k then 1 else 0)) (iterate henon (7 * k + 1) z).
Proof.
  intro b. pose (w := fun n => if b (n / 7)%nat then (n mod 7)%nat else O).
  assert (Hw : forall n, step (w n) (w (S n))).
  { intro n. unfold w. pose proof (Nat.div_mod n 7 ltac:(lia)) as E. pose proof (Nat.mod_upper_bound n 7 ltac:(lia)) as H.
    set (q := (n / 7)%nat) in *. set (r := (n mod 7)%nat) in *.
    destruct (Nat.eq_dec r 6) as [Hr | Hr].
    - replace (S n / 7)%nat with (S q) by (apply (Nat.div_unique _ _ _ 0); lia).
      replace (S n mod 7)%nat with 0%nat by (apply (Nat.mod_unique _ _ (S q)); lia).
      rewrite Hr. destruct (b q), (b (S q)); simpl; auto.
    - replace (S n / 7)%nat with q by (apply (Nat.div_unique _ _ _ (S r)); lia).
      replace (S n mod 7)%nat with (S r) by (apply (Nat.mod_unique _ _ q); lia).
      destruct (b q); [| simpl; auto].
      destruct r as [| [| [| [| [| [| r]]]]]]; simpl; auto; lia. }
  destruct (walks_are_followed w Hw) as [z Hz]. exists z. intro k. split.
  - specialize (Hz (7 * k)%nat). unfold w in Hz.
    replace (7 * k mod 7)%nat with 0%nat in Hz by (apply (Nat.mod_unique _ _ k); lia).
    now destruct (b (7 * k / 7)%nat).
  - specialize (Hz (7 * k + 1)%nat). unfold w in Hz.
    replace ((7 * k + 1) / 7)%nat with k in Hz by (apply (Nat.div_unique _ _ _ 1); lia).
    now replace ((7 * k + 1) mod 7)%nat with 1%nat in Hz by (apply (Nat.mod_unique _ _ k); lia).
Qed.
