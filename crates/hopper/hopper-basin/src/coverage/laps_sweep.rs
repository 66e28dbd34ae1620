//! The basins of a line as intervals, from below: a gap has a label if its image lies in an interval of known label.
//!
//! ```text
//!   known, from 0 up    ├── decaying ──┤├─ to α*_1 ─┤ …              gap [a, b]
//!                          ▲      ▲                                  │      │
//!                          └──────┴───────────── f ──────────────────┴──────┘        the image is inside: decaying
//! ```
//!
//! f is continuous and monotone on laps, whose ends are the critical points. So the image of [a, b] is the interval
//! from the smallest to the largest of f(a), f(b) and the critical values of [a, b] (docs/theory.md, Theorem 95).
//! Orbits descend: the image lies below the gap, where the labels are known already, and one hop suffices. A gap
//! without a label is halved, and left open once it is small.

use crate::basins::branches::branches_are_proved;
use crate::coverage::images::{ImagedSpeed, SpeedImage, SpeedImages};
use crate::coverage::preimage_guess::PreimageGuess;
use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use crate::fates::hopper_fate::HopperFate;
use crate::raster::rising_windows::trap_with_window;
use crate::traps::trap_index::TrapIndex;
use basin_of_attraction::{Interval, Label};
use passive_hopper::{FixedPointSpeed, MassRatio, index_below};
use std::f64::consts::PI;

/// Most images of a gap that are taken. The first one shows the label as a rule. Where it lies between two known
/// intervals, which the sweep left open, the second may. It affects the time, and what is left open.
const MOST_IMAGES: usize = 2;

/// The smallest width that a pass resolves, over that of the pass before. With a smaller factor there are fewer
/// passes, and more is resolved than needed. It affects the time only.
const FINER: f64 = 0.25;

/// A pass that leaves more than this part of what was open is the last one: what is open lies at preimages of what
/// is open below the pixel.
const STALLED: f64 = 0.8;

/// The width of the image of one speed, over that of a gap, from which a gap is divided so much further inside. It
/// affects the time only.
const BLURRED: f64 = 1e-3;

/// A part of the hop from a speed next to a fixed point: the image of so much above the speed lies below the speed.
const TURN: f64 = 0.9;

/// How far inside of the guessed preimage of an interval a gap is divided, as a part of the preimage. With less,
/// more guesses miss the preimage; with more, more is left to the next pass. 0.01 to 0.1 differ by a fifth in time.
const MARGIN: f64 = 0.03;

/// The guess of more preimages than this takes a third point, which costs a hop. It affects the time only.
const MANY: usize = 3;

/// Most images of a narrow window that are resolved apart. Next to a fixed point there are more, which the sweep
/// below leaves open.
const MOST_NARROW_IMAGES: usize = 64;

/// Every speed from 0 to `top` lies on a known lap, up to the ends of laps.
pub(crate) fn laps_are_known(mass_ratio: MassRatio, top: f64) -> bool {
    // The windows (nπ, α*_n) that begin below `top`.
    branches_are_proved(mass_ratio, (top / PI).floor() as u64)
}

/// Some speeds of a pixel.
#[derive(Debug, Clone, Copy)]
enum Span {
    Labelled(Interval, Label),
    Open(ImagedSpeed, ImagedSpeed),
}

/// How far a pixel is resolved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resolution {
    /// The open part of a pixel at which the passes end.
    pub tolerance: f64,
    /// The largest number of speeds inside a pixel whose images are taken.
    pub speeds: usize,
    /// Most passes over a pixel. A pass leaves some hundredths of each gap that it divides, and resolves gaps of a
    /// quarter of the width that the one before did. A small tolerance needs more.
    pub passes: usize,
    /// The smallest width that is resolved, over what may stay open of a pixel. Much below it a pixel would have
    /// more gaps than it may have. With a smaller one the turns next to a fixed point, of which there are ever
    /// more, take the time.
    pub finest: f64,
}

/// The intervals of known label, from 0 up to the speed that the sweep has reached.
///
/// The labels are as certain as the images and the traps that the sweep is given. With those of a strip of mass
/// ratios each label holds for all of them.
pub struct LapsSweep<I> {
    images: I,
    /// The traps, increasing.
    traps: Vec<(Interval, Label)>,
    /// Disjoint and increasing.
    known: Vec<(Interval, Label)>,
    /// The number of speeds that the pixel may still take.
    budget: usize,
}

