//! A panel that shows an execution: components against time, with events, resets and errors.

use hybrid_system::{Arc, ArcEnd, Error, EventKind, Execution, HybridSystem, Limits, State};
use journal_figures::{Anchor, Frame, Marker, Pen, Svg, ticks};

/// The components, in order. They differ in lightness and in dashes.
const CURVES: [Pen; 3] =
    [Pen::solid("#10386e", 1.8), Pen::solid("#d0702b", 1.8), Pen::solid("#22a672", 1.8)];
const RESET: Pen = Pen::dashed("#555", 1.0, "3 2.5");
const SURFACE: Pen = Pen::solid("#777", 0.8);
const FORBIDDEN: &str = "#e4e4e0";
const ERROR: &str = "#a3260f";

/// Points on each arc. An arc of a parabola with 24 pieces is smooth in print.
const POINTS: u32 = 24;

/// The most events of a scene. The longest drawn execution has some twenty.
const MOST_EVENTS: usize = 10_000;

/// Instants closer than this share of the time axis are one dot.
const SAME_DOT: f64 = 1e-6;

/// A point of the panel: time and value.
type Point = (f64, f64);

/// The width of a dot, as a share of the time axis: 8 of 278 points.
const WIDTH_OF_DOT: f64 = 0.03;

/// A panel.
pub(super) struct Panel {
    title: &'static str,
    label: &'static str,
    duration: f64,
    range: (f64, f64),
    first_pen: usize,
    forbidden: Option<(f64, f64)>,
    surfaces: Vec<f64>,
    curves: Vec<(Vec<Point>, usize)>,
    resets: Vec<(Point, Point)>,
    /// Events: the place, the number at the instant, the symbol.
    events: Vec<(Point, usize, Marker)>,
    errors: Vec<Point>,
    /// Directions of fields, from point to point.
    arrows: Vec<(Point, Point)>,
}

impl Panel {
    pub(super) fn new(
        title: &'static str,
        duration: f64,
        range: (f64, f64),
        label: &'static str,
    ) -> Self {
        Panel {
            title,
            label,
            duration,
            range,
            first_pen: 0,
            forbidden: None,
            surfaces: Vec::new(),
            curves: Vec::new(),
            resets: Vec::new(),
            events: Vec::new(),
            errors: Vec::new(),
            arrows: Vec::new(),
        }
    }

    /// Values between `low` and `high` cannot flow.
    pub(super) fn forbidden(mut self, low: f64, high: f64) -> Self {
        self.forbidden = Some((low.max(self.range.0), high));
        self
    }

    /// A line at a surface.
    pub(super) fn surface(mut self, value: f64) -> Self {
        self.surfaces.push(value);
        self
    }

    /// A function of time.
    pub(super) fn function(self, value: impl Fn(f64) -> f64) -> Self {
        let whole = (0.0, self.duration);
        self.piece(whole, value)
    }

    /// A function between two times: a piece of one that jumps.
    pub(super) fn piece(mut self, (from, to): (f64, f64), value: impl Fn(f64) -> f64) -> Self {
        let times =
            (0..=4 * POINTS).map(|k| from + (to - from) * f64::from(k) / f64::from(4 * POINTS));
        self.curves.push((times.map(|t| (t, value(t))).collect(), self.first_pen));
        self
    }

    /// An event.
    pub(super) fn event(mut self, time: f64, value: f64) -> Self {
        self.mark((time, value), Marker::Disc);
        self
    }

    fn mark(&mut self, at: Point, marker: Marker) {
        let near =
            |dot: &&mut (Point, usize, Marker)| (dot.0.0 - at.0).abs() < SAME_DOT * self.duration;
        match self.events.iter_mut().find(near) {
            Some(dot) => dot.1 += 1,
            None => self.events.push((at, 1, marker)),
        }
    }

    /// An error. It replaces the events at its instant, whose number says nothing.
    fn error(&mut self, at: Point) {
        self.events.retain(|dot| (dot.0.0 - at.0).abs() > SAME_DOT * self.duration);
        self.errors.push(at);
    }

    /// The curves that follow have the pens from this one on.
    pub(super) fn pen(mut self, first: usize) -> Self {
        self.first_pen = first;
        self
    }

    /// The execution of a system up to the end of the time axis: these components.
    pub(super) fn scene<T: HybridSystem<State = State<N>>, const N: usize>(
        mut self,
        scene: &T,
        mode: T::Mode,
        start: State<N>,
        components: &[usize],
    ) -> Self {
        let (mut time, mut state, mut mode) = (0.0, start, mode);
        for arc in Execution::new(scene, mode, start, Limits::new(self.duration, MOST_EVENTS)) {
            match arc {
                Ok(arc) => {
                    self.arc(scene, &arc, components);
                    if let Some((next, after)) = arc.event().and_then(|event| event.after) {
                        (time, state, mode) = (arc.time + arc.duration, after, next);
                    }
                }
                Err(Error::Grazing { time: elapsed, .. }) => {
                    self.motion(scene, (mode, time, &state), elapsed, components);
                    let end = scene.flow(mode, &state, elapsed);
                    self.error((time + elapsed, end[components[0]]));
                }
                Err(_) => self.error((time, state[components[0]])),
            }
        }
        self
    }

