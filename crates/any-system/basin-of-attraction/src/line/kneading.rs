//! Kneading sequences of unimodal maps, and their topological entropy with proved bounds.

use crate::error::Error;
use crate::statistics::bounds::Bounds;
use interval_arithmetic::Enclosure;

/// On which side of the critical point a point of its orbit is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Where the map rises to its maximum.
    Left,
    /// At the critical point itself.
    Centre,
    /// Where it falls.
    Right,
}

/// The sides on which the images of the critical point of a unimodal map with a maximum are: f(c), f²(c), f³(c), …
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct KneadingSequence {
    sides: Vec<Side>,
}

impl KneadingSequence {
    /// The proved beginning of the sequence, up to `most` sides: the map is evaluated with enclosures, and the sequence ends where an image may be on
    /// either side, as it must in the end where the map stretches, or at the critical point, where it repeats itself.
    ///
    /// The map rises on the left of `critical` and falls on its right. A point outside of what the map leads back, such as one that escapes to −∞, is on
    /// its side as any other.
    ///
    /// ```
    /// use basin_of_attraction::{Enclosure, KneadingSequence};
    /// // The tent map of slope √2 has the entropy ln √2.
    /// let slope = Enclosure::from(2.0).sqrt().expect("a root");
    /// let tent = |x: Enclosure| match x.high() <= 0.5 {
    ///     true => slope * x,
    ///     false => slope * (Enclosure::from(1.0) - x),
    /// };
    /// let found = KneadingSequence::of_map(tent, Enclosure::from(0.5), 100);
    /// assert!(found.sides().len() > 60);
    /// let entropy = found.entropy()?;
    /// assert!(entropy.covers(0.5 * 2f64.ln()) && entropy.half_width() < 1e-6);
    /// # Ok::<(), basin_of_attraction::Error>(())
    /// ```
    pub fn of_map(
        map: impl Fn(Enclosure) -> Enclosure,
        critical: Enclosure,
        most: usize,
    ) -> KneadingSequence {
        let mut sides = Vec::new();
        let mut at = map(critical);
        while sides.len() < most {
            let side = match at {
                at if at.high() < critical.low() => Side::Left,
                at if at.low() > critical.high() => Side::Right,
                at if at == critical && at.width() == 0.0 => Side::Centre,
                _ => break,
            };
            sides.push(side);
            if side == Side::Centre {
                break;
            }
            at = map(at);
        }
        KneadingSequence { sides }
    }

    /// The sequence with these sides. It ends at the first [`Side::Centre`].
    pub fn from_sides(sides: &[Side]) -> KneadingSequence {
        let end = sides.iter().position(|side| *side == Side::Centre);
        KneadingSequence { sides: sides[..end.map_or(sides.len(), |end| end + 1)].to_vec() }
    }

    /// The sides.
    pub fn sides(&self) -> &[Side] {
        &self.sides
    }

    /// The topological entropy, with bounds that hold for every map whose sequence begins so: −ln of the smallest zero of the kneading determinant
    /// D(t) = 1 + θ₁t + θ₂t² + … in (0, 1), where θₖ is the sign of the slope of fᵏ at the first image; 0 without a zero (J. Milnor and W. Thurston,
    /// Lecture Notes in Mathematics 1342, 465, 1988). It is between 0 and ln 2. What follows the known sides is bounded by tⁿ/(1 − t).
    ///
    /// # Errors
    /// [`Error::BadSearch`] without a side.
    pub fn entropy(&self) -> Result<Bounds, Error> {
        if self.sides.is_empty() {
            let (name, remedy) =
                ("a number of sides", "; a sequence begins with the side of the first image");
            return Err(Error::BadSearch { name, value: 0.0, remedy });
        }
        // The coefficients, the first of which is 1, and whether others follow.
        let mut signs = vec![1.0];
        let mut sign = 1.0;
        for side in &self.sides {
            match side {
                Side::Left => {}
                Side::Right => sign = -sign,
                Side::Centre => break,
            }
            signs.push(sign);
        }
        let goes_on = self.sides.last() != Some(&Side::Centre);
        let determinant = |t: Enclosure| {
            let known = signs.iter().rev().fold(Enclosure::ZERO, |sum, sign| sum * t + *sign);
            if !goes_on {
                return known;
            }
            let rest = t.powi(signs.len() as i32) / (Enclosure::from(1.0) - t);
            known + Enclosure::new(-rest.high(), rest.high())
        };
        // Up to `positive` there is no zero, and at `negative` there was one.
        let (positive, negative) = first_zero(determinant, MOST_TERMS / signs.len());
        let entropy = |t: f64| (-pxfm::f_log(t)).clamp(0.0, std::f64::consts::LN_2);
        let lower = negative.map_or(0.0, |t| entropy(t) * (1.0 - 2.0 * f64::EPSILON));
        let upper =
            (entropy(positive) * (1.0 + 2.0 * f64::EPSILON)).min(std::f64::consts::LN_2.next_up());
        Ok(Bounds { lower, upper })
    }
}

/// Terms of all evaluations together: a second. Where the sequence has no entropy the function comes near 0, and steps get short; the bounds hold wherever
/// they end.
const MOST_TERMS: usize = 50_000_000;

/// Where a function that is 1 at 0 has no zero up to, from ½ on, and where it is negative then, below 1.
fn first_zero(
    function: impl Fn(Enclosure) -> Enclosure,
    mut evaluations: usize,
) -> (f64, Option<f64>) {
    /// Parts of the way from ½ to 1 of the first steps. A step that is not proved is halved.
    const PARTS: f64 = 256.0;
    /// The shortest step, as a part of the place: some rounding of the sums.
    const SHORTEST: f64 = 1e-15;
    // The entropy is at most ln 2: there is no zero below ½.
    let (mut at, mut step) = (0.5, 0.5 / PARTS);
    // Proved steps double the next one.
    while at < 1.0 && step > SHORTEST && evaluations > 0 {
        evaluations -= 1;
        let next = (at + step).min(1.0 - f64::EPSILON);
        if next <= at {
            break;
        }
        match function(Enclosure::new(at, next)).is_positive() {
            true => (at, step) = (next, 2.0 * step),
            false => step *= 0.5,
        }
    }
    // From there on the first place at which it is negative for certain, by steps that double.
    let mut beyond = SHORTEST;
    while at + beyond < 1.0 {
        if function(Enclosure::from(at + beyond)).is_negative() {
            return (at, Some(at + beyond));
        }
        beyond *= 2.0;
    }
    (at, None)
}
