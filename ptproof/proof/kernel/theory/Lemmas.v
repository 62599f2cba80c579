(* Claims that are used as lemmas. Everything here is proved. *)
Lemma integer_plus : forall x y, is_integer x -> is_integer y -> is_integer (x + y).
Proof. intros x y [m M] [n N]. exists (m + n)%Z. rewrite plus_IZR. lra. Qed.
Lemma integer_minus : forall x y, is_integer x -> is_integer y -> is_integer (x - y).
Proof. intros x y [m M] [n N]. exists (m - n)%Z. rewrite minus_IZR. lra. Qed.
Lemma integer_mult : forall x y, is_integer x -> is_integer y -> is_integer (x * y).
Proof. intros x y [m M] [n N]. exists (m * n)%Z. rewrite mult_IZR. subst. reflexivity. Qed.
Lemma integer_constant : forall z, is_integer (IZR z).
Proof. intro z. exists z. reflexivity. Qed.
Ltac whole := first
  [ assumption | apply integer_constant | apply integer_plus; whole | apply integer_minus; whole | apply integer_mult; whole ].
Ltac assumed K t := lazymatch type of K with
  | ?A -> _ => let P := fresh in assert (P : A) by (first [ t | fail 1 "at" A ]); specialize (K P)
  end.
(* Powers whose exponents are numbers, or which are of roots. *)
Lemma rpow_one : forall x e, e = 1 -> 0 <= x -> rpow x e = x.
Proof.
  intros x e E [P | P]; subst.
  - rewrite rpow_Rpower by exact P. apply Rpower_1, P.
  - apply rpow_zero; lra.
Qed.
Lemma rpow_half : forall x e, e = 1 / 2 -> 0 <= x -> rpow x e = sqrt x.
Proof.
  intros x e E [P | P]; subst e.
  - rewrite rpow_Rpower by exact P. replace (1 / 2) with (/ 2) by field. apply Rpower_sqrt, P.
  - subst x. rewrite sqrt_0. apply rpow_zero; lra.
Qed.
Lemma rpow_two : forall x e, e = 2 -> 0 <= x -> rpow x e = x ^ 2.
Proof.
  intros x e E [P | P]; subst e.
  - rewrite rpow_Rpower by exact P. replace 2 with (INR 2) by (simpl; ring). apply Rpower_pow, P.
  - subst x. rewrite rpow_zero by lra. ring.
Qed.
Lemma rpow_none : forall x e, e = 0 -> rpow x e = 1.
Proof.
  intros x e E. subst. unfold rpow. destruct (Req_EM_T x 0); [destruct (Req_EM_T 0 0); [reflexivity | contradiction]|].
  unfold Rpower. rewrite Rmult_0_l. apply exp_0.
Qed.
Lemma Rpower_one : forall x e, e = 1 -> 0 < x -> Rpower x e = x.
Proof. intros x e E P; subst. apply Rpower_1, P. Qed.
Lemma Rpower_half : forall x e, e = 1 / 2 -> 0 < x -> Rpower x e = sqrt x.
Proof. intros x e E P; subst. replace (1 / 2) with (/ 2) by field. apply Rpower_sqrt, P. Qed.
Lemma Rpower_two : forall x e, e = 2 -> 0 < x -> Rpower x e = x ^ 2.
Proof. intros x e E P; subst. replace 2 with (INR 2) by (simpl; ring). apply Rpower_pow, P. Qed.
Lemma Rpower_three_halves : forall x e, e = 3 / 2 -> 0 < x -> Rpower x e = sqrt x ^ 3.
Proof.
  intros x e E P; subst. rewrite <- Rpower_sqrt by exact P. rewrite <- (Rpower_pow 3) by apply exp_pos.
  rewrite Rpower_mult. f_equal. simpl; field.
