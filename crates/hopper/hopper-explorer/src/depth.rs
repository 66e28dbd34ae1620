//! Windows of any size about a boundary point: the zoom goes on where doubles end.

use crate::json::Json;
use crate::labels;
use crate::refusal::Refusal;
use crate::tile::opaque;
use basin_of_attraction::{Grid, Interval, Label};
use hopper_basin::{
    CircleLimits, EdgeChart, Fates, FollowedEdge, GroundingEdge, HopperFate, PhaseBasins,
    edge_frame, edge_label, edge_phase, edge_phases, frame_slant,
};
use hopper_figures::{BesideEdges, Layer, LayerColumns, Values, fate_colors, share_pixels};
use passive_hopper::MassRatio;

/// An open boundary point.
#[derive(Debug)]
pub enum Depth {
    /// One that comes to a fixed point exactly.
    OfFixedPoint(Box<PointDepth>),
    /// One from which a hop just uses up the energy.
    OfGrounding(GroundingEdge),
}

/// A boundary point that comes to a fixed point: its chart, its slope over M, and the circle of fates of the fixed point.
#[derive(Debug)]
pub struct PointDepth {
    fates: Fates,
    chart: EdgeChart,
    edge: FollowedEdge,
    circle: PhaseBasins,
}

/// Most pixels of a frame each way.
const MOST_PIXELS: usize = 2048;

impl Depth {
    /// The boundary point nearest to a speed: one that comes to a fixed point, or an edge of grounding.
    ///
    /// # Errors
    /// The refusals of [`EdgeChart::nearest`], [`FollowedEdge::new`] and [`PhaseBasins::new`].
    pub fn near(mass_ratio: f64, alpha: f64) -> Result<Self, Refusal> {
        let fates = Fates::new(MassRatio::new(mass_ratio)?)?;
        let chart = EdgeChart::nearest(&fates, alpha);
        let far = |point: f64| (point - alpha).abs();
        let nearest = chart.as_ref().map_or(f64::INFINITY, |chart| far(chart.point().0));
        match GroundingEdge::nearest(&fates, alpha) {
            Ok(edge) if far(edge.point) < nearest => return Ok(Depth::OfGrounding(edge)),
            _ => {}
        }
        let chart = chart?;
        let edge = FollowedEdge::new(&chart)?;
        let circle = PhaseBasins::new(&fates, chart.n(), CircleLimits::default())?;
        Ok(Depth::OfFixedPoint(Box::new(PointDepth { fates, chart, edge, circle })))
    }

    /// Whether this is the chart about exactly this speed.
    #[cfg(feature = "deep")]
    pub(crate) fn is_at(&self, mass_ratio: f64, alpha: f64) -> bool {
        let (own, point) = match self {
            Depth::OfFixedPoint(of) => (of.chart.mass_ratio(), of.chart.point().0),
            Depth::OfGrounding(edge) => (edge.mass_ratio, edge.point),
        };
        own.value() == mass_ratio && point == alpha
    }

    /// The boundary point, as JSON.
    pub(crate) fn json(&self) -> Json {
        match self {
            Depth::OfFixedPoint(of) => of.json(),
            Depth::OfGrounding(edge) => Json::object()
                .text("kind", "grounding")
                .number("massRatio", edge.mass_ratio.value())
                .number("alpha", edge.point)
                .integer("hops", edge.hops as u64)
                .text("side", if edge.hops_above { "above" } else { "below" })
                .number("growth", edge.growth)
                .number("byMassRatio", edge.by_mass_ratio)
                .number("slant", edge.slant()),
        }
    }

    /// The boundary point as text, for tests.
    pub fn text(&self) -> String {
        self.json().finish()
    }

    /// What changes with the depth, as JSON. At a preimage of a fixed point: the place on the circle with which the window of half height 10^−`depth` ends,
    /// and the turns until there, as the fraction of Ψ with its error, and the whole number as three digits with a power of ten. At an edge of grounding: the
    /// speed after the last hop at the window's end, which is all that changes.
    ///
    /// # Errors
    /// The refusals of [`edge_phase`].
    pub fn phase(&self, depth: f64) -> Result<String, Refusal> {
        Ok(self.phase_json(depth)?.finish())
    }

    pub(crate) fn phase_json(&self, depth: f64) -> Result<Json, Refusal> {
        let of = match self {
            Depth::OfFixedPoint(of) => of,
            Depth::OfGrounding(edge) => {
                return Ok(
                    Json::object().number("lastSpeedExponent", edge.last_speed_exponent(depth))
                );
            }
        };
        let phase = edge_phase(&of.chart, &of.circle, depth)?;
        let digits = phase.whole().to_string();
        let first: String = digits.chars().take(3).collect();
        Ok(Json::object()
            .number("fraction", phase.fraction())
            .number("error", phase.error())
            .text("turns", &first)
            .integer("more", (digits.len() - first.len()) as u64))
    }

