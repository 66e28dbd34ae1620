//! Other systems in the page: their equations, their attractors, and the basins of a window.
//!
//! The crates for any system answer: an entry of [`SYSTEMS`] is all that a further one needs.

use crate::json::{Json, objects};
use crate::refusal::Refusal;
use basin_of_attraction::{
    Attractors, Grid, Hyperrectangle, Interval, Label, RecurrenceLimits, StateGrid,
};
use equations::{Formulas, Names};
use return_map::FlowSteps;
use std::f64::consts::PI;
use std::ops::Range;

/// Steps of the time after which a colour has faded by a half: how long a start takes is seen, and late ones stay visible.
const FADES: f64 = 60.0;

/// How exact a flow is followed: pixels beside a boundary change with it, and nothing else.
const TOLERANCE: f64 = 1e-5;

/// Random orbits that must come back to an attractor: it is a trap as far as these show.
const TESTS: usize = 20;

/// Most pixels of a picture each way.
const MOST_PIXELS: usize = 2048;

/// A system whose basins are shown.
#[derive(Debug)]
pub struct System {
    /// Its name.
    pub name: &'static str,
    /// What it is, in a sentence or two.
    pub about: &'static str,
    states: &'static [&'static str],
    field: &'static [&'static str],
    /// The time of a step of the search.
    step: f64,
    /// The region of each state; the picture has the first two, and the others are 0.
    region: &'static [(f64, f64)],
    /// Cells along each state.
    cells: &'static [usize],
    /// Points of an attractor that the search locates: 50 for one that moves, some for a state of rest.
    locate: usize,
    /// Whether the first state is an angle.
    turns: bool,
    /// Starts of the search, one near each attractor, with the meaning of its basin, and its colour.
    fates: &'static [(&'static [f64], &'static str, [u8; 3])],
    axes: [&'static str; 2],
}

/// All systems.
pub static SYSTEMS: &[System] = &[
    System {
        name: "driven pendulum",
        about: "A pendulum with friction and a constant torque, φ″ = ½ − φ′/10 − sin φ: let go at an angle with a rate, it comes to rest or turns for ever.",
        states: &["x", "v"],
        field: &["v", "0.5 - 0.1*v - sin(x)"],
        step: 0.5,
        region: &[(-PI, PI), (-10.0, 10.0)],
        cells: &[200, 200],
        locate: 50,
        turns: true,
        fates: &[
            (&[PI / 6.0, 0.0], "comes to rest", [0xc8, 0xc8, 0xc0]),
            (&[0.0, 5.0], "turns for ever", [0x1f, 0x4e, 0x96]),
        ],
        axes: ["angle φ", "rate φ′"],
    },
    System {
        name: "magnetic pendulum",
        about: "A pendulum over three magnets, with friction: where it comes to rest, for each place at which it is let go.",
        states: &["x", "y", "u", "v"],
        field: &[
            "u",
            "v",
            "-0.5*x - 0.2*u + (1 - x)/((1 - x)^2 + y^2 + 0.09)^1.5 + (-0.5 - x)/((-0.5 - x)^2 + (sqrt(3)/2 - y)^2 + 0.09)^1.5 + (-0.5 - x)/((-0.5 - x)^2 + (-sqrt(3)/2 - y)^2 + 0.09)^1.5",
            "-0.5*y - 0.2*v - y/((1 - x)^2 + y^2 + 0.09)^1.5 + (sqrt(3)/2 - y)/((-0.5 - x)^2 + (sqrt(3)/2 - y)^2 + 0.09)^1.5 + (-sqrt(3)/2 - y)/((-0.5 - x)^2 + (-sqrt(3)/2 - y)^2 + 0.09)^1.5",
        ],
        step: 1.0,
        region: &[(-2.0, 2.0), (-2.0, 2.0), (-3.0, 3.0), (-3.0, 3.0)],
        cells: &[30, 30, 30, 30],
        locate: 10,
        turns: false,
        fates: &[
            (&[1.0, 0.0, 0.0, 0.0], "to the magnet on the right", [0x22, 0xa6, 0x72]),
            (&[-0.5, 0.866, 0.0, 0.0], "to the upper one", [0xd0, 0x3a, 0x2b]),
            (&[-0.5, -0.866, 0.0, 0.0], "to the lower one", [0x1f, 0x4e, 0x96]),
        ],
        axes: ["x", "y"],
    },
];

/// What a pixel without an attractor has.
const UNDECIDED: [u8; 3] = [0xff, 0xd7, 0x00];

/// Names, sentences, windows and legends of all systems, as JSON.
pub fn systems() -> String {
    systems_json().finish()
}

