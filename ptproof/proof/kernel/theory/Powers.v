(* Powers whose base may be 0, and limits of powers. Everything here is proved. *)

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
Lemma negative : forall x, 0 < x -> - x < 0.
Proof. intros; lra. Qed.
Lemma nonpositive : forall x, 0 <= x -> - x <= 0.
Proof. intros; lra. Qed.
Ltac grows_by_structure :=
  first
  [ lra
  | lazymatch goal with
    | |- ?x <= ?x => apply Rle_refl
    | |- - _ < 0 => apply negative; sign
    | |- - _ <= 0 => apply nonpositive; sign
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
  repeat match goal with
  | |- / ?x <= ?y => replace (/ x) with (1 / x) by apply Rmult_1_l
  | |- ?y <= / ?x => replace (/ x) with (1 / x) by apply Rmult_1_l
  | |- / ?x < ?y => replace (/ x) with (1 / x) by apply Rmult_1_l
  | |- ?y < / ?x => replace (/ x) with (1 / x) by apply Rmult_1_l
  end;
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

(* Limits of powers, from the right of 0. *)
Lemma right_power_of_0 : forall (B : R -> R) q, filterlim B (at_right 0) (locally 0) -> at_right 0 (fun d => 0 <= B d) ->
  0 < q -> filterlim (fun d => rpow (B d) q) (at_right 0) (locally 0).
Proof.
  intros B q L S Q. apply filterlim_locally. intro e.
  assert (P : 0 < Rpower e (/ q)) by apply exp_pos.
  generalize (filter_and _ _ S (proj1 (filterlim_locally B 0) L (mkposreal _ P))). apply filter_imp. intros d [N H].
  unfold ball in *; simpl in *; unfold AbsRing_ball, abs, minus, plus, opp in *; simpl in *.
  rewrite Ropp_0, Rplus_0_r, Rabs_pos_eq in * by (try apply rpow_nonneg; exact N).
  destruct N as [N|N].
  - rewrite rpow_Rpower by exact N. replace (pos e) with (Rpower (Rpower e (/ q)) q).
    + apply Rpower_grows; [exact Q | lra].
    + rewrite Rpower_mult. replace (/ q * q) with 1 by (field; lra). apply Rpower_1, cond_pos.
  - rewrite rpow_zero by lra. apply cond_pos.
Qed.
Lemma right_power_of_infinity : forall (B : R -> R) q, filterlim B (at_right 0) (Rbar_locally p_infty) -> q < 0 ->
  filterlim (fun d => Rpower (B d) q) (at_right 0) (locally 0).
Proof.
  intros B q L Q. unfold Rpower.
  apply (filterlim_comp _ _ _ (fun d => q * ln (B d)) exp (at_right 0) (Rbar_locally m_infty)); [|exact is_lim_exp_m].
  apply (filterlim_ext (fun d => - (- q * ln (B d)))); [intro; ring|].
  apply (filterlim_comp _ _ _ (fun d => - q * ln (B d)) Ropp (at_right 0) (Rbar_locally p_infty));
    [|exact (filterlim_Rbar_opp p_infty)].
  apply (filterlim_comp _ _ _ (fun d => ln (B d)) (fun y => - q * y) (at_right 0) (Rbar_locally p_infty)).
  - apply (filterlim_comp _ _ _ B ln (at_right 0) (Rbar_locally p_infty)); [exact L | exact is_lim_ln_p].
  - pose proof (filterlim_Rbar_mult_l (- q) p_infty) as M. simpl in M.
    destruct (Rle_dec 0 (- q)) as [P|P]; [|lra]. destruct (Rle_lt_or_eq_dec 0 (- q) P); [exact M | lra].
Qed.
Lemma right_rpow_of_infinity : forall (B : R -> R) q, filterlim B (at_right 0) (Rbar_locally p_infty) -> q < 0 ->
  filterlim (fun d => rpow (B d) q) (at_right 0) (locally 0).
Proof.
  intros B q L Q. apply (filterlim_ext_loc (fun d => Rpower (B d) q)); [|apply right_power_of_infinity; assumption].
  assert (P : Rbar_locally p_infty (fun y => 0 < y)) by (exists 0; auto).
  assert (K : at_right 0 (fun d => 0 < B d)) by exact (L _ P).
  revert K. apply filter_imp. intros d H. symmetry. apply rpow_Rpower, H.
Qed.
Lemma right_root_of_infinity : forall (B : R -> R) q, filterlim B (at_right 0) (Rbar_locally p_infty) -> 0 < q ->
  filterlim (fun d => / Rpower (B d) q) (at_right 0) (locally 0).
Proof.
  intros B q L Q. apply (filterlim_ext (fun d => Rpower (B d) (- q))); [intro; apply Rpower_Ropp|].
  apply right_power_of_infinity; [exact L | lra].
Qed.

Ltac same_powers := repeat match goal with
  | |- context [Rpower ?a ?y] => match goal with |- context [Rpower ?b y] =>
      assert_fails (constr_eq a b); let E := fresh in assert (E : a = b) by (field; sides); rewrite E; clear E end
  | |- context [rpow ?a ?y] => match goal with |- context [rpow ?b y] =>
      assert_fails (constr_eq a b); let E := fresh in assert (E : a = b) by (field; sides); rewrite E; clear E end
  end.
Ltac same_powers_at d := right_at d; same_powers; rational.
Ltac negative_exponent q e := assert (q < 0) by (enough (0 < e) by (replace q with (- e) by (field; sides); lra); sign).
(* What the power falls from: a base B that tends to 0, or to infinity as 1/h does. *)
Ltac falls_with_base B q d :=
  let H := fresh in
  assert (H : filterlim (fun d => rpow (B d) q) (at_right 0) (locally 0))
    by (apply right_power_of_0; [ apply right_continuous; [ differentiable | cbv beta; rational ] | right_at d; sign | sign ]);
  cbv beta in H.
Ltac falls_in_base B h q e d :=
  let H := fresh in
  assert (H : filterlim (fun d => rpow (B d) q) (at_right 0) (locally 0))
    by (negative_exponent q e;
        apply (right_rpow_of_infinity B); [ grows h d | assumption ]);
  cbv beta in H.
Ltac falls_by_root B h q d :=
  let H := fresh in
  assert (H : filterlim (fun d => / Rpower (B d) q) (at_right 0) (locally 0))
    by (apply (right_root_of_infinity B); [ grows h d | sign ]);
  cbv beta in H.
Ltac base_as form := first [ left; positive_as form | apply rpow_defined; [ positive_as form | sign ] ].
