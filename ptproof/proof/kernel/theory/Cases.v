(* Cases, roots, bounds of one variable, and sums of multiples of facts. Everything here is proved. *)

(* Minima, maxima, absolute values and branches, one at a time. *)
Lemma Rmax_case_of : forall a b, (b <= a /\ Rmax a b = a) \/ (a <= b /\ Rmax a b = b).
Proof. intros a b. destruct (Rle_dec a b); [right | left]; split; try lra; [apply Rmax_right | apply Rmax_left]; lra. Qed.
Lemma Rmin_case_of : forall a b, (a <= b /\ Rmin a b = a) \/ (b <= a /\ Rmin a b = b).
Proof. intros a b. destruct (Rle_dec a b); [left | right]; split; try lra; [apply Rmin_left | apply Rmin_right]; lra. Qed.
Lemma Rabs_case_of : forall a, (0 <= a /\ Rabs a = a) \/ (a <= 0 /\ Rabs a = - a).
Proof. intro a. destruct (Rle_dec 0 a); [left | right]; split; try lra; [apply Rabs_pos_eq | apply Rabs_left1]; lra. Qed.
Ltac one_of d := let L := fresh in let E := fresh in destruct d as [[L E] | [L E]]; rewrite ?E in *; clear E.
(* The two cases of a decision: its proposition or the other one is a fact then. *)
Ltac branch_of d := destruct d;
  repeat match goal with
  | H : ~ (_ <= _) |- _ => apply Rnot_le_lt in H
  | H : ~ (_ < _) |- _ => apply Rnot_lt_le in H
  | H : ~ (_ >= _) |- _ => apply Rnot_ge_lt in H
  | H : ~ (_ > _) |- _ => apply Rnot_gt_le in H
  end.

(* A product that is 0, and a quotient. *)
Lemma quotient_zero : forall a b, b <> 0 -> a / b = 0 -> a = 0.
Proof. intros a b N E. apply (Rmult_eq_reg_r (/ b)); [|apply Rinv_neq_0_compat; exact N]. rewrite Rmult_0_l. exact E. Qed.
Lemma gap_zero : forall a b d, a = b -> b - a = d -> d = 0.
Proof. intros; lra. Qed.

(* A square root by what is below it. *)
Lemma dominated : forall p q r s, 0 <= p -> q ^ 2 = s -> p ^ 2 = r -> s <= r -> 0 <= p + q.
Proof. intros p q r s P Q R L. subst. destruct (Rle_dec 0 (p + q)); [assumption|]. exfalso. nra. Qed.
Lemma dominated_strictly : forall p q r s, 0 <= p -> q ^ 2 = s -> p ^ 2 = r -> s < r -> 0 < p + q.
Proof. intros p q r s P Q R L. subst. destruct (Rlt_dec 0 (p + q)); [assumption|]. exfalso. nra. Qed.
Lemma pow2_opp : forall x, (- x) ^ 2 = x ^ 2.
Proof. intro; ring. Qed.
Ltac squared := as_reals; unfold Rdiv; rewrite ?Rpow_mult_distr, ?pow2_opp, ?Rpow_mult_distr; rewrite ?pow2_sqrt by sign; rational.
Ltac bounded_sign := first
  [ sign
  | lazymatch goal with
    | |- 0 <= _ * _ => apply Rmult_le_pos; bounded_sign
    | |- 0 <= _ => about_angles; lra
    end ].
Ltac dominated_by p q r s :=
  to_difference;
  lazymatch goal with
  | |- 0 <= ?d => replace d with (p + q) by rational; apply (dominated p q r s); [ bounded_sign | squared | squared | ]
  | |- 0 < ?d => replace d with (p + q) by rational; apply (dominated_strictly p q r s); [ bounded_sign | squared | squared | ]
  end.
Lemma root_value : forall x e, 0 <= e -> e ^ 2 = x -> sqrt x = e.
Proof. intros x e P E. rewrite <- E. apply sqrt_pow2. exact P. Qed.
Ltac root_is x e := let E := fresh in assert (E : sqrt x = e) by (apply root_value; [ sign | squared ]); rewrite ?E in *; clear E.

