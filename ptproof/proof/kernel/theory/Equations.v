(* Equations up to whole periods, and up to squares of roots. Everything here is proved. *)

Ltac one_period f a b L n :=
  let E := fresh in
  assert (E : f a = f b) by (replace a with (b + 2 * INR n * PI) by (cbn [INR]; field; sides); apply L);
  rewrite E; clear E.
Ltac some_periods f a b L :=
  first [ one_period f a b L 1%nat | one_period f a b L 2%nat | one_period f a b L 3%nat | one_period f a b L 4%nat ].
Ltac whole_periods :=
  repeat match goal with
  | |- context [sin ?a] =>
      match goal with |- context [sin ?b] => assert_fails (constr_eq a b); some_periods sin a b sin_period end
  | |- context [cos ?a] =>
      match goal with |- context [cos ?b] => assert_fails (constr_eq a b); some_periods cos a b cos_period end
  end.

(* Every square of a cosine by the one of the sine. *)
Lemma cos_power : forall x k r, cos x ^ (2 * k + r) = (1 - sin x ^ 2) ^ k * cos x ^ r.
Proof.
  intros x k r. rewrite pow_add, pow_mult. f_equal. f_equal.
  pose proof (sin2_cos2 x). unfold Rsqr in *. lra.
Qed.
Ltac squared_cosines :=
  repeat match goal with
  | |- context [cos ?x ^ S (S ?n)] =>
      let k := eval compute in (Nat.div2 (S (S n))) in
      let r := eval compute in (S (S n) - 2 * k)%nat in
      change (cos x ^ S (S n)) with (cos x ^ (2 * k + r)); rewrite (cos_power x k r)
  end.

(* The difference of the two sides is e, in which every square of a root less what it is of is 0. *)
Ltac zero_as e :=
  as_reals; apply Rminus_diag_uniq;
  lazymatch goal with |- ?d = 0 => replace d with e by rational end.
Ltac squared_root x := rewrite (sqrt_sqrt x) by from_fact.
Ltac is_zero := unfold Rdiv; ring.

(* a <= b by the squares, where b is not negative. *)
Lemma below_by_squares : forall a b, 0 <= b -> a ^ 2 <= b ^ 2 -> a <= b.
Proof. intros a b P L. destruct (Rle_dec a b); [assumption|]. exfalso. nra. Qed.
Ltac by_squares :=
  match goal with
  | |- _ <= _ => apply below_by_squares; [ sign | ]
  | |- _ >= _ => apply Rle_ge; apply below_by_squares; [ sign | ]
  end; cases; timeout 4 nra.

(* What an exponential is above, and how it compares to others. *)
Lemma exp_above : forall x, 1 + x <= exp x.
Proof. intro x. destruct (Req_dec x 0) as [E | E]; [subst; rewrite exp_0; lra | left; apply exp_ineq1; exact E]. Qed.
Lemma exp_halves : forall x, exp x = exp (x / 2) * exp (x / 2).
Proof. intro x. rewrite <- exp_plus. f_equal. field. Qed.
Lemma exp_above_twice : forall x, 0 <= x -> 2 * x <= exp x.
Proof.
  intros x P. pose proof (exp_above (x - 1)). pose proof (exp_above 1).
  replace x with ((x - 1) + 1) at 2 by ring. rewrite exp_plus. nra.
Qed.
Ltac about_exp :=
  repeat match goal with
  | |- context [exp ?x] => note (1 + x <= exp x) ltac:(apply exp_above); pose proof (exp_pos x)
  end.
Ltac about_exp_here :=
  repeat match goal with |- context [exp ?x] => note (2 * x <= exp x) ltac:(apply exp_above_twice; lra) end.
Ltac by_exponentials := about_exp; cases; first [ lra | about_exp_here; lra | timeout 4 nra ].

