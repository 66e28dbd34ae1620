//! Each claim fails if the thing that it tests is replaced by a false one, and holds for the true one.

use super::boundary::{
    M, accumulation, boundary_points, countable, leaving, printed_tree, remainder,
};
use super::box_count::{boundary_boxes, first_hump};
use super::checks;
use super::construction::{each_level, two_preimages};
use super::fixed_points::{all_are_fixed, digits, touches};
use super::humps::{above_first, falls_through, multimodal};
use super::invariance::{Pairs, invariance, no_invariance, stable_form};
use super::measures::{Fractions, POINTS, Printed, counted, fall_and_recovery, measure};
use super::stability::{beta, exponents, lambda, one_way};
use super::sudden::{Windows, sudden_windows};
use super::trap::{Places, computed_traps, edges, leading_order, smallest_at_one, symmetric};
use crate::error::Error;
use crate::figures::fig_05_construction::levels;
use crate::independent::blind_landing::{printed_landing, sampled_excess};
use crate::independent::integrated_hopper::integrated;
use crate::independent::map::{printed, stable};
use basin_of_attraction::{Branch, Interval, IntervalBasins, IntervalSet, PreimageTree};
use hopper_asymptotics::{Coefficients, Form, LEFT_FACTOR};
use hopper_basin::{Trap, crisis};
use passive_hopper::{LiftOffMap, MassRatio, alpha_star};
use std::f64::consts::PI;
use std::sync::LazyLock;

/// One test for each claim, and a test that no claim is left out. Each line has the name of the test, the name of the
/// claim, the check of the true thing, and the checks of false things.
macro_rules! claims {
    ($($test:ident: $name:literal, $truth:expr, [$($falsehood:expr),+];)*) => {
        $(
            #[test]
            fn $test() {
                let truth = || -> Result<_, Error> { Ok($truth) };
                let truth = truth().unwrap();
                assert!(truth.holds, "the true one: {truth:?}");
                $(
                    let falsehood = || -> Result<_, Error> { Ok($falsehood) };
                    let falsehood = falsehood().unwrap();
                    assert!(!falsehood.holds, "the false one: {falsehood:?}");
                )+
            }
        )*

        #[test]
        fn every_claim_has_a_test_with_a_falsehood() {
            let mut tested = vec![$($name),*];
            let mut claims: Vec<&str> = checks().map(|check| check.name).collect();
            tested.sort_unstable();
            claims.sort_unstable();
            assert_eq!(tested, claims);
        }
    };
}

type Image = Result<Option<f64>, Error>;

/// M where there should be none: 10⁻⁹ of κ.
fn with_mass(alpha: f64, mass_ratio: MassRatio) -> Image {
    Ok(printed(alpha, mass_ratio)?.map(|next| next * (1.0 + 1e-9 * mass_ratio.kappa())))
}

/// The same in an integrated hopper, above the error of its integration.
fn integrated_with_mass(alpha: f64, mass_ratio: MassRatio) -> Image {
    Ok(integrated(alpha, mass_ratio)?.map(|next| next * (1.0 + 1e-4 * mass_ratio.kappa())))
}

/// The larger one of M and 1/M.
fn heavier(mass_ratio: MassRatio) -> MassRatio {
    if mass_ratio.value() < 1.0 { mass_ratio.inverted() } else { mass_ratio }
}

/// κ in place of μ.
fn with_kappa(alpha: f64, mass_ratio: MassRatio) -> Image {
    let hop = LiftOffMap::new(mass_ratio).hop(alpha)?;
    let loss = (alpha * alpha - hop.next_speed_squared) * mass_ratio.kappa() / mass_ratio.mu();
    let square = alpha * alpha - loss;
    Ok((square > 0.0).then(|| square.sqrt()))
}

/// All landings but the first skipped: contact follows a sudden one.
fn one_landing(alpha: f64, mass_ratio: MassRatio) -> Image {
    let landing = printed_landing(alpha, mass_ratio)?;
    let (m, y, t) = (mass_ratio.value(), 1.0 + landing.excess, landing.time);
    let (sin, cos) = pxfm::f_sincos(t);
    let v = (alpha - t + m * (alpha * cos - sin)) / (1.0 + m);
    let square = ((1.0 + m) * v * v + m * y * y + 2.0 * y - 2.0 - m) / (1.0 + m);
    Ok((square > 0.0).then(|| square.sqrt()))
}

/// The fixed points off by 10⁻⁶.
fn star_off(n: u64) -> f64 {
    alpha_star(n) + 1e-6
}

/// The map with its fixed points off by 10⁻⁶.
fn map_off(alpha: f64, mass_ratio: MassRatio) -> Image {
    Ok(printed(alpha - 1e-6, mass_ratio)?.map(|next| next + 1e-6))
}

