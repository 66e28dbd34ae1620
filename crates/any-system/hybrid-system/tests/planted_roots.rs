//! A million guards (in release builds) with roots at known places, some of them within a few ulps of each other,
//! of the start or of the end: each root is found once.

use basin_of_attraction::SplitMix64;
use hybrid_system::*;
use nalgebra::Vector1;

/// Events are searched in (0, END].
const END: f64 = 4.0;

/// A root must be found exactly once if it is farther than this from all other roots, from the start and from the end.
const ALONE: f64 = 0.05;

/// A grazing or an undecided sign is accepted only if two roots, or an end, lie within this distance. The value has a
/// margin: five close roots make a guard like x⁵, which is below a rounding of 1e-13 only for |x| < 3e-3.
const CROWD: f64 = 0.2;

/// Largest distance of an event from a root that is alone. The coefficients are rounded to about 1e-14. The slope at
/// the root is at least about ALONE⁴ = 6e-6.
const KNOWN: f64 = 1e-6;

/// Largest distance of an event from the nearest root of a crowd. Five factors up to 8 have coefficients with a
/// rounding of 8⁵ · 30ε = 2e-10 together. A crowd of five roots is hidden up to the fifth root of this number,
/// 1.2e-2.
const CLOSE: f64 = 2e-2;

/// Random numbers, one after the other.
struct Random {
    generator: SplitMix64,
    drawn: u64,
}

impl Random {
    fn new(state: u64) -> Self {
        Random { generator: SplitMix64::from_state(state), drawn: 0 }
    }
    fn bits(&mut self) -> u64 {
        self.drawn += 1;
        self.generator.bits(self.drawn)
    }
    fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * 2f64.powi(-53)
    }

    /// One to five roots in [−1, 5], often crowded.
    fn roots(&mut self) -> Vec<f64> {
        let mut roots: Vec<f64> = Vec::new();
        for _ in 0..1 + self.bits() % 5 {
            let anywhere = 6.0 * self.unit() - 1.0;
            let ulps = (self.bits() % 17) as i64 - 8;
            let near = |x: f64| x + ulps as f64 * f64::EPSILON * x.abs().max(1.0);
            roots.push(match (self.bits() % 8, roots.last()) {
                (0, _) => near(0.0),
                (1, _) => near(END),
                (2 | 3, Some(&other)) => near(other),
                (4, Some(&other)) => other + 1e-6 * self.unit(),
                _ => anywhere,
            });
        }
        roots.sort_by(f64::total_cmp);
        roots
    }
}

/// A flow whose state is time, with a guard given by its zeros.
struct Planted<'a> {
    roots: &'a [f64],
    form: Form,
}

#[derive(Clone, Copy, PartialEq)]
enum Form {
    /// Π (t − r) as a polynomial.
    Polynomial,
    /// Π sin(ω(t − r)) as a sum of sines.
    Trigonometric,
    /// Π (t − r) as a product, with enclosures.
    Enclosed,
}

/// The other zeros of sin ω(t − r) are at a distance π/ω = 5.2 from r: beyond the end for roots in [−1, 5], or
/// before the start.
const OMEGA: f64 = 0.6;

impl HybridSystem for Planted<'_> {
    type State = State<1>;
    type Mode = ();
    type Surface = ();
    fn flow(&self, _: (), x: &State<1>, t: f64) -> State<1> {
        Vector1::new(x[0] + t)
    }
    fn guards(&self, _: ()) -> &[Guard<()>] {
        const { &[Guard::either(())] }
    }
    fn guard_value(&self, _: (), x: &State<1>) -> f64 {
        let factor = |root: &f64| match self.form {
            Form::Polynomial | Form::Enclosed => x[0] - root,
            Form::Trigonometric => (OMEGA * (x[0] - root)).sin(),
        };
        self.roots.iter().map(factor).product()
    }
    fn guard_quasi_polynomial(&self, _: (), _: (), x: &State<1>) -> Option<QuasiPolynomial> {
        let factor = |root: f64| match self.form {
            Form::Polynomial => Some(QuasiPolynomial::polynomial(&[x[0] - root, 1.0])),
            Form::Trigonometric => {
                let (sin, cos) = (OMEGA * (x[0] - root)).sin_cos();
                Some(QuasiPolynomial::sine(cos, OMEGA) + QuasiPolynomial::cosine(sin, OMEGA))
            }
            Form::Enclosed => None,
        };
        let one = QuasiPolynomial::polynomial(&[1.0]);
        self.roots.iter().try_fold(one, |product, root| Some(product * factor(*root)?))
    }
    fn guard_enclosure(
        &self,
        _: (),
        _: (),
        x: &State<1>,
        order: u32,
        (from, to): (f64, f64),
    ) -> Option<Enclosure> {
        let factors: Vec<_> = self
            .roots
            .iter()
            .map(|root| {
                // Roundings of x + t, and of its difference from the root; all values are below 8.
                let at = |t: f64| Enclosure::around(x[0] + t - root, 4.0 * f64::EPSILON * 8.0);
                Enclosure::new(at(from).low(), at(to).high())
            })
            .collect();
        match order {
            0 => Some(product(factors.iter().copied())),
            // (Π fᵢ)′ = Σ Π_{j≠i} fⱼ
            1 => (0..factors.len())
                .map(|i| {
                    product(
                        factors
                            .iter()
                            .copied()
                            .enumerate()
                            .filter_map(|(j, f)| (j != i).then_some(f)),
                    )
                })
                .reduce(|a, b| outward(a.low() + b.low(), a.high() + b.high())),
            _ => None,
        }
    }
    fn reset(&self, _: (), _: (), x: &State<1>) -> Reset<(), State<1>> {
        Reset::Jump { mode: (), state: *x }
    }
}

