(** Prints what the main theorems assume. *)

From Hopper Require Import Model Energy FirstLanding Windows Fates OneSudden Losses Finite Traps Crises OneSided Hops Chaos Henon
  OneSuddenLine CrisisLines1to5 CrisisLines6to10 TrapLines OneSidedLines Basin.

Definition all := (one_sided, flights_unique, stays_below, trap, long_trap, trap_of_squares, part_by_signs, whole_trap,
  falls_below, first_state, hop_with_one_landing, flight_solution, flight_unique, landing_closed, energy_of_landing, contact_ends, hop_loss,
  hop_not_above, next_speed, grounded_exactly, every_hop, finitely_many, half_time, A_increases, first_landing, half_time_continuous, fixed_points,
  sudden_exactly, times_before, times_after, star_exists, star_unique, fates, intervals_have_fates, long_flights,
  at_most_one_sudden, one_or_two_flights, bounds_of_landing, take_off_lands, one_crisis, inverse_mass_ratio, trap_of_smaller_mu, sudden_hop, contact_hop).
Definition lines := (one_sudden, crisis_1, crisis_2, crisis_3, crisis_4, crisis_5, crisis_6, crisis_7, crisis_8, crisis_9,
  crisis_10, trap_1_100, trap_1_200, trap_1_300, trap_1_400, trap_1_500, trap_1_600, trap_1_700, trap_1_800, trap_1_900,
  trap_1_1000, falls_1_100, falls_1_1000, trap_1_1, trap_2_2, trap_3_3, trap_4_4, trap_5_5, trap_6_6, trap_7_7, trap_8_8, basin).
Definition chaos := (disjoint_01, walks_are_followed, walks_differ, binary_sequences).

Print Assumptions all.
Print Assumptions lines.
Print Assumptions chaos.