/// The map at another mass ratio.
fn at_mass(factor: f64) -> impl Fn(f64, MassRatio) -> Image + Sync {
    move |alpha, mass_ratio| printed(alpha, MassRatio::new(factor * mass_ratio.value())?)
}

fn windows(n: u64) -> (f64, f64) {
    (n as f64 * PI, alpha_star(n))
}

fn excess(alpha: f64, mass_ratio: MassRatio) -> Result<f64, Error> {
    Ok(printed_landing(alpha, mass_ratio)?.excess)
}

fn few(mass_ratio: f64) -> Result<Fractions, Error> {
    counted(mass_ratio, 300)
}

fn all_points(mass_ratio: f64) -> Result<Fractions, Error> {
    counted(mass_ratio, POINTS)
}

/// A measure off by 0.001.
fn measure_off(mass_ratio: f64) -> Result<Fractions, Error> {
    let Fractions { all, first } = all_points(mass_ratio)?;
    Ok(Fractions { all: all - 0.001, first: first - 0.001 })
}

/// The levels without one interval of level `k`.
fn without_interval(k: usize) -> Result<Vec<IntervalSet>, Error> {
    let mut levels = levels()?;
    let rest = levels[k].intervals()[1..].to_vec();
    levels[k] = IntervalSet::union(rest);
    Ok(levels)
}

/// A level of the construction dropped.
fn without_level(k: usize) -> Result<Vec<IntervalSet>, Error> {
    let mut levels = levels()?;
    levels[k] = IntervalSet::union(Vec::new());
    Ok(levels)
}

/// The preimage tree of the tent map of slope 3, which leaves Cantor's set.
fn cantor_tree() -> Result<PreimageTree, Error> {
    let tent = |x: f64| Some(if x < 0.5 { 3.0 * x } else { 3.0 * (1.0 - x) });
    let left = Branch { domain: Interval::new(0.0, 0.5)?, at_left: 0.0, at_right: 1.5 };
    let right = Branch { domain: Interval::new(0.5, 1.0)?, at_left: 1.5, at_right: 0.0 };
    let (window, hole) = (Interval::new(0.0, 1.0)?, Interval::new(1.0 + 1e-12, 1.5)?);
    Ok(PreimageTree::grow_from_known(&tent, &[left, right], hole, window, 12)?)
}

/// The ends of the intervals of Cantor's construction on hump n, after 13 steps.
fn cantor_points(n: u64) -> Vec<f64> {
    let mut parts = vec![(alpha_star(n), alpha_star(n + 1))];
    for _ in 0..13 {
        let thirds = |(a, b): (f64, f64)| [(a, a + (b - a) / 3.0), (b - (b - a) / 3.0, b)];
        parts = parts.into_iter().flat_map(thirds).collect();
    }
    parts.into_iter().flat_map(|(a, b)| [a, b]).collect()
}

/// The trap 1 % longer, or with M where there should be none.
fn false_trap(n: u64, mass_ratio: MassRatio, factor: f64) -> Result<Trap, Error> {
    let trap = Trap::new(n, mass_ratio)?;
    Ok(Trap { delta: trap.delta * factor, ..trap })
}

fn left_hop(distance: f64) -> Result<f64, Error> {
    let next = LiftOffMap::new(MassRatio::new(M)?).hop_near_fixed_point(2, -distance)?.next;
    Ok(next.map_or(f64::INFINITY, |next| -next))
}

fn corrected(n: u64, mass_ratio: MassRatio) -> Result<f64, Error> {
    Ok(Coefficients::new(n, mass_ratio, Form::Corrected)?.lambda)
}

/// λ without ¾.
fn uncorrected(n: u64, mass_ratio: MassRatio) -> Result<f64, Error> {
    Ok(Coefficients::new(n, mass_ratio, Form::Printed)?.lambda)
}

/// Computed once for all that is said about them.
static BOUNDARY: LazyLock<[Vec<f64>; 2]> = LazyLock::new(|| boundary_points().unwrap());
static FIRST_HUMP: LazyLock<IntervalBasins> = LazyLock::new(|| first_hump().unwrap());

const PAIRS: Pairs = Pairs { printed: 2000, integrated: 40 };
const WINDOWS: Windows = Windows { printed: 4, sampled: 2 };
const PLACES: Places = Places { printed: 1, integrated: 1 };

