//! How a checkpoint is written (feature `serde`).

use crate::arrival::Arrival;
use crate::checkpoint::Checkpoint;
use crate::point::Point;
use crate::state::StateVector;
use serde::ser::{Error, Serialize, SerializeStruct, Serializer};

impl<M, S, X> Serialize for Checkpoint<M, S, X>
where
    M: Serialize,
    S: Serialize + Copy + PartialEq,
    X: Serialize + StateVector,
{
    fn serialize<W: Serializer>(&self, writer: W) -> Result<W::Ok, W::Error> {
        // JSON would write these numbers as null, and the reader would refuse the file.
        let Point { state, time, history, arrival, .. } = &self.point;
        let states = state.is_finite()
            && history.is_finite()
            && arrival.as_ref().is_none_or(Arrival::is_finite);
        if !states || !time.value().is_finite() {
            let (time, state) = (self.point.time.value(), self.point.state.components());
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
