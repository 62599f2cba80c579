(* Powers whose base may be 0, and limits of powers. Everything here is proved. *)
From Coq Require Import Reals Lra Lia Psatz Nsatz FunctionalExtensionality.
From Coquelicot Require Import Coquelicot.
From Ptproof Require Import Base Smooth.
Open Scope R_scope.

(* Powers of one exponent, and inequalities by structure: what grows in each part that is not the same. *)
Lemma Rpower_grows : forall x y e, 0 < e -> 0 < x < y -> Rpower x e < Rpower y e.
Proof.
  intros x y e E [P L]. unfold Rpower. apply exp_increasing. apply Rmult_lt_compat_l; [exact E|]. apply ln_increasing; assumption.
Qed.
Lemma rpow_grows : forall x y e, 0 < e -> 0 <= x <= y -> rpow x e <= rpow y e.
Proof.
  intros x y e E [[P|P] L].
  - rewrite !rpow_Rpower by lra. destruct L as [L|L]; [left; apply Rpower_grows; lra | subst; apply Rle_refl].
  - rewrite rpow_zero by lra. apply rpow_nonneg.
Qed.
Lemma rpow_1 : forall e, rpow 1 e = 1.
Proof. intro e. rewrite rpow_Rpower by lra. unfold Rpower. rewrite ln_1, Rmult_0_r. exact exp_0. Qed.
Lemma rpow_positive : forall x e, 0 < x -> 0 < rpow x e.
Proof. intros x e P. rewrite rpow_Rpower by exact P. apply exp_pos. Qed.
Lemma quotients_of_roots : forall a b p q r e, 0 <= a -> 0 <= b -> 0 < p -> 0 < q -> 0 < e -> r * e = 1 ->
  (rpow a e * q <= rpow b e * p -> a / Rpower p r <= b / Rpower q r) /\
  (rpow a e * q < rpow b e * p -> a / Rpower p r < b / Rpower q r).