fn product(factors: impl Iterator<Item = Enclosure>) -> Enclosure {
    factors.fold(Enclosure::new(1.0, 1.0), |a, b| {
        let ends = [a.low() * b.low(), a.low() * b.high(), a.high() * b.low(), a.high() * b.high()];
        outward(
            ends.iter().copied().fold(f64::INFINITY, f64::min),
            ends.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        )
    })
}

fn outward(low: f64, high: f64) -> Enclosure {
    Enclosure::new(low.next_down(), high.next_up())
}

/// Follows one guard and compares its events with its roots.
fn check(roots: &[f64], form: Form) {
    let system = Planted { roots, form };
    let mut found = Vec::new();
    let mut open = END;
    for arc in Execution::new(&system, (), Vector1::new(0.0), Limits::new(END, 100)) {
        match arc {
            Ok(arc) => found.extend(arc.event().map(|event| event.before[0])),
            // An error is allowed only where several roots are close together, or near the start or the end.
            Err(Error::Grazing { time, .. }) => {
                let at = found.last().unwrap_or(&0.0) + time;
                let crowd = roots.iter().filter(|root| (*root - at).abs() < CROWD).count();
                let inside = (CROWD..=END - CROWD).contains(&at);
                assert!(crowd >= 2 || !inside, "{roots:?}: grazing at {at}");
                open = at;
            }
            Err(Error::UndecidedSign { .. }) => {
                let at = found.last().copied().unwrap_or(0.0);
                let crowd = roots.iter().filter(|root| (*root - at).abs() < CROWD).count();
                assert!(crowd >= 2, "{roots:?}: undecided at {at}");
                open = at;
            }
            Err(error) => panic!("{roots:?}: {error}"),
        }
    }
    let close = |a: f64, b: f64| (a - b).abs() < KNOWN;
    for (k, &root) in roots.iter().enumerate() {
        let neighbours =
            [k.checked_sub(1).map_or(0.0, |k| roots[k]), *roots.get(k + 1).unwrap_or(&END)];
        let alone = neighbours.iter().chain(&[0.0, END]).all(|other| (root - other).abs() > ALONE);
        if alone && root > 0.0 && root < open - CROWD {
            let times = found.iter().filter(|time| close(**time, root)).count();
            assert_eq!(times, 1, "{roots:?}: {root} in {found:?}");
        }
    }
    // Near every event there is a root, and there are no more events than roots.
    for time in &found {
        let nearest = roots.iter().map(|root| (root - time).abs()).fold(f64::INFINITY, f64::min);
        assert!(nearest < CLOSE, "{roots:?}: {time}");
    }
    assert!(found.len() <= roots.len(), "{roots:?}: {found:?}");
    // Without an error, and without roots at the ends, the guard ends on the right side: of close roots an even number
    // may be missed, and no odd number.
    let clear = |at: f64| roots.iter().all(|root| (root - at).abs() > CLOSE);
    if open >= END && clear(0.0) && clear(END) {
        let inside = roots.iter().filter(|root| (0.0..END).contains(*root)).count();
        assert_eq!(found.len() % 2, inside % 2, "{roots:?}: {found:?}");
    }
}

/// Without optimization of the release profile one case of twenty runs, which takes some seconds. The rare
/// arrangements, of which one in 10⁵ has found an error before, need the full number: `cargo test --release`.
const PART: usize = if cfg!(debug_assertions) { 20 } else { 1 };

fn run(seed: u64, cases: usize, form: Form) {
    let mut random = Random::new(seed);
    for _ in 0..cases / PART {
        check(&random.roots(), form);
    }
}

#[test]
fn roots_of_polynomials_are_found_once() {
    run(1, 600_000, Form::Polynomial);
}

#[test]
fn roots_of_sums_of_sines_are_found_once() {
    run(2, 200_000, Form::Trigonometric);
}

#[test]
fn roots_of_guards_with_enclosures_are_found_once() {
    run(3, 200_000, Form::Enclosed);
}
