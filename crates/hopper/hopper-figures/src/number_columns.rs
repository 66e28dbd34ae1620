//! The pixels of the layers of numbers of one hop, and of phases, some columns at a time.

use crate::error::Error;
use crate::layer_columns::LayerColumns;
use hopper_basin::Fates;
use hopper_proof::ProvedPoints;
use passive_hopper::{Hop, LiftOffMap};
use std::f64::consts::LN_10;

/// The bits of a real number of a layer.
fn bits(number: Option<f64>) -> u64 {
    u64::from((number.unwrap_or(f64::NAN) as f32).to_bits())
}

/// A number of each pixel's next hop.
fn of_hops(of: &LayerColumns, number: impl Fn(&Hop) -> u64) -> Result<Vec<Vec<u64>>, Error> {
    let speeds = of.speeds();
    of.each(|ratio| {
        let map = LiftOffMap::new(ratio);
        speeds.iter().map(|&speed| Ok(number(&map.hop(speed)?))).collect()
    })
}

/// The shares of the energy ½(1 + M)α² that the next hops lose.
pub(crate) fn relative_losses(of: &LayerColumns) -> Result<Vec<Vec<u64>>, Error> {
    of_hops(of, |hop| {
        // α² − α′² = (α − α′)(α + α′), which does not cancel.
        let lost =
            hop.loss.zip(hop.next).map(|(loss, next)| loss / hop.speed * (1.0 + next / hop.speed));
        bits(lost)
    })
}

/// The numbers of sudden lift-offs in the next hops.
pub(crate) fn sudden_lift_offs(of: &LayerColumns) -> Result<Vec<Vec<u64>>, Error> {
    of_hops(of, |hop| hop.sudden as u64)
}

/// The times of flight of the next hops.
pub(crate) fn flight_times(of: &LayerColumns) -> Result<Vec<Vec<u64>>, Error> {
    of_hops(of, |hop| bits(Some(hop.flight_time)))
}

/// |∂α′/∂α|.
pub(crate) fn slopes(of: &LayerColumns) -> Result<Vec<Vec<u64>>, Error> {
    let speeds = of.speeds();
    of.each(|ratio| {
        let map = LiftOffMap::new(ratio);
        let slope = |&speed: &f64| Ok(bits(map.slopes(speed)?.map(|slopes| slopes.by_speed.abs())));
        speeds.iter().map(slope).collect()
    })
}

/// The digits that enclosed orbits have where their fates are proved.
pub(crate) fn digits(of: &LayerColumns) -> Result<Vec<Vec<u64>>, Error> {
    let speeds = of.speeds();
    of.each(|ratio| {
        let mut points = ProvedPoints::new(ratio.value())?;
        let digits = |&speed: &f64| {
            let fate = points.fate(speed)?;
            // The enclosure of a double has 16 digits at most.
            let digits = -pxfm::f_log(fate.spread.max(0.5 * f64::EPSILON)) / LN_10;
            Ok(bits((!fate.label.is_undecided()).then_some(digits.clamp(0.0, 16.0))))
        };
        speeds.iter().map(digits).collect()
    })
}

/// The fractions of the phase with which the orbits come to their fixed points.
pub(crate) fn phases(of: &LayerColumns) -> Result<Vec<Vec<u64>>, Error> {
    let speeds = of.speeds();
    of.each(|ratio| Ok(Fates::new(ratio)?.phases(&speeds)?.into_iter().map(bits).collect()))
}