pub(crate) fn systems_json() -> Json {
    let color = |[red, green, blue]: [u8; 3]| format!("#{red:02x}{green:02x}{blue:02x}");
    let fate = |name: &str, own| Json::object().text("name", name).text("color", &color(own));
    let one = |system: &System| {
        let window = system.region[..2].iter().flat_map(|side| [side.0, side.1]);
        let fates = system.fates.iter().map(|(_, name, own)| fate(name, *own));
        let fates = fates.chain([fate("undecided", UNDECIDED)]);
        Json::object()
            .text("name", system.name)
            .text("about", system.about)
            .text("x", system.axes[0])
            .text("y", system.axes[1])
            .json("window", crate::json::numbers(window))
            .json("fates", objects(fates))
    };
    Json::object().json("systems", objects(SYSTEMS.iter().map(one)))
}

/// A system whose attractors are found.
#[derive(Debug)]
pub struct OpenSystem {
    system: &'static System,
    number: usize,
    flow: FlowSteps,
    attractors: Attractors,
    /// For each attractor, by its label, the place of its fate.
    fates: Vec<(Label, usize)>,
}

impl OpenSystem {
    /// Finds the attractors of the system with this number.
    ///
    /// # Errors
    /// A refusal for a number that there is not; those of the search.
    pub fn new(number: usize) -> Result<OpenSystem, Refusal> {
        let last = SYSTEMS.len() - 1;
        let missing =
            || Refusal::new(format!("there is no system {number}; there are 0 to {last}"));
        let system = SYSTEMS.get(number).ok_or_else(missing)?;
        let said = |error: &dyn std::fmt::Display| Refusal::new(error.to_string());
        let names = Names::new(system.states, &[]).map_err(|error| said(&error))?;
        let field = Formulas::from_text(names, system.field).map_err(|error| said(&error))?;
        let flow = FlowSteps::new(&field, (0.0, system.step), TOLERANCE);
        let flow = flow.map_err(|error| said(&error))?;
        let side = |&(from, to): &(f64, f64)| Interval::new(from, to);
        let sides = system.region.iter().map(side).collect::<Result<Vec<_>, _>>()?;
        let mut grid = StateGrid::new(Hyperrectangle::new(sides)?, system.cells)?;
        if system.turns {
            grid = grid.periodic(0)?;
        }
        let limits =
            RecurrenceLimits { locate: system.locate, tests: TESTS, ..RecurrenceLimits::default() };
        let starts: Vec<Vec<f64>> = system.fates.iter().map(|(start, ..)| start.to_vec()).collect();
        let attractors = Attractors::search(&flow, grid, &starts, limits)?;
        let mut fates = Vec::new();
        for (place, start) in starts.iter().enumerate() {
            let ends =
                attractors.convergences(&flow, 1, |_, state| state.copy_from_slice(start))?;
            fates.extend(ends.first().map(|(label, _)| (*label, place)));
        }
        Ok(OpenSystem { system, number, flow, attractors, fates })
    }

    /// The number of the system.
    pub fn number(&self) -> usize {
        self.number
    }

    /// Columns of a picture of a window, as red, green, blue and opacity, the highest row first. A colour fades with the time to the attractor.
    ///
    /// # Errors
    /// A refusal for a picture of more than 2048 pixels each way, and for a window that is inverted.
    pub fn strip(
        &self,
        (x, y): ((f64, f64), (f64, f64)),
        (columns, rows): (usize, usize),
        part: Range<usize>,
    ) -> Result<Vec<u8>, Refusal> {
        let good = |pixels: usize| (1..=MOST_PIXELS).contains(&pixels);
        if !(good(columns) && good(rows)) || part.start > part.end || part.end > columns {
            let text = format!(
                "a picture has 1 to {MOST_PIXELS} pixels each way, not {columns} × {rows}, and columns {part:?} are to be some of them"
            );
            return Err(Refusal::new(text));
        }
        let (x, y) = (Interval::new(x.0, x.1)?, Interval::new(y.0, y.1)?);
        let grid = Grid { x, y, columns, rows };
        let width = part.len();
        let found = self.attractors.convergences(&self.flow, width * rows, |at, state| {
            state.fill(0.0);
            state[0] = grid.x_at(part.start + at % width.max(1));
            state[1] = grid.y_at(rows - 1 - at / width.max(1));
        })?;
        Ok(found.into_iter().flat_map(|(label, steps)| self.pixel(label, steps)).collect())
    }

    fn pixel(&self, label: Label, steps: usize) -> [u8; 4] {
        let place = self.fates.iter().find(|(own, _)| *own == label).map(|(_, place)| *place);
        let [red, green, blue] = place.map_or(UNDECIDED, |place| self.system.fates[place].2);
        let strength =
            if place.is_some() { 0.4 + 0.6 * FADES / (FADES + steps as f64) } else { 1.0 };
        let faded = |byte: u8| (255.0 - strength * (255.0 - f64::from(byte))).round() as u8;
        [faded(red), faded(green), faded(blue), u8::MAX]
    }
}