    fn arc<T: HybridSystem<State = State<N>>, const N: usize>(
        &mut self,
        scene: &T,
        arc: &Arc<T::Mode, T::Surface, State<N>>,
        components: &[usize],
    ) {
        self.motion(scene, (arc.mode, arc.time, &arc.start), arc.duration, components);
        match &arc.end {
            ArcEnd::Event(event) => {
                let marker = match event.kind {
                    EventKind::Touch => Marker::Diamond,
                    _ => Marker::Disc,
                };
                self.mark((event.time, event.before[components[0]]), marker);
                let Some((_, after)) = event.after else { return };
                for &component in components {
                    let (from, to) = (event.before[component], after[component]);
                    if from != to {
                        self.resets.push(((event.time, from), (event.time, to)));
                    }
                }
            }
            ArcEnd::Sliding { sliding, .. } => {
                let at = (sliding.time, sliding.state[components[0]]);
                self.events.retain(|dot| (dot.0.0 - at.0).abs() > SAME_DOT * self.duration);
                self.events.push((at, 1, Marker::Diamond));
            }
            // Dots near the limit would cover each other.
            ArcEnd::Zeno { limit, .. } => {
                self.events
                    .retain(|dot| (dot.0.0 - limit.time).abs() > WIDTH_OF_DOT * self.duration);
                self.events.push(((limit.time, limit.state[components[0]]), 1, Marker::Wedge));
            }
            _ => {}
        }
    }

    fn motion<T: HybridSystem<State = State<N>>, const N: usize>(
        &mut self,
        scene: &T,
        (mode, time, start): (T::Mode, f64, &State<N>),
        duration: f64,
        components: &[usize],
    ) {
        if !(duration > 0.0) {
            return;
        }
        for (pen, &component) in components.iter().enumerate() {
            let point = |k: u32| {
                let elapsed = duration * f64::from(k) / f64::from(POINTS);
                (time + elapsed, scene.flow(mode, start, elapsed)[component])
            };
            self.curves.push(((0..=POINTS).map(point).collect(), self.first_pen + pen));
        }
    }

    /// The rates of one component in the modes below and above the surface at 0, as arrows behind the last event.
    pub(super) fn fields<T: HybridSystem<State = State<N>>, const N: usize>(
        mut self,
        scene: &T,
        modes: [T::Mode; 2],
        component: usize,
    ) -> Self {
        /// Length of the arrows, in units of time.
        const ARROW: f64 = 0.3;
        let from = self.events.last().map_or(0.0, |dot| dot.0.0);
        for k in 1..=3 {
            let time = from + 1.4 * ARROW * f64::from(k) - 0.5 * ARROW;
            for mode in modes {
                let Some(field) = scene.vector_field(mode, &State::zeros()) else { continue };
                let rate = field[component];
                let end = -0.06 * rate.signum();
                self.arrows.push(((time, end - ARROW * rate), (time + ARROW, end)));
            }
        }
        self
    }
}

/// The panels in two columns.
pub(super) fn draw(panels: &[Panel]) -> Svg {
    let rows = panels.len().div_ceil(2);
    let mut svg = Svg::new(690.0, 182.0 * rows as f64 + 8.0);
    for (k, panel) in panels.iter().enumerate() {
        let (x, y) = (52.0 + 344.0 * (k % 2) as f64, 26.0 + 182.0 * (k / 2) as f64);
        let frame = Frame::linear(x, y, 278.0, 112.0, (0.0, panel.duration), panel.range);
        if let Some((low, high)) = panel.forbidden {
            let (top, bottom) = (frame.at((0.0, high)).1, frame.at((0.0, low)).1);
            svg.fill_rect(frame.left, top, frame.width, bottom - top, FORBIDDEN);
        }
        for &surface in &panel.surfaces {
            frame.polyline(&mut svg, &[(0.0, surface), (panel.duration, surface)], SURFACE);
        }
        frame.clipped(&mut svg, |svg| {
            for &(from, to) in &panel.resets {
                frame.polyline(svg, &[from, to], RESET);
            }
            for (points, pen) in &panel.curves {
                frame.curve(svg, points, CURVES[*pen]);
            }
            for &(from, to) in &panel.arrows {
                svg.arrow(frame.at(from), frame.at(to), Pen::solid("#777", 1.0));
            }
        });
        for &(at, number, marker) in &panel.events {
            let (x, y) = frame.at(at);
            svg.marker((x, y), marker, 8.0, "#000");
            if number > 1 {
                svg.text(x + 6.0, y + 14.0, Anchor::Start, 11.0, &number.to_string());
            }
        }
        for &at in &panel.errors {
            svg.marker(frame.at(at), Marker::Cross, 9.0, ERROR);
        }
        frame.axes(&mut svg, &ticks(frame.x, 4), &ticks(frame.y, 4), "time $t$", panel.label);
        svg.text(x, y - 9.0, Anchor::Start, 12.5, panel.title);
    }
    svg
}