(* Both sides by their parts, each of which grows. *)
Lemma exp_le_exp : forall x y, x <= y -> exp x <= exp y.
Proof. intros x y [L | E]; [left; apply exp_increasing; exact L | right; rewrite E; reflexivity]. Qed.
Ltac leaf_of_parts := first [ assumption | lra | solve [ unfold Rabs; destruct (Rcase_abs _); lra ] | solve [ by_squares ] | solve [ cases; timeout 2 nra ] ].
Ltac part_sign := first [ sign | apply Rplus_le_le_0_compat; part_sign | apply Rmult_le_pos; part_sign ].
Ltac parts_grow :=
  lazymatch goal with
  | |- ?a >= ?b => apply Rle_ge; parts_grow
  | |- ?a <= ?a => apply Rle_refl
  | |- exp _ <= exp _ => apply exp_le_exp; parts_grow
  | |- ?a ^ ?n <= ?b ^ ?n => first [ apply pow_incr; split; [ part_sign | parts_grow ] | leaf_of_parts ]
  | |- ?a - ?c <= ?b - ?c => apply Rplus_le_compat_r; parts_grow
  | |- ?a + ?b <= ?c + ?d => first [ apply Rplus_le_compat; parts_grow | leaf_of_parts ]
  | |- ?a * ?b <= ?c * ?d =>
      first [ apply Rmult_le_compat; [ part_sign | part_sign | parts_grow | parts_grow ]
            | rewrite (Rmult_comm c d); apply Rmult_le_compat; [ part_sign | part_sign | parts_grow | parts_grow ]
            | leaf_of_parts ]
  | |- _ <= _ => leaf_of_parts
  end.
Ltac parts_grow_strictly :=
  lazymatch goal with
  | |- ?a > ?b => change (b < a); parts_grow_strictly
  | |- exp _ < exp _ => apply exp_increasing; parts_grow_strictly
  | |- ?c + ?a < ?c + ?b => apply Rplus_lt_compat_l; parts_grow_strictly
  | |- ?c * ?a < ?c * ?b => apply Rmult_lt_compat_l; [ sign | parts_grow_strictly ]
  | |- ?c * ?a < ?d * ?b =>
      apply Rmult_le_0_lt_compat; [ part_sign | part_sign | parts_grow_strictly | parts_grow_strictly ]
  | |- _ ^ 2 < _ ^ 2 => nra
  | |- _ < _ => lra
  end.

(* What grows without bound with its variable. *)
Lemma shifted_grows : forall (F : (R -> Prop) -> Prop) (f : R -> R) c, Filter F ->
  filterlim f F (Rbar_locally p_infty) -> filterlim (fun s => f s + c) F (Rbar_locally p_infty).
Proof.
  intros F f c FF L. apply (filterlim_comp _ _ _ f (fun y => y + c) F (Rbar_locally p_infty)); [exact L|].
  intros Q [M HM]. exists (M - c). intros y Y. apply HM. lra.
Qed.
Ltac without_bound :=
  cbv beta;
  lazymatch goal with
  | |- filterlim (fun s => s) _ _ => apply filterlim_id
  | |- filterlim (fun s => ln (@?f s)) _ _ => apply (filterlim_comp _ _ _ f ln _ (Rbar_locally p_infty)); [ without_bound | exact is_lim_ln_p ]
  | |- filterlim (fun s => @?f s + ?c) _ _ => apply shifted_grows; [ typeclasses eauto | without_bound ]
  | |- filterlim (Rmult ?c) _ _ => apply (multiple_grows _ (fun s => s)); [ typeclasses eauto | sign | apply filterlim_id ]
  | |- filterlim (fun s => ?c * @?f s) _ _ => apply multiple_grows; [ typeclasses eauto | sign | without_bound ]
  end.
Ltac far_away :=
  lazymatch goal with
  | |- Rbar_locally p_infty _ => exists 0; intros ? ?; cbv beta; sign
  | |- filterlim _ (Rbar_locally p_infty) (Rbar_locally p_infty) => without_bound
  end.

(* Products of vectors whose squared lengths are bounded. *)
Lemma product_of_vectors : forall p q x y m, 0 <= m -> (p ^ 2 + q ^ 2) * (x ^ 2 + y ^ 2) <= m ^ 2 ->
  p * x + q * y <= m /\ - (p * x + q * y) <= m.
Proof.
  intros p q x y m M L. assert (S : (p * x + q * y) ^ 2 <= m ^ 2) by (pose proof (pow2_ge_0 (p * y - q * x)); lra).
  destruct (root_of_squares _ _ M S). lra.