Qed.
Lemma Rpower_none : forall x e, e = 0 -> Rpower x e = 1.
Proof. intros x e E. subst. unfold Rpower. rewrite Rmult_0_l. apply exp_0. Qed.
Lemma rpow_of_root : forall x e, 0 <= x -> rpow (sqrt x) e = rpow x (e / 2).
Proof.
  intros x e [P | P].
  - rewrite !rpow_Rpower by (try apply sqrt_lt_R0; exact P). rewrite <- Rpower_sqrt by exact P. rewrite Rpower_mult.
    f_equal. field.
  - subst x. rewrite sqrt_0. unfold rpow. destruct (Req_EM_T 0 0); [|contradiction].
    destruct (Req_EM_T e 0), (Req_EM_T (e / 2) 0); try reflexivity; exfalso; lra.
Qed.
Ltac simple_power x e lemma1 lemmah lemma2 lemma0 :=
  first [ rewrite (lemma1 x e) in * by (first [ field; sides | sign ])
        | rewrite (lemmah x e) in * by (first [ field; sides | sign ])
        | rewrite (lemma2 x e) in * by (first [ field; sides | sign ])
        | rewrite (lemma0 x e) in * by (field; sides) ].
Ltac same_exponents f x a := match goal with
  | |- context [f x ?b] => assert_fails (constr_eq a b); replace (f x b) with (f x a) by (f_equal; field; sides)
  end.
Lemma Rpower_of_root : forall x e, 0 < x -> Rpower (sqrt x) e = Rpower x (e / 2).
Proof. intros x e P. rewrite <- Rpower_sqrt by exact P. rewrite Rpower_mult. f_equal. field. Qed.
(* The root of a product of squares. *)
Ltac root_of x := lazymatch x with
  | ?a * ?b => let r := root_of a in let s := root_of b in constr:(r * s)
  | ?a / ?b => let r := root_of a in let s := root_of b in constr:(r / s)
  | ?a ^ 2 => a
  | IZR ?z => let r := eval compute in (Z.sqrt z) in constr:(IZR r)
  end.
Ltac simple_powers :=
  repeat match goal with
  | |- context [sqrt ?x] => let r := root_of x in rewrite (root_value x r) in * by (first [ sign | rational ])
  | |- context [sqrt ?x ^ 2] => rewrite (pow2_sqrt x) in * by sign
  | |- context [rpow ?x ?e] => rewrite (rpow_Rpower x e) in * by (first [ assumption | lra ])
  | |- context [Rpower (Rpower ?x ?a) ?b] => rewrite (Rpower_mult x a b) in *
  | |- context [Rpower (sqrt ?x) ?e] => rewrite (Rpower_of_root x e) in * by (first [ assumption | lra ])
  | |- context [Rpower (?x * ?y) ?e] => rewrite <- (Rpower_mult_distr x y e) in * by sign
  | |- context [rpow (sqrt ?x) ?e] => rewrite (rpow_of_root x e) in * by sign
  | |- context [rpow ?x ?e] => simple_power x e rpow_one rpow_half rpow_two rpow_none
  | |- context [Rpower ?x ?e] => simple_power x e Rpower_one Rpower_half Rpower_two Rpower_none
  | |- context [Rpower ?x ?e] => rewrite (Rpower_three_halves x e) in * by (first [ field; sides | sign ])
  end;
  repeat match goal with
  | |- context [rpow ?x ?a] => same_exponents rpow x a
  | |- context [Rpower ?x ?a] => same_exponents Rpower x a
  end.