(* A number is c times the square of a new one, which is then its root up to the root of c. *)
Lemma square_of : forall x, 0 <= x -> exists r, 0 <= r /\ sqrt x = r /\ x = r ^ 2 /\ (0 < x -> 0 < r).
Proof.
  intros x P. exists (sqrt x). split; [apply sqrt_pos|]. split; [reflexivity|].
  split; [rewrite pow2_sqrt by exact P; reflexivity | apply sqrt_lt_R0].
Qed.
Lemma multiple_of_square : forall c x, 0 < c -> 0 <= x ->
  exists r, 0 <= r /\ sqrt x = sqrt c * r /\ x = c * r ^ 2 /\ (0 < x -> 0 < r).
Proof.
  intros c x C P. assert (D : 0 <= x / c) by (apply Rdiv_le_0_compat; assumption).
  exists (sqrt (x / c)). split; [apply sqrt_pos|]. split.
  - rewrite <- sqrt_mult by lra. f_equal. field. lra.
  - split; [rewrite pow2_sqrt by exact D; field; lra|].
    intro. apply sqrt_lt_R0. apply Rdiv_lt_0_compat; assumption.
Qed.
Ltac as_square x r :=
  let P := fresh in let E := fresh in let F := fresh in let G := fresh in
  assert (P : 0 <= x) by sign; destruct (square_of x P) as [r [? [E [F G]]]];
  try (specialize (G ltac:(sign))); rewrite ?E in *; clear E P; subst x.
Ltac as_multiple c x r :=
  let P := fresh in let E := fresh in let F := fresh in let G := fresh in
  assert (P : 0 <= x) by sign; destruct (multiple_of_square c x ltac:(lra) P) as [r [? [E [F G]]]];
  try (specialize (G ltac:(sign))); rewrite ?E in *; clear E P; subst x.
(* Equal up to the square of a root q, with Q : q q = c. *)
Ltac up_to Q := as_reals; first [ ring [Q] | field [Q]; sides ].

(* What is below a positive root is its square. *)
Ltac by_squares_of_roots := as_reals;
  repeat match goal with |- context [sqrt ?x] =>
    let p := fresh in let s := fresh in let P := fresh in let E := fresh in
    set (p := x) in *;
    assert (P : 0 < sqrt p) by (apply sqrt_lt_R0; first [ sign | unfold p; sign ]);
    assert (E : p = sqrt p * sqrt p) by (symmetry; apply sqrt_sqrt; first [ sign | unfold p; sign ]);
    set (s := sqrt p) in *; clearbody s; clearbody p; subst p end; rational.

(* Forms of degree two in two variables. *)
Lemma form_positive : forall a b c x y, 0 < a -> 0 < a * c - b ^ 2 -> 0 < x ^ 2 + y ^ 2 ->
  0 < a * x ^ 2 + 2 * b * x * y + c * y ^ 2.
Proof.
  intros a b c x y A D P. apply (divide_positive a); [exact A|].
  replace (a * (a * x ^ 2 + 2 * b * x * y + c * y ^ 2)) with ((a * x + b * y) ^ 2 + (a * c - b ^ 2) * y ^ 2) by ring.
  destruct (Req_dec y 0) as [E | E].
  - subst. assert (0 < x ^ 2) by nra. assert (x <> 0) by nra.
    assert (0 < (a * x + b * 0) ^ 2) by (apply pow2_gt_0; nra). nra.
  - assert (0 < (a * c - b ^ 2) * y ^ 2) by (apply Rmult_lt_0_compat; [exact D | apply pow2_gt_0; exact E]).
    pose proof (pow2_ge_0 (a * x + b * y)). lra.
Qed.
Lemma form_nonneg : forall a b c x y, 0 < a -> 0 <= a * c - b ^ 2 -> 0 <= a * x ^ 2 + 2 * b * x * y + c * y ^ 2.
Proof.
  intros a b c x y A D. apply (divide_nonneg a); [exact A|].
  replace (a * (a * x ^ 2 + 2 * b * x * y + c * y ^ 2)) with ((a * x + b * y) ^ 2 + (a * c - b ^ 2) * y ^ 2) by ring.
  apply Rplus_le_le_0_compat; [apply pow2_ge_0 | apply Rmult_le_pos; [exact D | apply pow2_ge_0]].
Qed.
Lemma form_semidefinite : forall a b c x y, 0 <= a -> 0 <= c -> 0 <= a * c - b ^ 2 ->
  0 <= a * x ^ 2 + 2 * b * x * y + c * y ^ 2.
