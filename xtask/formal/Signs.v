(** The [interval] tactic over the integers of the kernel: with [i_prec] it needs no axioms of machine arithmetic. *)

From Interval Require Import Specific_stdz Specific_ops Tactic.

Module KernelFloat := SpecificFloat StdZRadix2.
Module KernelInterval := IntervalTactic KernelFloat.
Export KernelInterval.