(* Roots, powers and exponentials of what is a number once it is multiplied out. *)
Lemma rpow_of_one : forall e, rpow 1 e = 1.
Proof. intro e. rewrite rpow_Rpower by lra. unfold Rpower. rewrite ln_1, Rmult_0_r. apply exp_0. Qed.
Ltac simple_values := repeat match goal with
  | |- context [exp ?x] => lazymatch x with context [ln ?u] => let E := fresh in first
      [ assert (E : x = ln u) by rational; rewrite E, (exp_ln u) by sign; clear E
      | assert (E : x = - ln u) by rational; rewrite E, exp_Ropp, (exp_ln u) by sign; clear E ] end
  | |- context [sqrt ?x] => let E := fresh in assert (E : x = 1) by rational; rewrite E, sqrt_1; clear E
  | |- context [sqrt ?x] => let E := fresh in assert (E : x = 0) by rational; rewrite E, sqrt_0; clear E
  | |- context [cos (IZR (Zneg ?n))] => change (IZR (Zneg n)) with (- IZR (Zpos n)); rewrite cos_neg
  | |- context [sin (IZR (Zneg ?n))] => change (IZR (Zneg n)) with (- IZR (Zpos n)); rewrite sin_neg
  | |- context [exp ?x] => let E := fresh in assert (E : x = 0) by rational; rewrite E, exp_0; clear E
  | |- context [rpow ?x ?e] => let E := fresh in assert (E : x = 1) by rational; rewrite E, rpow_of_one; clear E
  end.
(* Powers of one base by each other: 0 or positive, and every exponent a multiple of another one. *)
Ltac base_cases := repeat match goal with
  | |- context [rpow ?x ?e] =>
      let P := fresh in assert (P : 0 <= x) by (first [ assumption | lra | sign ]);
      let E := fresh in destruct (nonneg_cases x P) as [E | E];
      [ rewrite ?E; zero_powers | repeat match goal with |- context [rpow x ?a] => rewrite (rpow_Rpower x a E) end ]
  end.
Ltac multiple_powers := repeat match goal with |- context [Rpower ?x ?b] =>
  match goal with |- context [Rpower x ?a] =>
    assert_fails (constr_eq a b);
    let E := fresh in assert (E : Rpower x b = Rpower x a ^ 2) by (timeout 3 by_powers); rewrite E; clear E
  end end.
Ltac same_by_powers := as_reals; simple_values; base_cases; multiple_powers; rational.
Ltac said_by_powers H := lazymatch type of H with
  | _ <= _ => apply (le_as _ _ _ _ H)
  | _ < _ => apply (lt_as _ _ _ _ H)
  | _ >= _ => apply (ge_as _ _ _ _ H)
  | _ > _ => apply (gt_as _ _ _ _ H)
  | _ = _ => apply (eq_as _ _ _ _ H)
  end; same_by_powers.
(* Squares of products with roots and exponentials. *)
Lemma exp_square : forall x, exp x ^ 2 = exp (2 * x).
Proof. intro x. replace (2 * x) with (x + x) by ring. rewrite exp_plus. ring. Qed.
Ltac squares_of_factors := progress (rewrite ?Rpow_mult_distr, ?exp_square; repeat rewrite pow2_sqrt by sign).
(* Equal part by part: the same powers, exponentials and roots of what is equal, in sums and products of either order. *)
Ltac agree := as_reals; first
  [ reflexivity
  | lazymatch goal with
    | |- rpow _ _ = rpow _ _ => f_equal; agree
    | |- Rpower _ _ = Rpower _ _ => f_equal; agree
    | |- exp _ = exp _ => f_equal; agree
    | |- sqrt _ = sqrt _ => f_equal; agree
    | |- ?a + ?b = ?c + ?d => first [ by_arithmetic | solve [ f_equal; agree ] | solve [ rewrite (Rplus_comm c d); f_equal; agree ] ]
    | |- ?a * ?b = ?c * ?d => first [ by_arithmetic | solve [ f_equal; agree ] | solve [ rewrite (Rmult_comm c d); f_equal; agree ] ]
    | |- _ / _ = _ / _ => first [ by_arithmetic | solve [ f_equal; agree ] ]
    | |- _ => by_arithmetic
    end ]
with by_arithmetic := solve [ ring | field; sides ].
Ltac agrees H := lazymatch type of H with
  | _ <= _ => lazymatch goal with |- _ >= _ => apply Rle_ge | |- _ => idtac end; apply (le_as _ _ _ _ H); agree
  | _ < _ => lazymatch goal with |- _ > _ => red | |- _ => idtac end; apply (lt_as _ _ _ _ H); agree
  | _ >= _ => lazymatch goal with |- _ <= _ => apply (le_as _ _ _ _ (Rge_le _ _ H)) | |- _ => apply (ge_as _ _ _ _ H) end; agree
  | _ = _ => apply (eq_as _ _ _ _ H); agree
  end.
