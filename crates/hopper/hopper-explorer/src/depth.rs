//! Windows of any size about a boundary point: the zoom goes on where doubles end.

use crate::json::Json;
use crate::labels;
use crate::refusal::Refusal;
use crate::tile::opaque;
use hopper_basin::{
    CircleLimits, EdgeChart, Fates, FollowedEdge, HopperFate, PhaseBasins, edge_frame, edge_phase,
    frame_slant,
};
use hopper_figures::share_pixels;
use passive_hopper::MassRatio;

/// An open boundary point: its chart, its slope over M, and the circle of fates of the fixed point that it comes to.
#[derive(Debug)]
pub struct Depth {
    fates: Fates,
    chart: EdgeChart,
    edge: FollowedEdge,
    circle: PhaseBasins,
}

/// Most pixels of a frame each way.
const MOST_PIXELS: usize = 1024;

impl Depth {
    /// The boundary point nearest to a speed.
    ///
    /// # Errors
    /// The refusals of [`EdgeChart::nearest`], [`FollowedEdge::new`] and [`PhaseBasins::new`].
    pub fn near(mass_ratio: f64, alpha: f64) -> Result<Self, Refusal> {
        let fates = Fates::new(MassRatio::new(mass_ratio)?)?;
        let chart = EdgeChart::nearest(&fates, alpha)?;
        let edge = FollowedEdge::new(&chart)?;
        let circle = PhaseBasins::new(&fates, chart.n(), CircleLimits::default())?;
        Ok(Depth { fates, chart, edge, circle })
    }

    /// Whether this is the chart about exactly this speed.
    #[cfg(feature = "deep")]
    pub(crate) fn is_at(&self, mass_ratio: f64, alpha: f64) -> bool {
        self.chart.mass_ratio().value() == mass_ratio && self.chart.point().0 == alpha
    }

    /// The boundary point, as JSON.
    pub(crate) fn json(&self) -> Json {
        let (point, rest, error) = self.chart.point();
        let label = HopperFate::label_of_fixed_point(self.chart.n());
        Json::object()
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

    /// The boundary point as text, for tests.
    pub fn text(&self) -> String {
        self.json().finish()
    }

    /// The place on the circle with which the window of half height 10^−`depth` ends, and the turns until there, as JSON: the fraction of Ψ with its error, and
    /// the whole number as three digits with a power of ten.
    ///
    /// # Errors
    /// The refusals of [`edge_phase`].
    pub fn phase(&self, depth: f64) -> Result<String, Refusal> {
        Ok(self.phase_json(depth)?.finish())
    }

    pub(crate) fn phase_json(&self, depth: f64) -> Result<Json, Refusal> {
        let phase = edge_phase(&self.chart, &self.circle, depth)?;
        let digits = phase.whole().to_string();
        let first: String = digits.chars().take(3).collect();
        Ok(Json::object()
            .number("fraction", phase.fraction())
            .number("error", phase.error())
            .text("turns", &first)
            .integer("more", (digits.len() - first.len()) as u64))
    }

    /// The pixels of the window of half height 10^−`depth` about the point, the highest row first.
    ///
    /// # Errors
    /// The refusals of [`edge_frame`], and of frames with more than 1024 pixels each way.
    pub fn frame(&self, depth: f64, columns: usize, rows: usize) -> Result<Vec<u8>, Refusal> {
        if columns > MOST_PIXELS || rows > MOST_PIXELS {
            let text =
                format!("a frame has up to {MOST_PIXELS} pixels each way, not {columns} × {rows}");
            return Err(Refusal::new(text));
        }
        let about = (&self.chart, &self.edge);
        let raster = edge_frame(&self.fates, about, &self.circle, depth, (columns, rows))?;
        Ok(opaque(&share_pixels(&raster)))
    }
}