claims! {
    invariance_fails_with_m_where_there_should_be_none: "$M$ → 1/$M$ invariance",
        invariance(&printed, &integrated, PAIRS)?,
        [
            invariance(&with_mass, &integrated, PAIRS)?,
            invariance(&printed, &integrated_with_mass, PAIRS)?,
            invariance(&with_kappa, &integrated, PAIRS)?
        ];
    no_invariance_fails_for_an_invariant_map: "no invariance with sudden lift-offs",
        no_invariance(&printed, &integrated, PAIRS)?,
        [
            no_invariance(&|alpha, m| printed(alpha, heavier(m)), &integrated, PAIRS)?,
            no_invariance(&printed, &|alpha, m| integrated(alpha, heavier(m)), PAIRS)?
        ];
    the_stable_form_fails_with_kappa_in_place_of_mu: "the stable map contains $M$ in $μ$ alone",
        stable_form(&stable, 2000)?,
        [stable_form(&with_kappa, 2000)?];
    sudden_windows_fail_when_they_are_shifted: "where landings are sudden",
        sudden_windows(&windows, &excess, &sampled_excess, WINDOWS)?,
        [
            sudden_windows(&|n| (windows(n).0 + 1e-6, windows(n).1), &excess, &sampled_excess, WINDOWS)?,
            sudden_windows(&|n| (windows(n).0, star_off(n)), &excess, &sampled_excess, WINDOWS)?,
            sudden_windows(&windows, &excess, &|_, _| Ok(-1.0), WINDOWS)?
        ];
    digits_fail_for_fixed_points_off_by_a_millionth: "fixed points",
        digits(&alpha_star),
        [digits(&star_off), digits(&|n| alpha_star(n) * (1.0 + 1e-14))];
    incessant_hopping_fails_off_the_fixed_points: "incessant hopping is possible",
        all_are_fixed(&printed, &alpha_star, 3)?,
        [all_are_fixed(&printed, &star_off, 3)?, all_are_fixed(&map_off, &alpha_star, 3)?];
    touches_fail_where_the_map_crosses: "the fixed points are touches",
        touches(&printed, &alpha_star)?,
        [
            touches(&printed, &star_off)?,
            touches(&|alpha, m| Ok(printed(alpha, m)?.map(|next| next + 1e-6)), &alpha_star)?
        ];
    one_way_stability_fails_with_fixed_points_off: "one-way stability",
        one_way(&printed)?,
        [one_way(&map_off)?];
    the_factor_10_fails_with_a_landing_skipped: "the exponent 4/3, and 10 on the left",
        exponents(&printed, LEFT_FACTOR)?,
        [exponents(&one_landing, LEFT_FACTOR)?, exponents(&printed, 9.9)?];
    beta_fails_without_its_6: "β",
        beta(&|n| Ok(Coefficients::new(n, MassRatio::ONE, Form::Corrected)?.beta))?,
        [beta(&|n| {
            Ok(Coefficients::new(n, MassRatio::ONE, Form::Corrected)?.beta / pxfm::f_cbrt(6.0))
        })?];
    lambda_fails_without_three_quarters: "λ (erratum)",
        lambda(&printed, &corrected)?,
        [lambda(&printed, &uncorrected)?];
    delta_fails_when_the_trap_is_moved_by_a_hundredth: "Δ, the interval of attraction",
        edges(&printed, &|n, m| Ok(Trap::new(n, m)?.delta))?,
        [edges(&printed, &|n, m| Ok(false_trap(n, m, 1.01)?.delta))?];
    the_leading_order_fails_without_three_quarters: "Δ = λ⁻³ as the leading order",
        leading_order(&printed, &|n| corrected(n, MassRatio::ONE))?,
        [leading_order(&printed, &|n| uncorrected(n, MassRatio::ONE))?];
    the_smallest_delta_fails_at_another_mass_ratio: "Δ is smallest at M = 1",
        smallest_at_one(&printed, &integrated, PLACES)?,
        [
            smallest_at_one(&at_mass(1.01), &integrated, PLACES)?,
            smallest_at_one(
                &printed,
                &|alpha, m| integrated(alpha, MassRatio::new(1.2 * m.value())?),
                PLACES
            )?
        ];
    equal_deltas_fail_with_m_where_there_should_be_none: "Δ is the same at M and 1/M",
        symmetric(&printed, &integrated, PLACES)?,
        [symmetric(&with_mass, &integrated, PLACES)?, symmetric(&printed, &integrated_with_mass, PLACES)?];
    computed_traps_fail_with_m_where_there_should_be_none: "the computed trap contains $M$ in $μ$ alone",
        computed_traps(&|n, m| Ok(Trap::new(n, m)?))?,
        [computed_traps(&|n, m| false_trap(n, m, 1.0 + 1e-9 * m.kappa()))?];
    multimodality_fails_for_a_map_without_dips: "multimodality",
        multimodal(&printed)?,
        [multimodal(&at_mass(0.05))?];
    small_mass_ratios_fail_beyond_the_crisis: "small M: the whole map is above α*₁",
        above_first(&printed)?,
        [above_first(&at_mass(1.05))?];
    the_crisis_fails_when_it_is_off_by_a_millionth: "where that ends",
        falls_through(&printed, crisis(1)?.mass_ratio)?,
        [
            falls_through(&printed, crisis(1)?.mass_ratio * (1.0 + 1e-6))?,
            falls_through(&at_mass(1.0 + 1e-9), crisis(1)?.mass_ratio)?
        ];
    the_whole_measure_fails_when_off_by_a_thousandth: "measure at M = 0.1, all basins",
        measure(&all_points, &printed, &Printed::ALL_AT_ONE_TENTH, 20)?,
        [
            measure(&measure_off, &printed, &Printed::ALL_AT_ONE_TENTH, 20)?,
            measure(&all_points, &at_mass(1.5), &Printed::ALL_AT_ONE_TENTH, 20)?
        ];
    the_first_measure_fails_when_off_by_a_thousandth: "measure at M = 0.1, first basin",
        measure(&all_points, &printed, &Printed::FIRST_AT_ONE_TENTH, 20)?,
        [measure(&measure_off, &printed, &Printed::FIRST_AT_ONE_TENTH, 20)?];
    the_small_measure_fails_when_off_by_a_thousandth: "measure at M = 0.2, all basins",
        measure(&all_points, &printed, &Printed::ALL_AT_ONE_FIFTH, 20)?,
        [
            measure(&measure_off, &printed, &Printed::ALL_AT_ONE_FIFTH, 20)?,
            measure(&all_points, &at_mass(0.5), &Printed::ALL_AT_ONE_FIFTH, 20)?
        ];
    the_recovery_fails_for_measures_of_m_below_1: "fall and recovery of the measure",
        fall_and_recovery(&few)?,
        [fall_and_recovery(&|m| few(m.min(1.0)))?, fall_and_recovery(&|m| few(m.max(1.0)))?];
    two_preimages_fail_with_one_dropped: "two preimages on the next hump",
        two_preimages(&levels()?, &printed)?,
        [two_preimages(&without_interval(1)?, &printed)?, two_preimages(&levels()?, &at_mass(0.1))?];
    the_construction_fails_with_a_level_dropped: "the construction, level by level",
        each_level(&levels()?, &printed, 2000)?,
        [
            each_level(&without_level(2)?, &printed, 2000)?,
            each_level(&without_interval(2)?, &printed, 2000)?,
            each_level(&levels()?, &one_landing, 2000)?
        ];
    the_tree_fails_for_a_cantor_set: "a Cantor set?",
        remainder(&printed_tree(&printed)?)?,
        [remainder(&cantor_tree()?)?];
    accumulation_fails_for_a_cantor_set: "where the pieces accumulate",
        accumulation(&printed, &BOUNDARY)?,
        [
            accumulation(&printed, &[cantor_points(1), cantor_points(2)])?,
            accumulation(&at_mass(1.01), &BOUNDARY)?
        ];
    the_law_of_leaving_fails_without_its_10: "how fast the pieces shrink",
        leaving(&printed, LEFT_FACTOR)?,
        [leaving(&printed, 1.0)?, leaving(&one_landing, LEFT_FACTOR)?];
    countability_fails_for_a_map_that_rises: "the boundary is countable",
        countable(&printed, M)?,
        [
            countable(&|alpha, m| Ok(printed(alpha, m)?.map(|next| next + 1e-6)), M)?,
            countable(&printed, 2.0)?
        ];
    the_box_count_fails_without_its_10: "the dimension of the boundary",
        boundary_boxes(&left_hop, LEFT_FACTOR, &FIRST_HUMP)?,
        [
            boundary_boxes(&left_hop, 1.0, &FIRST_HUMP)?,
            boundary_boxes(&left_hop, 9.0, &FIRST_HUMP)?
        ];
}

/// Each statement that a claim names exists in docs/theory.md.
#[test]
fn proofs_exist_in_the_theory() {
    let theory = include_str!("../../../../../docs/theory.md");
    for check in checks() {
        let Some(proof) = check.ground.proof() else { continue };
        let begins = |line: &str| {
            let rest = line.strip_prefix("**").and_then(|line| line.strip_prefix(proof));
            rest.is_some_and(|rest| !rest.starts_with(|next: char| next.is_ascii_digit()))
        };
        assert!(
            theory.lines().any(begins),
            "docs/theory.md has no {proof}, named by {}",
            check.name
        );
    }
}

/// Every claim that is no theorem names its test.
#[test]
fn claims_name_their_tests() {
    for check in checks() {
        assert!(check.ground.test().is_none_or(|test| test.len() > 10), "{}", check.name);
    }
}