(* H in other words: both sides are the same by arithmetic. *)
Ltac in_words H := first
  [ exact H | lra | solve [ timeout 10 (agrees H) ] | timeout 10 (as_said H)
  | solve [ squares_of_factors; timeout 10 (as_said H) ]
  | solve [ revert H; progress simple_powers; intro H;
      first [ exact H | timeout 10 (as_said H) | squares_of_factors; timeout 10 (as_said H) ] ]
  | solve [ progress (repeat match goal with |- context [sqrt ?x] => is_var x; by_root x end); timeout 10 (as_said H) ]
  | solve [ timeout 12 (said_by_powers H) ] ].
Ltac as_claimed P t := let H := fresh in assert (H : P) by (first [ assumption | t ]); in_words H.
Ltac as_known P H := first [ assert P by assumption; clear H | assert P by (timeout 25 (in_words H)); clear H | idtac ].
Ltac function_premise :=
  first [ assumption | intros; cbv beta; first [ assumption | solve [ sign ] | solve [ derivable ] | solve [ whole ]
        | match goal with H : forall _, _ |- _ => solve [ apply H ] end ] ].
(* A root and what it is below, or above. *)
Lemma below_root : forall x y, 0 <= x -> x ^ 2 <= y -> x <= sqrt y.
Proof. intros x y X L. rewrite <- (sqrt_pow2 x X). apply sqrt_le_1_alt, L. Qed.
Lemma root_below : forall x y, 0 <= y -> x <= y ^ 2 -> sqrt x <= y.
Proof. intros x y Y L. rewrite <- (sqrt_pow2 y Y). apply sqrt_le_1_alt, L. Qed.
Ltac by_square_of_root :=
  first [ apply below_root; [ sign | ] | apply root_below; [ sign | ] ];
  rewrite ?Rpow_mult_distr; repeat rewrite pow2_sqrt by sign; found_as.
Ltac by_squares_of_sides := match goal with H : ?x <= ?y |- ?a <= ?y ^ 2 =>
  apply Rle_trans with (x ^ 2); [ right; squares_of_factors; alike | apply pow_incr; split; [ first [ assumption | sign ] | exact H ] ] end.
Ltac library_lemma := first
  [ assumption | lra | solve [ sign ] | apply rpow_nonneg
  | apply exp_le_exp; lra | apply exp_above
  | solve [ by_square_of_root ] | solve [ by_squares_of_sides ]
  | apply rpow_mono; first [ assumption | lra | sign ]
  | timeout 3 inequality ].

(* A goal from few facts by contradiction. *)
Ltac plain_number x := first [ is_var x | lazymatch x with IZR _ => idtac end ].
Ltac only_from P :=
  let N := fresh in
  match goal with |- ?G => let Q := only_goal P G in enough (N : Q) by (apply N; first [ assumption | lra | solve [ sign ] | timeout 10 found_as ]) end;
  repeat match goal with H : ?T |- _ =>
    lazymatch T with
    | ?a < ?b => assert_fails (plain_number a; plain_number b)
    | ?a <= ?b => assert_fails (plain_number a; plain_number b)
    | ?a > ?b => assert_fails (plain_number a; plain_number b)
    | ?a >= ?b => assert_fails (plain_number a; plain_number b)
    | ?a <> ?b => assert_fails (plain_number a; plain_number b)
    | @eq R ?a ?b => assert_fails (plain_number a; plain_number b)
    end; clear H end;
  intros
