//! A quasi-polynomial with its derivatives, in the form in which it is searched: values, bounds and rounding errors.
//!
//! Two changes leave the zeros where they are and keep all numbers of moderate size:
//!
//! * The common factor exp(σt) of the largest rate σ is removed. No rate is positive then, so that no exponential
//!   overflows, and a damped oscillation is searched like an undamped one.
//! * Time is counted in a unit 2ᵏ near the horizon. Powers of two are exact. A frequency of 1e-170 would have an ω² of
//!   zero otherwise.

use super::quasi_polynomial::QuasiPolynomial;
use super::quasi_term::{Term, slope_coefficient, slope_length};
use super::rounded::Rounded;
use crate::error::Error;

/// Roundings for each coefficient of a term and for each term of a sum: Horner's product and sum.
const ROUNDINGS_PER_COEFFICIENT: f64 = 2.0;

/// Roundings of the sine, the cosine and the two products with them.
const ROUNDINGS_OF_SINE_AND_COSINE: f64 = 4.0;

/// Roundings of the exponential and of the product with it.
const ROUNDINGS_OF_EXPONENTIAL: f64 = 2.0;

/// The unit of time lies between 2⁻¹⁰⁰⁰ and 2¹⁰⁰⁰, so that its inverse is a double.
const LARGEST_EXPONENT: i32 = 1000;

/// Coefficients in units of time are below 2⁶⁶⁴ ≈ 1e200. A horizon so long that one would be larger gets a shorter
/// unit. A larger number would leave no room for the derivatives of a function of high frequency.
const COEFFICIENT_EXPONENT: i32 = 664;

/// Frequencies and rates in units of time are below 2¹⁰⁰ ≈ 1e30, so that third derivatives do not overflow.
const RATE_EXPONENT: i32 = 100;

/// The exponential and the oscillation of one term, the same in all derivatives.
#[derive(Debug)]
struct Kind {
    sigma: Rounded,
    omega: Rounded,
}

/// The places of the polynomials p and q of one term in one derivative.
#[derive(Debug, Clone, Copy)]
struct Place {
    cos: usize,
    sin: usize,
    end: usize,
}

/// A function and its first derivatives, in units of time.
#[derive(Debug)]
pub(crate) struct Layers {
    unit: f64,
    kinds: Vec<Kind>,
    /// For each derivative in turn, the places of all terms.
    places: Vec<Place>,
    coefficients: Vec<Rounded>,
}

/// Bounds for one derivative on an interval of time.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Size {
    /// Bound on the absolute value.
    pub(crate) bound: f64,
    /// Bound on the rounding error of a computed value.
    pub(crate) rounding: f64,
}

impl Layers {
    /// The function with its first `derivatives` derivatives, for times up to `horizon`.
    ///
    /// # Errors
    /// [`Error::NotFinite`] if a coefficient, a rate or a frequency is not finite, or the horizon so long that the
    /// function overflows there; [`Error::DerivativeOverflows`].
    pub(crate) fn new(
        function: &QuasiPolynomial,
        horizon: f64,
        derivatives: usize,
    ) -> Result<Self, Error> {
        function.check()?;
        let terms = function.terms();
        let unit = unit_of_time(terms, horizon);
        if !(horizon / unit).is_finite() {
            return Err(Error::NotFinite { at: horizon, value: function.value(horizon) });
        }
        let largest =
            terms.iter().map(|term| term.sigma).max_by(|a, b| a.value.total_cmp(&b.value));
        let common = largest.unwrap_or_default();
        let mut layers = Layers {
            unit,
            kinds: Vec::with_capacity(terms.len()),
            places: Vec::with_capacity(terms.len() * (derivatives + 1)),
            coefficients: Vec::with_capacity(coefficients_in(terms) * (derivatives + 1)),
        };
        for term in terms {
            let sigma =
                if term.sigma == common { Rounded::default() } else { term.sigma + -common };
            layers.kinds.push(Kind { sigma: sigma.shifted(unit), omega: term.omega.shifted(unit) });
            layers.push(in_units(&term.cos, unit), in_units(&term.sin, unit));
        }
        for layer in 0..derivatives {
            for (term, kind) in (0..terms.len()).map(|k| (layer * terms.len() + k, k)) {
                layers.push_slopes(layers.places[term], kind);
            }
        }
        if !layers.coefficients.iter().all(|c| c.size().is_finite()) {
            return Err(Error::DerivativeOverflows { horizon });
        }
        Ok(layers)
    }

