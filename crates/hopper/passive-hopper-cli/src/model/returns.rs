//! What `branch` and `diagram` ask: the returns to a surface along a parameter.

use crate::error::Error;
use crate::model::file::{Model, texts};
use crate::model::period::check_period;
use crate::model::places::Places;
use crate::model::question::{ModelOptions, check_surface, mode_at, place_of};
use journal_figures::{Frame, Svg, ticks};
use return_map::{EquationReturns, ReturnEnds};

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

/// How far a state that is not named may be from its start behind the surface: a section has it to rounding.
const NAMED: f64 = 1e-6;

/// What a return must fulfil so that the map is what the flow does.
#[derive(Debug, Clone)]
pub(crate) struct Checks {
    model: Model,
    parameter: String,
    surface: String,
    mode: String,
    /// The coordinates.
    names: Vec<String>,
}

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

    /// The map of a section with these coordinates, which begins in the mode of these points of it, each at the parameters; and what its returns must fulfil.
    ///
    /// # Errors
    /// [`Error::Misuse`] for names that the model does not have, for starts in several modes, and for a forced model whose surface is no clock.
    pub(crate) fn returns(
        &self,
        model: &Model,
        names: &[String],
        (starts, parameters): (&[Vec<f64>], &[f64]),
    ) -> Result<(EquationReturns, Checks), Error> {
        for name in names {
            place_of(&model.equations.names().states, name, "--near")?;
        }
        let is_guard = !model.clocks.contains(&self.surface);
        if is_guard && !model.equations.is_autonomous() {
            let text = "--surface: the equations use the time, and each return begins at t = 0; give a surface with a period, or make \
                        the phase a state";
            return Err(Error::Misuse(text.to_owned()));
        }
        let mut mode: Option<String> = None;
        for &parameter in parameters {
            let model = with_parameter(model, &self.parameter, parameter);
            for start in starts {
                let own = mode_at(self.mode.as_deref(), &model, &whole(&model, names, start))?;
                if let Some(other) = mode.as_ref().filter(|mode| **mode != own) {
                    let text = format!(
                        "--near: by `where` the starts are in the modes {other} and {own}; give --mode, or one call for each mode"
                    );
                    return Err(Error::Misuse(text));
                }
                mode = Some(own);
            }
            // Only a formula `where` can give another mode at another parameter.
            if !Places::new(&model)?.are_given() {
                break;
            }
        }
        let mode = mode.unwrap_or_default();
        let ends = (mode.as_str(), self.surface.as_str());
        let map = EquationReturns::new(&model.equations, &self.parameter, ends, &texts(names));
        let map = map.map_err(|error| Error::Misuse(error.to_string()))?;
        let checks = Checks {
            model: model.clone(),
            parameter: self.parameter.clone(),
            surface: self.surface.clone(),
            mode,
            names: names.to_vec(),
        };
        Ok((map, checks))
    }
}

/// The model at another value of a parameter.
fn with_parameter(model: &Model, parameter: &str, value: f64) -> Model {
    let mut model = model.clone();
    let value = value.to_string();
    model.equations = model.equations.with_parameters(&[(parameter, &value)]);
    model
}

/// The whole state at a point of the section: what is not named is 0.
fn whole(model: &Model, names: &[String], point: &[f64]) -> Vec<f64> {
    let place = |state| names.iter().position(|name| name == state);
    let states = model.equations.names().states.iter();
    states.map(|state| place(state).map_or(0.0, |at| point[at])).collect()
}

impl Checks {
    /// Refuses returns, one after the other, that do not come back to the mode and to all states of their start, or that take no period of the model: what is
    /// periodic in the named coordinates would be no orbit. A point without a return is not refused here.
    ///
    /// # Errors
    /// [`Error::Misuse`] with what does not come back, and where.
    pub(crate) fn check(
        &self,
        map: &EquationReturns,
        (point, parameter): (&[f64], f64),
        returns: usize,
    ) -> Result<(), Error> {
        let model = with_parameter(&self.model, &self.parameter, parameter);
        let mut point = point.to_vec();
        for _ in 0..returns {
            let Ok(ends) = map.return_ends(&point, parameter) else { return Ok(()) };
            self.check_end(parameter, &ends)?;
            check_period(&model, ends.time, &ends.start, Some(&self.surface), "--surface")?;
            point = ends.image;
        }
        Ok(())
    }

    fn check_end(&self, parameter: f64, ends: &ReturnEnds) -> Result<(), Error> {
        let Checks { surface, names, .. } = self;
        let at = format!("at {} = {parameter}", self.parameter);
        let ReturnEnds { start, mode, state: after, .. } = ends;
        if *mode != self.mode {
            let own = &self.mode;
            let text = format!(
                "--surface: {at} a return ends in the mode {mode}, and the next one is to begin in {own}; give a surface that leads back to \
                 {own}"
            );
            return Err(Error::Misuse(text));
        }
        let states = &self.model.equations.names().states;
        for (state, (from, to)) in states.iter().zip(start.iter().zip(after)) {
            let apart = (from - to).abs() > NAMED * (1.0 + from.abs());
            if !names.contains(state) && apart {
                let text = format!(
                    "--near: {state} is {from} where a return begins and {to} behind {surface}, {at}; name it in --near"
                );
                return Err(Error::Misuse(text));
            }
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