with only_goal P G := lazymatch P with True => G | ?A -> ?B => let Q := only_goal B G in constr:(A -> Q) end.
Lemma equation_top : forall a b top bottom, a = b -> 0 < bottom -> b - a = top / bottom -> top = 0.
Proof. intros a b top bottom L P E. replace top with ((b - a) * bottom) by (rewrite E; field; lra). rewrite L. ring. Qed.
Ltac equation_from bottom top :=
  match goal with H : ?a = ?b |- _ => first
    [ assert (top = 0) by (apply (equation_top a b top bottom H); [ sign | rational ])
    | assert (top = 0) by (apply (equation_top b a top bottom (eq_sym H)); [ sign | rational ]) ] end.
Ltac deny d := lazymatch goal with
  | |- 0 <= ?t => apply Rnot_lt_le; let N := fresh in intro N; assert (0 < d) by (replace d with (- t) by ring; lra); clear N
  | |- 0 < ?t => apply Rnot_le_lt; let N := fresh in intro N; assert (0 <= d) by (replace d with (- t) by ring; lra); clear N
  end.
Lemma times_zero : forall a b, b = 0 -> a * b = 0.
Proof. intros; subst; ring. Qed.
Ltac no_product p := assert (p = 0) by (apply times_zero; assumption).
Ltac power_known := first [ by_powers | solve [ rewrite <- Rsqr_pow2; apply Rsqr_sqrt; sign ] | solve [ apply pow2_sqrt; sign ]
  | match goal with |- sin ?x ^ 2 = _ => pose proof (sin2_cos2 x); unfold Rsqr in *; lra end ].
(* A bound that a function never comes above: how the gap moves, and what an exponential or a power is at the start. *)
Ltac gap_moves U Y s defined := intros s ?; facts; defined; apply (is_derive_minus U Y);
  [ apply Derive_correct; first [ assumption | match goal with H : forall _, _ |- _ => solve [ apply H; lra ] end ]
  | auto_derive; [ repeat split; sign | first [ rational | same_values; rational ] ] ].
Ltac value_at old new := replace old with new by
  (first [ rational | rewrite <- exp_0; f_equal; rational | unfold Rpower; rewrite <- exp_0; f_equal; rational ]).
(* A product of exponentials as one, and equal exponents. *)
Ltac exponents_agree := repeat rewrite Rmult_assoc; rewrite <- ?exp_plus; first [ rational | f_equal; f_equal; rational | same_values; rational ].
(* A sum as a product with another one. *)
Ltac same_sum old new := let E := fresh in assert (E : old = new) by (field; sides); rewrite ?E in *; clear E.
(* A variable by a letter for a sum in which it stands. *)
Ltac moved w v value := let E := fresh in assert (E : v = value) by (unfold w; rational); clearbody w; subst v.
(* A minimum, maximum or absolute value as a letter with its bounds. *)
Lemma Rabs_bounds : forall a, a <= Rabs a /\ - a <= Rabs a /\ 0 <= Rabs a.
Proof. intro a. split; [apply Rle_abs|]. split; [rewrite <- Rabs_Ropp; apply Rle_abs | apply Rabs_pos]. Qed.
Ltac bounded_as w e :=
  lazymatch e with
  | Rmax ?a ?b => pose proof (Rmax_l a b); pose proof (Rmax_r a b)
  | Rmin ?a ?b => pose proof (Rmin_l a b); pose proof (Rmin_r a b)
  | Rabs ?a => pose proof (Rabs_bounds a); facts
  end;
  try (assert (0 < e) by (first [ sign | lra ])); try (assert (0 <= e) by (first [ sign | lra ]));
  named w e.
Ltac bisected x := cbv beta; interval with (i_bisect x, i_depth 14).
(* A value between numbers. *)
Ltac between_numbers low e high := assert (low <= e) by interval; assert (e <= high) by interval.
(* Powers of exponentials as exponentials. *)
Lemma exp_power : forall a n, exp a ^ n = exp (IZR (Z.of_nat n) * a).
Proof.
  intros a n. rewrite <- INR_IZR_INZ. induction n as [|n H].
  - simpl. rewrite Rmult_0_l, exp_0. reflexivity.
  - rewrite S_INR. change (exp a ^ S n) with (exp a * exp a ^ n). rewrite H, <- exp_plus. f_equal. ring.