    /// The fate at a point of such a window, `x` half widths to the right of its middle and `y` half heights above it, and the number of the layer, if it
    /// has one on each side, as JSON.
    ///
    /// # Errors
    /// The refusals of [`edge_label`].
    pub fn label(&self, layer: &Layer, depth: f64, (x, y): (f64, f64)) -> Result<String, Refusal> {
        Ok(self.label_json(layer, depth, (x, y))?.finish())
    }

    pub(crate) fn label_json(
        &self,
        layer: &Layer,
        depth: f64,
        (x, y): (f64, f64),
    ) -> Result<Json, Refusal> {
        let label = match self {
            Depth::OfFixedPoint(of) => {
                edge_label((&of.chart, &of.edge), &of.circle, depth, (x, y))?
            }
            Depth::OfGrounding(edge) => Some(side_of(edge, (x, y))),
        };
        let own = labels::label(label.unwrap_or(HopperFate::UNDECIDED));
        Ok(match self.number(layer, (x, y))? {
            Some(number) => own.number("number", number),
            None => own,
        })
    }

    /// The pixels of the window of half height 10^−`depth` about the point, the highest row first: of a layer, or of the fates if the layer has
    /// [nothing](BesideEdges::Nothing) there.
    ///
    /// # Errors
    /// The refusals of [`edge_frame`] and [`edge_phases`], and of frames with more than 2048 pixels each way.
    pub fn frame(
        &self,
        layer: &Layer,
        depth: f64,
        (columns, rows): (usize, usize),
    ) -> Result<Vec<u8>, Refusal> {
        if columns > MOST_PIXELS || rows > MOST_PIXELS {
            let text =
                format!("a frame has up to {MOST_PIXELS} pixels each way, not {columns} × {rows}");
            return Err(Refusal::new(text));
        }
        if !(depth >= 0.0 && depth.is_finite()) {
            return Err(Refusal::new(format!("a depth is a finite number from 0 on, not {depth}")));
        }
        let values = layer.values();
        match (self, layer.beside_edges, values) {
            (_, BesideEdges::Sides, Some(values)) if depth < SAMPLED => {
                self.sampled(values, depth, (columns, rows))
            }
            (Depth::OfFixedPoint(of), BesideEdges::Phases, Some(values)) => {
                of.phases(values, depth, (columns, rows))
            }
            (_, BesideEdges::Sides, Some(values)) => {
                let colors = self.numbers_beside(values)?.map(|number| values.color(number));
                Ok(opaque(&two_sides(self.slope(), colors, (columns, rows))))
            }
            (Depth::OfFixedPoint(of), ..) => {
                let about = (&of.chart, &of.edge);
                let raster = edge_frame(&of.fates, about, &of.circle, depth, (columns, rows))?;
                Ok(opaque(&share_pixels(&raster)))
            }
            (Depth::OfGrounding(edge), ..) => {
                let fates = [side_of(edge, (0.0, -1.0)), side_of(edge, (0.0, 1.0))];
                let colors = match (layer.beside_edges, values) {
                    // Of neither side an orbit comes to a fixed point of which phases are shown.
                    (BesideEdges::Phases, Some(values)) => [values.color(NO_NUMBER); 2],
                    _ => fates.map(fate_colors::rgb),
                };
                Ok(opaque(&two_sides(self.slope(), colors, (columns, rows))))
            }
        }
    }

    /// The number of a layer on the side of a point, in half widths and half heights; `None` where there is none, and for layers that are more than two numbers.
    fn number(&self, layer: &Layer, (x, y): (f64, f64)) -> Result<Option<f64>, Refusal> {
        let (BesideEdges::Sides, Some(values)) = (layer.beside_edges, layer.values()) else {
            return Ok(None);
        };
        let number = self.numbers_beside(values)?[usize::from(y > self.slope() * x)];
        Ok(Some(values.number(number)).filter(|number| !number.is_nan()))
    }

    /// The half width of the window in M over its half height, and the slope of the edge over M.
    fn slant(&self) -> (f64, f64) {
        match self {
            Depth::OfFixedPoint(of) => (frame_slant(&of.edge), of.edge.by_mass_ratio),
            Depth::OfGrounding(edge) => (edge.slant(), edge.by_mass_ratio),
        }
    }

    /// The slope of the edge, in half heights to half widths.
    fn slope(&self) -> f64 {
        let (slant, by_mass_ratio) = self.slant();
        by_mass_ratio * slant
    }

    /// The numbers of a layer below and above the point, so near that they are those at the edge. None where they still change there: the slope at an edge of
    /// grounding has no limit.
    fn numbers_beside(&self, values: &Values) -> Result<[u64; 2], Refusal> {
        let (ratio, point) = self.place();
        let at = |part: f64| {
            let (x, y) = ((ratio, f64::EPSILON * ratio), (point, part * point));
            let found = numbers_about(values, (x, y), (1, 2))?;
            Ok::<_, Refusal>([found[0], found[1]])
        };
        let (near, nearer) = (at(BESIDE)?, at(BESIDE / 16.0)?);
        let is_limit = |side: usize| {
            let [one, other] = [near[side], nearer[side]].map(|number| values.number(number));
            one == other || (one - other).abs() <= CHANGE * (one.abs() + other.abs())
        };
        Ok([0, 1].map(|side| if is_limit(side) { nearer[side] } else { NO_NUMBER }))
    }