/// The traps of the fixed points up to `top`, at one mass ratio.
pub(crate) fn traps_up_to(fates: &Fates, top: f64) -> Result<Vec<(Interval, Label)>, Error> {
    let traps = TrapIndex::new(top, |n| trap_with_window(fates, n))?;
    let trap = |(n, (left, right)): (u32, (f64, f64))| {
        let inside = right.is_finite() && left <= right;
        let label = HopperFate::label_of_fixed_point(n.into());
        inside.then_some((Interval { left, right }, label))
    };
    Ok(traps.ends().filter_map(trap).collect())
}

impl<I: SpeedImages> LapsSweep<I> {
    /// A sweep that has not begun. Every speed of a trap has its label; the traps are disjoint and increase.
    pub fn new(images: I, traps: Vec<(Interval, Label)>) -> Self {
        LapsSweep { images, traps, known: Vec::new(), budget: 0 }
    }

    /// The images of a window of speeds, as long as each is narrower than `widest`, from the first one down.
    pub(crate) fn narrow_images(&self, window: Interval, widest: f64) -> Vec<Interval> {
        let (mut images, mut own) = (Vec::new(), window);
        while images.len() < MOST_NARROW_IMAGES {
            let left = self.end(own.left.max(f64::MIN_POSITIVE));
            let image = self.images.of_all_between(&left, &self.end(own.right));
            let SpeedImage::Within(low, high) = image else { break };
            let trapped = self.traps.iter().any(|(trap, _)| trap.left <= low && high <= trap.right);
            if trapped || low <= 0.0 || high - low > widest {
                break;
            }
            own = Interval { left: low, right: high };
            images.push(own);
        }
        images
    }

    /// The intervals found so far: disjoint, increasing, each with the label of all its speeds.
    pub fn into_known(self) -> Vec<(Interval, Label)> {
        self.known
    }

    /// Labels the speeds from `left` ≥ 0 to `right`, the next pixel.
    pub fn add_pixel(&mut self, left: f64, right: f64, resolution: Resolution) {
        let before = (self.known.len(), self.known.last().copied());
        let allowed = resolution.tolerance * (right - left);
        let (mut finest, mut open_before) = (allowed, f64::INFINITY);
        self.budget = resolution.speeds;
        let mut parts = self.cut(left, right);
        for _ in 0..resolution.passes {
            // The labels of the pixel are found again from below, now in smaller gaps.
            self.known.truncate(before.0);
            if let (Some(last), Some(own)) = (self.known.last_mut(), before.1) {
                *last = own;
            }
            let mut next = Vec::with_capacity(2 * parts.len());
            for part in parts {
                match part {
                    Span::Labelled(interval, label) => self.add(&mut next, interval, label),
                    Span::Open(a, b) => self.resolve((a, b), finest, &mut next),
                }
            }
            parts = next;
            let open = |part: &Span| match part {
                Span::Labelled(..) => 0.0,
                Span::Open(a, b) => b.speed - a.speed,
            };
            let open = parts.iter().map(open).sum::<f64>();
            let stalled = finest <= resolution.finest * allowed && open > STALLED * open_before;
            if self.budget == 0 || open <= allowed || stalled {
                return;
            }
            open_before = open;
            finest = (FINER * finest).max(resolution.finest * allowed);
        }
    }

    /// The traps of a pixel, and the gaps between them.
    fn cut(&self, left: f64, right: f64) -> Vec<Span> {
        let mut parts = Vec::new();
        // No hop starts with the speed 0, which belongs to the trap of α*_0.
        let mut from = self.end(left.max(f64::MIN_POSITIVE));
        let first = self.traps.partition_point(|(trap, _)| trap.right <= left);
        for &(trap, label) in self.traps[first..].iter().take_while(|(trap, _)| trap.left < right) {
            let (low, high) = (trap.left.max(left), trap.right.min(right));
            if from.speed < low {
                parts.push(Span::Open(from, self.end(low)));
            }
            parts.push(Span::Labelled(Interval { left: low, right: high }, label));
            from = self.end(high);
        }
        if from.speed < right {
            parts.push(Span::Open(from, self.end(right)));
        }
        parts
    }

    fn end(&self, speed: f64) -> ImagedSpeed {
        ImagedSpeed { speed, reached: self.images.of_speed(speed) }
    }