Proof.
  intros a b c x y [A | A] C D; [apply form_nonneg; assumption|].
  assert (b = 0) by (subst a; nra). subst. assert (0 <= c * y ^ 2) by (apply Rmult_le_pos; [exact C | apply pow2_ge_0]). lra.
Qed.
Ltac form_from a b c x y := lazymatch goal with
  | |- 0 <= ?d => replace d with (a * x ^ 2 + 2 * b * x * y + c * y ^ 2) by rational; apply form_semidefinite
  end.
Ltac from_fact := first
  [ assumption | lra | sign
  | match goal with
    | H : ?p < ?q |- 0 < ?d => replace d with (q - p) by rational; lra
    | H : ?p > ?q |- 0 < ?d => replace d with (p - q) by rational; lra
    | H : ?p <= ?q |- 0 <= ?d => replace d with (q - p) by rational; lra
    | H : ?p >= ?q |- 0 <= ?d => replace d with (p - q) by rational; lra
    end
  | nra ].
Ltac form_of a b c x y :=
  to_difference;
  lazymatch goal with
  | |- 0 < ?d => replace d with (a * x ^ 2 + 2 * b * x * y + c * y ^ 2) by rational; apply form_positive; from_fact
  | |- 0 <= ?d => replace d with (a * x ^ 2 + 2 * b * x * y + c * y ^ 2) by rational; apply form_nonneg; from_fact
  end.

(* A bound by a factor that is positive: c (v - e) >= 0 is known. *)
Ltac at_least_by c v e s :=
  let P := fresh in let Q := fresh in let E := fresh in
  assert (P : 0 <= c * (v - e)) by from_bound;
  pose (s := v - e); assert (Q : 0 <= s) by (unfold s; apply (divide_nonneg c); [ sign | exact P ]);
  assert (E : v = e + s) by (unfold s; ring); clear P; clearbody s; subst v.
Ltac above_by c v e s :=
  let P := fresh in let Q := fresh in let E := fresh in
  assert (P : 0 < c * (v - e)) by from_bound;
  pose (s := v - e); assert (Q : 0 < s) by (unfold s; apply (divide_positive c); [ sign | exact P ]);
  assert (E : v = e + s) by (unfold s; ring); clear P; clearbody s; subst v.

(* From a square below a square. *)
Lemma root_of_squares : forall p q, 0 <= q -> p ^ 2 <= q ^ 2 -> - q <= p <= q.
Proof. intros p q Q L. split; nra. Qed.
Lemma root_of_squares_strictly : forall p q, 0 <= q -> p ^ 2 < q ^ 2 -> - q < p < q.
Proof. intros p q Q L. split; nra. Qed.
Ltac roots_of p q :=
  let L := fresh in
  first [ assert (L : p ^ 2 < q ^ 2) by from_fact; apply (root_of_squares_strictly p q ltac:(sign)) in L
        | assert (L : p ^ 2 <= q ^ 2) by from_fact; apply (root_of_squares p q ltac:(sign)) in L ];
  destruct L.

(* f grows where its derivative is not negative. *)
Lemma grows_between : forall (f g : R -> R) a b, (forall x, is_derive f x (g x)) ->
  (forall x, a <= x <= b -> 0 <= g x) -> forall x, a <= x <= b -> f a <= f x.
Proof.
  intros f g a b D P x X. destruct (MVT_gen f a x g) as [c [C E]].
  - intros; apply D.
  - intros; apply continuity_pt_filterlim. apply (ex_derive_continuous f). eexists; apply D.
  - rewrite Rmin_left, Rmax_right in C by lra. assert (0 <= g c) by (apply P; lra). nra.
Qed.
Lemma from_its_derivative : forall (f g : R -> R) a b, (forall x, is_derive f x (g x)) -> f a = 0 ->
  (forall x, a <= x <= b -> 0 <= g x) -> forall x, a <= x <= b -> 0 <= f x.
Proof. intros f g a b D Z P x X. rewrite <- Z. apply (grows_between f g a b); assumption. Qed.
Ltac zero_there := cbv beta; rewrite ?Rmult_0_r, ?Rmult_0_l; unfold Rdiv; rewrite ?Rmult_0_r, ?Rmult_0_l, ?sin_0, ?cos_0; first [ ring | field | trigonometric ].
(* f is 0 at a, and its derivative g is not negative between a and b. *)
Ltac by_derivative f g a b :=
  apply (from_its_derivative f g a b);
  [ intro; auto_derive; [ exact I | cbv beta; first [ ring | field | trigonometric ] ] | solve [zero_there] | ].
