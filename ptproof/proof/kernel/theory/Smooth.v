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

(* Whether two derivatives are the same is asked of what is derived, not of the definition by filters: a hypothesis that
   does not fit is then passed over at once. *)
#[global] Opaque ex_derive is_derive Derive RInt is_RInt ex_RInt exp sin cos ln sqrt PI.

(* Norms: equal calls of an unknown function are made the same, and squares of roots are gone. *)
Ltac same_call old new :=
  let E := fresh in assert (E : old = new) by (f_equal; field; sides); rewrite ?E in *; clear E.
Ltac without_squared_roots := rewrite ?pow2_sqrt by sign.
