(* Inequalities between sums of products, and what follows from differential inequalities. Everything here is proved. *)

(* A sum of products, of which each factor is not negative: known so, or by its structure. *)
Ltac nonneg_sum :=
  lazymatch goal with
  | |- 0 <= _ + _ => apply Rplus_le_le_0_compat; nonneg_sum
  | |- 0 <= _ * _ => apply Rmult_le_pos; nonneg_sum
  | |- _ => first [ assumption | sign ]
  end.
Ltac chain_as e :=
  to_difference; lazymatch goal with |- 0 <= ?d => replace d with e; [ nonneg_sum | symmetry ] end.

Lemma minus_nonneg : forall a b, a <= b -> 0 <= b - a.
Proof. intros; lra. Qed.
Lemma ln_minus_nonneg : forall a b, 0 < a -> a <= b -> 0 <= ln b - ln a.
Proof. intros a b P [L | E]; [apply minus_nonneg; left; apply ln_increasing; assumption | subst; lra]. Qed.
Ltac fact a b := assert (0 <= b - a) by (apply minus_nonneg; first [ assumption | lra ]).
Ltac log_fact a b :=
  assert (0 <= ln b - ln a) by (apply ln_minus_nonneg; [ sign | first [ assumption | lra | quickly ] ]).
Ltac log_fact_as a b e := assert (0 <= ln b - ln a) by (apply ln_minus_nonneg; [ sign | chain_as e; rational ]).
Ltac log_exp x e := assert (0 <= ln x - ln 1) by
  (rewrite ln_exp, ln_1, Rminus_0_r; lazymatch goal with |- 0 <= ?d => replace d with e by rational end; nonneg_sum).
(* a <= b, since the logarithm of b / a is the sum e of what is not negative. *)
Ltac below_by_logarithms a b e :=
  assert (0 <= b - a);
  [ apply minus_nonneg; by_logarithms; apply Rminus_le_0; replace (ln b - ln a) with e;
    [ nonneg_sum | symmetry; logarithms; rational ]
  | ].
Ltac put_value x := match goal with
  | E : ?a = ?b |- _ => constr_eq a x; is_var x; rewrite E
  | E : ?b = ?a |- _ => constr_eq a x; is_var x; rewrite <- E
  end.
(* A variable that is not negative, as the square of its root. *)
Ltac by_root x :=
  let r := fresh "r" in let E := fresh in
  assert (E : sqrt x * sqrt x = x) by (apply sqrt_sqrt; sign);
  assert (0 <= sqrt x) by apply sqrt_pos;
  try (assert (0 < sqrt x) by (apply sqrt_lt_R0; sign));
  generalize dependent (sqrt x); intros r; intros; subst x.

(* What is below a power, and what a power is below. *)
Lemma below_power : forall x e q r, 0 <= x -> 0 < r -> 0 < e -> q * e = 1 -> rpow x e <= r -> x <= Rpower r q.
Proof.
  intros x e q r [X | X] P E I L.
  - rewrite rpow_Rpower in L by assumption. apply ln_le_inv; [assumption | apply exp_pos |].
    rewrite ln_Rpower. apply ln_le in L; [|apply exp_pos]. rewrite ln_Rpower in L.
    assert (0 < q) by (apply Rmult_lt_reg_r with e; lra).
    replace (ln x) with (q * (e * ln x)) by (rewrite <- Rmult_assoc, I; ring).
    apply Rmult_le_compat_l; lra.
  - subst x. left. apply exp_pos.
Qed.
Ltac raised_bound x e q r := assert (x <= Rpower r q) by (apply (below_power x e q r); [ sign | sign | sign | rational | lra ]).

(* Differential inequalities. *)
Lemma constant : forall c s : R, is_derive (fun _ : R => c) s 0.
Proof. intros. auto_derive; [exact I | ring]. Qed.

(* D <= 0 stays so if D does not grow where it is positive. *)
Lemma stays_below : forall (D G : R -> R) p q, p <= q ->
  (forall s, p <= s <= q -> is_derive D s (G s)) -> D p <= 0 ->
  (forall s, p <= s <= q -> 0 < D s -> G s <= 0) -> D q <= 0.
Proof.
  intros D G p q L A B C. destruct (Rle_lt_dec (D q) 0) as [|P]; [assumption | exfalso].
  set (E := fun s => p <= s <= q /\ D s <= 0).
  destruct (completeness E) as [m [M N]].
  { exists q. intros s [S _]. lra. }
  { exists p. split; [lra | assumption]. }
  assert (M1 : p <= m) by (apply M; split; [lra | assumption]).
  assert (M2 : m <= q) by (apply N; intros s [S _]; lra).
  assert (D m <= 0) as Z.
  { destruct (Rle_lt_dec (D m) 0) as [|Q]; [assumption | exfalso].
    destruct (near_positive D m (ex_intro _ _ (A m (conj M1 M2))) Q) as [e H].
    assert (F : m <= m - e / 2); [|pose proof (cond_pos e); lra].
    apply N. intros s [S T]. destruct (Rle_lt_dec s (m - e / 2)) as [|U]; [assumption | exfalso].
    assert (s <= m) by (apply M; split; assumption).
    assert (0 < D s); [|lra]. apply H. unfold ball; simpl; unfold AbsRing_ball, abs, minus, plus, opp; simpl.
    rewrite Rabs_left1 by lra. pose proof (cond_pos e). lra. }
  assert (m < q) as Y by (destruct M2 as [|X]; [assumption | subst m; lra]).
  destruct (MVT_cor2 D G m q Y) as [c [K1 K2]].
  { intros c K. apply is_derive_Reals. apply A. lra. }
  assert (G c <= 0).
  { apply C; [lra|]. destruct (Rle_lt_dec (D c) 0) as [X|]; [|assumption].
    assert (c <= m); [apply M; split; [lra | assumption] | lra]. }
  nra.