Ltac enclosed := cbv beta; intros; first [ lra | interval | match goal with H : _ <= ?x <= _ |- _ => interval with (i_bisect x, i_depth 14) end
  | match goal with H : _ <= ?x <= _ |- _ => interval with (i_bisect x, i_taylor x, i_depth 12) end ].
(* Far away: x^n times what is bounded away from 0. *)
Ltac far e := cbv beta;
  lazymatch goal with |- 0 <= ?d => replace d with e by (field; repeat split; lra) end;
  apply Rmult_le_pos; [ apply pow_le; lra | left; interval ].
Lemma in_three : forall (P : R -> Prop) m n, (forall x, 0 <= x <= m -> P x) -> (forall x, m <= x <= n -> P x) ->
  (forall x, n <= x -> P x) -> forall x, 0 <= x -> P x.
Proof.
  intros P m n A B C x X. destruct (Rle_dec x m); [apply A; lra|].
  destruct (Rle_dec x n); [apply B; lra | apply C; lra].
Qed.
Lemma in_two : forall (P : R -> Prop) a m n, (forall x, a <= x <= m -> P x) -> (forall x, m <= x <= n -> P x) ->
  forall x, a <= x <= n -> P x.
Proof. intros P a m n A B x X. destruct (Rle_dec x m); [apply A; lra | apply B; lra]. Qed.
Lemma both_sides : forall (f g : R -> R), (forall x, f (- x) = g x) -> (forall x, 0 <= x -> 0 <= f x) ->
  (forall x, 0 <= x -> 0 <= g x) -> forall x, 0 <= f x.
Proof.
  intros f g E A B x. destruct (Rle_dec 0 x); [apply A; assumption|].
  rewrite <- (Ropp_involutive x), E. apply B. lra.
Qed.
Lemma both_sides_alike : forall (f : R -> R), (forall x, f (- x) = f x) -> (forall x, 0 <= x -> 0 <= f x) ->
  forall x, 0 <= f x.
Proof. intros f E A. apply (both_sides f f); assumption. Qed.
Ltac turned b :=
  repeat match goal with
  | |- context [sin ?c] => assert_fails (constr_eq c b); replace (sin c) with (- sin b) by (rewrite <- sin_neg; f_equal; field)
  | |- context [cos ?c] => assert_fails (constr_eq c b); replace (cos c) with (cos b) by (rewrite <- (cos_neg b); f_equal; field)
  end.

(* A fact whose denominator is not 0, whatever its sign. *)
Lemma top_times_bottom : forall a b top bottom, a < b -> bottom <> 0 -> b - a = top / bottom -> 0 < top * bottom.
Proof.
  intros a b top bottom L N E. replace (top * bottom) with ((b - a) * bottom ^ 2) by (rewrite E; field; exact N).
  apply Rmult_lt_0_compat; [lra | apply pow2_gt_0; exact N].
Qed.
Lemma top_times_bottom_nonneg : forall a b top bottom, a <= b -> bottom <> 0 -> b - a = top / bottom -> 0 <= top * bottom.
Proof.
  intros a b top bottom L N E. replace (top * bottom) with ((b - a) * bottom ^ 2) by (rewrite E; field; exact N).
  apply Rmult_le_pos; [lra | apply pow2_ge_0].
Qed.
Ltac fact_by_square bottom top whole :=
  let go H L := let F := fresh in pose proof (L _ _ top bottom H ltac:(sign) ltac:(rational)) as F;
    replace (top * bottom) with whole in F by ring in
  match goal with
  | H : ?a < ?b |- _ => go H top_times_bottom
  | H : ?a > ?b |- _ => go (Rgt_lt _ _ H) top_times_bottom
  | H : ?a <= ?b |- _ => go H top_times_bottom_nonneg
  | H : ?a >= ?b |- _ => go (Rge_le _ _ H) top_times_bottom_nonneg
  end.

