//! Maps that are enclosed with their derivatives.

use crate::certificate::Record;
use crate::event::ProvedEvent;
use crate::matrix::{Matrix, exact, sums};
use crate::set::{AffineSet, Chain};
use crate::undecided::Error;
use interval_arithmetic::Enclosure;
use nalgebra::DMatrix;
use serde_json::Value;

/// A differentiable map of some variables, which may depend on parameters that are intervals.
pub trait EnclosedMap {
    /// The number of variables.
    fn dimension(&self) -> usize;

    /// The images of all points of a set: of the variables, and then of the parameters; with derivatives if they are wanted.
    ///
    /// # Errors
    /// [`Error::Undecided`] where nothing is proved. [`Reason::Stopped`](crate::Reason::Stopped) says that an event that ends the execution comes first, for all
    /// points.
    fn carry(&self, start: StartSet) -> Result<Carried, Error>;

    /// What a certificate says of the map, if one can: the system, if it has one, and the map.
    #[doc(hidden)]
    fn as_json(&self) -> Option<(Option<Value>, Value)> {
        None
    }

    /// The steps of points whose execution ends, of a map that is recorded.
    #[doc(hidden)]
    fn end_of(&self, _start: StartSet) -> Result<Option<Record>, Error> {
        Ok(None)
    }

    /// An error unless the images, with these events, are where another map begins: the map itself, if it is iterated.
    ///
    /// # Errors
    /// [`Reason::OtherMode`](crate::Reason::OtherMode), of maps that have modes.
    fn leads_into(&self, _carried: &Carried, _next: &Self) -> Result<(), Error>
    where
        Self: Sized,
    {
        Ok(())
    }

    /// The images of all points of a box, with derivatives.
    ///
    /// # Errors
    /// As [`carry`](Self::carry).
    fn image(&self, domain: &[Enclosure]) -> Result<MapImage, Error> {
        let carried = self.carry(StartSet::of_box(domain))?;
        let derivatives = carried.chain.map(|chain| chain.matrix());
        Ok(MapImage {
            values: carried.set.hull()[..self.dimension()].to_vec(),
            derivatives: derivatives.unwrap_or_else(|| {
                Matrix::from_fn(self.dimension(), domain.len(), |_, _| Enclosure::WHOLE)
            }),
            events: carried.events,
        })
    }
}

/// Where a map begins: a set of its variables and parameters, and the derivatives that are wanted.
#[derive(Debug, Clone)]
pub struct StartSet {
    pub(crate) set: AffineSet,
    pub(crate) chain: Option<Chain>,
}

impl StartSet {
    /// A box, with derivatives with respect to its variables.
    pub fn of_box(domain: &[Enclosure]) -> StartSet {
        let set = AffineSet::of_box(domain);
        StartSet { set, chain: Some(Chain::identity(domain.len())) }
    }

    /// The points c + A u for all u of a box, with derivatives with respect to u.
    pub fn of_parallelepiped(
        centre: &[f64],
        directions: &DMatrix<f64>,
        u: &[Enclosure],
    ) -> StartSet {
        let directions = Matrix::of_numbers(directions);
        let set = AffineSet::of_box(u);
        // The set has its centre in the middle of the box, not at u = 0.
        let at_centre = sums(&exact(centre), &directions.apply(&set.centre_box()));
        let set = set.image(&at_centre, &directions, None);
        StartSet { set, chain: Some(Chain::identity(u.len()).then(&directions)) }
    }

    /// A set, with derivatives with respect to its points.
    pub fn of_set(set: &AffineSet) -> StartSet {
        StartSet { set: set.clone(), chain: Some(Chain::identity(set.centre().len())) }
    }

    /// The same without derivatives, in less time.
    #[must_use]
    pub fn without_derivatives(mut self) -> Self {
        self.chain = None;
        self
    }
}

/// Where a map leads.
#[derive(Debug, Clone)]
pub struct Carried {
    /// The images.
    pub set: AffineSet,
    /// The events until the images, one after the other.
    pub events: Vec<ProvedEvent>,
    /// The derivatives, if they are wanted.
    pub(crate) chain: Option<Chain>,
    /// The steps, of a map that is recorded.
    pub(crate) record: Option<Record>,
}

/// The images of a box under a map.
#[derive(Debug, Clone)]
pub struct MapImage {
    /// A box that holds them.
    pub values: Vec<Enclosure>,
    /// The derivatives at all points of the box, with respect to variables and parameters.
    pub derivatives: Matrix,
    /// The events until the images, one after the other.
    pub events: Vec<ProvedEvent>,
}

/// The record of a map that is recorded, and the set at its start: the written one then.
pub(crate) fn written(is_recorded: bool, set: AffineSet) -> (Option<Record>, AffineSet) {
    match is_recorded {
        true => {
            let (record, set) = Record::from(&set);
            (Some(record), set)
        }
        false => (None, set),
    }
}