    /// M and α of the point.
    fn place(&self) -> (f64, f64) {
        match self {
            Depth::OfFixedPoint(of) => (of.chart.mass_ratio().value(), of.chart.point().0),
            Depth::OfGrounding(edge) => (edge.mass_ratio.value(), edge.point),
        }
    }

    /// The colours of a layer in a window that doubles resolve.
    fn sampled(
        &self,
        values: &Values,
        depth: f64,
        (columns, rows): (usize, usize),
    ) -> Result<Vec<u8>, Refusal> {
        let (ratio, point) = self.place();
        let half = pxfm::f_exp10(-depth);
        let (slant, _) = self.slant();
        let sides = ((ratio, half * slant), (point, half));
        let numbers = numbers_about(values, sides, (columns, rows))?;
        let row = |row: usize| (0..columns).map(move |column| column * rows + row);
        let colors = (0..rows).rev().flat_map(row).flat_map(|at| values.color(numbers[at]));
        Ok(opaque(&colors.collect::<Vec<u8>>()))
    }
}

/// The numbers of a layer in a window, column after column, each from below: each side has a middle and a half.
fn numbers_about(
    values: &Values,
    ((x, half_x), (y, half_y)): ((f64, f64), (f64, f64)),
    (columns, rows): (usize, usize),
) -> Result<Vec<u64>, Refusal> {
    let (x, y) = (Interval::new(x - half_x, x + half_x)?, Interval::new(y - half_y, y + half_y)?);
    let grid = Grid { x, y, columns, rows };
    let of = LayerColumns { grid, logarithmic: false, columns: 0..columns };
    Ok((values.columns)(&of)?.concat())
}

/// Depths up to which the numbers of one hop are those of pixels.
const SAMPLED: f64 = 5.0;

/// Half of the height of the window in which the numbers at the edge are taken, as a part of the speed: far enough for doubles, and so near that they change by
/// some 10⁻⁸.
const BESIDE: f64 = 1e-9;

/// A number that changes more on a sixteenth of the distance has no limit at the edge.
const CHANGE: f64 = 1e-3;

/// A real number of a layer that is none.
const NO_NUMBER: u64 = f32::NAN.to_bits() as u64;

impl PointDepth {
    /// The colours of the phases.
    fn phases(
        &self,
        values: &Values,
        depth: f64,
        (columns, rows): (usize, usize),
    ) -> Result<Vec<u8>, Refusal> {
        let about = (&self.chart, &self.edge);
        let found = edge_phases(&self.fates, about, &self.circle, depth, (columns, rows))?;
        let color = |phase: &Option<f64>| {
            let number = phase.map_or(NO_NUMBER, |phase| u64::from((phase as f32).to_bits()));
            values.color(number)
        };
        let rows = found.chunks(columns.max(1)).rev();
        Ok(opaque(&rows.flatten().flat_map(color).collect::<Vec<u8>>()))
    }

    fn json(&self) -> Json {
        let (point, rest, error) = self.chart.point();
        let label = HopperFate::label_of_fixed_point(self.chart.n());
        Json::object()
            .text("kind", "fixed point")
            .number("massRatio", self.chart.mass_ratio().value())
            .number("alpha", point)
            .number("rest", rest)
            .number("error", error)
            .integer("n", self.chart.n())
            .integer("hops", self.chart.hops() as u64)
            .number("slope", self.chart.slope())
            .number("byMassRatio", self.edge.by_mass_ratio)
            .number("slant", frame_slant(&self.edge))
            .json("fate", labels::label(label))
    }
}

/// The fate at a point about an edge of grounding, in half widths and half heights.
fn side_of(edge: &GroundingEdge, (x, y): (f64, f64)) -> Label {
    let is_above = y > edge.by_mass_ratio * edge.slant() * x;
    match is_above == edge.hops_above {
        true => HopperFate::label_of_fixed_point(0),
        false => HopperFate::GROUNDED,
    }
}

/// The colours below and above an edge, which is a straight line at any depth.
fn two_sides(slope: f64, [below, above]: [[u8; 3]; 2], (columns, rows): (usize, usize)) -> Vec<u8> {
    let middle = |at: usize, all: usize| (2 * at + 1) as f64 / all as f64 - 1.0;
    let pixel = |row: usize, column: usize| {
        if -middle(row, rows) > slope * middle(column, columns) { above } else { below }
    };
    (0..rows).flat_map(|row| (0..columns).flat_map(move |column| pixel(row, column))).collect()
}