    /// Labels parts of a gap, from below, as far as their width is at least `finest`.
    fn resolve(&mut self, (a, b): (ImagedSpeed, ImagedSpeed), finest: f64, parts: &mut Vec<Span>) {
        let mut from = a;
        while from.speed < b.speed {
            if let Some((end, label)) = self.one_label_up_to_fixed_point(&from) {
                let right = end.min(b.speed);
                self.add(parts, Interval { left: from.speed, right }, label);
                from = if right < b.speed { self.end(right) } else { b };
                continue;
            }
            // Next to a fixed point the image of the gap may reach into the gap itself: turn by turn, each image is
            // known. An unknown image is below its speed.
            let highest = match b.reached {
                SpeedImage::Within(_, high) => high,
                SpeedImage::Unknown => b.speed,
                SpeedImage::Grounded => 0.0,
            };
            let mut next = b;
            if let SpeedImage::Within(low, _) = from.reached
                && highest > from.speed
            {
                let step = TURN * (from.speed - low);
                if step < finest {
                    return parts.push(Span::Open(from, b));
                }
                if from.speed + step < b.speed {
                    next = self.end(from.speed + step);
                }
            }
            self.split((from, next), finest, parts);
            from = next;
        }
    }

    /// The largest speed below the next fixed point, and the label of all speeds up to there, if a turn below
    /// `from` has one label and the map rises from there on (docs/theory.md, Theorem 95.3).
    fn one_label_up_to_fixed_point(&self, from: &ImagedSpeed) -> Option<(f64, Label)> {
        let (SpeedImage::Within(low, _), &(own, label)) = (from.reached, self.known.last()?) else {
            return None;
        };
        let turn = own.left <= low && own.right == from.speed;
        if !turn {
            return None;
        }
        let star = FixedPointSpeed::new(index_below(from.speed).ok()? + 1);
        let end = star.largest_below();
        let rises = from.speed < end && self.images.rises_up_to_fixed_point(from.speed);
        rises.then_some((end, label))
    }

    /// Divides a gap where the labels of its image change, and labels the parts.
    fn split(&mut self, (a, b): (ImagedSpeed, ImagedSpeed), finest: f64, parts: &mut Vec<Span>) {
        if let Some(label) = self.label(&a, &b, 1) {
            return self.add(parts, Interval { left: a.speed, right: b.speed }, label);
        }
        if b.speed - a.speed <= finest || self.budget == 0 {
            return parts.push(Span::Open(a, b));
        }
        let loose = self.images.are_sharper_on_halves();
        let unknown = || self.images.of_all_between(&a, &b) == SpeedImage::Unknown;
        if a.reached.kind() != b.reached.kind() || (loose && unknown()) {
            // The edge of grounding has no known interval as its image: it is bisected. So is the place of an
            // undecided hop, and an interval on which the map is not known to be monotone.
            let middle = a.speed.midpoint(b.speed);
            if !(a.speed < middle && middle < b.speed) {
                return parts.push(Span::Open(a, b));
            }
            let middle = self.end(middle);
            self.budget -= 1;
            let undecided = |end: &ImagedSpeed| end.reached == SpeedImage::Unknown;
            if [a, middle, b].iter().all(undecided) {
                // Hops that are open at some mass ratio of a strip lie in a band. It has ends that are worth
                // finding; inside, bisection finds nothing, and would take all speeds from the rest of the pixel.
                return parts.extend([Span::Open(a, middle), Span::Open(middle, b)]);
            }
            self.split((a, middle), finest, parts);
            return self.split((middle, b), finest, parts);
        }
        let mut from = a;
        let (cuts, images) = self.cuts(&a, &b, finest);
        for to in cuts {
            if from.speed < to.speed && to.speed < b.speed && self.budget > 0 {
                self.budget -= 1;
                self.label_or_open((from, to), images, parts);
                from = to;
            }
        }
        self.label_or_open((from, b), images, parts);
    }

    fn label_or_open(
        &mut self,
        (a, b): (ImagedSpeed, ImagedSpeed),
        images: usize,
        parts: &mut Vec<Span>,
    ) {
        match self.label(&a, &b, images) {
            Some(label) => self.add(parts, Interval { left: a.speed, right: b.speed }, label),
            None => parts.push(Span::Open(a, b)),
        }
    }

