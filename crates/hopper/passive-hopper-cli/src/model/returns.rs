//! What `branch` and `diagram` ask: the returns to a surface along a parameter.

use crate::error::Error;
use crate::model::file::{Model, texts};
use crate::model::period::check_period;
use crate::model::question::{ModelOptions, check_surface, failed, mode_at};
use hybrid_system::EquationsModel;
use journal_figures::{Frame, Svg, ticks};
use nalgebra::DVector;
use return_map::EquationReturns;

/// A return map along a parameter.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct ReturnsOptions {
    #[command(flatten)]
    model: ModelOptions,
    /// The parameter that changes
    #[arg(long)]
    pub(crate) parameter: String,
    /// From this value of the parameter
    #[arg(long, value_parser = crate::options::values::finite, allow_negative_numbers = true)]
    pub(crate) from: f64,
    /// To this value
    #[arg(long, value_parser = crate::options::values::finite, allow_negative_numbers = true)]
    pub(crate) to: f64,
    /// The surface to which the orbit returns
    #[arg(long)]
    surface: String,
    /// The mode behind the surface [default: that of the file, or the first one whose `where` the start fulfils]
    #[arg(long)]
    mode: Option<String>,
}

/// The longest return that is tried, as in the library.
const LONGEST: f64 = 1e3;

/// How far a state that is not named may be from its start behind the surface: a section has it to rounding.
const NAMED: f64 = 1e-6;

impl ReturnsOptions {
    pub(crate) fn model(&self) -> Result<Model, Error> {
        let model = self.model.model()?;
        check_surface(&model, &self.surface)?;
        Ok(model)
    }

    /// The ends of the window, the lower one first.
    ///
    /// # Errors
    /// [`Error::Misuse`] for a window without a length.
    pub(crate) fn window(&self) -> Result<(f64, f64), Error> {
        let (from, to) = (self.from.min(self.to), self.from.max(self.to));
        match from < to {
            true => Ok((from, to)),
            false => Err(Error::Misuse(format!(
                "--from {from} --to {to}: the window must have a length"
            ))),
        }
    }

    /// The map of a section with these coordinates, which begins in the mode of a point of it.
    ///
    /// # Errors
    /// [`Error::Misuse`] for names that the model does not have, and for a return that does not come back to all states of its start,
    /// or at no period of the model: an orbit would be periodic in the named coordinates alone then.
    pub(crate) fn map(
        &self,
        model: &Model,
        names: &[String],
        (start, parameter): (&[f64], f64),
    ) -> Result<EquationReturns, Error> {
        let states = &model.equations.names().states;
        let value = |state| names.iter().position(|name| name == state).map_or(0.0, |at| start[at]);
        let whole: Vec<f64> = states.iter().map(value).collect();
        let mode = mode_at(self.mode.as_deref(), model, &whole)?;
        let ends = (mode.as_str(), self.surface.as_str());
        let map = EquationReturns::new(&model.equations, &self.parameter, ends, &texts(names));
        let map = map.map_err(|error| Error::Misuse(error.to_string()))?;
        let value = parameter.to_string();
        let mut model = model.clone();
        model.equations = model.equations.with_parameters(&[(&self.parameter, &value)]);
        self.check_closing(&model, &mode, (names, whole))?;
        Ok(map)
    }

    fn check_closing(
        &self,
        model: &Model,
        mode: &str,
        (names, start): (&[String], Vec<f64>),
    ) -> Result<(), Error> {
        let surface = self.surface.as_str();
        let is_guard = !model.clocks.iter().any(|clock| clock == surface);
        if is_guard && !model.equations.is_autonomous() {
            let text = "--surface: the equations use the time, and each return begins at t = 0; give a surface with a period, or make \
                        the phase a state";
            return Err(Error::Misuse(text.to_owned()));
        }
        let own: EquationsModel<DVector<f64>> = model.equations.model().map_err(failed)?;
        let run = own.start_at(mode, start.clone(), (0.0, LONGEST)).map_err(failed)?;
        for arc in run {
            let arc = arc.map_err(failed)?;
            let Some(event) = arc.event().filter(|event| event.surface == *surface) else {
                continue;
            };
            let Some((_, after)) = &event.after else { return Ok(()) };
            let states = &model.equations.names().states;
            for (state, (from, to)) in states.iter().zip(start.iter().zip(after.iter())) {
                let apart = (from - to).abs() > NAMED * (1.0 + from.abs());
                if !names.contains(state) && apart {
                    let text = format!(
                        "--near: {state} is {from} at the start and {to} behind {surface}; name it in --near"
                    );
                    return Err(Error::Misuse(text));
                }
            }
            return check_period(model, event.time, &start, Some(surface), "--surface");
        }
        Ok(())
    }
}

/// Pixels of the frame up.
pub(crate) const HEIGHT: usize = 330;

/// A figure of a coordinate over the parameter: a frame that holds these heights, and what is drawn there.
pub(crate) fn over_parameter(
    (window, heights): ((f64, f64), impl IntoIterator<Item = f64>),
    (parameter, coordinate): (&str, &str),
    draw: impl FnOnce(&Frame, &mut Svg) -> Result<(), journal_figures::Error>,
) -> Result<Svg, Error> {
    let ends = |(low, high): (f64, f64), x: f64| (low.min(x), high.max(x));
    let (low, high) = heights.into_iter().fold((f64::INFINITY, f64::NEG_INFINITY), ends);
    // Without a point there is an empty frame.
    let (low, high) = if low <= high { (low, high) } else { (0.0, 1.0) };
    let room = 0.05 * (high - low).max(1e-9 * high.abs().max(1e-9));
    let mut svg = Svg::new(620.0, 400.0);
    let frame = Frame::linear(72.0, 14.0, 530.0, HEIGHT as f64, window, (low - room, high + room));
    draw(&frame, &mut svg)?;
    let (x, y) = (ticks(frame.x, 6), ticks(frame.y, 6));
    frame.axes(&mut svg, &x, &y, parameter, coordinate);
    Ok(svg)
}
