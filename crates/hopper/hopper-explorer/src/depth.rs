//! Windows of any size about a boundary point: the zoom goes on where doubles end.

use crate::json::Json;
use crate::labels;
use crate::refusal::Refusal;
use crate::tile::opaque;
use basin_of_attraction::Label;
use hopper_basin::{
    CircleLimits, EdgeChart, Fates, FollowedEdge, GroundingEdge, HopperFate, PhaseBasins,
    edge_frame, edge_label, edge_phase, frame_slant,
};
use hopper_figures::{fate_colors, share_pixels};
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

    /// The fate at a point of such a window, `x` half widths to the right of its middle and `y` half heights above it, as JSON.
    ///
    /// # Errors
    /// The refusals of [`edge_label`].
    pub fn label(&self, depth: f64, (x, y): (f64, f64)) -> Result<String, Refusal> {
        Ok(self.label_json(depth, (x, y))?.finish())
    }

    pub(crate) fn label_json(&self, depth: f64, (x, y): (f64, f64)) -> Result<Json, Refusal> {
        let label = match self {
            Depth::OfFixedPoint(of) => {
                edge_label((&of.chart, &of.edge), &of.circle, depth, (x, y))?
            }
            Depth::OfGrounding(edge) => Some(side_of(edge, (x, y))),
        };
        Ok(labels::label(label.unwrap_or(HopperFate::UNDECIDED)))
    }

    /// The pixels of the window of half height 10^−`depth` about the point, the highest row first.
    ///
    /// # Errors
    /// The refusals of [`edge_frame`], and of frames with more than 2048 pixels each way.
    pub fn frame(&self, depth: f64, columns: usize, rows: usize) -> Result<Vec<u8>, Refusal> {
        if columns > MOST_PIXELS || rows > MOST_PIXELS {
            let text =
                format!("a frame has up to {MOST_PIXELS} pixels each way, not {columns} × {rows}");
            return Err(Refusal::new(text));
        }
        match self {
            Depth::OfFixedPoint(of) => {
                let about = (&of.chart, &of.edge);
                let raster = edge_frame(&of.fates, about, &of.circle, depth, (columns, rows))?;
                Ok(opaque(&share_pixels(&raster)))
            }
            Depth::OfGrounding(edge) => Ok(opaque(&two_sides(edge, columns, rows))),
        }
    }
}

impl PointDepth {
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

/// The fates of the pixels' middles on both sides of an edge of grounding, which is a straight line at any depth.
fn two_sides(edge: &GroundingEdge, columns: usize, rows: usize) -> Vec<u8> {
    let middle = |at: usize, all: usize| (2 * at + 1) as f64 / all as f64 - 1.0;
    let pixel = |row: usize, column: usize| {
        fate_colors::rgb(side_of(edge, (middle(column, columns), -middle(row, rows))))
    };
    (0..rows).flat_map(|row| (0..columns).flat_map(move |column| pixel(row, column))).collect()
}