    /// Where to divide a gap: at a critical point, or else a little inside of the preimages of the known intervals
    /// in its image. The preimages are guessed; the labels do not depend on the guess.
    fn cuts(&self, a: &ImagedSpeed, b: &ImagedSpeed, finest: f64) -> (Vec<ImagedSpeed>, usize) {
        let critical = self.images.critical_points();
        let first = critical.partition_point(|&speed| speed <= a.speed + 0.5 * finest);
        if let Some(&turn) = critical.get(first).filter(|&&speed| speed < b.speed - 0.5 * finest) {
            return (vec![self.end(turn)], 1);
        }
        let (mut at_a, mut at_b) = (a.reached, b.reached);
        for image in 1..=MOST_IMAGES {
            let (Some(from), Some(to)) = (at_a.middle(), at_b.middle()) else {
                break;
            };
            // An image of one speed is wide if it holds for many mass ratios.
            let width = 0.5 * at_a.width().max(at_b.width());
            let (low, high) = (from.min(to), from.max(to));
            let blur = if width > BLURRED * (high - low) { width } else { 0.0 };
            let first = self.known.partition_point(|(own, _)| own.right <= low);
            // On a line, the narrowest interval whose preimage counts.
            let narrowest = finest * (high - low) / (b.speed - a.speed);
            let sharp = |own: Interval| Interval { left: own.left + blur, right: own.right - blur };
            let seen = |own: &Interval| own.right.min(high) - own.left.max(low) >= narrowest;
            let inside = self.known[first..].iter().take_while(|(own, _)| own.left < high);
            let inside: Vec<Interval> = inside.map(|(own, _)| sharp(*own)).filter(seen).collect();
            if inside.is_empty() {
                (at_a, at_b) = (self.end(from).reached, self.end(to).reached);
                continue;
            }
            let mut guess = PreimageGuess::line((from, a.speed), (to, b.speed));
            let mut cuts = Vec::with_capacity(2 * inside.len() + 1);
            // A third point costs a hop, and pays if several intervals are looked for.
            if inside.len() > MANY && image == 1 {
                let middle = self.end(a.speed.midpoint(b.speed));
                if let Some(y) = middle.reached.middle() {
                    guess = guess.with((y, middle.speed));
                }
                cuts.push(middle);
            }
            for own in inside {
                let (x, y) = (guess.at(own.left.max(low)), guess.at(own.right.min(high)));
                let margin = MARGIN * (y - x);
                // The ends of the gap are known.
                cuts.extend((own.left > low).then(|| self.end(x + margin)));
                cuts.extend((own.right < high).then(|| self.end(y - margin)));
            }
            if cuts.is_empty() && self.images.are_sharper_on_halves() {
                // One interval holds the images of both ends, and not those of all between: a bound on these was
                // too wide.
                cuts.push(self.end(a.speed.midpoint(b.speed)));
            }
            cuts.sort_by(|p, q| p.speed.total_cmp(&q.speed));
            return (cuts, image);
        }
        (Vec::new(), 1)
    }

    fn add(&mut self, parts: &mut Vec<Span>, interval: Interval, label: Label) {
        parts.push(Span::Labelled(interval, label));
        match self.known.last_mut() {
            Some((last, own)) if *own == label && last.right == interval.left => {
                last.right = interval.right;
            }
            _ => self.known.push((interval, label)),
        }
    }

    /// The label of all speeds from `a` to `b`; `None` if the images do not show it.
    fn label(&self, a: &ImagedSpeed, b: &ImagedSpeed, images: usize) -> Option<Label> {
        let mut reached = self.images.of_all_between(a, b);
        for image in 1..=images {
            let (low, high) = match reached {
                SpeedImage::Within(low, high) => (low, high),
                SpeedImage::Grounded => return Some(HopperFate::GROUNDED),
                SpeedImage::Unknown => return None,
            };
            // The first interval that does not end below the image, and the last one that does not begin above it.
            let first = self.known.partition_point(|(own, _)| own.right < low);
            let last = self.known[first..].partition_point(|(own, _)| own.left <= high) + first;
            if let Some(&(own, label)) = self.known.get(first)
                && last > first
            {
                if own.left <= low && high <= own.right {
                    return Some(label);
                }
                if self.known[last - 1].1 != label {
                    return None; // it contains speeds of two basins
                }
            }
            if low <= 0.0 || image == images {
                return None;
            }
            reached = self.images.of_all_between(&self.end(low), &self.end(high));
        }
        None
    }
}