(* One factor of an equation is 0 if the others are not. *)
Lemma other_factor : forall a b p q, a = b -> q <> 0 -> b - a = p * q -> p = 0.
Proof.
  intros a b p q E N F. assert (Z : p * q = 0) by lra. apply Rmult_integral in Z. destruct Z; [assumption | contradiction].
Qed.
Ltac is_not_zero := first
  [ sign | match goal with N : ?a <> ?b |- _ <> 0 => let E := fresh in intro E; apply N; lra end
  | let E := fresh in intro E; nra ].
Ltac factor_is_zero p q :=
  match goal with
  | H : ?a = ?b |- _ => let F := fresh in assert (F : p = 0) by (apply (other_factor a b p q H); [ is_not_zero | rational ])
  end.

Ltac rational ::= as_reals; first [ reflexivity | ring | field; sides
  | match goal with Q : ?q * ?q = IZR _ |- _ => up_to Q end ].
Ltac keeps_root c := let Q := fresh in assert (Q : sqrt c * sqrt c = c) by (apply sqrt_sqrt; lra).

(* What is known of sin and cos of u for every u. *)
Lemma sin_by_its_argument : forall u, u ^ 2 - u ^ 4 / 6 <= u * sin u <= u ^ 2.
Proof.
  intro u. assert (H : forall y, 0 <= y -> y ^ 2 - y ^ 4 / 6 <= y * sin y <= y ^ 2).
  { intros y Y. pose proof (sin_above y Y). pose proof (sin_below y Y). split; nra. }
  destruct (Rle_dec 0 u) as [P | P]; [apply H; exact P|].
  replace (u * sin u) with ((- u) * sin (- u)) by (rewrite sin_neg; ring).
  replace (u ^ 2) with ((- u) ^ 2) by ring. replace (u ^ 4) with ((- u) ^ 4) by ring. apply H. lra.
Qed.
Ltac bounds_of_sin u := pose proof (sin_square_below u); pose proof (proj1 (sin_by_its_argument u));
  pose proof (proj2 (sin_by_its_argument u)); pose proof (proj1 (SIN_bound u)); pose proof (proj2 (SIN_bound u)).
Ltac bounds_of_cos u := pose proof (proj1 (cos_between u)); pose proof (proj2 (cos_between u));
  pose proof (proj1 (COS_bound u)); pose proof (proj2 (COS_bound u)).
(* Two-sided. *)
Ltac between := apply Rle_antisym.
(* A fact that says less than 0 of what is not negative; or that this is 0. *)
Ltac contradicts bottom top below :=
  exfalso; fact_from bottom top;
  assert (0 < below) by sign || assert (0 <= below) by sign;
  assert (top = - (below)) by ring; lra.
Ltac vanishes v :=
  let E := fresh in assert (E : v = 0) by (apply Rle_antisym; [ | assumption ];
    match goal with
    | H : ?a <= ?b |- _ => apply Rnot_lt_le; let L := fresh in intro L;
        assert (0 < a - b) by (match goal with |- 0 < ?d => field_simplify d; [ sign | sides ] end); lra
    end); subst v.

Ltac each_factor := first
  [ sign
  | lazymatch goal with
    | |- 0 <= _ * _ => apply Rmult_le_pos; each_factor
    | |- 0 < _ * _ => apply Rmult_lt_0_compat; each_factor
    | |- 0 <= _ / _ => apply Rdiv_le_0_compat; [each_factor | sign]
    | |- 0 < _ / _ => apply Rdiv_lt_0_compat; [each_factor | sign]
    | |- 0 <= _ => timeout 2 nra
    | |- 0 < _ => timeout 2 nra
    end ].
Ltac factors_as e := to_difference; written_as e; each_factor.

(* Values at places that are known. *)
Ltac known_values :=
  same_values; rewrite ?sin_3PI2, ?cos_3PI2, ?sin_PI2, ?cos_PI2, ?sin_PI, ?cos_PI, ?sin_2PI, ?cos_2PI, ?sin_0, ?cos_0;
  first [ rational | apply root_value; [ sign | squared ] | symmetry; apply root_value; [ sign | squared ] ].

(* The same on every neighbourhood. *)
Ltac everywhere :=
  cbv beta;
  lazymatch goal with
  | |- locally _ _ => apply filter_forall; intro; everywhere
  | |- ex_derive _ _ => solve [ differentiable | derivative_sides ]
  | |- _ => sign
  end.

