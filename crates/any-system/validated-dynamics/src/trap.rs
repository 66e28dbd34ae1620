//! Traps: sets that a map leads into themselves, all of whose points converge to a fixed point.

use crate::cells::{MOST_SIDES, part_of};
use crate::enclosed_map::{EnclosedMap, StartSet};
use crate::fixed_point::ProvedFixedPoint;
use crate::frame::inverse_of;
use crate::matrix::{Matrix, exact, middle, offsets, row_norm};
use crate::multipliers::eigenbasis;
use crate::set::AffineSet;
use crate::undecided::{Error, Reason};
use interval_arithmetic::Enclosure;
use nalgebra::{DMatrix, Schur};

/// The largest contraction that is tried has the size of the fixed point, or 1 if that is smaller. The next ones are a fourth as large each, so often:
/// down to 10⁻²⁴ of it, for models in units in which all numbers are small.
const SMALLER: f64 = 0.25;
const SMALLER_TRIES: usize = 40;

/// How much larger a trap is, at first, whose image is to be in the trap before. Where it is not, the square root of this factor is tried, down to
/// the second one, at which growth ends. A box that turns by an eighth of a turn is √2 times as wide, so that a pair of multipliers of size 0.65 allows a
/// factor of 1.09.
const GROWN: f64 = 2.0;
const LEAST_GROWN: f64 = 1.04;

/// How much shorter each direction of Schur's form is than the one before: not at all, and as much as an entry above the diagonal may need that is large
/// beside the multipliers.
const SHORTER: [f64; 2] = [1.0, 0.05];

/// The most steps of the iteration to Schur's form: many more than any matrix needs.
const SCHUR_STEPS: usize = 10_000;

/// A trap of this size is not grown: its map is linear, or nearly so.
const LARGEST: f64 = 1e100;

/// How often the box of a trap is halved until each part's image is in the trap before. Each time the error of a part's image falls by four, and
/// their number grows by 2ⁿ.
const HALVES: u32 = 14;

/// A trap: the points c + A u with |u_k| ≤ ρ. They all converge to the one fixed point in it: the map is a contraction of a smaller set of this
/// form, in the coordinates u, and leads the larger ones step by step into smaller ones.
#[derive(Debug, Clone)]
pub struct Trap {
    centre: Vec<f64>,
    directions: DMatrix<f64>,
    size: f64,
    contracting: f64,
    contraction: f64,
    inverse: Matrix,
    parameters: Vec<Enclosure>,
    growth: Vec<Growth>,
}

/// A larger size of a trap, and the parts of it, in its coordinates, whose images are in the trap before.
#[derive(Debug, Clone)]
pub(crate) struct Growth {
    pub(crate) size: f64,
    pub(crate) parts: Vec<Vec<Enclosure>>,
}

impl Trap {
    /// The centre c.
    pub fn centre(&self) -> &[f64] {
        &self.centre
    }

    /// The directions A, as columns.
    pub fn directions(&self) -> &DMatrix<f64> {
        &self.directions
    }

    /// The size ρ.
    pub fn size(&self) -> f64 {
        self.size
    }

    /// The size of the contraction.
    pub fn contracting(&self) -> f64 {
        self.contracting
    }

    /// The parameters, for all of whose values it is a trap.
    pub fn parameters(&self) -> &[Enclosure] {
        &self.parameters
    }

    /// How it grew from the size of the contraction.
    pub(crate) fn growth(&self) -> &[Growth] {
        &self.growth
    }

    /// A bound of the norm of its derivatives in the coordinates u: distances to the fixed point fall by this factor there, at least.
    pub fn contraction(&self) -> f64 {
        self.contraction
    }

