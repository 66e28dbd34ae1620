//! The map with its fixed points and traps, and the cobweb of an orbit.

use crate::error::Error;
use crate::fate_colors;
use crate::graph::{Graph, cuts_between};
use crate::motion_plot::short;
use hopper_basin::{HopperFate, Trap};
use journal_figures::{Anchor, Frame, Pen, Svg, ticks};
use passive_hopper::{LiftOffMap, alpha_star, index_below};

/// A picture of the map: f(α) over a window of speeds, with the diagonal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MapPlot<'a> {
    /// The map.
    pub map: &'a LiftOffMap,
    /// The window of speeds, the same on both axes.
    pub window: (f64, f64),
    /// The speeds of an orbit, whose cobweb is drawn.
    pub orbit: &'a [f64],
    /// Whether the orbit ends on the ground.
    pub grounded: bool,
}

/// Points of a piece of the graph. The longest piece of a window of one hump fills the page, and is smooth with these.
const POINTS: usize = 160;

/// The most steps of a cobweb that are drawn. More are not told apart.
const MOST_STEPS: usize = 5000;

const GRAPH: Pen = Pen::solid("#000", 1.4);
const DIAGONAL: Pen = Pen::dashed("#000", 0.7, "1.5 2.5");
const WEB: Pen = Pen::solid("#b02418", 0.9);
const WEB_COLOR: &str = "#b02418";

impl MapPlot<'_> {
    /// The window about an orbit: from 0 unless the orbit stays far above it.
    pub fn window_of(orbit: &[f64], grounded: bool) -> (f64, f64) {
        let low = orbit.iter().copied().fold(f64::INFINITY, f64::min);
        let high = orbit.iter().copied().fold(0.0, f64::max);
        // At a fixed point the orbit stays: the window then has a millionth of the speed on each side.
        let span = (high - low).max(1e-6 * high);
        let from = low - 0.15 * span;
        (if grounded || from < 0.3 * high { 0.0 } else { from }, high + 0.08 * span)
    }

    /// The drawing.
    ///
    /// # Errors
    /// [`Error::TooWide`] and [`Error::EmptyWindow`] for such windows; [`Error::Hopper`] for an end that is no speed.
    pub fn draw(&self) -> Result<Svg, Error> {
        let (from, to) = self.window;
        let graph = Graph::drawn(self.map, &cuts_between(from, to)?, POINTS);
        let mut svg = Svg::new(560.0, 560.0);
        let frame = Frame::linear(74.0, 40.0, 466.0, 466.0, self.window, self.window);
        self.draw_traps(&mut svg, &frame)?;
        frame.clipped(&mut svg, |svg| {
            frame.polyline(svg, &[(from, from), (to, to)], DIAGONAL);
            for piece in &graph.pieces {
                frame.curve(svg, piece, GRAPH);
            }
            self.draw_web(svg, &frame);
        });
        self.draw_fixed_points(&mut svg, &frame)?;
        let (x_ticks, y_ticks) = (ticks(self.window, 6), ticks(self.window, 8));
        let labels = (
            "lift-off speed $α$_{j} (units of $m$_{2}$gω$/$k$)",
            "next lift-off speed $α$_{j+1} (units of $m$_{2}$gω$/$k$)",
        );
        frame.axes(&mut svg, &x_ticks, &y_ticks, labels.0, labels.1);
        let ratio = short(self.map.mass_ratio().value());
        let title = match self.orbit.first() {
            Some(&start) => format!("$M$ = {ratio}, $α$_{{0}} = {}", short(start)),
            None => format!("$M$ = {ratio}"),
        };
        svg.text(frame.left + frame.width, 27.0, Anchor::End, 12.0, &title);
        svg.text(frame.left, 27.0, Anchor::Start, 12.0, "coloured: the traps of the fixed points");
        if !graph.undecided.is_empty() {
            let text = "red, below the frame: speeds whose hop is not decided";
            svg.text(frame.left, 12.0, Anchor::Start, 12.0, text);
            for &alpha in &graph.undecided {
                let (x, y) = frame.at((alpha, from));
                svg.line((x, y + 1.0), (x, y + 5.0), WEB);
            }
        }
        Ok(svg)
    }

    /// The indices of the fixed points in the window, and the one below it.
    fn indices(&self) -> Result<std::ops::RangeInclusive<u64>, Error> {
        Ok(index_below(self.window.0)?..=index_below(self.window.1)?)
    }

    /// The traps as bands over their speeds.
    fn draw_traps(&self, svg: &mut Svg, frame: &Frame) -> Result<(), Error> {
        let (from, to) = self.window;
        for n in self.indices()? {
            let trap = Trap::new(n, self.map.mass_ratio())?;
            let (left, right) = (trap.fixed_point.value().max(from), trap.right().min(to));
            if left < right {
                let (x0, x1) = (frame.at((left, from)).0, frame.at((right, from)).0);
                let color = fate_colors::light_css(HopperFate::label_of_fixed_point(n));
                // A trap narrower than a line is still seen.
                svg.fill_rect(x0, frame.top, (x1 - x0).max(0.8), frame.height, color);
            }
        }
        Ok(())
    }

    fn draw_fixed_points(&self, svg: &mut Svg, frame: &Frame) -> Result<(), Error> {
        let indices = self.indices()?;
        // More labels than this would touch each other.
        let labelled = indices.end() - indices.start() <= 12;
        for n in indices {
            let star = alpha_star(n);
            if n == 0 || star < self.window.0 || star > self.window.1 {
                continue;
            }
            let (x, y) = frame.at((star, star));
            svg.dot(x, y, 3.0, "#000");
            if labelled {
                svg.text(x - 7.0, y - 5.0, Anchor::End, 11.5, &format!("$α$^{{∗}}_{{{n}}}"));
            }
        }
        Ok(())
    }

    fn draw_web(&self, svg: &mut Svg, frame: &Frame) {
        let (Some(&start), Some(&last)) = (self.orbit.first(), self.orbit.last()) else { return };
        let steps = (self.orbit.len() - 1).min(MOST_STEPS);
        let next = |speed: f64| self.map.image(speed).ok().flatten();
        let mut corners = vec![(start, self.window.0)];
        corners.extend(journal_figures::cobweb(next, start, steps).skip(usize::from(steps > 0)));
        if self.grounded && steps + 1 == self.orbit.len() {
            corners.push((last, self.window.0));
        }
        frame.polyline(svg, &corners, WEB);
        let (x, y) = frame.at((start, self.window.0));
        svg.dot(x, y - 3.0, 3.0, WEB_COLOR);
    }
}