Qed.
Lemma dot_by_multiple : forall p q x y c, 0 <= c -> p ^ 2 + q ^ 2 <= c ^ 2 * (x ^ 2 + y ^ 2) ->
  p * x + q * y <= c * (x ^ 2 + y ^ 2) /\ - (p * x + q * y) <= c * (x ^ 2 + y ^ 2).
Proof.
  intros p q x y c C L. assert (P : 0 <= x ^ 2 + y ^ 2) by (pose proof (pow2_ge_0 x); pose proof (pow2_ge_0 y); lra).
  apply product_of_vectors; [apply Rmult_le_pos; assumption|].
  apply Rle_trans with (c ^ 2 * (x ^ 2 + y ^ 2) * (x ^ 2 + y ^ 2)); [apply Rmult_le_compat_r; assumption | right; ring].
Qed.
Lemma dot_by_lengths : forall c d p q x y, 0 <= c -> 0 <= d -> p ^ 2 + q ^ 2 <= c ^ 2 -> x ^ 2 + y ^ 2 <= d ^ 2 ->
  p * x + q * y <= c * d /\ - (p * x + q * y) <= c * d.
Proof.
  intros c d p q x y C D L M. apply product_of_vectors; [apply Rmult_le_pos; assumption|].
  rewrite Rpow_mult_distr. apply Rmult_le_compat; try assumption;
    [ pose proof (pow2_ge_0 p); pose proof (pow2_ge_0 q) | pose proof (pow2_ge_0 x); pose proof (pow2_ge_0 y) ]; lra.
Qed.
Lemma squares_below : forall a b s r, 0 <= a -> a <= b -> a ^ 2 = s -> b ^ 2 = r -> s <= r.
Proof. intros a b s r A L E F. subst s r. apply pow_incr. split; assumption. Qed.
Ltac squares_of a b s r :=
  let S := fresh in assert (S : s <= r) by (apply (squares_below a b s r); [ sign | lra | squared | squared ]).
Ltac dots p q x y c := let D := fresh in
  assert (D : p * x + q * y <= c * (x ^ 2 + y ^ 2) /\ - (p * x + q * y) <= c * (x ^ 2 + y ^ 2))
    by (apply (dot_by_multiple p q x y c); [ sign | lra ]); destruct D.
Ltac dots_by_lengths c d p q x y := let D := fresh in
  assert (D : p * x + q * y <= c * d /\ - (p * x + q * y) <= c * d)
    by (apply (dot_by_lengths c d p q x y); [ sign | sign | lra | lra ]); destruct D.

(* Powers of a base that may be 0. *)
Ltac letter_for name b :=
  let P := fresh in
  assert (P : 0 <= b) by (first [ sign | nra | match goal with H : ?a <= ?c |- 0 <= ?c => apply Rle_trans with (2 := H); sign
    | H : ?a <= ?c |- 0 <= ?d => apply Rle_trans with a; [ sign | replace d with c by rational; exact H ] end ]);
  set (name := b) in *; clearbody name.
Lemma nonneg_cases : forall x, 0 <= x -> x = 0 \/ 0 < x.
Proof. intros x [P | P]; [right; exact P | left; symmetry; exact P]. Qed.
Ltac zero_or_positive b :=
  let P := fresh in assert (P : 0 <= b) by sign;
  let E := fresh in destruct (nonneg_cases b P) as [E | E]; [ rewrite ?E in *; clear E P; try clear b | ].
Ltac exponent_sign := first [ sign | lra | match goal with |- 0 < ?e => field_simplify e; [ sign | sides ] end
  | match goal with |- 0 < ?a / ?b => apply Rdiv_lt_0_compat; lra end ].
Ltac zero_powers :=
  repeat match goal with
  | |- context [rpow 0 ?e] => rewrite (rpow_zero 0 e eq_refl) by exponent_sign
  | H : context [rpow 0 ?e] |- _ => rewrite (rpow_zero 0 e eq_refl) in H by exponent_sign
  end.
Ltac positive_powers ::=
  repeat match goal with
  | |- context [rpow ?x ?e] => rewrite (rpow_Rpower x e) by sign
  | H : context [rpow ?x ?e] |- _ => rewrite (rpow_Rpower x e) in H by sign
  end.
