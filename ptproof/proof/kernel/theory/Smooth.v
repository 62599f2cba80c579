(* Tactics that do not lose themselves in definitions, and smoothness. Everything here is proved. *)

(* smooth_on n D f: f is n times continuously differentiable on the open set D. The derivative is Frechet's. *)
Fixpoint smooth_on (n : nat) {V : NormedModule R_AbsRing} (D : V -> Prop) (f : V -> R) : Prop :=
  match n with
  | O => forall p, D p -> continuous f p
  | S m => exists l : V -> V -> R,
      (forall p, D p -> filterdiff f (locally p) (l p)) /\ (forall v, smooth_on m D (fun p => l p v))
  end.
Definition smooth_at (n : nat) {V : NormedModule R_AbsRing} (f : V -> R) (x : V) : Prop :=
  exists D : V -> Prop, open D /\ D x /\ smooth_on n D f.

Section Closure.
Context {V : NormedModule R_AbsRing}.
Implicit Types (D : V -> Prop) (f g : V -> R).

Lemma on_ext : forall n D f g, (forall p, f p = g p) -> smooth_on n D f -> smooth_on n D g.
Proof. intros n D f g E. replace g with f; [easy | apply functional_extensionality; exact E]. Qed.

Lemma on_on : forall n D (E : V -> Prop) f, (forall p, E p -> D p) -> smooth_on n D f -> smooth_on n E f.
Proof.
  induction n as [|n IH]; intros D E f S; simpl; [auto|].
  intros [l [A B]]. exists l. split; [auto|]. intro v. apply (IH D); auto.
Qed.

Lemma on_lower : forall n D f, smooth_on (S n) D f -> smooth_on n D f.
Proof.
  induction n as [|n IH]; intros D f [l [A B]].
  - intros p P. apply (filterdiff_continuous f). exists (l p). auto.
  - exists l. split; [exact A|]. intro v. apply IH, B.
Qed.

Lemma on_continuous : forall n D f, smooth_on n D f -> forall p, D p -> continuous f p.
Proof. induction n as [|n IH]; intros D f H; [exact H | apply IH, on_lower, H]. Qed.

Lemma on_const : forall n D c, smooth_on n D (fun _ => c).
Proof.
  induction n as [|n IH]; intros D c; simpl; [intros; apply continuous_const|].
  exists (fun _ _ => 0). split; [intros p _; exact (filterdiff_const (V := R_NormedModule) c) | intro; apply IH].
Qed.

Lemma on_linear : forall n D f, is_linear f -> smooth_on n D f.
Proof.
  intros [|n] D f L.
  - intros p _. apply (filterdiff_continuous f). exists f. apply filterdiff_linear, L.
  - exists (fun _ => f). split; [intros; apply filterdiff_linear, L | intro v; apply on_const].
Qed.

Lemma on_plus : forall n D f g, smooth_on n D f -> smooth_on n D g -> smooth_on n D (fun p => f p + g p).
Proof.
  induction n as [|n IH]; intros D f g.
  - intros F G p P. apply (continuous_plus f g); auto.
  - intros [lf [F F']] [lg [G G']]. exists (fun p v => lf p v + lg p v). split.
    + intros p P. apply (filterdiff_plus_fct f g); auto.
    + intro v. apply IH; auto.
Qed.

Lemma on_mult : forall n D f g, smooth_on n D f -> smooth_on n D g -> smooth_on n D (fun p => f p * g p).
Proof.
  induction n as [|n IH]; intros D f g.
  - intros F G p P. apply (continuous_mult f g); auto.
  - intros HF HG. pose proof (on_lower _ _ _ HF) as F0. pose proof (on_lower _ _ _ HG) as G0.
    destruct HF as [lf [F F']], HG as [lg [G G']].
    exists (fun p v => lf p v * g p + f p * lg p v). split.
    + intros p P. apply (filterdiff_mult_fct f g p (lf p) (lg p)); auto. exact Rmult_comm.
    + intro v. apply on_plus; apply IH; auto.
Qed.

Lemma on_comp : forall n D (E : R -> Prop) (h : R -> R) g,
  smooth_on n E h -> smooth_on n D g -> (forall p, D p -> E (g p)) -> smooth_on n D (fun p => h (g p)).
Proof.
  induction n as [|n IH]; intros D E h g.
  - intros H G I p P. apply (continuous_comp g h); [apply G; exact P | apply H, I, P].
  - intros HH HG I. pose proof (on_lower _ _ _ HG) as G0. destruct HH as [lh [H H']], HG as [lg [G G']].
    exists (fun p v => lg p v * lh (g p) 1). split.
    + intros p P. apply (filterdiff_ext_lin _ (fun v => lh (g p) (lg p v))).
      * apply (filterdiff_comp' g h); auto.
      * intro v. replace (lg p v) with (scal (lg p v) 1) at 1 by (unfold scal; simpl; unfold mult; simpl; ring).
        rewrite (linear_scal _ (proj1 (H (g p) (I p P)))). reflexivity.
    + intro v. apply on_mult; [apply G' | apply (IH D E (fun x => lh x 1)); auto].
Qed.


Lemma filterdiff_pair : forall {U W : NormedModule R_AbsRing} (f : V -> U) (g : V -> W) p lf lg,
  filterdiff f (locally p) lf -> filterdiff g (locally p) lg ->
  filterdiff (fun q => (f q, g q)) (locally p) (fun v => (lf v, lg v)).
Proof.
  intros U W f g p lf lg F G. apply (filterdiff_comp'_2 f g (fun a b => (a, b)) p lf lg (fun a b => (a, b)) F G).
  apply (filterdiff_ext_lin _ (fun t => t)); [|intros []; reflexivity].
  apply (filterdiff_ext (fun t => t)); [intros []; reflexivity | apply filterdiff_id].
Qed.

Lemma on_comp2 : forall n D (E : R * R -> Prop) (h : R * R -> R) g1 g2,
  smooth_on n E h -> smooth_on n D g1 -> smooth_on n D g2 -> (forall p, D p -> E (g1 p, g2 p)) -> smooth_on n D (fun p => h (g1 p, g2 p)).
Proof.
  induction n as [|n IH]; intros D E h g1 g2.
  - intros H G1 G2 I p P. apply (continuous_comp_2 g1 g2 (fun a b => h (a, b))); [apply G1; exact P | apply G2; exact P |].
    apply (continuous_ext h); [intros []; reflexivity | apply H, I, P].
  - intros HH HG1 HG2 I. pose proof (on_lower _ _ _ HG1) as G10. pose proof (on_lower _ _ _ HG2) as G20.
    destruct HH as [lh [H H']], HG1 as [l1 [G1 G1']], HG2 as [l2 [G2 G2']].
    exists (fun p v => l1 p v * lh (g1 p, g2 p) (1, 0) + l2 p v * lh (g1 p, g2 p) (0, 1)). split.
    + intros p P. apply (filterdiff_ext_lin _ (fun v => lh (g1 p, g2 p) (l1 p v, l2 p v))).
      * apply (filterdiff_comp' (fun p => (g1 p, g2 p)) h); [apply filterdiff_pair; auto | apply H, I, P].
      * intro v. pose proof (proj1 (H _ (I p P))) as L.
        replace (l1 p v, l2 p v) with (plus (scal (l1 p v) ((1, 0) : R * R)) (scal (l2 p v) ((0, 1) : R * R)) : R * R).
        -- rewrite (linear_plus _ L), !(linear_scal _ L). reflexivity.
        -- unfold plus, scal; simpl; unfold prod_plus, prod_scal, plus, scal; simpl; unfold mult; simpl. f_equal; ring.
    + intro v. apply on_plus; apply on_mult; auto; [apply (IH D E (fun q => lh q (1, 0))) | apply (IH D E (fun q => lh q (0, 1)))]; auto.
Qed.

Lemma on_comp3 : forall n D (E : R * R * R -> Prop) (h : R * R * R -> R) g1 g2 g3,
  smooth_on n E h -> smooth_on n D g1 -> smooth_on n D g2 -> smooth_on n D g3 -> (forall p, D p -> E (g1 p, g2 p, g3 p)) ->
  smooth_on n D (fun p => h (g1 p, g2 p, g3 p)).
Proof.
  induction n as [|n IH]; intros D E h g1 g2 g3.
  - intros H G1 G2 G3 I p P.
    apply (continuous_comp_2 (fun p => (g1 p, g2 p)) g3 (fun a b => h (a, b))).
    + apply (continuous_comp_2 g1 g2 (fun a b => (a, b))); [apply G1; exact P | apply G2; exact P |].
      apply (continuous_ext (fun t => t)); [intros []; reflexivity | apply continuous_id].
    + apply G3, P.
    + apply (continuous_ext h); [intros []; reflexivity | apply H, I, P].
  - intros HH HG1 HG2 HG3 I. pose proof (on_lower _ _ _ HG1) as G10. pose proof (on_lower _ _ _ HG2) as G20.
    pose proof (on_lower _ _ _ HG3) as G30.
    destruct HH as [lh [H H']], HG1 as [l1 [G1 G1']], HG2 as [l2 [G2 G2']], HG3 as [l3 [G3 G3']].
    exists (fun p v => l1 p v * lh (g1 p, g2 p, g3 p) (1, 0, 0) + l2 p v * lh (g1 p, g2 p, g3 p) (0, 1, 0)
                       + l3 p v * lh (g1 p, g2 p, g3 p) (0, 0, 1)). split.
    + intros p P. apply (filterdiff_ext_lin _ (fun v => lh (g1 p, g2 p, g3 p) (l1 p v, l2 p v, l3 p v))).
      * apply (filterdiff_comp' (fun p => (g1 p, g2 p, g3 p)) h); [|apply H, I, P].
        apply (filterdiff_pair (fun p => (g1 p, g2 p)) g3); [apply filterdiff_pair|]; auto.
      * intro v. pose proof (proj1 (H _ (I p P))) as L.
        replace (l1 p v, l2 p v, l3 p v) with
          (plus (plus (scal (l1 p v) ((1, 0, 0) : R * R * R)) (scal (l2 p v) ((0, 1, 0) : R * R * R)))
                (scal (l3 p v) ((0, 0, 1) : R * R * R)) : R * R * R).
        -- rewrite !(linear_plus _ L), !(linear_scal _ L). reflexivity.
        -- unfold plus, scal; simpl; unfold prod_plus, prod_scal, plus, scal; simpl;
           unfold prod_plus, prod_scal, plus, scal; simpl; unfold mult; simpl. repeat f_equal; ring.
    + intro v. apply on_plus; [apply on_plus|]; apply on_mult; auto;
        [ apply (IH D E (fun q => lh q (1, 0, 0))) | apply (IH D E (fun q => lh q (0, 1, 0)))
        | apply (IH D E (fun q => lh q (0, 0, 1))) ]; auto.
Qed.

(* The same at a point. *)
Lemma open_preimage : forall {W : UniformSpace} D (h : V -> W) (E : W -> Prop),
  open D -> open E -> (forall p, D p -> continuous h p) -> open (fun p => D p /\ E (h p)).
Proof.
  intros W D h E O P H x [A B]. apply filter_and; [apply O, A|]. exact (H x A E (P _ B)).
Qed.

Implicit Type x : V.

Lemma smooth_const : forall n c x, smooth_at n (fun _ => c) x.
Proof. intros n c x. exists (fun _ => True). repeat split; [apply open_true | apply on_const]. Qed.
Lemma smooth_linear : forall n f x, is_linear f -> smooth_at n f x.
Proof. intros n f x L. exists (fun _ => True). repeat split; [apply open_true | apply on_linear, L]. Qed.
Lemma smooth_plus : forall n f g x, smooth_at n f x -> smooth_at n g x -> smooth_at n (fun p => f p + g p) x.
Proof.
  intros n f g x [D [O [I F]]] [E [P [J G]]]. exists (fun p => D p /\ E p). repeat split; auto; [apply open_and; auto|].
  apply on_plus; [apply (on_on n D) | apply (on_on n E)]; tauto.
Qed.
Lemma smooth_mult : forall n f g x, smooth_at n f x -> smooth_at n g x -> smooth_at n (fun p => f p * g p) x.
Proof.
  intros n f g x [D [O [I F]]] [E [P [J G]]]. exists (fun p => D p /\ E p). repeat split; auto; [apply open_and; auto|].
  apply on_mult; [apply (on_on n D) | apply (on_on n E)]; tauto.
Qed.
Lemma smooth_ext : forall n f g x, (forall p, f p = g p) -> smooth_at n f x -> smooth_at n g x.
Proof. intros n f g x E [D [O [I F]]]. exists D. repeat split; auto. apply (on_ext n D f); auto. Qed.
Lemma smooth_opp : forall n f x, smooth_at n f x -> smooth_at n (fun p => - f p) x.
Proof.
  intros n f x F. apply (smooth_ext n (fun p => -1 * f p)); [intro; ring|]. apply smooth_mult; [apply smooth_const | exact F].
Qed.
Lemma smooth_minus : forall n f g x, smooth_at n f x -> smooth_at n g x -> smooth_at n (fun p => f p - g p) x.
Proof. intros n f g x F G. apply smooth_plus; [exact F | apply smooth_opp, G]. Qed.
Lemma smooth_pow : forall n k f x, smooth_at n f x -> smooth_at n (fun p => f p ^ k) x.
Proof. intros n k f x F. induction k as [|k IH]; [exact (smooth_const n 1 x) | exact (smooth_mult n f _ x F IH)]. Qed.

Lemma smooth_of : forall n (h : R -> R) g x, smooth_at n h (g x) -> smooth_at n g x -> smooth_at n (fun p => h (g p)) x.
Proof.
  intros n h g x [E [P [J H]]] [D [O [I G]]]. exists (fun p => D p /\ E (g p)). repeat split; auto.
  - apply open_preimage; auto. apply (on_continuous n), G.
  - apply (on_comp n _ E); [exact H | apply (on_on n D); tauto | tauto].
Qed.
Lemma smooth_of2 : forall n (h : R * R -> R) g1 g2 x,
  smooth_at n h (g1 x, g2 x) -> smooth_at n g1 x -> smooth_at n g2 x -> smooth_at n (fun p => h (g1 p, g2 p)) x.
Proof.
  intros n h g1 g2 x [E [P [J H]]] [D1 [O1 [I1 G1]]] [D2 [O2 [I2 G2]]].
  exists (fun p => (D1 p /\ D2 p) /\ E (g1 p, g2 p)). repeat split; auto.
  - apply (open_preimage _ (fun p => (g1 p, g2 p))); auto; [apply open_and; auto|]. intros p [A B].
    apply (continuous_comp_2 g1 g2 (fun a b => (a, b)));
      [apply (on_continuous n D1); auto | apply (on_continuous n D2); auto |].
    apply (continuous_ext (fun t => t)); [intros []; reflexivity | apply continuous_id].
  - apply (on_comp2 n _ E); [exact H | apply (on_on n D1); tauto | apply (on_on n D2); tauto | tauto].
Qed.
Lemma smooth_of3 : forall n (h : R * R * R -> R) g1 g2 g3 x,
  smooth_at n h (g1 x, g2 x, g3 x) -> smooth_at n g1 x -> smooth_at n g2 x -> smooth_at n g3 x ->
  smooth_at n (fun p => h (g1 p, g2 p, g3 p)) x.
Proof.
  intros n h g1 g2 g3 x [E [P [J H]]] [D1 [O1 [I1 G1]]] [D2 [O2 [I2 G2]]] [D3 [O3 [I3 G3]]].
  exists (fun p => ((D1 p /\ D2 p) /\ D3 p) /\ E (g1 p, g2 p, g3 p)). repeat split; auto.
  - apply (open_preimage _ (fun p => (g1 p, g2 p, g3 p))); auto; [repeat apply open_and; auto|]. intros p [[A B] F].
    apply (continuous_comp_2 (fun p => (g1 p, g2 p)) g3 (fun a b => (a, b)));
      [apply (continuous_comp_2 g1 g2 (fun a b => (a, b)))| apply (on_continuous n D3); auto |].
    + apply (on_continuous n D1); auto.
    + apply (on_continuous n D2); auto.
    + apply (continuous_ext (fun t => t)); [intros []; reflexivity | apply continuous_id].
    + apply (continuous_ext (fun t => t)); [intros []; reflexivity | apply continuous_id].
  - apply (on_comp3 n _ E); [exact H | apply (on_on n D1); tauto | apply (on_on n D2); tauto | apply (on_on n D3); tauto | tauto].
Qed.

Lemma smooth_continuous : forall n f x, smooth_at n f x -> continuous f x.
Proof. intros n f x [D [_ [I H]]]. apply (on_continuous n D); assumption. Qed.
Lemma smooth_nonzero : forall f x, smooth_at 0 f x -> f x <> 0 -> locally x (fun p => f p <> 0).
Proof. intros f x H N. exact (smooth_continuous _ _ _ H (fun y => y <> 0) (open_neq 0 (f x) N)). Qed.
Lemma smooth_positive : forall f x, smooth_at 0 f x -> 0 < f x -> locally x (fun p => 0 < f p).
Proof. intros f x H N. exact (smooth_continuous _ _ _ H (fun y => 0 < y) (open_gt 0 (f x) N)). Qed.
Lemma smooth_nonneg : forall f x, smooth_at 0 f x -> 0 < f x -> locally x (fun p => 0 <= f p).
Proof. intros f x H N. apply (filter_imp (fun p => 0 < f p)); [intros; lra | apply smooth_positive; assumption]. Qed.
End Closure.

(* The functions of the library. *)
Lemma on_step : forall n (D : R -> Prop) (f d : R -> R),
  (forall x, D x -> is_derive f x (d x)) -> smooth_on n D d -> smooth_on (S n) D f.
Proof.
  intros n D f d H G. exists (fun p v => v * d p). split; [intros p P; exact (H p P)|].
  intro v. apply on_mult; [apply on_const | exact G].
Qed.
Lemma on_circle : forall n (D : R -> Prop), smooth_on n D sin /\ smooth_on n D cos.
Proof.
  induction n as [|n IH]; intro D.
  - split; intros x _; [apply continuous_sin | apply continuous_cos].
  - destruct (IH D) as [S K]. split; [apply (on_step n D sin cos) | apply (on_step n D cos (fun x => -1 * sin x))].
    + intros; apply is_derive_sin.
    + exact K.
    + intros x _. replace (-1 * sin x) with (- sin x) by ring. apply is_derive_cos.
    + apply on_mult; [apply on_const | exact S].
Qed.
Lemma on_exp : forall n (D : R -> Prop), smooth_on n D exp.
Proof.
  induction n as [|n IH]; intro D; [intros x _; apply continuous_exp|].
  apply (on_step n D exp exp); [intros; apply is_derive_exp | apply IH].
Qed.
Lemma on_Rinv : forall n, smooth_on n (fun x => x <> 0) Rinv.
Proof.
  induction n as [|n IH]; [intros x N; apply continuous_Rinv, N|].
  apply (on_step n _ Rinv (fun x => -1 * (/ x * / x))).
  - intros x N. auto_derive; [exact N | field; exact N].
  - apply on_mult; [apply on_const | apply on_mult; exact IH].
Qed.
Lemma on_ln : forall n, smooth_on n (fun x => 0 < x) ln.
Proof.
  intros [|n].
  - intros x P. apply (ex_derive_continuous ln). exists (/ x). apply is_derive_ln, P.
  - apply (on_step n _ ln Rinv); [intros; apply is_derive_ln; assumption|].
    apply (on_on n (fun x => x <> 0)); [intros; lra | apply on_Rinv].
Qed.
Lemma on_sqrt : forall n, smooth_on n (fun x => 0 < x) sqrt.
Proof.
  induction n as [|n IH].
  - intros x P. apply (ex_derive_continuous sqrt). auto_derive. exact P.
  - apply (on_step n _ sqrt (fun x => / 2 * / sqrt x)).
    + intros x P. auto_derive; [exact P|]. pose proof (sqrt_lt_R0 x P). field. lra.
    + apply on_mult; [apply on_const|]. apply (on_comp n _ (fun x => x <> 0) Rinv); [apply on_Rinv | exact IH |].
      intros x P. pose proof (sqrt_lt_R0 x P). lra.
Qed.
Lemma smooth_sin : forall n y, smooth_at n sin y.
Proof. intros. exists (fun _ => True). repeat split; [apply open_true | apply on_circle]. Qed.
Lemma smooth_cos : forall n y, smooth_at n cos y.
Proof. intros. exists (fun _ => True). repeat split; [apply open_true | apply on_circle]. Qed.
Lemma smooth_exp : forall n y, smooth_at n exp y.
Proof. intros. exists (fun _ => True). repeat split; [apply open_true | apply on_exp]. Qed.
Lemma smooth_Rinv : forall n y, y <> 0 -> smooth_at n Rinv y.
Proof. intros n y H. exists (fun x => x <> 0). repeat split; [apply open_neq | exact H | apply on_Rinv]. Qed.
Lemma smooth_ln : forall n y, 0 < y -> smooth_at n ln y.
Proof. intros n y H. exists (fun x => 0 < x). repeat split; [apply open_gt | exact H | apply on_ln]. Qed.
Lemma smooth_sqrt : forall n y, 0 < y -> smooth_at n sqrt y.
Proof. intros n y H. exists (fun x => 0 < x). repeat split; [apply open_gt | exact H | apply on_sqrt]. Qed.

Lemma smooth_lower : forall {V : NormedModule R_AbsRing} m n (f : V -> R) x, (n <= m)%nat -> smooth_at m f x -> smooth_at n f x.
Proof.
  intros V m n f x L [D [O [I H]]]. exists D. repeat split; auto. induction L; [exact H | apply IHL, on_lower, H].
Qed.

(* Smoothness by structure. What a denominator, a root or a logarithm needs is known, or a matter of signs. *)
Ltac linear_form :=
  lazymatch goal with
  | |- is_linear (fun p => p) => apply is_linear_id
  | |- is_linear (fun p => fst p) => apply is_linear_fst
  | |- is_linear (fun p => snd p) => apply is_linear_snd
  | |- is_linear (fun p => fst (@?g p)) => apply (is_linear_comp g fst); [ linear_form | apply is_linear_fst ]
  | |- is_linear (fun p => snd (@?g p)) => apply (is_linear_comp g snd); [ linear_form | apply is_linear_snd ]
  end.
Ltac point := cbn [fst snd]; sign.
Ltac known_smooth :=
  cbn [fst snd];
  match goal with H : forall _, _ |- smooth_at _ _ _ => eapply (smooth_lower); [ | apply H; sign ]; lia end.
(* Said below, where partial derivatives are known to be smooth. *)
Ltac partials_smoothly := fail.
Ltac smoothly :=
  cbv beta;
  lazymatch goal with
  | |- smooth_at _ (fun _ => ?c) _ => apply smooth_const
  | |- smooth_at _ (fun p => p) _ => apply smooth_linear; linear_form
  | |- smooth_at _ (fun p => fst _) _ => apply smooth_linear; linear_form
  | |- smooth_at _ (fun p => snd _) _ => apply smooth_linear; linear_form
  | |- smooth_at ?n (fun p => @?f p + @?g p) _ => apply (smooth_plus n f g); smoothly
  | |- smooth_at ?n (fun p => @?f p - @?g p) _ => apply (smooth_minus n f g); smoothly
  | |- smooth_at ?n (fun p => @?f p * @?g p) _ => apply (smooth_mult n f g); smoothly
  | |- smooth_at ?n (fun p => @?f p / @?g p) _ => apply (smooth_mult n f (fun p => / g p)); smoothly
  | |- smooth_at ?n (fun p => - @?f p) _ => apply (smooth_opp n f); smoothly
  | |- smooth_at ?n (fun p => (@?f p) ^ ?k) _ => apply (smooth_pow n k f); smoothly
  | |- smooth_at ?n (fun p => / @?f p) _ => apply (smooth_of n Rinv f); [ apply smooth_Rinv; point | smoothly ]
  | |- smooth_at ?n (fun p => sin (@?f p)) _ => apply (smooth_of n sin f); [ apply smooth_sin | smoothly ]
  | |- smooth_at ?n (fun p => cos (@?f p)) _ => apply (smooth_of n cos f); [ apply smooth_cos | smoothly ]
  | |- smooth_at ?n (fun p => exp (@?f p)) _ => apply (smooth_of n exp f); [ apply smooth_exp | smoothly ]
  | |- smooth_at ?n (fun p => ln (@?f p)) _ => apply (smooth_of n ln f); [ apply smooth_ln; point | smoothly ]
  | |- smooth_at ?n (fun p => sqrt (@?f p)) _ => apply (smooth_of n sqrt f); [ apply smooth_sqrt; point | smoothly ]
  | |- smooth_at ?n (fun p => Rpower (@?f p) (@?g p)) ?x =>
      change (smooth_at n (fun p => exp (g p * ln (f p))) x); smoothly
  | |- smooth_at _ (fun p => Derive _ _) _ => partials_smoothly
  | |- smooth_at ?n (fun p => ?h (@?a p) (@?b p) (@?c p)) ?x =>
      is_var h; apply (smooth_of3 n (fun q : R * R * R => h (fst (fst q)) (snd (fst q)) (snd q)) a b c x);
      [ known_smooth | smoothly | smoothly | smoothly ]
  | |- smooth_at ?n (fun p => ?h (@?a p) (@?b p)) ?x =>
      is_var h; apply (smooth_of2 n (fun q : R * R => h (fst q) (snd q)) a b x); [ known_smooth | smoothly | smoothly ]
  | |- smooth_at ?n (fun p => ?h (@?a p)) ?x =>
      is_var h; apply (smooth_of n (fun q => h q) a x); [ known_smooth | smoothly ]
  end.
Ltac near_smoothly :=
  cbv beta;
  first
  [ apply filter_forall; intros; cbn [fst snd]; sign
  | lazymatch goal with
    | |- locally _ (fun p => @?f p <> 0) => apply (smooth_nonzero f); [ smoothly | point ]
    | |- locally _ (fun p => 0 < @?f p) => apply (smooth_positive f); [ smoothly | point ]
    | |- locally _ (fun p => 0 <= @?f p) => apply (smooth_nonneg f); [ smoothly | point ]
    end ].

(* The chain rule for functions of several variables that are smooth. *)
Lemma along : forall (F : R -> R -> R) (a b : R -> R) (t da db : R) (l : R * R -> R),
  filterdiff (fun p : R * R => F (fst p) (snd p)) (locally (a t, b t)) l -> is_derive a t da -> is_derive b t db ->
  is_derive (fun t => F (a t) (b t)) t (l (da, db)).
Proof.
  intros F a b t da db l H A B. pose proof (proj1 H) as L.
  apply (filterdiff_ext_lin _ (fun v : R => l (scal v da : R, scal v db : R))).
  - apply (filterdiff_comp' (fun t => (a t, b t)) (fun p : R * R => F (fst p) (snd p)) t
      (fun v : R => (scal v da : R, scal v db : R)) l); [apply filterdiff_pair; [exact A | exact B] | exact H].
  - intro v. rewrite <- (linear_scal _ L). reflexivity.
Qed.
Lemma chain2 : forall (F : R -> R -> R) (a b : R -> R) (t da db : R),
  smooth_at 1 (fun p : R * R => F (fst p) (snd p)) (a t, b t) -> is_derive a t da -> is_derive b t db ->
  is_derive (fun t => F (a t) (b t)) t
    (Derive (fun x => F x (b t)) (a t) * da + Derive (fun y => F (a t) y) (b t) * db).
Proof.
  intros F a b t da db [D [_ [P [l [H _]]]]] A B. specialize (H _ P). pose proof (proj1 H) as L.
  assert (E : Derive (fun x => F x (b t)) (a t) = l (a t, b t) (1, 0)).
  { apply is_derive_unique. apply (along F (fun x => x) (fun _ => b t) (a t) 1 0); [exact H | apply (is_derive_id (a t)) | apply (is_derive_const (b t))]. }
  assert (G : Derive (fun y => F (a t) y) (b t) = l (a t, b t) (0, 1)).
  { apply is_derive_unique. apply (along F (fun _ => a t) (fun y => y) (b t) 0 1); [exact H | apply (is_derive_const (a t)) | apply (is_derive_id (b t))]. }
  rewrite E, G. pose proof (along F a b t da db _ H A B) as K.
  replace (l (a t, b t) (1, 0) * da + l (a t, b t) (0, 1) * db) with (l (a t, b t) (da, db)); [exact K|].
  replace ((da, db) : R * R) with (plus (scal da ((1, 0) : R * R)) (scal db ((0, 1) : R * R)) : R * R).
  - rewrite (linear_plus _ L), !(linear_scal _ L). unfold plus, scal; simpl; unfold mult; simpl. as_reals. ring.
  - unfold plus, scal; simpl; unfold prod_plus, prod_scal, plus, scal; simpl; unfold mult; simpl. f_equal; ring.
Qed.
Lemma partial1 : forall (F : R -> R -> R) x y, smooth_at 1 (fun p : R * R => F (fst p) (snd p)) (x, y) -> ex_derive (fun x => F x y) x.
Proof.
  intros F x y [D [_ [P [l [H _]]]]]. eexists. apply (along F (fun x => x) (fun _ => y) x 1 0 _ (H _ P)); [apply (is_derive_id x) | apply (is_derive_const y)].
Qed.
Lemma partial2 : forall (F : R -> R -> R) x y, smooth_at 1 (fun p : R * R => F (fst p) (snd p)) (x, y) -> ex_derive (fun y => F x y) y.
Proof.
  intros F x y [D [_ [P [l [H _]]]]]. eexists. apply (along F (fun _ => x) (fun y => y) y 0 1 _ (H _ P)); [apply (is_derive_const x) | apply (is_derive_id y)].
Qed.
Lemma on_ext_open : forall n (V : NormedModule R_AbsRing) (D : V -> Prop) (f g : V -> R), open D ->
  (forall p, D p -> f p = g p) -> smooth_on n D f -> smooth_on n D g.
Proof.
  intros [|n] V D f g O E; simpl.
  - intros H p P. apply (continuous_ext_loc g f p); [exact (filter_imp D _ E (O p P)) | exact (H p P)].
  - intros [l [A B]]. exists l. split; [|exact B]. intros p P.
    apply (filterdiff_ext_locally f g); [exact (filter_imp D _ E (O p P)) | exact (A p P)].
Qed.
Lemma smooth_partial1 : forall n (F : R -> R -> R),
  (forall a b, smooth_at (S n) (fun q : R * R => F (fst q) (snd q)) (a, b)) ->
  forall a b, smooth_at n (fun q : R * R => Derive (fun x => F x (snd q)) (fst q)) (a, b).
Proof.
  intros n F S a b. destruct (S a b) as [D [O [P [l [H L]]]]]. exists D. repeat split; [exact O | exact P |].
  apply (on_ext_open n _ D (fun q => l q (1, 0))); [exact O | | apply L].
  intros [x y] Q. symmetry. apply is_derive_unique. simpl.
  apply (along F (fun x => x) (fun _ => y) x 1 0 _ (H _ Q)); [apply (is_derive_id x) | apply (is_derive_const y)].
Qed.
Lemma smooth_partial2 : forall n (F : R -> R -> R),
  (forall a b, smooth_at (S n) (fun q : R * R => F (fst q) (snd q)) (a, b)) ->
  forall a b, smooth_at n (fun q : R * R => Derive (fun y => F (fst q) y) (snd q)) (a, b).
Proof.
  intros n F S a b. destruct (S a b) as [D [O [P [l [H L]]]]]. exists D. repeat split; [exact O | exact P |].
  apply (on_ext_open n _ D (fun q => l q (0, 1))); [exact O | | apply L].
  intros [x y] Q. symmetry. apply is_derive_unique. simpl.
  apply (along F (fun _ => x) (fun y => y) y 0 1 _ (H _ Q)); [apply (is_derive_const x) | apply (is_derive_id y)].
Qed.
Lemma chain1 : forall (g a : R -> R) t da, ex_derive g (a t) -> is_derive a t da -> is_derive (fun t => g (a t)) t (Derive g (a t) * da).
Proof.
  intros g a t da G A. rewrite Rmult_comm. apply (is_derive_comp g a t); [apply Derive_correct, G | exact A].
Qed.
Lemma smooth_derivable : forall (g : R -> R) x, smooth_at 1 (fun p : R => g p) x -> ex_derive g x.
Proof.
  intros g x [D [_ [P [l [H _]]]]]. exists (l x 1). specialize (H _ P). pose proof (proj1 H) as L.
  apply (filterdiff_ext_lin _ (l x)); [exact H|]. intro v. rewrite <- (linear_scal _ L). f_equal. symmetry. exact (Rmult_1_r v).
Qed.

(* Derivatives by structure, of functions that are unknown too. *)
Lemma rate_of_plus : forall (f g : R -> R) t a b, is_derive f t a -> is_derive g t b -> is_derive (fun t => f t + g t) t (a + b).
Proof. intros. apply (is_derive_plus f g); assumption. Qed.
Lemma rate_of_minus : forall (f g : R -> R) t a b, is_derive f t a -> is_derive g t b -> is_derive (fun t => f t - g t) t (a - b).
Proof. intros. apply (is_derive_minus f g); assumption. Qed.
Lemma rate_of_opp : forall (f : R -> R) t a, is_derive f t a -> is_derive (fun t => - f t) t (- a).
Proof. intros. apply (is_derive_opp f); assumption. Qed.
Lemma rate_of_mult : forall (f g : R -> R) t a b, is_derive f t a -> is_derive g t b ->
  is_derive (fun t => f t * g t) t (a * g t + f t * b).
Proof. intros. apply (is_derive_mult f g); [assumption | assumption | intros; apply Rmult_comm]. Qed.
Lemma rate_of_inv : forall (f : R -> R) t a, f t <> 0 -> is_derive f t a -> is_derive (fun t => / f t) t (- a / f t ^ 2).
Proof. intros. apply is_derive_inv; assumption. Qed.
Lemma rate_of_pow : forall (f : R -> R) n t a, is_derive f t a -> is_derive (fun t => f t ^ n) t (INR n * a * f t ^ pred n).
Proof. intros. apply is_derive_pow; assumption. Qed.
Lemma rate_of_const : forall (c t : R), is_derive (fun _ => c) t 0.
Proof. intros. apply (is_derive_const c). Qed.
Lemma rate_of_id : forall t : R, is_derive (fun t => t) t 1.
Proof. intros. apply (is_derive_id t). Qed.
Lemma rate_of_exp : forall (f : R -> R) t a, is_derive f t a -> is_derive (fun t => exp (f t)) t (a * exp (f t)).
Proof. intros. apply (is_derive_comp exp f); [apply is_derive_exp | assumption]. Qed.
Lemma rate_of_ln : forall (f : R -> R) t a, 0 < f t -> is_derive f t a -> is_derive (fun t => ln (f t)) t (a * / f t).
Proof. intros. apply (is_derive_comp ln f); [apply is_derive_ln; assumption | assumption]. Qed.
Lemma rate_of_sqrt : forall (f : R -> R) t a, 0 < f t -> is_derive f t a -> is_derive (fun t => sqrt (f t)) t (a * / (2 * sqrt (f t))).
Proof.
  intros f t a P A. apply (is_derive_comp sqrt f t); [|assumption]. auto_derive; [exact P | field].
  pose proof (sqrt_lt_R0 _ P). lra.
Qed.
Lemma rate_of_Rpower : forall (f : R -> R) e t a, 0 < f t -> is_derive f t a ->
  is_derive (fun t => Rpower (f t) e) t (a * (e / f t * Rpower (f t) e)).
Proof.
  intros f e t a P A. apply (is_derive_comp (fun x => Rpower x e) f t); [|assumption].
  unfold Rpower. auto_derive; [exact P | field; lra].
Qed.
Lemma rate_of_rpow : forall (f : R -> R) e t a, 0 < f t -> is_derive f t a ->
  is_derive (fun t => rpow (f t) e) t (a * (e / f t * rpow (f t) e)).
Proof.
  intros f e t a P A. rewrite rpow_Rpower by exact P.
  apply (is_derive_ext_loc (fun t => Rpower (f t) e)); [|apply rate_of_Rpower; assumption].
  assert (N : locally t (fun y => 0 < f y)) by (apply (near_positive f); [eexists; exact A | exact P]).
  revert N. apply filter_imp. intros y Y. rewrite rpow_Rpower by exact Y. reflexivity.
Qed.
Lemma rate_of_sin : forall (f : R -> R) t a, is_derive f t a -> is_derive (fun t => sin (f t)) t (a * cos (f t)).
Proof. intros. apply (is_derive_comp sin f); [apply is_derive_sin | assumption]. Qed.
Lemma rate_of_cos : forall (f : R -> R) t a, is_derive f t a -> is_derive (fun t => cos (f t)) t (a * - sin (f t)).
Proof. intros. apply (is_derive_comp cos f); [apply is_derive_cos | assumption]. Qed.
Lemma rate_value : forall (f : R -> R) (t l e : R), is_derive f t l -> l = e -> is_derive f t e.
Proof. intros f t l e D E. rewrite <- E. exact D. Qed.
Lemma rate_of_unknown : forall (h : R -> R) (t : R), ex_derive h t -> is_derive h t (Derive (fun x : R => h x) t).
Proof. intros h t D. apply (Derive_correct h), D. Qed.
Ltac smooth_enough := cbv beta; match goal with H : context [smooth_at] |- smooth_at _ _ _ => eapply smooth_lower; [ | simple eapply H ]; lia end.
Ltac rated :=
  cbv beta;
  lazymatch goal with
  | |- is_derive (fun _ => ?c) _ _ => apply rate_of_const
  | |- is_derive (fun t => t) _ _ => apply rate_of_id
  | |- is_derive (fun t => @?f t + @?g t) _ _ => eapply (rate_of_plus f g); rated
  | |- is_derive (fun t => @?f t - @?g t) _ _ => eapply (rate_of_minus f g); rated
  | |- is_derive (fun t => - @?f t) _ _ => eapply (rate_of_opp f); rated
  | |- is_derive (fun t => @?f t * @?g t) _ _ => eapply (rate_of_mult f g); rated
  | |- is_derive (fun t => @?f t / @?g t) _ _ => eapply (rate_of_mult f (fun t => / g t)); rated
  | |- is_derive (fun t => / @?f t) _ _ => eapply (rate_of_inv f); [ cbv beta; sign | rated ]
  | |- is_derive (fun t => (@?f t) ^ ?n) _ _ => eapply (rate_of_pow f n); rated
  | |- is_derive (fun t => exp (@?f t)) _ _ => eapply (rate_of_exp f); rated
  | |- is_derive (fun t => sin (@?f t)) _ _ => eapply (rate_of_sin f); rated
  | |- is_derive (fun t => cos (@?f t)) _ _ => eapply (rate_of_cos f); rated
  | |- is_derive (fun t => ln (@?f t)) _ _ => eapply (rate_of_ln f); [ cbv beta; sign | rated ]
  | |- is_derive (fun t => sqrt (@?f t)) _ _ => eapply (rate_of_sqrt f); [ cbv beta; sign | rated ]
  | |- is_derive (fun t => Rpower (@?f t) ?e) _ _ => eapply (rate_of_Rpower f e); [ cbv beta; sign | rated ]
  | |- is_derive (fun t => rpow (@?f t) ?e) _ _ => eapply (rate_of_rpow f e); [ cbv beta; sign | rated ]
  | |- is_derive (fun t => ?h (@?a t) (@?b t)) _ _ => is_var h; eapply (chain2 h a b); [ smooth_enough | rated | rated ]
  | |- is_derive (fun t => ?h t) ?t _ => is_var h; apply (rate_of_unknown h); derivable
  | |- is_derive (fun t => ?h (@?a t)) _ _ => is_var h; eapply (chain1 (fun x : R => h x) a); [ derivable | rated ]
  | |- is_derive ?h ?t _ => is_var h; apply (rate_of_unknown h); derivable
  end
with derivable := cbv beta; first
  [ assumption
  | match goal with H : forall _, _ |- ex_derive ?f ?x => solve [ apply (smooth_derivable f); smooth_enough | apply H; first [ assumption | lra ] ] end
  | lazymatch goal with
    | |- ex_derive (fun x => ?h x ?y) ?z => is_var h; apply (partial1 h z y); smooth_enough
    | |- ex_derive (fun y => ?h ?x y) ?z => is_var h; apply (partial2 h x z); smooth_enough
    end
  | eexists; rated ].
Ltac derivative_as d e :=
  let E := fresh in
  assert (E : d = e) by (apply is_derive_unique; eapply rate_value; [ rated | cbn [INR pred]; first [ rational | by_squares_of_roots ] ]); rewrite ?E in *; clear E.

(* Values of unknown functions, and their derivatives, as numbers. *)
Ltac named a e := set (a := e) in *; clearbody a.
(* Equal up to the order in which sums and products are written, also inside functions. *)
Ltac of_library f := first [ is_var f | constr_eq f exp | constr_eq f ln | constr_eq f sqrt | constr_eq f Rabs | constr_eq f sin
  | constr_eq f cos ].
Ltac alike := as_reals; first [ reflexivity | ring | field; sides | solve [ same_heads; first [ reflexivity | ring | field; sides ] ] ]
with same_heads :=
  repeat match goal with
  | |- context [?f ?a] =>
      of_library f;
      match goal with |- context [f ?b] => assert_fails (constr_eq a b);
        let E := fresh in assert (E : f a = f b) by (f_equal; alike); rewrite E; clear E end
  | |- context [?f ?a ?c] =>
      first [ is_var f | constr_eq f rpow | constr_eq f Rpower | constr_eq f Rmax | constr_eq f Rmin ];
      match goal with |- context [f ?b ?d] => assert_fails (constr_eq (f a c) (f b d));
        let E := fresh in assert (E : f a c = f b d) by (f_equal; alike); rewrite E; clear E end
  | |- context [?f ?a ?c ?e] =>
      is_var f;
      match goal with |- context [f ?b ?d ?g] => assert_fails (constr_eq (f a c e) (f b d g));
        let E := fresh in assert (E : f a c e = f b d g) by (f_equal; alike); rewrite E; clear E end
  end.
Lemma le_as : forall a b c d : R, a <= b -> c = a -> d = b -> c <= d.
Proof. intros; lra. Qed.
Lemma lt_as : forall a b c d : R, a < b -> c = a -> d = b -> c < d.
Proof. intros; lra. Qed.
Lemma ge_as : forall a b c d : R, a >= b -> c = a -> d = b -> c >= d.
Proof. intros; lra. Qed.
Lemma gt_as : forall a b c d : R, a > b -> c = a -> d = b -> c > d.
Proof. intros; lra. Qed.
Lemma eq_as : forall a b c d : R, a = b -> c = a -> d = b -> c = d.
Proof. intros; lra. Qed.
Lemma ne_as : forall a b c d : R, a <> b -> c = a -> d = b -> c <> d.
Proof. intros; lra. Qed.
Ltac last_of H := lazymatch type of H with _ /\ _ => let P := fresh in destruct H as [P H]; last_of H | _ => idtac end.
Ltac as_said H :=
  lazymatch type of H with
  | _ <= _ => lazymatch goal with |- _ >= _ => apply Rle_ge | |- _ => idtac end; apply (le_as _ _ _ _ H); alike
  | _ < _ => lazymatch goal with |- _ > _ => red | |- _ => idtac end; apply (lt_as _ _ _ _ H); alike
  | _ >= _ => lazymatch goal with |- _ <= _ => apply (le_as _ _ _ _ (Rge_le _ _ H)) | |- _ => apply (ge_as _ _ _ _ H) end; alike
  | _ > _ => lazymatch goal with |- _ < _ => apply (lt_as _ _ _ _ H) | |- _ => apply (gt_as _ _ _ _ H) end; alike
  | _ = _ => apply (eq_as _ _ _ _ H); alike
  | _ <> _ => apply (ne_as _ _ _ _ H); alike
  end.
Ltac shown_as c d :=
  lazymatch goal with
  | |- ?a <= ?b => apply (le_as c d a b); [ | alike | alike ]
  | |- ?a < ?b => apply (lt_as c d a b); [ | alike | alike ]
  | |- ?a >= ?b => apply (ge_as c d a b); [ | alike | alike ]
  | |- ?a > ?b => apply (gt_as c d a b); [ | alike | alike ]
  | |- ?a = ?b => apply (eq_as c d a b); [ | alike | alike ]
  | |- ?a <> ?b => apply (ne_as c d a b); [ | alike | alike ]
  end.
Ltac found_as := first [ assumption | match goal with H : _ |- _ => as_said H end ].

(* Partial derivatives of a function of two arguments that is smooth everywhere. *)
Ltac partial_smooth h :=
  let known := (intros; cbv beta; cbn [fst snd]; known_smooth) in
  first [ known | apply (smooth_partial1 _ h); known | apply (smooth_partial2 _ h); known
  | apply (smooth_partial1 _ (fun x y => Derive (fun x => h x y) x)); intros; apply (smooth_partial1 _ h); known
  | apply (smooth_partial2 _ (fun x y => Derive (fun x => h x y) x)); intros; apply (smooth_partial1 _ h); known
  | apply (smooth_partial1 _ (fun x y => Derive (fun y => h x y) y)); intros; apply (smooth_partial2 _ h); known
  | apply (smooth_partial2 _ (fun x y => Derive (fun y => h x y) y)); intros; apply (smooth_partial2 _ h); known ].
Ltac partials_smoothly ::=
  cbv beta;
  lazymatch goal with
  | |- smooth_at ?n (fun p => Derive (fun x => Derive (fun z => ?h z (@?b p)) x) (@?a p)) ?w =>
      apply (smooth_of2 n (fun q : R * R => Derive (fun x => Derive (fun z => h z (snd q)) x) (fst q)) a b w); [ partial_smooth h | smoothly | smoothly ]
  | |- smooth_at ?n (fun p => Derive (fun y => Derive (fun z => ?h z y) (@?a p)) (@?b p)) ?w =>
      apply (smooth_of2 n (fun q : R * R => Derive (fun y => Derive (fun z => h z y) (fst q)) (snd q)) a b w); [ partial_smooth h | smoothly | smoothly ]
  | |- smooth_at ?n (fun p => Derive (fun x => Derive (fun z => ?h x z) (@?b p)) (@?a p)) ?w =>
      apply (smooth_of2 n (fun q : R * R => Derive (fun x => Derive (fun z => h x z) (snd q)) (fst q)) a b w); [ partial_smooth h | smoothly | smoothly ]
  | |- smooth_at ?n (fun p => Derive (fun y => Derive (fun z => ?h (@?a p) z) y) (@?b p)) ?w =>
      apply (smooth_of2 n (fun q : R * R => Derive (fun y => Derive (fun z => h (fst q) z) y) (snd q)) a b w); [ partial_smooth h | smoothly | smoothly ]
  | |- smooth_at ?n (fun p => Derive (fun x => ?h x (@?b p)) (@?a p)) ?w =>
      apply (smooth_of2 n (fun q : R * R => Derive (fun x => h x (snd q)) (fst q)) a b w); [ partial_smooth h | smoothly | smoothly ]
  | |- smooth_at ?n (fun p => Derive (fun y => ?h (@?a p) y) (@?b p)) ?w =>
      apply (smooth_of2 n (fun q : R * R => Derive (fun y => h (fst q) y) (snd q)) a b w); [ partial_smooth h | smoothly | smoothly ]
  end.
Ltac derivable_near := cbv beta; cbn [fst snd]; first [ derivable | apply filter_forall; intros; derivable_near ].
Ltac near_smoothly ::=
  cbv beta;
  first
  [ apply filter_forall; intros; cbn [fst snd]; first [ sign | derivable_near ]
  | lazymatch goal with
    | |- locally _ (fun p => @?f p <> 0) => apply (smooth_nonzero f); [ smoothly | point ]
    | |- locally _ (fun p => 0 < @?f p) => apply (smooth_positive f); [ smoothly | point ]
    | |- locally _ (fun p => 0 <= @?f p) => apply (smooth_nonneg f); [ smoothly | point ]
    end ].

(* Close to a place, also where what is unknown is composed; a power is defined where its base is positive. *)
Ltac near ::=
  let rated := first [ differentiable | derivable ] in
  lazymatch goal with
  | |- locally ?x (fun y => 0 < @?f y \/ _) => apply (filter_imp (fun y => 0 < f y)); [ intros ? ?; left; assumption | near ]
  | |- locally ?x (fun y => @?f y <> 0) => apply (near_nonzero f); [ rated | cbv beta; sign ]
  | |- locally ?x (fun y => 0 < @?f y) => first [ apply filter_forall; intro; sign | apply (near_positive f); [ rated | cbv beta; sign ] ]
  | |- locally ?x (fun y => 0 <= @?f y) => first [ apply filter_forall; intro; sign | apply (near_nonneg f); [ rated | cbv beta; sign ] ]
  | |- locally ?x _ => apply filter_forall; intro; first [ rated | sign ]
  end.

(* Whether two derivatives are the same is asked of what is derived, not of the definition by filters: a hypothesis that
   does not fit is then passed over at once. *)
#[global] Opaque ex_derive is_derive Derive RInt is_RInt ex_RInt exp sin cos ln sqrt PI.

(* Norms: equal calls of an unknown function are made the same, and squares of roots are gone. *)
Ltac same_call old new :=
  let E := fresh in assert (E : old = new) by (f_equal; field; sides); rewrite ?E in *; clear E.
Ltac without_squared_roots := rewrite ?pow2_sqrt by sign.
