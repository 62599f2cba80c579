(* What the restated claims are said with, and the tactics that are tried on them. Everything here is proved. *)
From Coq Require Import Reals Lra Lia Psatz Nsatz FunctionalExtensionality.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Tactic.
Open Scope R_scope.

(* The declarations of symbols. *)
Lemma Rlt_Rminus_rev : forall a b, 0 < b - a -> a < b.
Proof. intros. lra. Qed.

Definition is_integer (x : R) : Prop := exists z : Z, x = IZR z.

(* x^y for x >= 0: Coq's Rpower is 1 where x = 0. *)
Definition rpow (x y : R) : R :=
  if Req_EM_T x 0 then (if Req_EM_T y 0 then 1 else 0) else Rpower x y.

Lemma rpow_Rpower : forall x y, 0 < x -> rpow x y = Rpower x y.
Proof. intros x y H. unfold rpow. destruct (Req_EM_T x 0); [lra | reflexivity]. Qed.

Lemma rpow_zero : forall x y, x = 0 -> 0 < y -> rpow x y = 0.
Proof.
  intros x y H K. unfold rpow. destruct (Req_EM_T x 0); [|contradiction].
  destruct (Req_EM_T y 0); [lra | reflexivity].
Qed.

Lemma rpow_nonneg : forall x y, 0 <= rpow x y.
Proof.
  intros x y. unfold rpow. destruct (Req_EM_T x 0); [destruct (Req_EM_T y 0); lra|].
  left. apply exp_pos.
Qed.

Lemma rpow_defined : forall x y, 0 <= x -> 0 < y -> 0 < x \/ (x = 0 /\ 0 < y).
Proof. intros x y [H | H] K; [left | right]; auto. Qed.

Lemma rpow_defined_as : forall x y, x >= 0 -> y > 0 -> 0 < x \/ (x = 0 /\ 0 < y).
Proof. intros x y H K. apply rpow_defined; lra. Qed.

Lemma Rpower_positive : forall x y, 0 < Rpower x y.
Proof. intros. apply exp_pos. Qed.

Lemma integer_at_least_1 : forall x, is_integer x -> 0 < x -> 1 <= x.
Proof. intros x [z E] H. subst. apply lt_IZR in H. apply IZR_le. lia. Qed.

Lemma ln_eq : forall x y, 0 < x -> 0 < y -> ln x = ln y -> x = y.
Proof. intros. apply ln_inv; assumption. Qed.

Lemma ln_le_inv : forall x y, 0 < x -> 0 < y -> ln x <= ln y -> x <= y.
Proof.
  intros x y H K [L | L]; [left; apply ln_lt_inv; assumption | right; apply ln_inv; assumption].
Qed.

Lemma ln_pow : forall x n, 0 < x -> ln (x ^ n) = INR n * ln x.
Proof. intros. rewrite <- Rpower_pow by assumption. unfold Rpower. apply ln_exp. Qed.

Lemma ln_sqrt : forall x, 0 < x -> ln (sqrt x) = ln x / 2.
Proof.
  intros x H. assert (E : ln x = ln (sqrt x) + ln (sqrt x)).
  { rewrite <- ln_mult by (apply sqrt_lt_R0; assumption). rewrite sqrt_sqrt by lra. reflexivity. }
  lra.
Qed.

Lemma ln_div : forall x y, 0 < x -> 0 < y -> ln (x / y) = ln x - ln y.
Proof. intros. unfold Rdiv. rewrite ln_mult, ln_Rinv; auto using Rinv_0_lt_compat. Qed.

Lemma ln_Rpower : forall x y, ln (Rpower x y) = y * ln x.
Proof. intros. unfold Rpower. apply ln_exp. Qed.

Lemma near_nonzero : forall (f : R -> R) x, ex_derive f x -> f x <> 0 -> locally x (fun y => f y <> 0).
Proof.
  intros f x D N. apply (ex_derive_continuous f) in D.
  exact (D (fun z => z <> 0) (open_neq 0 (f x) N)).
Qed.

Lemma near_positive : forall (f : R -> R) x, ex_derive f x -> 0 < f x -> locally x (fun y => 0 < f y).
Proof.
  intros f x D N. apply (ex_derive_continuous f) in D.
  exact (D (fun z => 0 < z) (open_gt 0 (f x) N)).
Qed.

Lemma near_nonneg : forall (f : R -> R) x, ex_derive f x -> 0 < f x -> locally x (fun y => 0 <= f y).
Proof.
  intros f x D N. apply (filter_imp (fun y => 0 < f y)); [intros; lra | apply near_positive; assumption].
Qed.

Lemma ln_of_more : forall x, 0 < x -> 0 < ln (x + 1).
Proof. intros x P. rewrite <- ln_1. apply ln_increasing; lra. Qed.
Lemma even_power : forall x n, Nat.even n = true -> 0 <= x ^ n.
Proof.
  intros x n E. apply Nat.even_spec in E. destruct E as [m E]. rewrite E, pow_mult. apply pow_le, pow2_ge_0.
Qed.

(* Hypotheses taken apart, and what is known of integers. *)
Ltac facts :=
  repeat match goal with
  | H : _ /\ _ |- _ => destruct H
  | H : is_integer ?n, P : 0 < ?n |- _ =>
      lazymatch goal with _ : 1 <= n |- _ => fail | _ => pose proof (integer_at_least_1 n H P) end
  end.

Ltac pieces := repeat match goal with |- _ /\ _ => split | |- _ <-> _ => fail end.

(* Signs, by the structure of the expression. *)
Ltac sign :=
  lazymatch goal with
  | |- ?a > ?b => change (b < a); sign
  | |- ?a >= ?b => apply Rle_ge; sign
  | |- _ <> 0 => first [ assumption | solve [apply Rgt_not_eq; red; sign_pos] | sign_nonzero ]
  | |- 0 < _ => first [ assumption | sign_pos ]
  | |- 0 <= _ => first [ assumption | sign_nonneg ]
  end
with sign_pos :=
  first
  [ assumption
  | lazymatch goal with
    | |- 0 < _ * _ => apply Rmult_lt_0_compat; sign_pos
    | |- 0 < _ / _ => apply Rdiv_lt_0_compat; sign_pos
    | |- 0 < / _ => apply Rinv_0_lt_compat; sign_pos
    | |- 0 < _ ^ _ => first [ apply pow_lt; sign_pos | apply pow2_gt_0; sign ]
    | |- 0 < sqrt _ => apply sqrt_lt_R0; sign_pos
    | |- 0 < exp _ => apply exp_pos
    | |- 0 < ln (_ + 1) => apply ln_of_more; sign_pos
    | |- 0 < ln (1 + _) => rewrite Rplus_comm; apply ln_of_more; sign_pos
    | |- 0 < Rpower _ _ => apply exp_pos
    | |- 0 < rpow _ _ => rewrite rpow_Rpower by sign_pos; apply exp_pos
    | |- 0 < PI => exact PI_RGT_0
    | |- 0 < Rmax ?a ?b => first [ apply Rlt_le_trans with (2 := Rmax_l a b); sign_pos | apply Rlt_le_trans with (2 := Rmax_r a b); sign_pos ]
    | |- 0 < Rmin _ _ => apply Rmin_pos; sign_pos
    | |- 0 < _ + _ => first [ apply Rplus_lt_le_0_compat; [sign_pos | sign_nonneg]
                            | apply Rplus_le_lt_0_compat; [sign_nonneg | sign_pos] ]
    end
  | match goal with H : forall _, _ |- _ => solve [simple apply H; first [assumption | lra]] end
  | lra ]
with sign_nonneg :=
  first
  [ assumption
  | lazymatch goal with
    | |- 0 <= _ * _ => apply Rmult_le_pos; sign_nonneg
    | |- 0 <= _ / _ => apply Rdiv_le_0_compat; [sign_nonneg | sign_pos]
    | |- 0 <= / _ => left; apply Rinv_0_lt_compat; sign_pos
    | |- 0 <= _ ^ 2 => apply pow2_ge_0
    | |- 0 <= _ ^ _ => first [ apply even_power; reflexivity | apply pow_le; sign_nonneg ]
    | |- 0 <= sqrt _ => apply sqrt_pos
    | |- 0 <= rpow _ _ => apply rpow_nonneg
    | |- 0 <= Rabs _ => apply Rabs_pos
    | |- 0 <= exp _ => left; apply exp_pos
    | |- 0 <= Rpower _ _ => left; apply exp_pos
    | |- 0 <= _ + _ => apply Rplus_le_le_0_compat; sign_nonneg
    end
  | match goal with H : forall _, _ |- _ => solve [simple apply H; first [assumption | lra]] end
  | lra
  | lazymatch goal with  (* of a sum, product or power the parts have been looked at *)
    | |- 0 <= _ + _ => fail | |- 0 <= _ * _ => fail | |- 0 <= _ / _ => fail | |- 0 <= _ ^ _ => fail | |- _ => left; sign_pos
    end ]
with sign_nonzero :=
  first
  [ assumption
  | lazymatch goal with
    | |- _ * _ <> 0 => apply Rmult_integral_contrapositive_currified; sign_nonzero
    | |- _ / _ <> 0 => apply Rmult_integral_contrapositive_currified; [sign_nonzero | apply Rinv_neq_0_compat; sign_nonzero]
    | |- / _ <> 0 => apply Rinv_neq_0_compat; sign_nonzero
    | |- _ ^ _ <> 0 => apply pow_nonzero; sign_nonzero
    | |- - _ <> 0 => apply Ropp_neq_0_compat; sign_nonzero
    end
  | solve [apply Rgt_not_eq; red; sign_pos]
  | lra
  | match goal with
    | H : ?h <> 0 |- ?g <> 0 =>
        let E := fresh in intro E; apply H; first [ lra | field_simplify_eq; [ lra | repeat split; sign_pos ] ]
    end
  | match goal with
    | |- ?g <> 0 => let E := fresh in intro E;
        field_simplify_eq in E; [ lra | repeat split; sign_pos ]
    end ].

(* The same after the polynomial is multiplied out, so that what cancels is gone. *)
Ltac sign_of_polynomial :=
  match goal with
  | |- ?e <> 0 => progress ring_simplify e; sign
  | |- 0 < ?e => progress ring_simplify e; sign
  | |- 0 <= ?e => progress ring_simplify e; sign
  end.
Ltac sides := repeat split; first [ sign | assumption | sign_of_polynomial ].

(* Equal arguments of one unknown function are made the same. *)
Ltac same_arguments :=
  repeat match goal with
  | |- context [?f ?a] =>
      is_var f;
      match goal with
      | |- context [f ?b] =>
          lazymatch type of a with R => idtac end;
          assert_fails (constr_eq a b);
          let E := fresh in assert (E : a = b) by (field; sides); rewrite E; clear E
      end
  end.

(* The same for the functions of the library, whose values at 0 are known. *)
Ltac same_values :=
  rewrite ?sin_0, ?cos_0, ?exp_0;
  repeat match goal with
  | |- context [exp ?a] => let E := fresh in assert (E : a = 0) by (field; sides); rewrite E, exp_0; clear E
  | |- context [sin ?a] => let E := fresh in assert (E : a = 0) by (field; sides); rewrite E, sin_0; clear E
  | |- context [sin ?a] => let E := fresh in assert (E : a = PI / 2) by (field; sides); rewrite E, sin_PI2; clear E
  | |- context [sin ?a] => let E := fresh in assert (E : a = 3 * (PI / 2)) by (field; sides); rewrite E, sin_3PI2; clear E
  | |- context [cos ?a] => let E := fresh in assert (E : a = 0) by (field; sides); rewrite E, cos_0; clear E
  | |- context [?f ?a] =>
      first [ constr_eq f exp | constr_eq f sin | constr_eq f cos | constr_eq f ln | constr_eq f sqrt ];
      match goal with
      | |- context [f ?b] =>
          assert_fails (constr_eq a b);
          let E := fresh in assert (E : a = b) by (field; sides); rewrite E; clear E
      end
  end.

Ltac as_reals := lazymatch goal with |- ?x = ?y => change (@eq R x y) end.
Ltac rational := as_reals; first [ reflexivity | ring | field; sides ].

(* sin and cos become s and c with s^2 + c^2 = 1. *)
Ltac expand_angles := repeat first [ rewrite cos_minus | rewrite sin_minus | rewrite cos_plus | rewrite sin_plus
  | rewrite cos_neg | rewrite sin_neg ].
Ltac circle x :=
  let S := fresh "s" in let C := fresh "c" in let P := fresh in
  pose proof (sin2_cos2 x) as P; unfold Rsqr in P; revert P;
  generalize (sin x) as S; generalize (cos x) as C; intros C S P.
Ltac circles := repeat match goal with |- context [sin ?x] => circle x | |- context [cos ?x] => circle x end.
Ltac opaque := unfold Rdiv;
  repeat match goal with |- context [Derive ?f ?x] => generalize (Derive f x); intro end;
  repeat match goal with
  | |- context [/ ?x] =>
      let H := fresh in
      first [ assert (H : x * / x = 1) by (apply Rinv_r; sign); revert H; generalize (/ x); intros ? ? | generalize (/ x); intro ]
  end;
  repeat match goal with
  | |- context [sqrt ?x] => generalize (sqrt x); intro
  | |- context [?f ?x] => is_var f; lazymatch type of (f x) with R => generalize (f x); intro end
  | |- context [?f ?x ?y] => is_var f; lazymatch type of (f x y) with R => generalize (f x y); intro end
  | |- context [?f ?x ?y ?z] => is_var f; lazymatch type of (f x y z) with R => generalize (f x y z); intro end
  | |- context [Derive ?f ?x] => generalize (Derive f x); intro
  end.
(* The difference itself in the ideal, and no power of it: those that are tried where it is not take far longer, and
   circles and reciprocals, for which the facts are, have radical ideals. *)
Ltac ideal := cbv [Rpow_def.pow] in *; solve [nsatz with radicalmax := 1%N strategy := 1%Z parameters := (@nil R) variables := (@nil R)].
Ltac angles_of_PI := rewrite ?cos_2PI, ?sin_2PI, ?cos_PI, ?sin_PI, ?cos_PI2, ?sin_PI2, ?cos_0, ?sin_0.
Ltac trigonometric := as_reals; expand_angles; angles_of_PI; first [ rational | opaque; circles; first [ rational | ideal ] ].

(* Derivatives of what is written out; those of unknown functions stay as they are. *)
Ltac head t := lazymatch t with ?g _ => head g | _ => t end.
Ltac unknown f := idtac;
  match f with
  | fun y => ?g y => let h := head g in is_var h
  | fun y => ?g y ?b => let h := head g in is_var h
  | fun y => ?g y ?b ?c => let h := head g in is_var h
  | fun y => ?g y ?b ?c ?d => let h := head g in is_var h
  | _ => let h := head f in is_var h
  end.
Ltac derivative_sides := repeat match goal with
  | |- _ /\ _ => split
  | |- True => exact I
  | H : forall _, _ |- ex_derive _ _ => solve [ apply H; first [ assumption | lra ] ]
  | H : forall _, _ |- ex_derive _ _ => apply H
  | |- ex_derive _ _ => eassumption
  end; try first [ sign | assumption ].
Ltac inner_derivatives :=
  repeat match goal with
  | |- context [Derive ?f] =>
      assert_fails (idtac; unknown f);
      let g := fresh "g" in let E := fresh in
      evar (g : R -> R);
      assert (E : Derive f = g)
        by (apply FunctionalExtensionality.functional_extensionality; intro; apply is_derive_unique;
            auto_derive; [ solve [derivative_sides] | unfold g; reflexivity ]);
      rewrite E; unfold g; clear E g; cbv beta
  end.
Ltac derivatives :=
  inner_derivatives;
  repeat match goal with
  | |- context [Derive ?f ?x] =>
      assert_fails (unknown f);
      let l := fresh "l" in let E := fresh in
      evar (l : R);
      assert (E : is_derive f x l) by (auto_derive; [ solve [derivative_sides] | unfold l; reflexivity ]);
      rewrite (is_derive_unique f x l E); unfold l; clear E l
  end.
Ltac differentiable := first [ solve [ auto_derive; derivative_sides ] | inner_derivatives; solve [ auto_derive; derivative_sides ] ].

Ltac near :=
  lazymatch goal with
  | |- locally ?x (fun y => @?f y <> 0) => apply (near_nonzero f); [ differentiable | cbv beta; sign ]
  | |- locally ?x (fun y => 0 < @?f y) => first [ apply filter_forall; intro; sign | apply (near_positive f); [ differentiable | cbv beta; sign ] ]
  | |- locally ?x (fun y => 0 <= @?f y) => first [ apply filter_forall; intro; sign | apply (near_nonneg f); [ differentiable | cbv beta; sign ] ]
  | |- locally ?x _ => apply filter_forall; intro; first [ differentiable | sign ]
  end.

(* Minima, maxima and absolute values, case by case. *)
Ltac cases :=
  unfold Rmin, Rmax, Rabs in *;
  repeat match goal with
  | |- context [if ?c then _ else _] => destruct c
  | H : context [if ?c then _ else _] |- _ => destruct c
  end.

(* Facts about what nra does not know. *)
Ltac note p proof := lazymatch goal with _ : p |- _ => fail | _ => assert p by proof end.
Ltac about_sqrt :=
  repeat match goal with
  | |- context [sqrt ?x] => note (0 <= sqrt x) ltac:(apply sqrt_pos);
      try (assert (0 < sqrt x) by (apply sqrt_lt_R0; sign));
      try (assert (sqrt x * sqrt x = x) by (apply sqrt_sqrt; sign))
  | H : context [sqrt ?x] |- _ => note (0 <= sqrt x) ltac:(apply sqrt_pos);
      try (assert (0 < sqrt x) by (apply sqrt_lt_R0; sign));
      try (assert (sqrt x * sqrt x = x) by (apply sqrt_sqrt; sign))
  end.
Ltac about_angles :=
  repeat match goal with
  | |- context [sin ?x] => note (-1 <= sin x <= 1) ltac:(apply SIN_bound); pose proof (sin2_cos2 x)
  | |- context [cos ?x] => note (-1 <= cos x <= 1) ltac:(apply COS_bound); pose proof (sin2_cos2 x)
  end; unfold Rsqr in *.
(* Polynomials below and above sin and cos. *)
(* x -> f x grows on [0, oo) if its derivative is not negative there. *)
Lemma grows_from_0 : forall f g : R -> R, (forall x, is_derive f x (g x)) -> (forall x, 0 <= x -> 0 <= g x) -> forall x, 0 <= x -> f 0 <= f x.
Proof.
  intros f g D P x X.
  destruct (MVT_gen f 0 x g) as [c [C E]].
  - intros; apply D.
  - intros; apply continuity_pt_filterlim. apply (ex_derive_continuous f). eexists; apply D.
  - rewrite Rmin_left, Rmax_right in C by lra. assert (0 <= g c) by (apply P; lra). nra.
Qed.
Lemma sin_below : forall x, 0 <= x -> sin x <= x.
Proof.
  intros x X. enough (0 - sin 0 <= x - sin x) by (rewrite sin_0 in *; lra).
  apply (grows_from_0 (fun x => x - sin x) (fun x => 1 - cos x)); [| |exact X].
  - intro; auto_derive; [easy | ring].
  - intros y _; pose proof (COS_bound y); lra.
Qed.
Lemma cos_above_half : forall x, 0 <= x -> 1 - x ^ 2 / 2 <= cos x.
Proof.
  intros x X. enough (cos 0 + 0 ^ 2 / 2 <= cos x + x ^ 2 / 2) by (rewrite cos_0 in *; lra).
  apply (grows_from_0 (fun x => cos x + x ^ 2 / 2) (fun x => x - sin x)); [| |exact X].
  - intro; auto_derive; [easy | field].
  - intros y Y; pose proof (sin_below y Y); lra.
Qed.
Lemma sin_above : forall x, 0 <= x -> x - x ^ 3 / 6 <= sin x.
Proof.
  intros x X. enough (sin 0 - 0 + 0 ^ 3 / 6 <= sin x - x + x ^ 3 / 6) by (rewrite sin_0 in *; lra).
  apply (grows_from_0 (fun x => sin x - x + x ^ 3 / 6) (fun x => cos x - 1 + x ^ 2 / 2)); [| |exact X].
  - intro; auto_derive; [easy | field].
  - intros y Y; pose proof (cos_above_half y Y); lra.
Qed.
Lemma cos_below_half : forall x, 0 <= x -> cos x <= 1 - x ^ 2 / 2 + x ^ 4 / 24.
Proof.
  intros x X. enough (1 - 0 ^ 2 / 2 + 0 ^ 4 / 24 - cos 0 <= 1 - x ^ 2 / 2 + x ^ 4 / 24 - cos x) by (rewrite cos_0 in *; lra).
  apply (grows_from_0 (fun x => 1 - x ^ 2 / 2 + x ^ 4 / 24 - cos x) (fun x => - x + x ^ 3 / 6 + sin x)); [| |exact X].
  - intro; auto_derive; [easy | field].
  - intros y Y; pose proof (sin_above y Y); lra.
Qed.
Lemma cos_between : forall x, 1 - x ^ 2 / 2 <= cos x <= 1 - x ^ 2 / 2 + x ^ 4 / 24.
Proof.
  intro x. destruct (Rle_dec 0 x).
  - split; [apply cos_above_half | apply cos_below_half]; assumption.
  - rewrite <- cos_neg. replace (x ^ 2) with ((- x) ^ 2) by ring. replace (x ^ 4) with ((- x) ^ 4) by ring.
    split; [apply cos_above_half | apply cos_below_half]; lra.
Qed.
Lemma sin_square_below : forall x, sin x ^ 2 <= x ^ 2.
Proof.
  intro x. assert (H : forall y, 0 <= y -> sin y ^ 2 <= y ^ 2).
  { intros y Y. pose proof (sin_below y Y). pose proof (sin_above y Y). pose proof (SIN_bound y).
    destruct (Rle_dec y 1); [|nra]. assert (0 <= sin y) by (assert (y ^ 3 <= y) by nra; lra). nra. }
  destruct (Rle_dec 0 x) as [P|P]; [apply H; exact P|].
  replace (sin x ^ 2) with (sin (- x) ^ 2) by (rewrite sin_neg; ring).
  replace (x ^ 2) with ((- x) ^ 2) by ring. apply H; lra.
Qed.
Ltac about_series :=
  repeat match goal with
  | |- context [cos ?x] => note (1 - x ^ 2 / 2 <= cos x <= 1 - x ^ 2 / 2 + x ^ 4 / 24) ltac:(apply cos_between)
  | |- context [sin ?x] =>
      note (sin x ^ 2 <= x ^ 2) ltac:(apply sin_square_below);
      try (assert (x - x ^ 3 / 6 <= sin x <= x) by (split; [apply sin_above | apply sin_below]; lra))
  end.
Ltac about_powers :=
  repeat match goal with
  | |- context [Rpower ?x ?y] => note (0 < Rpower x y) ltac:(apply exp_pos)
  | |- context [exp ?y] => note (0 < exp y) ltac:(apply exp_pos)
  | H : context [Rpower ?x ?y] |- _ => note (0 < Rpower x y) ltac:(apply exp_pos)
  | H : context [exp ?y] |- _ => note (0 < exp y) ltac:(apply exp_pos)
  end.
(* Every 1/d becomes a value i with d i = 1. *)
Ltac reciprocal d :=
  let v := fresh "i" in let E := fresh in let P := fresh in
  assert (E : d * / d = 1) by (apply Rinv_r; sign);
  try (assert (P : 0 < / d) by (apply Rinv_0_lt_compat; sign));
  set (v := / d) in *; clearbody v.
Ltac reciprocals :=
  unfold Rdiv in *;
  repeat match goal with
  | |- context [/ ?d] => reciprocal d
  | H : context [/ ?d] |- _ => reciprocal d
  end.

(* Two norms in the plane. *)
Lemma cauchy_schwarz : forall a b c d, a * c + b * d <= sqrt (a ^ 2 + b ^ 2) * sqrt (c ^ 2 + d ^ 2).
Proof.
  intros. rewrite <- sqrt_mult by nra. apply Rle_trans with (Rabs (a * c + b * d)); [apply Rle_abs|].
  rewrite <- sqrt_Rsqr_abs. apply sqrt_le_1_alt. unfold Rsqr.
  pose proof (pow2_ge_0 (a * d - b * c)). lra.
Qed.
Lemma cauchy_schwarz_below : forall a b c d, - (a * c + b * d) <= sqrt (a ^ 2 + b ^ 2) * sqrt (c ^ 2 + d ^ 2).
Proof.
  intros. replace (- (a * c + b * d)) with ((- a) * c + (- b) * d) by ring.
  replace (a ^ 2) with ((- a) ^ 2) by ring. replace (b ^ 2) with ((- b) ^ 2) by ring. apply cauchy_schwarz.
Qed.
Ltac norms e f := lazymatch e with sqrt (?a ^ 2 + ?b ^ 2) => lazymatch f with sqrt (?c ^ 2 + ?d ^ 2) =>
  pose proof (cauchy_schwarz a b c d); pose proof (cauchy_schwarz_below a b c d) end end.
Ltac about_norms :=
  match goal with
  | |- context [?e * ?f] => norms e f
  | H : ?x = sqrt (?a ^ 2 + ?b ^ 2), K : ?y = sqrt (?c ^ 2 + ?d ^ 2) |- _ =>
      assert_fails (constr_eq x y);
      pose proof (cauchy_schwarz a b c d); pose proof (cauchy_schwarz_below a b c d);
      assert (x * x = a ^ 2 + b ^ 2) by (rewrite H; apply sqrt_sqrt; nra);
      assert (y * y = c ^ 2 + d ^ 2) by (rewrite K; apply sqrt_sqrt; nra);
      rewrite <- ?H, <- ?K in *; clear H K
  end.
Ltac squares := repeat match goal with
  | E : ?x * ?x = ?y |- context [?x ^ 2] => replace (x ^ 2) with y by (rewrite <- E; ring)
  end.

Ltac inequality :=
  first
  [ assumption | lra | solve [sign] | timeout 4 nra
  | solve [interval]
  | solve [same_arguments; about_norms; squares; first [lra | timeout 4 nra]]
  | solve [about_series; first [lra | timeout 6 nra]]
  | solve [about_sqrt; about_angles; about_powers; first [lra | timeout 4 nra]]
  | solve [about_sqrt; about_powers; reciprocals; first [lra | timeout 8 nra]]
  | solve [cases; first [lra | timeout 4 nra | reciprocals; timeout 4 nra]] ].

(* One power of a base by another one. *)
Ltac logarithm a :=
  lazymatch a with
  | ?x * ?y => rewrite (ln_mult x y) in * by sign
  | ?x / ?y => rewrite (ln_div x y) in * by sign
  | / ?x => rewrite (ln_Rinv x) in * by sign
  | Rpower ?x ?y => rewrite (ln_Rpower x y) in *
  | ?x ^ ?n => rewrite (ln_pow x n) in * by sign
  | sqrt ?x => rewrite (ln_sqrt x) in * by sign
  | exp ?x => rewrite (ln_exp x) in *
  | 1 => rewrite ln_1 in *
  end.
Ltac logarithms :=
  repeat match goal with
  | |- context [ln ?a] => logarithm a
  | H : context [ln ?a] |- _ => logarithm a
  end;
  rewrite ?INR_IZR_INZ in *; simpl Z.of_nat in *.
Ltac by_powers := apply ln_eq; [ sign | sign | logarithms; field; sides ].
Ltac use_equations := repeat match goal with H : ?a = _ |- context [?a] => rewrite H; clear H end.
Ltac equality :=
  first
  [ solve [rational]
  | solve [subst; rational]
  | solve [use_equations; rational]
  | solve [derivatives; rational]
  | solve [same_arguments; rational]
  | solve [same_arguments; trigonometric]
  | solve [derivatives; same_arguments; same_values; rational]
  | solve [by_powers]
  | solve [subst; same_arguments; same_values; rational]
  | lra
  | solve [about_sqrt; timeout 10 ideal]
  | solve [about_sqrt; field_simplify_eq; [ timeout 10 ideal | sides ]]
  | solve [about_sqrt; reciprocals; timeout 10 ideal]
  | solve [cases; first [rational | lra | timeout 4 nra]] ].

Ltac leaf :=
  cbv beta;
  lazymatch goal with
  | |- True => exact I
  | |- ex_RInt _ _ _ =>
      eexists;
      match goal with
      | I : forall a b, is_RInt _ a b _ |- _ => apply I
      | I : forall _ a b, is_RInt _ a b _ |- _ => apply I
      | I : forall _ _ a b, is_RInt _ a b _ |- _ => apply I
      | I : forall _ _ _ a b, is_RInt _ a b _ |- _ => apply I
      end
  | |- ex_derive _ _ => first [ solve [derivative_sides] | differentiable ]
  | |- locally _ _ => near
  | |- _ \/ (_ = 0 /\ _) => first [ left; solve [sign] | apply rpow_defined; sign ]
  | |- forall _, _ => intros; facts; pieces; leaf
  | |- _ -> _ => intros; facts; pieces; leaf
  | |- _ <> 0 => first [ sign | let E := fresh in intro E; timeout 4 nra ]
  | |- _ = _ => equality
  | |- _ => first [ inequality | solve [derivatives; inequality] ]
  end.

(* Integrals that are known, also for all values of outer variables. *)
Ltac integrals := repeat match goal with
  | I : forall a b, is_RInt _ a b _ |- context [RInt _ _ _] => rewrite (is_RInt_unique _ _ _ _ (I _ _))
  | I : forall _ a b, is_RInt _ a b _ |- context [RInt _ _ _] => rewrite (is_RInt_unique _ _ _ _ (I _ _ _))
  | I : forall _ _ a b, is_RInt _ a b _ |- context [RInt _ _ _] => rewrite (is_RInt_unique _ _ _ _ (I _ _ _ _))
  | I : forall _ _ _ a b, is_RInt _ a b _ |- context [RInt _ _ _] => rewrite (is_RInt_unique _ _ _ _ (I _ _ _ _ _))
  end.
(* That an integral exists is known as it stands; what it is, is not put in there. *)
Ltac leaf_or_say :=
  lazymatch goal with |- context [ex_RInt] => idtac | |- _ => integrals end;
  first [ leaf | lazymatch goal with |- ?g => fail 1 "at" g end ].

(* A variable replaced: by what it is equal to, or by a bound and what is above the bound. *)
Ltac from_bound :=
  first
  [ lra
  | match goal with
    | H : ?a < ?b |- 0 < ?d => replace d with (b - a) by rational; lra
    | H : ?a > ?b |- 0 < ?d => replace d with (a - b) by rational; lra
    | H : ?a <= ?b |- 0 <= ?d => replace d with (b - a) by rational; lra
    | H : ?a >= ?b |- 0 <= ?d => replace d with (a - b) by rational; lra
    | H : ?a = ?b |- ?d = 0 => replace d with (b - a) by rational; lra
    | H : ?a = ?b |- ?d = 0 => replace d with (a - b) by rational; lra
    end ].
Ltac replace_by v e :=
  let P := fresh in let E := fresh in
  assert (P : v - e = 0) by from_bound; assert (E : v = e) by lra; clear P; subst v.
Ltac at_least v e s :=
  let P := fresh in let E := fresh in
  pose (s := v - e); assert (P : 0 <= s) by (unfold s; from_bound); assert (E : v = e + s) by (unfold s; ring);
  clearbody s; subst v.
Ltac above v e s :=
  let P := fresh in let E := fresh in
  pose (s := v - e); assert (P : 0 < s) by (unfold s; from_bound); assert (E : v = e + s) by (unfold s; ring);
  clearbody s; subst v.

(* The difference of the two sides is e, whose sign is seen by its structure. *)
Ltac to_difference :=
  lazymatch goal with
  | |- ?a < ?b => apply Rlt_Rminus_rev
  | |- ?a <= ?b => apply Rminus_le_0
  | |- ?a > ?b => change (b < a); apply Rlt_Rminus_rev
  | |- ?a >= ?b => apply Rle_ge; apply Rminus_le_0
  end.
Ltac written_as e :=
  lazymatch goal with
  | |- 0 < ?d => replace d with e by rational
  | |- 0 <= ?d => replace d with e by rational
  end.
Ltac positive_as e := written_as e; sign.
Ltac difference_as e := to_difference; positive_as e.
Ltac nonzero_as e := lazymatch goal with |- ?d <> 0 => replace d with e by rational end; sign.

(* The difference is top / bottom with bottom > 0: what is left is the sign of the polynomial top. *)
Ltac top_of top bottom :=
  to_difference;
  lazymatch goal with
  | |- 0 < ?d => replace d with (top / bottom) by rational; apply Rdiv_lt_0_compat; [ | sign ]
  | |- 0 <= ?d => replace d with (top / bottom) by rational; apply Rdiv_le_0_compat; [ | sign ]
  end.
Lemma top_nonneg : forall a b top bottom, a <= b -> 0 < bottom -> b - a = top / bottom -> 0 <= top.
Proof.
  intros a b top bottom L P E. replace top with ((b - a) * bottom) by (rewrite E; field; lra).
  apply Rmult_le_pos; lra.
Qed.
Lemma top_positive : forall a b top bottom, a < b -> 0 < bottom -> b - a = top / bottom -> 0 < top.
Proof.
  intros a b top bottom L P E. replace top with ((b - a) * bottom) by (rewrite E; field; lra).
  apply Rmult_lt_0_compat; lra.
Qed.
Ltac fact_from bottom top :=
  match goal with
  | H : ?a < ?b |- _ => assert (0 < top) by (apply (top_positive a b top bottom H); [ sign | rational ])
  | H : ?a > ?b |- _ => assert (0 < top) by (apply (top_positive b a top bottom H); [ sign | rational ])
  | H : ?a <= ?b |- _ => assert (0 <= top) by (apply (top_nonneg a b top bottom H); [ sign | rational ])
  | H : ?a >= ?b |- _ => assert (0 <= top) by (apply (top_nonneg b a top bottom (Rge_le _ _ H)); [ sign | rational ])
  | H : ?a = ?b |- _ => assert (0 <= top) by (apply (top_nonneg a b top bottom (Req_le _ _ H)); [ sign | rational ])
  | H : ?a = ?b |- _ => assert (0 <= top) by (apply (top_nonneg b a top bottom (Req_le_sym _ _ H)); [ sign | rational ])
  end.
Lemma divide_nonneg : forall a b, 0 < a -> 0 <= a * b -> 0 <= b.
Proof. intros a b P Q. apply Rmult_le_reg_l with a; lra. Qed.
Lemma divide_positive : forall a b, 0 < a -> 0 < a * b -> 0 < b.
Proof. intros a b P Q. apply Rmult_lt_reg_l with a; lra. Qed.
Ltac multiply_by a := first [ apply (divide_nonneg a); [ sign | ] | apply (divide_positive a); [ sign | ] ].
Ltac product p := first [ assert (0 < p) by sign | assert (0 <= p) by sign ].
Ltac linear := first [ lra | timeout 5 nra ].

(* Whatever is not rational arithmetic becomes a number of which only these facts are kept. *)
Ltac atom a e :=
  let P := fresh in
  lazymatch e with
  | sqrt ?x =>
      assert (P : 0 <= e) by apply sqrt_pos;
      try (let Q := fresh in assert (Q : 0 < e) by (apply sqrt_lt_R0; sign));
      try (let Q := fresh in assert (Q : e * e = x) by (apply sqrt_sqrt; sign))
  | sin ?x => pose proof (SIN_bound x); try pose proof (sin2_cos2 x)
  | cos ?x => pose proof (COS_bound x); try pose proof (sin2_cos2 x)
  | exp _ => assert (P : 0 < e) by apply exp_pos
  | Rpower _ _ => assert (P : 0 < e) by apply exp_pos
  | rpow _ _ => assert (P : 0 <= e) by apply rpow_nonneg
  | PI => pose proof PI_RGT_0
  | Rabs _ => assert (P : 0 <= e) by apply Rabs_pos
  | _ => first
      [ assert (P : 0 < e) by (match goal with H : forall _, _ |- _ => solve [simple apply H; first [assumption | lra]] end)
      | assert (P : 0 <= e) by (match goal with H : forall _, _ |- _ => solve [simple apply H; first [assumption | lra]] end)
      | idtac ]
  end;
  set (a := e) in *; clearbody a.

Ltac power_as old new := let E := fresh in assert (E : old = new) by by_powers; rewrite ?E in *; clear E.
Ltac by_logarithms :=
  lazymatch goal with
  | |- _ <= _ => apply ln_le_inv; [ sign | sign | ]
  | |- _ < _ => apply ln_lt_inv; [ sign | sign | ]
  | |- _ >= _ => apply Rle_ge; apply ln_le_inv; [ sign | sign | ]
  | |- _ > _ => apply ln_lt_inv; [ sign | sign | ]
  end.
Ltac logarithms_of a b :=
  first
  [ let H := fresh in assert (H : a <= b) by lra; apply (ln_le a b) in H; [ | sign ]
  | let H := fresh in assert (H : a < b) by lra; apply (ln_increasing a b) in H; [ | sign ] ].
Ltac quickly := try solve [ assumption | lra | sign ].

(* Limits: every place is approached as 0 from the right, by a distance d or by 1/d. *)
Lemma right_positive : at_right 0 (fun d => 0 < d).
Proof. exists (mkposreal 1 Rlt_0_1). intros y _ P. exact P. Qed.

Lemma right_nonzero : forall N : R -> R, ex_derive N 0 -> N 0 <> 0 -> at_right 0 (fun d => N d <> 0).
Proof. intros N D H. apply filter_le_within. apply near_nonzero; assumption. Qed.

Lemma right_above : forall N : R -> R, ex_derive N 0 -> 0 < N 0 -> at_right 0 (fun d => 0 < N d).
Proof. intros N D H. apply filter_le_within. apply near_positive; assumption. Qed.

Lemma near_infinity : forall P : R -> Prop, at_right 0 (fun d => P (/ d)) -> Rbar_locally p_infty P.
Proof.
  intros P [e H]. exists (/ e). intros x L.
  assert (X : 0 < x) by (apply Rlt_trans with (2 := L); apply Rinv_0_lt_compat, cond_pos).
  rewrite <- (Rinv_involutive x) by lra. apply H; [|apply Rinv_0_lt_compat; exact X].
  unfold ball; simpl; unfold AbsRing_ball, abs, minus, plus, opp; simpl.
  rewrite Ropp_0, Rplus_0_r, Rabs_pos_eq by (left; apply Rinv_0_lt_compat; exact X).
  rewrite <- (Rinv_involutive e) by (apply Rgt_not_eq, cond_pos).
  apply Rinv_lt_contravar; [|exact L].
  apply Rmult_lt_0_compat; [apply Rinv_0_lt_compat, cond_pos | exact X].
Qed.

Lemma near_left : forall a (P : R -> Prop), at_right 0 (fun d => P (a - d)) -> at_left a P.
Proof.
  intros a P [e H]. exists e. intros x B L. replace x with (a - (a - x)) by ring. apply H; [|lra].
  unfold ball in *; simpl in *; unfold AbsRing_ball, abs, minus, plus, opp in *; simpl in *.
  replace (a - x + - 0) with (- (x + - a)) by ring. rewrite Rabs_Ropp. exact B.
Qed.

Lemma near_right : forall a (P : R -> Prop), at_right 0 (fun d => P (a + d)) -> at_right a P.
Proof.
  intros a P [e H]. exists e. intros x B L. replace x with (a + (x - a)) by ring. apply H; [|lra].
  unfold ball in *; simpl in *; unfold AbsRing_ball, abs, minus, plus, opp in *; simpl in *.
  replace (x - a + - 0) with (x + - a) by ring. exact B.
Qed.

Lemma limit_infinity : forall (f g : R -> R) G,
  at_right 0 (fun d => f (/ d) = g d) -> filterlim g (at_right 0) G -> filterlim f (Rbar_locally p_infty) G.
Proof.
  intros f g G E L P H. apply near_infinity. specialize (L P H). unfold filtermap in L.
  generalize (filter_and _ _ E L). apply filter_imp. intros d [A B]. rewrite A. exact B.
Qed.

Lemma limit_left : forall a (f g : R -> R) G,
  at_right 0 (fun d => f (a - d) = g d) -> filterlim g (at_right 0) G -> filterlim f (at_left a) G.
Proof.
  intros a f g G E L P H. apply near_left. specialize (L P H). unfold filtermap in L.
  generalize (filter_and _ _ E L). apply filter_imp. intros d [A B]. rewrite A. exact B.
Qed.

Lemma limit_right : forall a (f g : R -> R) G,
  at_right 0 (fun d => f (a + d) = g d) -> filterlim g (at_right 0) G -> filterlim f (at_right a) G.
Proof.
  intros a f g G E L P H. apply near_right. specialize (L P H). unfold filtermap in L.
  generalize (filter_and _ _ E L). apply filter_imp. intros d [A B]. rewrite A. exact B.
Qed.

Lemma right_continuous : forall (g : R -> R) l, ex_derive g 0 -> g 0 = l -> filterlim g (at_right 0) (locally l).
Proof.
  intros g l D E. rewrite <- E. apply (filterlim_filter_le_1 g (filter_le_within _)).
  apply (ex_derive_continuous g). exact D.
Qed.

Lemma right_infinity : forall g h : R -> R,
  at_right 0 (fun d => g d = / h d) -> ex_derive h 0 -> h 0 = 0 -> at_right 0 (fun d => 0 < h d) ->
  filterlim g (at_right 0) (Rbar_locally p_infty).
Proof.
  intros g h E D Z S. apply (filterlim_ext_loc (fun d => / h d)).
  { revert E. apply filter_imp. intros d A. symmetry. exact A. }
  apply (filterlim_comp _ _ _ h Rinv (at_right 0) (at_right 0)); [|apply filterlim_Rinv_0_right].
  intros P [e H]. pose proof (right_continuous h 0 D Z (fun y => ball 0 e y) (locally_ball 0 e)) as B.
  unfold filtermap in *. generalize (filter_and _ _ B S). apply filter_imp. intros d [U V]. apply H; assumption.
Qed.

Lemma right_exp : forall B : R -> R,
  filterlim B (at_right 0) (Rbar_locally p_infty) -> filterlim (fun d => exp (- B d)) (at_right 0) (locally 0).
Proof.
  intros B L. apply (filterlim_comp _ _ _ (fun d => - B d) exp (at_right 0) (Rbar_locally m_infty)).
  - apply (filterlim_comp _ _ _ B Ropp (at_right 0) (Rbar_locally p_infty)); [exact L|].
    exact (filterlim_Rbar_opp p_infty).
  - exact is_lim_exp_m.
Qed.

Lemma right_plus : forall (f g : R -> R) l m n, filterlim f (at_right 0) (locally l) ->
  filterlim g (at_right 0) (locally m) -> l + m = n -> filterlim (fun d => f d + g d) (at_right 0) (locally n).
Proof.
  intros f g l m n F G E. rewrite <- E. apply (filterlim_comp_2 _ _ Rplus F G). apply (filterlim_plus l m).
Qed.

Lemma right_mult : forall (f g : R -> R) l m n, filterlim f (at_right 0) (locally l) ->
  filterlim g (at_right 0) (locally m) -> l * m = n -> filterlim (fun d => f d * g d) (at_right 0) (locally n).
Proof.
  intros f g l m n F G E. rewrite <- E. apply (filterlim_comp_2 _ _ Rmult F G). apply (filterlim_mult l m).
Qed.

Lemma right_smooth : forall (f g : R -> R) l n, filterlim f (at_right 0) (locally l) -> ex_derive g l -> g l = n ->
  filterlim (fun d => g (f d)) (at_right 0) (locally n).
Proof.
  intros f g l n F D E. rewrite <- E. apply (filterlim_comp _ _ _ f g _ _ _ F). apply (ex_derive_continuous g). exact D.
Qed.

Lemma right_opp : forall (f : R -> R) l n, filterlim f (at_right 0) (locally l) -> - l = n ->
  filterlim (fun d => - f d) (at_right 0) (locally n).
Proof.
  intros f l n F E. rewrite <- E. apply (filterlim_comp _ _ _ f Ropp _ _ _ F). apply (filterlim_opp l).
Qed.

Lemma right_value : forall (f : R -> R) l n, filterlim f (at_right 0) (locally l) -> l = n -> filterlim f (at_right 0) (locally n).
Proof. intros f l n F E. rewrite <- E. exact F. Qed.

Ltac here := cbv beta; first [ sign | apply Rlt_not_eq; lra | solve [timeout 3 nra] ].
(* N is not 0, or even positive, close to 0. *)
Ltac right_factor N :=
  first [ let H := fresh in assert (H : at_right 0 (fun d => 0 < N d)) by (apply (right_above N); [ differentiable | here ])
        | let H := fresh in assert (H : at_right 0 (fun d => N d <> 0)) by (apply (right_nonzero N); [ differentiable | here ]) ].
Ltac right_at d :=
  pose proof right_positive;
  repeat match goal with
  | H : at_right 0 ?P, K : at_right 0 ?Q |- _ => pose proof (filter_and _ _ H K); clear H K
  end;
  match goal with
  | H : at_right 0 ?P |- at_right 0 ?Q => refine (filter_imp P Q _ H); clear H; cbv beta; intros d ?; facts
  end.
Ltac near_right_of_0 :=
  lazymatch goal with
  | |- Rbar_locally p_infty _ => apply near_infinity
  | |- at_left _ _ => apply near_left
  | |- at_right _ _ => apply near_right
  end.
Ltac limit_at g :=
  lazymatch goal with
  | |- filterlim ?f (Rbar_locally p_infty) _ => apply (limit_infinity f g)
  | |- filterlim ?f (at_left ?a) _ => apply (limit_left a f g)
  | |- filterlim ?f (at_right ?a) _ => apply (limit_right a f g)
  end.
Ltac same_at d := right_at d; first [ rational | same_values; rational ].
Ltac grows h d :=
  apply (right_infinity _ h); [ same_at d | differentiable | cbv beta; rational | right_at d; sign ].
Ltac decays B h d :=
  let H := fresh in
  assert (H : filterlim (fun d => exp (- B d)) (at_right 0) (locally 0)) by (apply (right_exp B); grows h d); cbv beta in H.
Ltac right_limit :=
  first
  [ eassumption
  | apply right_continuous; [ differentiable | cbv beta; reflexivity ]
  | eapply right_plus; [ right_limit | right_limit | reflexivity ]
  | eapply right_mult; [ right_limit | right_limit | reflexivity ]
  | eapply right_opp; [ right_limit | reflexivity ] ].
Ltac tends := unfold Rminus, Rdiv in *; eapply right_value; [ right_limit | first [ rational | rewrite ?Rmult_0_r, ?Rmult_0_l; rational ] ].

(* sin and cos at whole multiples of pi. *)
Lemma sin_multiple : forall n, sin (INR n * PI) = 0.
Proof.
  induction n as [|n IH]; [rewrite Rmult_0_l; exact sin_0|].
  rewrite S_INR, Rmult_plus_distr_r, Rmult_1_l, neg_sin, IH. ring.
Qed.
Lemma cos_multiple : forall n, cos (INR n * PI) = (-1) ^ n.
Proof.
  induction n as [|n IH]; [rewrite Rmult_0_l; exact cos_0|].
  rewrite S_INR, Rmult_plus_distr_r, Rmult_1_l, neg_cos, IH. simpl. ring.
Qed.
Ltac times_PI a n := replace a with (INR n * PI) by (cbn [INR]; field; sides).
Ltac multiple_of_PI a :=
  first [ times_PI a 0%nat | times_PI a 1%nat | times_PI a 2%nat | times_PI a 3%nat | times_PI a 4%nat | times_PI a 5%nat
        | times_PI a 6%nat | times_PI a 8%nat | times_PI a 10%nat | times_PI a 12%nat ].
Ltac at_multiples_of_PI :=
  integrals; rewrite ?sin_0, ?cos_0;
  repeat match goal with
  | |- context [sin ?a] =>
      let E := fresh in assert (E : sin a = 0) by (multiple_of_PI a; apply sin_multiple); rewrite E; clear E
  | |- context [cos ?a] =>
      let E := fresh in assert (E : cos a = 1) by (multiple_of_PI a; rewrite cos_multiple; cbn [pow]; ring); rewrite E; clear E
  | |- context [cos ?a] =>
      let E := fresh in assert (E : cos a = -1) by (multiple_of_PI a; rewrite cos_multiple; cbn [pow]; ring); rewrite E; clear E
  end.

(* sin and cos of a whole multiple of an angle, by those of the angle. *)
Fixpoint turned_by (n : nat) (c s : R) : R * R :=
  match n with O => (1, 0) | S m => let p := turned_by m c s in (fst p * c - snd p * s, snd p * c + fst p * s) end.
Lemma turned_by_angle : forall n t, turned_by n (cos t) (sin t) = (cos (INR n * t), sin (INR n * t)).
Proof.
  induction n as [|n IH]; intro t.
  - cbn [turned_by INR]. rewrite Rmult_0_l, cos_0, sin_0. reflexivity.
  - cbn [turned_by]. rewrite IH, S_INR, Rmult_plus_distr_r, Rmult_1_l, cos_plus, sin_plus. reflexivity.
Qed.
Lemma cos_of_multiple : forall n t a, a = INR n * t -> cos a = fst (turned_by n (cos t) (sin t)).
Proof. intros n t a E. rewrite E, turned_by_angle. reflexivity. Qed.
Lemma sin_of_multiple : forall n t a, a = INR n * t -> sin a = snd (turned_by n (cos t) (sin t)).
Proof. intros n t a E. rewrite E, turned_by_angle. reflexivity. Qed.
Ltac as_multiple_angle a t L n way :=
  let E := fresh in pose proof (L n t a ltac:(cbn [INR]; way)) as E; cbn [turned_by fst snd] in E; rewrite E; clear E.
Ltac multiple_angle a t L :=
  let by_way way :=
    first [ as_multiple_angle a t L 1%nat way | as_multiple_angle a t L 2%nat way | as_multiple_angle a t L 3%nat way
          | as_multiple_angle a t L 4%nat way | as_multiple_angle a t L 5%nat way | as_multiple_angle a t L 6%nat way ] in
  first [ by_way ltac:(ring) | by_way ltac:(field; sides) ].
Ltac no_angle a :=
  lazymatch a with context [0] => let E := fresh in assert (E : a = 0) by (unfold Rdiv; ring); try rewrite E; clear E end.
Ltac angle_of x a t := assert_fails (constr_eq a t); lazymatch a with context [x] => idtac end.
(* Two polynomials in waves of multiples of t, which has the variable x: sin^2 is 1 - cos^2, all else are numbers. *)
Ltac waves x t :=
  as_reals;
  repeat match goal with
  | |- context [cos ?a] => no_angle a; rewrite cos_0
  | |- context [sin ?a] => no_angle a; rewrite sin_0
  | |- context [cos ?a] => angle_of x a t; multiple_angle a t cos_of_multiple
  | |- context [sin ?a] => angle_of x a t; multiple_angle a t sin_of_multiple
  end;
  let P := fresh in
  assert (P : sin t ^ 2 = 1 - cos t ^ 2) by (pose proof (sin2_cos2 t) as P; unfold Rsqr in P; lra);
  revert P; generalize (sin t) (cos t); intros ? ? P;
  first [ ring [P] | field [P]; sides ].

(* Integrals by an antiderivative F of what the function f is equal to, which is differentiated here. The function's
   waves are those of multiples of the angle t. *)
Ltac integral f g F t :=
  let W := fresh in
  assert (W : f = g)
    by (apply FunctionalExtensionality.functional_extensionality; let x := fresh in intro x; cbv beta; integrals;
        first [ reflexivity | rational | let u := eval cbv beta in (t x) in waves x u | at_multiples_of_PI; rational
              | same_values; rational | trigonometric ]);
  let D := fresh in let C := fresh in
  assert (D : forall x : R, is_derive F x (g x))
    by (intro; auto_derive; [ solve [derivative_sides] | cbv beta; first [ rational | same_values; rational | trigonometric ] ]);
  assert (C : forall x : R, continuous g x) by (intro; apply (ex_derive_continuous g); differentiable);
  let I := fresh in
  assert (I : forall a b, is_RInt f a b (F b - F a))
    by (try rewrite W; intros; apply (is_RInt_derive F g); intros; [ apply D | apply C ]);
  cbv beta in I; clear D C W.