    /// The unit of time, a power of two.
    pub(crate) fn unit(&self) -> f64 {
        self.unit
    }

    /// This time in units.
    pub(crate) fn in_units(&self, time: f64) -> f64 {
        time / self.unit
    }

    fn push(
        &mut self,
        cos: impl IntoIterator<Item = Rounded>,
        sin: impl IntoIterator<Item = Rounded>,
    ) {
        let start = self.coefficients.len();
        self.coefficients.extend(cos);
        let middle = self.coefficients.len();
        self.coefficients.extend(sin);
        self.places.push(Place { cos: start, sin: middle, end: self.coefficients.len() });
    }

    /// The polynomials of the derivative of one term.
    fn push_slopes(&mut self, Place { cos, sin, end }: Place, kind: usize) {
        let Kind { sigma, omega } = self.kinds[kind];
        let start = self.coefficients.len();
        for k in 0..slope_length(sigma, omega, sin - cos, end - sin) {
            let list = &self.coefficients;
            let c = slope_coefficient(sigma, omega, (&list[cos..sin], &list[sin..end]), k);
            self.coefficients.push(c);
        }
        let middle = self.coefficients.len();
        for k in 0..slope_length(sigma, -omega, end - sin, sin - cos) {
            let list = &self.coefficients;
            let c = slope_coefficient(sigma, -omega, (&list[sin..end], &list[cos..sin]), k);
            self.coefficients.push(c);
        }
        self.places.push(Place { cos: start, sin: middle, end: self.coefficients.len() });
    }

    fn place(&self, layer: usize, term: usize) -> Place {
        self.places[layer * self.kinds.len() + term]
    }

    /// The first K derivatives from order `first` on, at one time.
    pub(crate) fn values<const K: usize>(&self, first: usize, time: f64) -> [f64; K] {
        let mut sums = [0.0; K];
        for (term, kind) in self.kinds.iter().enumerate() {
            let (sin, cos) = match kind.omega.value {
                0.0 => (0.0, 1.0),
                omega => pxfm::f_sincos(omega * time),
            };
            let factor = match kind.sigma.value {
                0.0 => 1.0,
                sigma => interval_arithmetic::exp(sigma * time),
            };
            for (layer, sum) in sums.iter_mut().enumerate() {
                let Place { cos: p, sin: q, end } = self.place(first + layer, term);
                let p = horner(&self.coefficients[p..q], time);
                let q = horner(&self.coefficients[q..end], time);
                *sum += factor * (p * cos + q * sin);
            }
        }
        sums
    }

    /// Bounds on the first K derivatives from order `first` on, over [left, right], 0 ≤ left.
    ///
    /// In units of ε times the bound of each term, the rounding error of a value is: two roundings for each
    /// coefficient (Horner's product and sum) and two for each term of the sum; four for the sine, the cosine and
    /// the two products with them; two for the exponential; |ωt| and |σt| for the rounding of the phase and of the
    /// exponent. Each rounding is ε/2 at most. The other half covers the products of roundings and the rounding of
    /// this bound itself, as long as there are fewer than some 10⁷ of them. To this the errors of the coefficients,
    /// of the frequencies and of the rates are added.
    pub(crate) fn sizes<const K: usize>(&self, first: usize, left: f64, right: f64) -> [Size; K] {
        let mut sums = [Size::default(); K];
        for (term, Kind { sigma, omega }) in self.kinds.iter().enumerate() {
            // No rate is positive: the exponential is largest at the left end.
            let factor = match sigma.value {
                0.0 => 1.0,
                sigma => interval_arithmetic::exp(sigma * left),
            };
            let mut roundings = (omega.value.abs() + sigma.value.abs()) * right;
            if omega.value != 0.0 {
                roundings += ROUNDINGS_OF_SINE_AND_COSINE;
            }
            if sigma.value != 0.0 {
                roundings += ROUNDINGS_OF_EXPONENTIAL;
            }
            let moved = (omega.error + sigma.error) * right;
            for (layer, sum) in sums.iter_mut().enumerate() {
                let Place { cos, sin: _, end } = self.place(first + layer, term);
                let numbers = (end - cos + self.kinds.len()) as f64;
                let relative =
                    f64::EPSILON * (roundings + ROUNDINGS_PER_COEFFICIENT * numbers) + moved;
                let (size, error) = self.size(self.place(first + layer, term), right);
                sum.bound += factor * size;
                sum.rounding += factor * (relative * size + error);
            }
        }
        sums
    }

