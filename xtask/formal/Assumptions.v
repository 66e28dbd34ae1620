(** Prints what the main theorems assume. *)

From Hopper Require Import Model Energy FirstLanding Windows Fates OneSudden Losses Finite Traps Crises Hops Chaos Henon
  OneSuddenLine CrisisLines1to5 CrisisLines6to10 TrapLines OneSidedLines Basin.

Definition all := (flight_solution, flight_unique, landing_closed, energy_of_landing, contact_ends, hop_loss,
  hop_not_above, next_speed, grounded_exactly, every_hop, finitely_many, half_time, A_increases, first_landing, half_time_continuous, fixed_points,
  sudden_exactly, times_before, times_after, star_exists, star_unique, fates, intervals_have_fates, long_flights,
  at_most_one_sudden, one_or_two_flights, bounds_of_landing, take_off_lands, one_crisis, inverse_mass_ratio, trap_of_smaller_mu, sudden_hop, contact_hop).
Definition lines := (one_sudden, crisis_1, crisis_10, trap_1_200, falls_1_1000, trap_8_8, basin).
Definition chaos := (walks_are_followed, walks_differ, binary_sequences).

Print Assumptions all.
Print Assumptions lines.
Print Assumptions chaos.
