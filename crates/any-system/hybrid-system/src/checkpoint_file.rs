//! How a checkpoint is written and read (feature `serde`).

use crate::arrival::Arrival;
use crate::checkpoint::Checkpoint;
use crate::limits::Stop;
use crate::point::Point;
use crate::state::StateVector;
use serde::de::{Deserialize, Deserializer, Error as _};
use serde::ser::{Error as _, Serialize, SerializeStruct, Serializer};

impl<M, S, X: StateVector> Point<M, S, X>
where
    S: Copy + PartialEq,
{
    /// All its states.
    fn states(&self) -> impl Iterator<Item = &X> {
        let earlier = self.history.states();
        let arrival = self.arrival.iter().flat_map(Arrival::states);
        [&self.state].into_iter().chain(earlier).chain(arrival)
    }
}

impl<M, S, X> Serialize for Checkpoint<M, S, X>
where
    M: Serialize,
    S: Serialize + Copy + PartialEq,
    X: Serialize + StateVector,
{
    fn serialize<W: Serializer>(&self, writer: W) -> Result<W::Ok, W::Error> {
        // JSON would write these numbers as null, and the reader would refuse the file.
        let (time, state) = (self.point.time.value(), self.point.state.components());
        if !time.is_finite() || !self.point.states().all(StateVector::is_finite) {
            return Err(W::Error::custom(format!(
                "a checkpoint must be finite to be written: time {time}, state {state:?}"
            )));
        }
        let mut fields = writer.serialize_struct("Checkpoint", 2)?;
        fields.serialize_field("point", &self.point)?;
        fields.serialize_field("stop", &self.stop)?;
        fields.end()
    }
}

/// What stands in a file.
#[derive(serde::Deserialize)]
#[serde(rename = "Checkpoint")]
struct Read<M, S, X> {
    point: Point<M, S, X>,
    stop: Option<Stop>,
}

impl<'de, M, S, X> Deserialize<'de> for Checkpoint<M, S, X>
where
    M: Deserialize<'de>,
    S: Deserialize<'de> + Copy + PartialEq,
    X: Deserialize<'de> + StateVector,
{
    fn deserialize<R: Deserializer<'de>>(reader: R) -> Result<Self, R::Error> {
        let Read { point, stop } = Read::<M, S, X>::deserialize(reader)?;
        let dimension = point.state.dimension();
        let other = point.states().map(X::dimension).find(|other| *other != dimension);
        match other {
            None => Ok(Checkpoint { point, stop }),
            Some(other) => Err(R::Error::custom(format!(
                "a checkpoint with states of {dimension} and of {other} components is damaged"
            ))),
        }
    }
}
