(* Powers of a base that may be 0, smoothness, and tactics that do not lose themselves in definitions. *)
From Coq Require Import Reals Lra Psatz Nsatz FunctionalExtensionality.
From Coquelicot Require Import Coquelicot.
From Ptproof Require Import Base.
Open Scope R_scope.

(* Whether two derivatives are the same is asked of what is derived, not of the definition by filters: a hypothesis that
   does not fit is then passed over at once. *)
#[global] Opaque ex_derive is_derive Derive RInt exp sin cos ln sqrt PI.