Qed.

Lemma does_not_grow : forall (D G : R -> R) p q, p <= q ->
  (forall s, p <= s <= q -> is_derive D s (G s)) -> (forall s, p <= s <= q -> G s <= 0) -> D q <= D p.
Proof.
  intros D G p q L A B. apply Rminus_le. apply (stays_below (fun s => D s - D p) G p q L).
  - intros s S. replace (G s) with (G s - 0) by ring. apply (is_derive_minus D (fun _ => D p)); [apply A, S | apply constant].
  - lra.
  - intros s S _. apply B, S.
Qed.

(* U' <= f. *)
Lemma integral_bound : forall (U F f : R -> R) p q, p <= q ->
  (forall s, p <= s <= q -> ex_derive U s /\ Derive U s <= f s) -> (forall s, p <= s <= q -> is_derive F s (f s)) ->
  U q <= U p + (F q - F p).
Proof.
  intros U F f p q L A B. enough (U q - F q <= U p - F p) by lra.
  apply (does_not_grow (fun s => U s - F s) (fun s => Derive U s - f s) p q L).
  - intros s S. apply (is_derive_minus U F); [apply Derive_correct, A, S | apply B, S].
  - intros s S. destruct (A s S). lra.
Qed.

(* U' <= a U. *)
Lemma exponential_bound : forall (U F a : R -> R) p q, p <= q ->
  (forall s, p <= s <= q -> ex_derive U s /\ Derive U s <= a s * U s) -> (forall s, p <= s <= q -> is_derive F s (a s)) ->
  U q <= U p * exp (F q - F p).
Proof.
  intros U F a p q L A B.
  enough (U q * exp (- F q) <= U p * exp (- F p)) as H.
  { apply (Rmult_le_compat_r (exp (F q))) in H; [|left; apply exp_pos].
    rewrite Rmult_assoc, <- exp_plus, Rplus_opp_l, exp_0, Rmult_1_r in H.
    rewrite Rmult_assoc, <- exp_plus in H. replace (F q - F p) with (- F p + F q) by ring. exact H. }
  apply (does_not_grow (fun s => U s * exp (- F s)) (fun s => (Derive U s - a s * U s) * exp (- F s)) p q L).
  - intros s S. destruct (A s S) as [X _]. pose proof (B s S) as Y.
    replace ((Derive U s - a s * U s) * exp (- F s)) with (Derive U s * exp (- F s) + U s * (- a s * exp (- F s))) by ring.
    apply (is_derive_mult U (fun s => exp (- F s)) s); [apply Derive_correct, X | | intros; apply Rmult_comm].
    apply (is_derive_comp exp (fun s => - F s)); [apply is_derive_exp | apply (is_derive_opp F), Y].
  - intros s S. destruct (A s S). assert (0 < exp (- F s)) by apply exp_pos. nra.
Qed.

(* U' = f, and U' = a U. *)
Lemma is_integral : forall (U F f : R -> R) p q, p <= q ->
  (forall s, p <= s <= q -> ex_derive U s /\ Derive U s = f s) -> (forall s, p <= s <= q -> is_derive F s (f s)) ->
  U q = U p + (F q - F p).
Proof.
  intros U F f p q L A B. apply Rle_antisym.
  - apply (integral_bound U F f p q L); [|exact B]. intros s S. destruct (A s S). split; [assumption | lra].
  - enough (F q <= F p + (U q - U p)) by lra. apply (integral_bound F U f p q L).
    + intros s S. split; [exists (f s); apply B, S | right; apply is_derive_unique, B, S].
    + intros s S. destruct (A s S) as [X E]. rewrite <- E. apply Derive_correct, X.
Qed.
Lemma is_exponential : forall (U F a : R -> R) p q, p <= q ->
  (forall s, p <= s <= q -> ex_derive U s /\ Derive U s = a s * U s) -> (forall s, p <= s <= q -> is_derive F s (a s)) ->
  U q = U p * exp (F q - F p).
Proof.
  intros U F a p q L A B. apply Rle_antisym.
  - apply (exponential_bound U F a p q L); [|exact B]. intros s S. destruct (A s S). split; [assumption | lra].
  - enough (- U q <= - U p * exp (F q - F p)) by lra. apply (exponential_bound (fun s => - U s) F a p q L); [|exact B].
    intros s S. destruct (A s S) as [X E]. split.
    + exists (- Derive U s). apply (is_derive_opp U), Derive_correct, X.
    + right. rewrite Derive_opp, E. ring.
Qed.

(* U' <= b - c U, with c > 0 and b >= 0. *)
Lemma decay_bound : forall (U : R -> R) p q b c w, p <= q -> 0 < c -> 0 <= b -> U p <= w ->
  (forall s, p <= s <= q -> ex_derive U s /\ Derive U s <= b - c * U s) ->
  U q <= b / c + w * exp (- (c * (q - p))).
Proof.
  intros U p q b c w L C B W A.
  enough (U q - (b / c + w * exp (- (c * (q - p)))) <= 0) by lra.
  apply (stays_below (fun s => U s - (b / c + w * exp (- (c * (s - p)))))
                     (fun s => Derive U s - (0 + w * (- (c * 1) * exp (- (c * (s - p)))))) p q L).
  - intros s S. apply (is_derive_minus U); [apply Derive_correct, A, S|]. auto_derive; [exact I | unfold Rminus; ring].
  - replace (- (c * (p - p))) with 0 by ring. rewrite exp_0. assert (0 <= b / c) by (apply Rdiv_le_0_compat; lra). lra.
  - intros s S P. destruct (A s S) as [_ Q]. set (e := exp (- (c * (s - p)))) in *.
    assert (b = c * (b / c)) by (field; lra). set (l := b / c) in *. nra.
Qed.

Lemma rpow_mono : forall x y r, 0 < r -> 0 <= x -> x <= y -> rpow x r <= rpow y r.
Proof.
  intros x y r P [X | X] L.
  - rewrite !rpow_Rpower by lra. apply Rle_Rpower_l; lra.
  - subst x. rewrite (rpow_zero 0 r) by lra. apply rpow_nonneg.
Qed.
Lemma rpow_step : forall x r, 1 < r -> 0 <= x -> rpow x r = x * rpow x (r - 1).
Proof.
  intros x r P [X | X].
  - rewrite !rpow_Rpower by lra. rewrite <- (Rpower_1 x) at 2 by lra. rewrite <- Rpower_plus. f_equal. ring.
  - subst x. rewrite (rpow_zero 0 r), (rpow_zero 0 (r - 1)) by lra. ring.
Qed.
Lemma rpow_sum : forall x y r, 1 < r -> 0 <= x -> 0 <= y -> rpow x r + rpow y r <= rpow (x + y) r.
Proof.
  intros x y r P X Y. rewrite (rpow_step x), (rpow_step y), (rpow_step (x + y)) by lra.
  pose proof (rpow_mono x (x + y) (r - 1) ltac:(lra) X ltac:(lra)).
  pose proof (rpow_mono y (x + y) (r - 1) ltac:(lra) Y ltac:(lra)).
  rewrite Rmult_plus_distr_r. apply Rplus_le_compat; apply Rmult_le_compat_l; assumption.
Qed.
Lemma rpow_root : forall x r, 0 < r -> 0 <= x -> rpow (rpow x (/ r)) r = x.
Proof.
  intros x r P X. assert (0 < / r) by (apply Rinv_0_lt_compat; lra). destruct X as [X | X].
  - rewrite (rpow_Rpower x) by lra. rewrite rpow_Rpower by apply exp_pos.
    rewrite Rpower_mult, Rinv_l, Rpower_1 by lra. reflexivity.
  - subst x. rewrite (rpow_zero 0) by lra. apply rpow_zero; lra.
Qed.

(* y = w (1 + c (r - 1) w^(r - 1) (s - p))^(-1 / (r - 1)) solves y' = - c y^r. *)
Definition bernoulli_solution (w c r p s : R) := rpow (1 + c * (r - 1) * rpow w (r - 1) * (s - p)) (- (1 / (r - 1))) * w.
Lemma bernoulli_solves : forall w c r p s, 0 <= w -> 0 < c -> 1 < r -> p <= s ->
  0 <= bernoulli_solution w c r p s
  /\ is_derive (bernoulli_solution w c r p) s (- c * rpow (bernoulli_solution w c r p s) r).
Proof.
  intros w c r p s W C P L. split.
  { unfold bernoulli_solution. apply Rmult_le_pos; [apply rpow_nonneg | exact W]. }
  destruct W as [W | W].
  - pose (K := c * (r - 1) * rpow w (r - 1)). assert (EK : K = c * (r - 1) * rpow w (r - 1)) by reflexivity. clearbody K.
    assert (0 < K) as KP.
    { rewrite EK, rpow_Rpower by lra. repeat apply Rmult_lt_0_compat; try lra. apply exp_pos. }
    assert (Q : 0 < 1 + K * (s - p)) by (assert (0 <= K * (s - p)) by (apply Rmult_le_pos; lra); lra).
    apply (is_derive_ext_loc (fun s => Rpower (1 + K * (s - p)) (- (1 / (r - 1))) * w)).
    { unfold bernoulli_solution. rewrite <- EK.
      assert (N : locally s (fun y => 0 < 1 + K * (y - p))) by (apply (near_positive (fun y => 1 + K * (y - p))); [auto_derive; exact I | exact Q]).
      revert N. apply filter_imp. intros y Y. rewrite (rpow_Rpower _ _ Y). reflexivity. }
    unfold bernoulli_solution. rewrite <- EK. unfold Rpower at 1.
    auto_derive; [exact Q|].
    rewrite (rpow_Rpower (1 + K * (s - p))) by exact Q.
    set (B := 1 + K * (s - p)) in *.
    assert (0 < Rpower B (- (1 / (r - 1))) * w) by (apply Rmult_lt_0_compat; [apply exp_pos | lra]).
    rewrite rpow_Rpower by assumption.
    rewrite <- Rpower_mult_distr by (try apply exp_pos; lra).
    rewrite Rpower_mult.
    fold (Rpower B (- (1 / (r - 1)))).
    assert (E1 : Rpower B (- (1 / (r - 1)) * r) = Rpower B (- (1 / (r - 1))) * / B).
    { rewrite <- (Rpower_1 B) at 3 by lra. rewrite <- Rpower_Ropp, <- Rpower_plus. f_equal. field. lra. }
    assert (E2 : Rpower w r = rpow w (r - 1) * w).
    { rewrite rpow_Rpower by lra. rewrite <- (Rpower_1 w) at 3 by lra. rewrite <- Rpower_plus. f_equal. ring. }
    rewrite E1, E2. change (s + - p) with (s - p). fold B. unfold Rpower. rewrite EK. field. split; lra.
  - subst w.
    apply (is_derive_ext (fun _ => 0)).
    { intro. unfold bernoulli_solution. as_reals. ring. }
    replace (- c * rpow (bernoulli_solution 0 c r p s) r) with 0; [apply constant|].
    unfold bernoulli_solution. rewrite Rmult_0_r, rpow_zero by lra. ring.
Qed.
Lemma bernoulli_start : forall w c r p, bernoulli_solution w c r p p = w.
Proof.
  intros. unfold bernoulli_solution. replace (1 + c * (r - 1) * rpow w (r - 1) * (p - p)) with 1 by ring.
  rewrite rpow_Rpower by lra. unfold Rpower. rewrite ln_1, Rmult_0_r, exp_0. ring.
Qed.

(* U' <= b - c U^r, with U >= 0, c > 0, b >= 0 and r > 1. *)
Lemma bernoulli_bound : forall (U : R -> R) p q b c r w, p <= q -> 0 < c -> 0 <= b -> 1 < r -> 0 <= U p -> U p <= w ->
  (forall s, p <= s <= q -> ex_derive U s /\ Derive U s <= b - c * rpow (U s) r) ->
  U q <= rpow (b / c) (/ r) + bernoulli_solution w c r p q.
Proof.
  intros U p q b c r w L C B P N W A.
  assert (W0 : 0 <= w) by lra.
  set (l := rpow (b / c) (/ r)). set (y := bernoulli_solution w c r p).
  assert (BC : 0 <= b / c) by (apply Rdiv_le_0_compat; lra).
  assert (l0 : 0 <= l) by apply rpow_nonneg.
  enough (U q - (l + y q) <= 0) by lra.
  apply (stays_below (fun s => U s - (l + y s)) (fun s => Derive U s - (0 + - c * rpow (y s) r)) p q L).
  - intros s S. apply (is_derive_minus U); [apply Derive_correct, A, S|].
    apply (is_derive_plus (fun _ => l) y); [apply constant|]. apply bernoulli_solves; lra.
  - unfold y. rewrite bernoulli_start. lra.
  - intros s S D. destruct (A s S) as [_ Q].
    destruct (bernoulli_solves w c r p s W0 C P (proj1 S)) as [Y _]. fold y in Y.
    pose proof (rpow_mono (l + y s) (U s) r ltac:(lra) ltac:(lra) ltac:(lra)).
    pose proof (rpow_sum l (y s) r P l0 Y).
    assert (E : rpow l r = b / c) by (unfold l; apply rpow_root; lra).
    assert (b = c * (b / c)) by (field; lra).
    rewrite E in *. nra.
Qed.

(* U' <= a U^r, with U > 0 and r > 1, as long as the bound exists. *)
Lemma bernoulli_rate : forall (U F a : R -> R) p q r, p <= q -> 1 < r ->
  (forall s, p <= s <= q -> 0 < U s) ->
  (forall s, p <= s <= q -> ex_derive U s /\ Derive U s <= a s * Rpower (U s) r) ->
  (forall s, p <= s <= q -> is_derive F s (a s)) ->
  0 < 1 - (r - 1) * (F q - F p) * Rpower (U p) (r - 1) ->
  U q <= Rpower (1 - (r - 1) * (F q - F p) * Rpower (U p) (r - 1)) (- (1 / (r - 1))) * U p.
Proof.
  intros U F a p q r L R1 P A B D.
  assert (Up : 0 < U p) by (apply P; lra). assert (Uq : 0 < U q) by (apply P; lra).
  assert (H : - Rpower (U q) (- (r - 1)) <= - Rpower (U p) (- (r - 1)) + ((r - 1) * F q - (r - 1) * F p)).
  { assert (V : forall s, p <= s <= q ->
      is_derive (fun s => - Rpower (U s) (- (r - 1))) s ((r - 1) * (Rpower (U s) (- r) * Derive U s))).
    { intros s S. destruct (A s S) as [X _]. pose proof (P s S) as Y.
      unfold Rpower. auto_derive; [repeat split; assumption|].
      fold (Rpower (U s) (- (r - 1))). fold (Rpower (U s) (- r)).
      replace (Rpower (U s) (- (r - 1))) with (Rpower (U s) (- r) * U s).
      { change (fun x : R => U x) with U. field. lra. }
      rewrite <- (Rpower_1 (U s)) at 2 by lra. rewrite <- Rpower_plus. f_equal. ring. }
    apply (integral_bound (fun s => - Rpower (U s) (- (r - 1))) (fun s => (r - 1) * F s) (fun s => (r - 1) * a s) p q L).
    - intros s S. split; [eexists; apply V, S|].
      apply Rle_trans with ((r - 1) * (Rpower (U s) (- r) * Derive U s)); [right; apply is_derive_unique, V, S|].
      destruct (A s S) as [_ Q]. apply Rmult_le_compat_l; [lra|].
      replace (a s) with (Rpower (U s) (- r) * (a s * Rpower (U s) r)).
      { apply Rmult_le_compat_l; [left; apply exp_pos | exact Q]. }
      rewrite Rpower_Ropp. field. apply Rgt_not_eq, exp_pos.
    - intros s S. apply (is_derive_scal F s (r - 1)), B, S. }
  assert (E : Rpower (U p) (- (r - 1)) * (1 - (r - 1) * (F q - F p) * Rpower (U p) (r - 1)) <= Rpower (U q) (- (r - 1))).
  { rewrite (Rpower_Ropp (U p)) in *. assert (0 < Rpower (U p) (r - 1)) by apply exp_pos.
    set (v := Rpower (U p) (r - 1)) in *.
    replace (/ v * (1 - (r - 1) * (F q - F p) * v)) with (/ v - ((r - 1) * F q - (r - 1) * F p)) by (field; lra). lra. }
  apply ln_le in E; [|apply Rmult_lt_0_compat; [apply exp_pos | exact D]].
  rewrite ln_mult, !ln_Rpower in E by (try apply exp_pos; exact D).
  apply ln_le_inv; [exact Uq | apply Rmult_lt_0_compat; [apply exp_pos | exact Up] |].
  rewrite ln_mult, ln_Rpower by (try apply exp_pos; exact Up).
  set (l := ln (1 - _)) in *. set (x := ln (U p)) in *. set (y := ln (U q)) in *.
  apply Rmult_le_reg_l with (r - 1); [lra|].
  replace ((r - 1) * (- (1 / (r - 1)) * l + x)) with (- l + (r - 1) * x) by (field; lra). lra.
Qed.

(* The same where U may be 0: it does not rise from there. *)
Lemma no_rise_from_0 : forall (U F a : R -> R) m q r, m < q -> 1 < r -> U m <= 0 ->
  (forall s, m < s <= q -> 0 < U s) ->
  (forall s, m <= s <= q -> ex_derive U s /\ Derive U s <= a s * rpow (U s) r) ->
  (forall s, m <= s <= q -> is_derive F s (a s)) -> False.
Proof.
  intros U F a m q r L R1 Z P A B.
  assert (Uq : 0 < U q) by (apply P; lra).
  set (M := Rmax 1 (F q - F m + 1)). assert (M1 : 1 <= M) by apply Rmax_l.
  assert (M2 : F q - F m + 1 <= M) by apply Rmax_r. clearbody M.
  set (C := Rpower (1 / 2) (- (1 / (r - 1)))). assert (C0 : 0 < C) by apply exp_pos.
  set (x := 1 / (2 * (r - 1) * M)). assert (x0 : 0 < x) by (apply Rdiv_lt_0_compat; [lra | nra]).
  set (d := Rmin (Rpower x (1 / (r - 1))) (U q / (2 * C))).
  assert (D1 : d <= Rpower x (1 / (r - 1))) by apply Rmin_l. assert (D2 : d <= U q / (2 * C)) by apply Rmin_r.
  assert (D0 : 0 < d) by (apply Rmin_pos; [apply exp_pos | apply Rdiv_lt_0_compat; lra]). clearbody d.
  assert (N1 : locally m (fun s => 0 < d - U s)).
  { apply (near_positive (fun s => d - U s)); [|lra].
    apply (ex_derive_minus (fun _ => d) U); [apply ex_derive_const | apply A; lra]. }
  assert (N2 : locally m (fun s => 0 < F s - (F m - 1))).
  { apply (near_positive (fun s => F s - (F m - 1))); [|lra].
    apply (ex_derive_minus F (fun _ => F m - 1)); [exists (a m); apply B; lra | apply ex_derive_const]. }
  destruct (filter_and _ _ N1 N2) as [e H].
  set (s := m + Rmin (e / 2) ((q - m) / 2)). pose proof (cond_pos e) as E0.
  assert (S0 : 0 < Rmin (e / 2) ((q - m) / 2)) by (apply Rmin_pos; lra).
  assert (S1 : Rmin (e / 2) ((q - m) / 2) <= e / 2) by apply Rmin_l.
  assert (S2 : Rmin (e / 2) ((q - m) / 2) <= (q - m) / 2) by apply Rmin_r.
  assert (S : m < s < q) by (unfold s; lra).
  destruct (H s) as [K1 K2].
  { unfold ball; simpl; unfold AbsRing_ball, abs, minus, plus, opp; simpl. unfold s. rewrite Rabs_pos_eq; lra. }
  clearbody s. assert (Us : 0 < U s) by (apply P; lra).
  assert (X : Rpower (U s) (r - 1) <= x).
  { replace x with (Rpower (Rpower x (1 / (r - 1))) (r - 1)).
    - apply Rle_Rpower_l; lra.
    - rewrite Rpower_mult. replace (1 / (r - 1) * (r - 1)) with 1 by (field; lra). apply Rpower_1, x0. }
  assert (V : 0 < Rpower (U s) (r - 1)) by apply exp_pos.
  assert (Y : (r - 1) * (F q - F s) * Rpower (U s) (r - 1) <= 1 / 2).
  { apply Rle_trans with ((r - 1) * M * x); [|right; unfold x; field; lra].
    apply Rle_trans with ((r - 1) * M * Rpower (U s) (r - 1)).
    - apply Rmult_le_compat_r; [lra|]. apply Rmult_le_compat_l; lra.
    - apply Rmult_le_compat_l; [|exact X]. apply Rmult_le_pos; lra. }
  assert (W : U q <= Rpower (1 - (r - 1) * (F q - F s) * Rpower (U s) (r - 1)) (- (1 / (r - 1))) * U s).
  { apply (bernoulli_rate U F a s q r); try lra.
    - intros u Q. apply P. lra.
    - intros u Q. rewrite <- rpow_Rpower by (apply P; lra). apply A. lra.
    - intros u Q. apply B. lra. }
  assert (T : Rpower (1 - (r - 1) * (F q - F s) * Rpower (U s) (r - 1)) (- (1 / (r - 1))) <= C).
  { unfold C. rewrite !Rpower_Ropp. apply Rinv_le_contravar; [apply exp_pos|].
    apply Rle_Rpower_l; [left; apply Rdiv_lt_0_compat; lra | lra]. }
  assert (U q <= C * (U q / (2 * C))).
  { apply Rle_trans with (1 := W). apply Rmult_le_compat; [left; apply exp_pos | lra | exact T | lra]. }
  assert (C * (U q / (2 * C)) = U q / 2) by (field; lra). lra.
Qed.

(* U' <= a U^r, with U >= 0 and r > 1, as long as the bound exists. *)
Lemma bernoulli_any_rate : forall (U F a : R -> R) p q r, p <= q -> 1 < r ->
  (forall s, p <= s <= q -> 0 <= U s) ->
  (forall s, p <= s <= q -> ex_derive U s /\ Derive U s <= a s * rpow (U s) r) ->
  (forall s, p <= s <= q -> is_derive F s (a s)) ->
  0 < 1 - (r - 1) * (F q - F p) * rpow (U p) (r - 1) ->
  U q <= rpow (1 - (r - 1) * (F q - F p) * rpow (U p) (r - 1)) (- (1 / (r - 1))) * U p.
Proof.
  intros U F a p q r L R1 N A B D.
  destruct (Rle_lt_dec (U q) 0) as [Z | Uq].
  { apply Rle_trans with (1 := Z). apply Rmult_le_pos; [apply rpow_nonneg | apply N; lra]. }
  set (E := fun s => s = p \/ (p <= s <= q /\ U s <= 0)).
  destruct (completeness E) as [m [M1 M2]].
  { exists q. intros s [S | [S _]]; lra. }
  { exists p. left. reflexivity. }
  assert (P1 : p <= m) by (apply M1; left; reflexivity).
  assert (P2 : m <= q) by (apply M2; intros s [S | [S _]]; lra).
  assert (Above : forall s, m < s <= q -> 0 < U s).
  { intros s S. destruct (Rle_lt_dec (U s) 0) as [X | X]; [|exact X]. exfalso.
    assert (s <= m); [|lra]. apply M1. right. split; [lra | exact X]. }
  destruct (Rle_lt_dec (U m) 0) as [Z | Um].
  - exfalso. assert (m < q) by (destruct P2 as [X | X]; [exact X | subst; lra]).
    apply (no_rise_from_0 U F a m q r); try assumption.
    + intros s S. apply A. lra.
    + intros s S. apply B. lra.
  - assert (m = p) as E0.
    { destruct P1 as [X | X]; [exfalso | lra].
      destruct (near_positive U m (proj1 (A m (conj (Rlt_le _ _ X) P2))) Um) as [e H]. pose proof (cond_pos e) as E1.
      set (t := m - Rmin (e / 2) ((m - p) / 2)).
      assert (0 < Rmin (e / 2) ((m - p) / 2)) by (apply Rmin_pos; lra).
      assert (Rmin (e / 2) ((m - p) / 2) <= e / 2) by apply Rmin_l.
      assert (Rmin (e / 2) ((m - p) / 2) <= (m - p) / 2) by apply Rmin_r.
      assert (m <= t); [|unfold t in *; lra]. apply M2. intros s [S | [S Y]]; [unfold t; lra|].
      destruct (Rle_lt_dec s t) as [Q | Q]; [exact Q | exfalso].
      assert (s <= m) by (apply M1; right; split; assumption).
      assert (0 < U s); [|lra]. apply H. unfold ball; simpl; unfold AbsRing_ball, abs, minus, plus, opp; simpl.
      unfold t in Q. rewrite Rabs_left1; lra. }
    subst m. assert (P : forall s, p <= s <= q -> 0 < U s).
    { intros s [[S | S] T]; [apply Above; lra | subst; exact Um]. }
    rewrite (rpow_Rpower (U p)) in * by exact Um. rewrite rpow_Rpower by exact D.
    apply (bernoulli_rate U F a p q r); try assumption.
    intros s S. rewrite <- rpow_Rpower by (apply P, S). apply A, S.
Qed.

(* V' <= b V^q - c V^(2q), with V >= 0, c > 0, b >= 0 and 1/2 < q < 1: the root U = V^(1 - q) falls below the sum of its
   decay and of the level at which b and c balance. Here K = 1 / (1 - q) and r = K - 1; at V = 0 the root has no rate. *)
Lemma root_bound : forall (V : R -> R) p q b c K r, p <= q -> 0 < c -> 0 <= b -> 1 < r -> K = r + 1 ->
  (forall s, p <= s <= q -> 0 <= V s) ->
  (forall s, p <= s <= q -> ex_derive V s /\ Derive V s <= b * rpow (V s) (r / K) - c * rpow (V s) (2 * r / K)) ->
  V q <= rpow (rpow (b / c) (/ r) + bernoulli_solution (rpow (V p) (/ K)) (c / K) r p q) K.
Proof.
  intros V p q b c K r L C B R1 EK N A.
  assert (K0 : 0 < K) by lra. assert (I0 : 0 < / K) by (apply Rinv_0_lt_compat, K0).
  assert (BC : 0 <= b / c) by (apply Rdiv_le_0_compat; lra).
  set (l := rpow (b / c) (/ r)). assert (l0 : 0 <= l) by apply rpow_nonneg.
  assert (El : rpow l r = b / c) by (unfold l; apply rpow_root; lra).
  set (w := rpow (V p) (/ K)). assert (w0 : 0 <= w) by apply rpow_nonneg.
  assert (Ew : rpow w K = V p) by (unfold w; apply rpow_root; [exact K0 | apply N; lra]).
  assert (CK : 0 < c / K) by (apply Rdiv_lt_0_compat; assumption).
  clearbody l w. set (y := bernoulli_solution w (c / K) r p).
  destruct (Rle_lt_dec (l + w) 0) as [Z | P].
  { assert (l = 0) by lra. assert (w = 0) by lra. subst l w. rewrite rpow_zero in El, Ew by lra.
    assert (b = 0) by (replace b with (b / c * c) by (field; lra); rewrite <- El; ring).
    apply Rle_trans with (V p); [|rewrite <- Ew; apply rpow_nonneg].
    apply (does_not_grow V (Derive V) p q L).
    - intros s S. apply Derive_correct, A, S.
    - intros s S. destruct (A s S) as [_ Q]. subst b. pose proof (rpow_nonneg (V s) (2 * r / K)). nra. }
  assert (Y0 : forall s, p <= s <= q -> 0 <= y s /\ is_derive y s (- (c / K) * rpow (y s) r)).
  { intros s S. apply bernoulli_solves; lra. }
  assert (Y1 : forall s, p <= s <= q -> 0 < l + y s).
  { intros s S. destruct (Y0 s S) as [Q _]. destruct w0 as [W | W]; [|lra].
    assert (0 < y s); [|lra]. unfold y, bernoulli_solution. apply Rmult_lt_0_compat; [|exact W]. rewrite rpow_Rpower; [apply exp_pos|].
    assert (0 <= c / K * (r - 1) * rpow w (r - 1) * (s - p)); [|lra].
    repeat apply Rmult_le_pos; try lra. apply rpow_nonneg. }
  assert (Yp : y p = w) by apply bernoulli_start.
  rewrite (rpow_Rpower (l + y q)) by (apply Y1; lra).
  enough (V q - Rpower (l + y q) K <= 0) by lra.
  apply (stays_below (fun s => V s - Rpower (l + y s) K)
                     (fun s => Derive V s - - c * (Rpower (l + y s) r * rpow (y s) r)) p q L).
  - intros s S. apply (is_derive_minus V); [apply Derive_correct, A, S|].
    destruct (Y0 s S) as [_ D]. pose proof (Y1 s S) as Q.
    assert (E : is_derive (fun u => Rpower u K) (l + y s) (K * Rpower (l + y s) r)).
    { unfold Rpower. auto_derive; [exact Q|]. fold (Rpower (l + y s) K). fold (Rpower (l + y s) r).
      replace (Rpower (l + y s) K) with (Rpower (l + y s) r * (l + y s)); [field; lra|].
      rewrite EK, Rpower_plus, Rpower_1 by exact Q. reflexivity. }
    replace (- c * (Rpower (l + y s) r * rpow (y s) r)) with ((0 + - (c / K) * rpow (y s) r) * (K * Rpower (l + y s) r))
      by (field; lra).
    apply (is_derive_comp (fun u => Rpower u K) (fun s => l + y s)); [exact E|].
    apply (is_derive_plus (fun _ => l) y); [apply constant | exact D].
  - rewrite Yp. rewrite <- (rpow_Rpower (l + w)) by lra. rewrite <- Ew at 1.
    assert (rpow w K <= rpow (l + w) K); [apply rpow_mono; lra | lra].
  - intros s S D. destruct (A s S) as [_ Q]. destruct (Y0 s S) as [T _]. pose proof (Y1 s S) as P1.
    assert (Vs : 0 < V s) by (pose proof (exp_pos (K * ln (l + y s))); unfold Rpower in D; lra).
    set (X := rpow (V s) (r / K)) in *.
    assert (EX : rpow (V s) (2 * r / K) = X * X).
    { unfold X. rewrite !rpow_Rpower by exact Vs. rewrite <- Rpower_plus. f_equal. field. lra. }
    assert (G : rpow (l + y s) r <= X).
    { unfold X. rewrite !rpow_Rpower by lra. replace (Rpower (l + y s) r) with (Rpower (Rpower (l + y s) K) (r / K)).
      - apply Rle_Rpower_l; [apply Rdiv_le_0_compat; lra|]. split; [apply exp_pos | lra].
      - rewrite Rpower_mult. f_equal. field. lra. }
    pose proof (rpow_sum l (y s) r R1 l0 T) as M. rewrite El in M.
    rewrite <- (rpow_Rpower (l + y s) r) by exact P1. set (J := rpow (l + y s) r) in *.
    set (H := rpow (y s) r) in *. assert (H0 : 0 <= H) by apply rpow_nonneg.
    rewrite EX in Q. set (a := b / c) in *. assert (Eb : b = c * a) by (unfold a; field; lra).
    assert (J * H <= X * (X - a)) by (apply Rmult_le_compat; lra).
    assert (c * (J * H) <= c * (X * (X - a))) by (apply Rmult_le_compat_l; lra).
    rewrite Eb in Q. lra.
Qed.

(* The rate of U at s, by an assumption for all s. *)
Ltac bound := first [ assumption | lra ].
Ltac premises_of H :=
  repeat match type of H with ?A -> _ =>
    let P := fresh in assert (P : A) by (first [ assumption | lra | sign ]); specialize (H P); clear P
  end.
Ltac premise H tac :=
  lazymatch type of H with ?A -> _ =>
    let P := fresh in assert (P : A) by (first [ assumption | lra | sign | tac ]); specialize (H P); clear P
  end.
Ltac rate U s :=
  match goal with H : ?T |- _ =>
    lazymatch T with context [Derive (fun x => U x) _] => let K := fresh in pose proof (H s) as K; premises_of K; facts end
  end.
Ltac rate_is U s tac :=
  intros s ?; facts; rate U s; split;
  [ assumption
  | lazymatch goal with
    | K : Derive _ _ <= ?e |- _ => apply Rle_trans with e; [ exact K | tac ]
    | K : Derive _ _ = ?e |- _ => apply Rle_trans with e; [ right; exact K | tac ]
    end ].
Ltac rate_equals U s :=
  intros s ?; facts; rate U s; split;
  [ assumption | lazymatch goal with K : Derive _ _ = ?e |- _ => apply eq_trans with e; [ exact K | first [ rational | same_values; rational ] ] end ].
Ltac same := right; first [ rational | same_values; rational ].
Ltac antiderivative U s := intros s ?; facts; try (rate U s); auto_derive; [ repeat split; sign | first [ rational | same_values; rational ] ].

(* The bound of Bernoulli's inequality with its parts as they are written elsewhere. *)
Lemma bernoulli_bound_as : forall (U : R -> R) p q b c r w A i v B e,
  p <= q -> 0 < c -> 0 <= b -> 1 < r -> 0 <= U p -> U p <= w ->
  (forall s, p <= s <= q -> ex_derive U s /\ Derive U s <= b - c * rpow (U s) r) ->
  A = b / c -> i = / r -> v = rpow w (r - 1) -> B = 1 + c * (r - 1) * v * (q - p) -> e = - (1 / (r - 1)) ->
  U q <= rpow A i + rpow B e * w.
Proof.
  intros U p q b c r w A i v B e L C BN P N W H EA Ei Ev EB Ee. subst A i v B e.
  exact (bernoulli_bound U p q b c r w L C BN P N W H).
Qed.
Lemma bernoulli_decay_as : forall (U : R -> R) p q c r w v B e,
  p <= q -> 0 < c -> 1 < r -> 0 <= U p -> U p <= w ->
  (forall s, p <= s <= q -> ex_derive U s /\ Derive U s <= - (c * rpow (U s) r)) ->
  v = rpow w (r - 1) -> B = 1 + c * (r - 1) * v * (q - p) -> e = - (1 / (r - 1)) ->
  U q <= rpow B e * w.
Proof.
  intros U p q c r w v B e L C P N W H Ev EB Ee.
  subst v B e. pose proof (bernoulli_bound U p q 0 c r w L C (Rle_refl 0) P N W) as K.
  rewrite (rpow_zero (0 / c) (/ r)), Rplus_0_l in K; [ | unfold Rdiv; ring | apply Rinv_0_lt_compat; lra].
  apply K. intros s S. destruct (H s S). split; [assumption | lra].
Qed.
Lemma bernoulli_any_rate_as : forall (U F a : R -> R) p q r v B e, p <= q -> 1 < r ->
  (forall s, p <= s <= q -> 0 <= U s) ->
  (forall s, p <= s <= q -> ex_derive U s /\ Derive U s <= a s * rpow (U s) r) ->
  (forall s, p <= s <= q -> is_derive F s (a s)) ->
  v = rpow (U p) (r - 1) -> B = 1 - (r - 1) * (F q - F p) * v -> e = - (1 / (r - 1)) -> 0 < B ->
  U q <= rpow B e * U p.
Proof.
  intros U F a p q r v B e L R1 N A D Ev EB Ee P. subst v B e. apply (bernoulli_any_rate U F a); assumption.
Qed.
Lemma root_bound_as : forall (V : R -> R) p q b c K r m n v B e i A j, p <= q -> 0 < c -> 0 <= b -> 1 < r -> K = r + 1 ->
  (forall s, p <= s <= q -> 0 <= V s) ->
  (forall s, p <= s <= q -> ex_derive V s /\ Derive V s <= b * rpow (V s) m - c * rpow (V s) n) ->
  m = r / K -> n = 2 * r / K -> v = rpow (V p) ((r - 1) / K) -> B = 1 + c / K * (r - 1) * v * (q - p) ->
  e = - (1 / (r - 1)) -> i = / K -> A = b / c -> j = / r ->
  V q <= rpow (rpow B e * rpow (V p) i + rpow A j) K.
Proof.
  intros V p q b c K r m n v B e i A j L C BN R1 EK N H Em En Ev EB Ee Ei EA Ej. subst m n v B e i A j.
  pose proof (root_bound V p q b c K r L C BN R1 EK N H) as F. unfold bernoulli_solution in F.
  replace (rpow (rpow (V p) (/ K)) (r - 1)) with (rpow (V p) ((r - 1) / K)) in F; [rewrite Rplus_comm; exact F|].
  assert (0 < K) by lra. destruct (N p (conj (Rle_refl p) L)) as [P | P].
  - rewrite (rpow_Rpower (V p)), (rpow_Rpower (V p)), rpow_Rpower by (try apply exp_pos; exact P).
    rewrite Rpower_mult. f_equal. field. lra.
  - assert (0 < / K) by (apply Rinv_0_lt_compat; assumption). assert (0 < (r - 1) / K) by (apply Rdiv_lt_0_compat; lra).
    rewrite <- P, !rpow_zero by (try apply rpow_zero; lra). reflexivity.
Qed.
Lemma root_decay_as : forall (V : R -> R) p q c K r n v B e i, p <= q -> 0 < c -> 1 < r -> K = r + 1 ->
  (forall s, p <= s <= q -> 0 <= V s) ->
  (forall s, p <= s <= q -> ex_derive V s /\ Derive V s <= - (c * rpow (V s) n)) ->
  n = 2 * r / K -> v = rpow (V p) ((r - 1) / K) -> B = 1 + c / K * (r - 1) * v * (q - p) ->
  e = - (1 / (r - 1)) -> i = / K -> V q <= rpow (rpow B e * rpow (V p) i) K.
Proof.
  intros V p q c K r n v B e i L C R1 EK N H En Ev EB Ee Ei.
  replace (rpow B e * rpow (V p) i) with (rpow B e * rpow (V p) i + rpow (0 / c) (/ r)).
  - apply (root_bound_as V p q 0 c K r (r / K) n v B e i (0 / c) (/ r)); try assumption; try reflexivity; [lra|].
    intros s S. destruct (H s S). split; [assumption | lra].
  - rewrite (rpow_zero (0 / c)); [ring | unfold Rdiv; ring | apply Rinv_0_lt_compat; lra].
Qed.
Ltac never_negative := intros ? ?; facts; cbv beta;
  first [ sign | apply Rge_le; match goal with H : forall _, _ |- _ => solve [ apply H; first [ assumption | lra ] ] end ].
Ltac positive_powers := repeat (rewrite rpow_Rpower by sign).
Ltac same_power := first [ rational | f_equal; rational | positive_powers; first [ rational | f_equal; rational ] ].
Ltac same_rate := first [ same | positive_powers; same ].