Qed.
Ltac powers_of_exponentials :=
  rewrite ?Rpow_mult_distr;
  repeat match goal with |- context [exp ?a ^ ?n] => let z := eval compute in (Z.of_nat n) in
    rewrite (exp_power a n); change (Z.of_nat n) with z end.
Ltac alike ::= as_reals; first
  [ reflexivity | ring | field; sides | solve [ same_heads; first [ reflexivity | ring | field; sides ] ]
  | solve [ progress powers_of_exponentials; same_heads; first [ ring | field; sides ] ]
  | solve [ progress absolute_values; first [ ring | field; sides ] ]
  | solve [ match goal with |- context [Rabs ?a] => match goal with |- context [Rabs ?b] =>
      assert_fails (constr_eq a b); replace (Rabs a) with (Rabs b) by (rewrite <- Rabs_Ropp; f_equal; ring) end end;
      first [ reflexivity | ring | field; sides ] ] ].
(* What is known to be positive at all times is so at q. *)
Ltac positive_at q := match goal with H : forall _ : R, _ |- _ =>
  solve [ let K := fresh in pose proof (H q) as K; premises_of K; facts; found_as ] end.
Ltac sign_above := match goal with |- 1 <= 1 + ?x => cut (0 <= x); [ lra | sign ] end.
(* A power of what is at least 1 by one of a smaller whole exponent. *)
Lemma Rpower_at_least : forall b e n, 1 <= b -> INR n <= e -> b ^ n <= Rpower b e.
Proof.
  intros b e n B E. rewrite <- Rpower_pow by lra. unfold Rpower. apply exp_le_exp.
  apply Rmult_le_compat_r; [|exact E]. rewrite <- ln_1. destruct B as [B | B]; [left; apply ln_increasing; lra | rewrite B; lra].
Qed.
Ltac power_at_least b e n :=
  assert (b ^ n <= Rpower b e) by (apply Rpower_at_least; [ first [ lra | sign_above ] | simpl INR; first [ lra | nra ] ]).
(* A power whose exponent is a whole multiple of that of another one. *)
Lemma Rpower_whole : forall x e f n, f = INR n * e -> Rpower x f = Rpower x e ^ n.
Proof. intros x e f n E. rewrite <- Rpower_pow by apply exp_pos. rewrite Rpower_mult, E. f_equal. ring. Qed.
Lemma rpow_whole : forall x e f n, f = INR n * e -> 0 <= x -> 0 < e -> (0 < n)%nat -> rpow x f = rpow x e ^ n.
Proof.
  intros x e f n E [X | X] P N.
  - rewrite !rpow_Rpower by exact X. apply Rpower_whole, E.
  - assert (0 < INR n) by (apply lt_0_INR, N). subst x f. rewrite !rpow_zero by nra. symmetry. apply pow_i, N.
Qed.
Ltac whole_power old new n := let E := fresh in
  assert (E : old = new ^ n) by (first
    [ apply Rpower_whole; cbn [INR]; rational
    | apply rpow_whole; [ cbn [INR]; rational | first [ assumption | lra | sign ] | exponent_sign | lia ] ]);
  rewrite ?E in *; clear E.
(* What is below a power of what may be 0. *)
Lemma below_power_from_0 : forall x e q r, 0 <= x -> 0 <= r -> 0 < e -> q * e = 1 -> rpow x e <= r -> x <= rpow r q.
Proof.
  intros x e q r X R E I L. assert (Q : 0 < q) by (apply Rmult_lt_reg_r with e; lra).
  replace x with (rpow (rpow x e) q); [apply rpow_mono; [exact Q | apply rpow_nonneg | exact L]|].
  replace e with (/ q); [apply rpow_root; assumption|]. apply (Rmult_eq_reg_l q); [rewrite I; field; lra | lra].
Qed.
Ltac raised_bound_from_0 x e q r :=
  assert (x <= rpow r q) by (apply (below_power_from_0 x e q r); [ sign | sign | sign | rational | lra ]).