(* A power of what is itself a power: the exponents cancel. *)
Lemma power_of_power : forall v x a b, v = rpow x a -> 0 < x -> a * b = 1 -> Rpower v b = x.
Proof.
  intros v x a b E P F. rewrite E, rpow_Rpower by exact P. rewrite Rpower_mult, F. apply Rpower_1. exact P.
Qed.
Ltac power_back v x a b :=
  let E := fresh in
  assert (E : Rpower v b = x) by
    (apply (power_of_power v x a b); [ assumption | first [ sign | match goal with H : 0 < _ \/ _ |- _ => destruct H as [H | [_ H]]; [ exact H | exfalso; sign ] end ] | field; sides ]);
  rewrite ?E in *; clear E.

(* y^e with e > 0 grows without bound where y does. *)
Lemma power_grows : forall (F : (R -> Prop) -> Prop) (f : R -> R) e, Filter F -> 0 < e ->
  filterlim f F (Rbar_locally p_infty) -> filterlim (fun d => Rpower (f d) e) F (Rbar_locally p_infty).
Proof.
  intros F f e FF P L. unfold Rpower.
  apply (filterlim_comp _ _ _ (fun d => e * ln (f d)) exp F (Rbar_locally p_infty)); [| exact is_lim_exp_p].
  apply (filterlim_comp _ _ _ f (fun y => e * ln y) F (Rbar_locally p_infty)); [exact L|].
  apply (filterlim_comp _ _ _ ln (fun y => e * y) (Rbar_locally p_infty) (Rbar_locally p_infty)); [exact is_lim_ln_p|].
  intros Q [M HM]. exists (M / e). intros y Y. apply HM. apply (Rmult_lt_compat_l e) in Y; [|exact P].
  replace (e * (M / e)) with M in Y by (field; lra). exact Y.
Qed.
Lemma multiple_grows : forall (F : (R -> Prop) -> Prop) (f : R -> R) c, Filter F -> 0 < c ->
  filterlim f F (Rbar_locally p_infty) -> filterlim (fun d => c * f d) F (Rbar_locally p_infty).
Proof.
  intros F f c FF P L. apply (filterlim_comp _ _ _ f (fun y => c * y) F (Rbar_locally p_infty)); [exact L|].
  intros Q [M HM]. exists (M / c). intros y Y. apply HM. apply (Rmult_lt_compat_l c) in Y; [|exact P].
  replace (c * (M / c)) with M in Y by (field; lra). exact Y.
Qed.
Lemma quotient_grows : forall c, 0 < c -> filterlim (fun d => c / d) (at_right 0) (Rbar_locally p_infty).
Proof. intros c P. unfold Rdiv. apply multiple_grows; [typeclasses eauto | exact P | exact filterlim_Rinv_0_right]. Qed.
Ltac grows_by_parts :=
  cbv beta;
  lazymatch goal with
  | |- filterlim (fun d => Rpower (@?f d) ?e) _ _ => apply power_grows; [ typeclasses eauto | positive_exponent | grows_by_parts ]
  | |- filterlim (fun d => ?c * @?f d) _ _ => apply multiple_grows; [ typeclasses eauto | sign | grows_by_parts ]
  | |- filterlim (Rdiv ?c) _ _ => apply (quotient_grows c); sign
  | |- filterlim (fun d => ?c / d) _ _ => apply quotient_grows; sign
  end
with positive_exponent := first
  [ sign
  | match goal with |- 0 < / ?e => apply Rinv_0_lt_compat end;
    match goal with |- 0 < ?e => field_simplify e; [ sign | sides ] end ].
Ltac near_by_sign :=
  lazymatch goal with
  | |- at_right 0 _ => let d := fresh "d" in generalize right_positive; apply filter_imp; intros d ?; cbv beta;
      first [ sign | let E := fresh in intro E; field_simplify_eq in E; [ lra | sides ] ]
  | |- filterlim _ (at_right 0) (Rbar_locally p_infty) => grows_by_parts
  end.
(* Absolute values of products, of which one factor has a plain sign. *)
Ltac absolute_values :=
  rewrite ?Rabs_mult, ?Rabs_Ropp;
  repeat match goal with |- context [Rabs ?x] =>
    let E := fresh in assert (E : Rabs x = x) by (apply Rabs_pos_eq; sign); rewrite E; clear E end.