    /// Σ(|c| + e) tʲ and Σ e tʲ over both polynomials of a term, with the coefficients c and their errors e.
    fn size(&self, Place { cos, sin, end }: Place, time: f64) -> (f64, f64) {
        let sums = |list: &[Rounded]| {
            list.iter().rev().fold((0.0, 0.0), |(size, error), c| {
                (size * time + c.size(), error * time + c.error)
            })
        };
        let (p, q) = (sums(&self.coefficients[cos..sin]), sums(&self.coefficients[sin..end]));
        (p.0 + q.0, p.1 + q.1)
    }

    /// True if the constant term is larger than all other terms together up to `time`: then there is no zero.
    ///
    /// For an oscillation about a large constant one comparison decides, however many periods it has. The search by
    /// intervals would need several intervals for each period.
    pub(crate) fn stays_away(&self, time: f64) -> bool {
        let is_polynomial =
            |kind: &Kind| kind.sigma == Rounded::default() && kind.omega == Rounded::default();
        let constant = self.kinds.iter().position(is_polynomial).map(|term| self.place(0, term));
        let constant =
            constant.and_then(|Place { cos, sin, .. }| self.coefficients[cos..sin].first());
        let [Size { bound, rounding }] = self.sizes(0, 0.0, time);
        // The bound contains the constant itself once: |c| > bound − |c|.
        constant.is_some_and(|c| 2.0 * c.value.abs() > bound + rounding)
    }
}

/// p(t) by Horner's scheme.
fn horner(coefficients: &[Rounded], time: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * time + c.value)
}

/// The coefficients of the same polynomial of time/unit.
fn in_units(coefficients: &[Rounded], unit: f64) -> impl Iterator<Item = Rounded> {
    // unitʲ itself may overflow.
    coefficients.iter().enumerate().map(move |(j, &c)| (0..j).fold(c, |c, _| c.shifted(unit)))
}

fn coefficients_in(terms: &[Term]) -> usize {
    terms.iter().map(|term| 2 * term.cos.len().max(term.sin.len())).sum()
}

/// The power of two above the horizon, or a smaller one if a coefficient, a frequency or a rate would be too large.
fn unit_of_time(terms: &[Term], horizon: f64) -> f64 {
    let mut largest = (exponent(horizon) + 1).min(LARGEST_EXPONENT);
    for term in terms {
        for rate in [term.omega, term.sigma] {
            largest = largest.min(RATE_EXPONENT - exponent(rate.value));
        }
        for list in [&term.cos, &term.sin] {
            for (j, c) in list.iter().enumerate().skip(1) {
                largest =
                    largest.min((COEFFICIENT_EXPONENT - exponent(c.value)).div_euclid(j as i32));
            }
        }
    }
    power_of_two(largest.max(-LARGEST_EXPONENT))
}

/// Number of bits of the fraction of a double, and the offset of its exponent.
const FRACTION_BITS: u32 = 52;
const EXPONENT_OFFSET: i32 = 1023;

/// ⌊log₂|x|⌋; −1023 for zero and for subnormal numbers.
fn exponent(x: f64) -> i32 {
    (x.abs().to_bits() >> FRACTION_BITS) as i32 - EXPONENT_OFFSET
}

/// 2ᵏ for |k| ≤ 1000.
fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((exponent + EXPONENT_OFFSET) as u64) << FRACTION_BITS)
}