Proof.
  intros a b p q r e A B P Q E R.
  assert (Z : forall x, x = 0 -> rpow x e = 0) by (intros; apply rpow_zero; lra).
  assert (N : forall x y, 0 < y -> 0 <= x -> 0 < rpow x e * y -> 0 < x).
  { intros x y Y [X|X] L; [exact X|]. rewrite Z in L by lra. lra. }
  assert (S : forall x y, 0 < x -> x / Rpower y r = exp (ln x - r * ln y)).
  { intros x y X. unfold Rminus. rewrite exp_plus, exp_Ropp, exp_ln by exact X. reflexivity. }
  assert (T : forall x y, 0 < x -> 0 < y -> ln (rpow x e * y) = e * ln x + ln y).
  { intros x y X Y. rewrite rpow_Rpower, ln_mult, ln_Rpower by (try apply exp_pos; assumption). reflexivity. }
  assert (F : 0 < r) by nra.
  assert (G : forall x, r * (e * x) = x) by (intro x; rewrite <- Rmult_assoc, R; ring).
  destruct A as [A|A].
  - pose proof (Rmult_lt_0_compat _ _ (rpow_positive a e A) Q) as A'. split; intro L.
    + assert (B' : 0 < b) by (apply (N b p); lra).
      rewrite !S by assumption. pose proof (ln_le _ _ A' L) as M. rewrite !T in M by assumption.
      apply (Rmult_le_compat_l r) in M; [|lra]. rewrite !Rmult_plus_distr_l, !G in M.
      destruct (Req_dec (ln a - r * ln p) (ln b - r * ln q)) as [->|D]; [apply Rle_refl|]. left. apply exp_increasing. lra.
    + assert (B' : 0 < b) by (apply (N b p); lra).
      rewrite !S by assumption. pose proof (ln_increasing _ _ A' L) as M. rewrite !T in M by assumption.
      apply (Rmult_lt_compat_l r) in M; [|lra]. rewrite !Rmult_plus_distr_l, !G in M. apply exp_increasing. lra.
  - subst a. rewrite Z by reflexivity. unfold Rdiv at 1. rewrite !Rmult_0_l. split; intro L.
    + apply Rdiv_le_0_compat; [exact B | apply exp_pos].
    + unfold Rdiv at 1. rewrite !Rmult_0_l. apply Rdiv_lt_0_compat; [apply (N b p); assumption | apply exp_pos].
Qed.
Lemma quotients_le : forall a b c x y, 0 < c -> 0 < x -> 0 < y -> a / x <= b / y -> a / (c * x) <= b / (c * y).
Proof.
  intros a b c x y C X Y L. replace (a / (c * x)) with (/ c * (a / x)) by (field; lra).
  replace (b / (c * y)) with (/ c * (b / y)) by (field; lra).
  apply Rmult_le_compat_l; [left; apply Rinv_0_lt_compat; exact C | exact L].
Qed.
Lemma quotients_lt : forall a b c x y, 0 < c -> 0 < x -> 0 < y -> a / x < b / y -> a / (c * x) < b / (c * y).
Proof.
  intros a b c x y C X Y L. replace (a / (c * x)) with (/ c * (a / x)) by (field; lra).
  replace (b / (c * y)) with (/ c * (b / y)) by (field; lra).
  apply Rmult_lt_compat_l; [apply Rinv_0_lt_compat; exact C | exact L].
Qed.

Ltac plain_powers := repeat match goal with
  | |- context [rpow 1 ?y] => rewrite (rpow_1 y)
  | |- context [rpow ?x ?y] => rewrite (rpow_Rpower x y) by sign
  end.
Ltac grows_by_structure :=
  first
  [ lra
  | lazymatch goal with
    | |- ?x <= ?x => apply Rle_refl
    | |- ?a * _ <= ?a * _ => apply Rmult_le_compat_l; [ sign | grows_by_structure ]
    | |- _ * ?a <= _ * ?a => apply Rmult_le_compat_r; [ sign | grows_by_structure ]
    | |- _ / ?a <= _ / ?a => apply Rmult_le_compat_r; [ left; apply Rinv_0_lt_compat; sign | grows_by_structure ]
    | |- _ + _ <= _ + _ => apply Rplus_le_compat; grows_by_structure
    | |- rpow _ ?e <= rpow _ ?e => apply rpow_grows; [ sign | split; [ sign | grows_by_structure ] ]
    | |- Rpower _ ?e <= Rpower _ ?e => apply Rle_Rpower_l; [ sign | split; [ sign | grows_by_structure ] ]
    | |- ?a * _ < ?a * _ => apply Rmult_lt_compat_l; [ sign | grows_by_structure ]
    | |- _ * ?a < _ * ?a => apply Rmult_lt_compat_r; [ sign | grows_by_structure ]
    | |- _ / ?a < _ / ?a => apply Rmult_lt_compat_r; [ apply Rinv_0_lt_compat; sign | grows_by_structure ]
    | |- ?a + _ < ?a + _ => apply Rplus_lt_compat_l; grows_by_structure
    | |- _ + ?a < _ + ?a => apply Rplus_lt_compat_r; grows_by_structure
    | |- Rpower _ ?e < Rpower _ ?e => apply Rpower_grows; [ sign | split; [ sign | grows_by_structure ] ]
    end ].
(* Both sides raised to a power e that makes their roots disappear. *)
Ltac raised e r := lazymatch goal with
  | |- ?a / Rpower ?p r <= ?b / Rpower ?q r =>
      apply (proj1 (quotients_of_roots a b p q r e ltac:(sign) ltac:(sign) ltac:(sign) ltac:(sign) ltac:(sign) ltac:(field; sides)))
  | |- ?a / Rpower ?p r < ?b / Rpower ?q r =>
      apply (proj2 (quotients_of_roots a b p q r e ltac:(sign) ltac:(sign) ltac:(sign) ltac:(sign) ltac:(sign) ltac:(field; sides)))
  end.
Ltac without_roots :=
  try first [ apply quotients_le; [ sign | sign | sign | ] | apply quotients_lt; [ sign | sign | sign | ] ];
  match goal with
  | |- context [_ / Rpower _ ?r] =>
      match goal with
      | |- context [rpow _ ?e] => raised e r
      | |- context [Rpower _ ?e] => raised e r
      end
  end.
Ltac powers_grow := repeat match goal with
  | |- context [rpow ?x ?e] => match goal with |- context [rpow ?y e] =>
      assert_fails (constr_eq x y); note (rpow x e <= rpow y e) ltac:(apply rpow_grows; [ sign | split; [ sign | grows_by_structure ] ]) end
  | |- context [Rpower ?x ?e] => match goal with |- context [Rpower ?y e] =>
      assert_fails (constr_eq x y); note (Rpower x e < Rpower y e) ltac:(apply Rpower_grows; [ sign | split; [ sign | grows_by_structure ] ]) end
  end.
Ltac by_growth :=
  plain_powers;
  first
  [ solve [ grows_by_structure ]
  | without_roots; plain_powers; powers_grow; unfold Rdiv; first [ lra | timeout 5 nra ] ].
