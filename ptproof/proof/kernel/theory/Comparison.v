(* Inequalities between sums of products, and what follows from differential inequalities. Everything here is proved. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Ptproof Require Import Base.
Open Scope R_scope.

(* A sum of products, of which each factor is not negative: known so, or by its structure. *)
Ltac nonneg_sum :=
  lazymatch goal with
  | |- 0 <= _ + _ => apply Rplus_le_le_0_compat; nonneg_sum
  | |- 0 <= _ * _ => apply Rmult_le_pos; nonneg_sum
  | |- _ => first [ assumption | sign ]
  end.
Ltac sum_as e :=
  to_difference; lazymatch goal with |- 0 <= ?d => replace d with e; [ nonneg_sum | symmetry ] end.

Lemma minus_nonneg : forall a b, a <= b -> 0 <= b - a.
Proof. intros; lra. Qed.
Lemma ln_minus_nonneg : forall a b, 0 < a -> a <= b -> 0 <= ln b - ln a.
Proof. intros a b P [L | E]; [apply minus_nonneg; left; apply ln_increasing; assumption | subst; lra]. Qed.
Ltac fact a b := assert (0 <= b - a) by (apply minus_nonneg; first [ assumption | lra ]).
Ltac log_fact a b :=
  assert (0 <= ln b - ln a) by (apply ln_minus_nonneg; [ sign | first [ assumption | lra | quickly ] ]).
(* a <= b, since the logarithm of b / a is the sum e of what is not negative. *)
Ltac below_by_logarithms a b e :=
  assert (0 <= b - a);
  [ apply minus_nonneg; by_logarithms; apply Rminus_le_0; replace (ln b - ln a) with e;
    [ nonneg_sum | symmetry; logarithms; rational ]
  | ].
Ltac substitute x := match goal with E : x = _ |- _ => subst x | E : _ = x |- _ => subst x end.
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
Ltac raised x e q r := assert (x <= Rpower r q) by (apply (below_power x e q r); [ sign | sign | sign | rational | lra ]).