    /// The largest trap about an attracting fixed point that is found with the directions of its eigenvectors, or where these are nearly
    /// parallel, with those of Schur's form.
    ///
    /// ```
    /// use equations::{Formulas, Names};
    /// use validated_dynamics::{FormulaMap, Trap, fixed_point};
    /// let names = Names::new(&["x"], &[])?;
    /// let cosine = FormulaMap::new(Formulas::from_text(names, &["cos(x)"])?, 1)?;
    /// let trap = Trap::new(&cosine, &fixed_point(&cosine, &[0.7], &[])?, 1000)?;
    /// assert!(trap.size() > 0.5 && trap.contraction() < 1.0);
    /// # Ok::<(), validated_dynamics::Error>(())
    /// ```
    ///
    /// It grows until it has used up this many `images`.
    ///
    /// # Errors
    /// [`Error::Undecided`] with [`Reason::NotInside`] if no trap is found: of a fixed point that does not attract, or hardly; what the map does not
    /// decide.
    pub fn new(
        map: &impl EnclosedMap,
        fixed: &ProvedFixedPoint,
        images: usize,
    ) -> Result<Trap, Error> {
        let count = map.dimension();
        if fixed.point.len() != count || !(1..=MOST_SIDES).contains(&count) {
            let given = fixed.point.len();
            let reason =
                format!("{given} variables, but the map has {count}, of at most {MOST_SIDES}");
            return Error::argument("fixed", reason);
        }
        let own =
            Matrix::from_fn(count, count, |row, column| fixed.image.derivatives.at(row, column));
        let centre = middle(&fixed.point);
        let mut size = centre.iter().fold(1.0, |largest: f64, x| largest.max(x.abs()));
        let all = directions(&own.middle());
        let mut found = None;
        'sizes: for _ in 0..SMALLER_TRIES {
            for directions in &all {
                match Trap::proved(map, &centre, directions, size, &fixed.parameters) {
                    Ok(Some(trap)) => {
                        found = Some(trap);
                        break 'sizes;
                    }
                    Ok(None) => {}
                    Err(Error::Undecided(undecided)) => {
                        if matches!(
                            undecided.reason,
                            Reason::OtherMode { .. } | Reason::Interrupted
                        ) {
                            return Err(Error::Undecided(undecided));
                        }
                    }
                    Err(error) => return Err(error),
                }
            }
            size *= SMALLER;
        }
        let reason = Reason::NotInside { tries: SMALLER_TRIES };
        let found = found.ok_or_else(|| Error::of_variables(reason, &fixed.point))?;
        found.grown(map, images)
    }

    /// The same trap, grown as long as the images of all parts of the larger one are in the one before.
    fn grown(mut self, map: &impl EnclosedMap, mut images: usize) -> Result<Trap, Error> {
        let mut factor = GROWN;
        while factor > LEAST_GROWN && self.size < LARGEST {
            let size = factor * self.size;
            let all = vec![Enclosure::new(-size, size); self.centre.len()];
            let mut parts = Vec::new();
            match self.receives(map, &all, HALVES, (&mut images, &mut parts))? {
                true => {
                    self.size = size;
                    self.growth.push(Growth { size, parts });
                }
                false => factor = factor.sqrt(),
            }
        }
        Ok(self)
    }

    /// True if all points with these coordinates, or their images, are in the trap. The parts whose images are go to the list.
    fn receives(
        &self,
        map: &impl EnclosedMap,
        u: &[Enclosure],
        halves: u32,
        (images, parts): (&mut usize, &mut Vec<Vec<Enclosure>>),
    ) -> Result<bool, Error> {
        if u.iter().all(|u| u.magnitude() <= self.size) {
            return Ok(true);
        }
        if *images == 0 {
            return Ok(false);
        }
        *images -= 1;
        match map.carry(self.start(u).without_derivatives()) {
            Ok(carried)
                if self.contains_set(&carried.set) && map.leads_into(&carried, map).is_ok() =>
            {
                parts.push(u.to_vec());
                return Ok(true);
            }
            Ok(_) | Err(Error::Undecided(_)) if halves > 0 => {}
            Ok(_) | Err(Error::Undecided(_)) => return Ok(false),
            Err(error) => return Err(error),
        }
        for part in 0..1 << u.len() {
            let part = part_of(u, part);
            if !self.receives(map, &part, halves - 1, (&mut *images, &mut *parts))? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// The points with these coordinates, and the parameters, which are further coordinates in the direction of themselves.
    pub(crate) fn start(&self, u: &[Enclosure]) -> StartSet {
        let parameters = &self.parameters;
        let (count, more) = (self.directions.ncols(), parameters.len());
        let all = DMatrix::from_fn(count + more, count + more, |row, column| {
            match row < count && column < count {
                true => self.directions[(row, column)],
                false => f64::from(row == column),
            }
        });
        let at = middle(parameters);
        let u = [u, &offsets(parameters, &at)].concat();
        StartSet::of_parallelepiped(&[&self.centre[..], &at].concat(), &all, &u)
    }

    /// The trap of this centre, these directions and this size, for all values of the parameters; `None` if it is not proved to be one.
    ///
    /// # Errors
    /// What the map does not decide.
    pub fn proved(
        map: &impl EnclosedMap,
        centre: &[f64],
        directions: &DMatrix<f64>,
        size: f64,
        parameters: &[Enclosure],
    ) -> Result<Option<Trap>, Error> {
        let count = map.dimension();
        let are_square = directions.nrows() == count && directions.ncols() == count;
        if !are_square || centre.len() != count || !(size > 0.0 && size.is_finite()) {
            let reason = format!(
                "a centre of {count} numbers, {count}×{count} directions and a positive size are needed"
            );
            return Error::argument("trap", reason);
        }
        let Some(near) = directions.clone().lu().try_inverse() else { return Ok(None) };
        let Some(inverse) = inverse_of(directions, &near) else { return Ok(None) };
        let mut trap = Trap {
            centre: centre.to_vec(),
            directions: directions.clone(),
            size,
            contracting: size,
            contraction: f64::INFINITY,
            inverse,
            parameters: parameters.to_vec(),
            growth: Vec::new(),
        };
        let u = vec![Enclosure::new(-size, size); count];
        let carried = map.carry(trap.start(&u))?;
        map.leads_into(&carried, map)?;
        let Some(chain) = carried.chain else { return Ok(None) };
        let slopes = trap.inverse.times(&chain.matrix());
        let own = Matrix::from_fn(count, count, |row, column| slopes.at(row, column));
        trap.contraction = row_norm(&own);
        let inside = trap.coordinates(&carried.set).iter().all(|u| u.magnitude() < size);
        Ok((trap.contraction < 1.0 && inside).then_some(trap))
    }

    /// The coordinates u of the points of a set.
    pub(crate) fn coordinates(&self, set: &AffineSet) -> Vec<Enclosure> {
        let off = offsets(&exact(set.centre()), &self.centre);
        set.values(&self.inverse.apply(&off), &self.inverse)
    }

    /// True if all points of a box are in the trap.
    pub fn contains(&self, points: &[Enclosure]) -> bool {
        let coordinates = self.inverse.apply(&offsets(points, &self.centre));
        points.len() == self.centre.len() && coordinates.iter().all(|u| u.magnitude() <= self.size)
    }

    /// True unless no point of a box is in the trap, for certain.
    pub(crate) fn meets(&self, points: &[Enclosure]) -> bool {
        let coordinates = self.inverse.apply(&offsets(points, &self.centre));
        coordinates.iter().all(|u| u.low() <= self.size && -self.size <= u.high())
    }

    /// True if all points of a set are in the trap.
    pub fn contains_set(&self, set: &AffineSet) -> bool {
        set.centre().len() == self.centre.len()
            && self.coordinates(set).iter().all(|u| u.magnitude() <= self.size)
    }
}

/// Directions in which a map may contract: the eigenvectors of its derivative, and those of Schur's form, where a matrix with multiple eigenvalues is
/// triangular, with the later ones shorter, so that what is above the diagonal is small.
fn directions(derivative: &DMatrix<f64>) -> Vec<DMatrix<f64>> {
    let eigenvectors = eigenbasis(derivative).map(|(basis, _)| basis);
    let mut found: Vec<DMatrix<f64>> = eigenvectors.into_iter().collect();
    if let Some(schur) = Schur::try_new(derivative.clone(), f64::EPSILON, SCHUR_STEPS) {
        let (vectors, _) = schur.unpack();
        for shorter in SHORTER {
            let mut scaled = vectors.clone();
            let mut length = 1.0;
            for mut column in scaled.column_iter_mut() {
                column *= length;
                length *= shorter;
            }
            found.push(scaled);
        }
    }
    found.retain(|basis| basis.clone().lu().try_inverse().is_some());
    found
}
