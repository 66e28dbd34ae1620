//! Images of speeds and of intervals of speeds, for all mass ratios of a strip: narrow enclosures of F.
//!
//! The plain enclosure of a hop is as wide as its intervals allow. Three facts make it narrow. Along κ the mean
//! value form takes the middle of the strip and a bound on the slope. Along α a monotone F has its extremes at the
//! ends. And on a contact part F falls with μ.

use crate::error::Error;
use crate::fixed_points::fixed_point;
use crate::hop::hop_enclosure::{HopEnclosure, Reached, image_of};
use crate::hop::part::SpeedPart;
use crate::hop::strip::Strip;
use crate::hop::turns::{Turns, turns_up_to};
use hopper_basin::{ImagedSpeed, SpeedImage, SpeedImages, rising_window};
use interval_arithmetic::{Enclosure, PI};
use passive_hopper::{HalfFlight, index_below};

/// So far below α*_n the map is proved to rise, for all M and for M ≤ 1 (docs/theory.md, Theorem 81).
const RISES_BELOW_STAR: f64 = 0.0109;
const RISES_BELOW_STAR_LIGHT: f64 = 0.0586;

/// The images of the hops at all mass ratios of a strip.
#[derive(Debug, Clone)]
pub struct ProvedImages {
    strip: Strip,
    middle: Strip,
    /// By humps.
    turns: Vec<Turns>,
    cuts: Vec<f64>,
}

impl ProvedImages {
    /// The images of speeds up to `top`, for all mass ratios of `strip`.
    ///
    /// # Errors
    /// [`Error::Basin`] for a speed beyond the humps of the library.
    pub fn new(strip: Strip, top: f64) -> Result<Self, Error> {
        let turns = turns_up_to(&strip, top)?;
        let mut cuts = Vec::new();
        for (n, turns) in turns.iter().enumerate() {
            // The ends of windows and contact parts, and of turns; or else the speed at which the map falls most
            // steeply.
            cuts.extend((n > 0).then(|| (PI * n as f64).middle()));
            match turns {
                Turns::All(turns) => {
                    cuts.extend(
                        turns.iter().flat_map(|turn| [turn.speeds.left, turn.speeds.right]),
                    );
                }
                Turns::Unknown => {
                    let steepest = 0.5 * fixed_point(2 * n as u64 + 1).middle();
                    cuts.push(HalfFlight::at(steepest).start_speed(0.0));
                }
            }
        }
        cuts.sort_by(f64::total_cmp);
        Ok(ProvedImages { strip, middle: strip.centre(), turns, cuts })
    }

    /// The images of single speeds, and of intervals as narrow as their enclosures: without the turns of humps,
    /// which help wide intervals and take longer than hundreds of hops.
    pub(crate) fn of_points(strip: Strip) -> Self {
        ProvedImages { strip, middle: strip.centre(), turns: Vec::new(), cuts: Vec::new() }
    }

    /// The mass ratios.
    pub fn strip(&self) -> &Strip {
        &self.strip
    }

    /// F of one speed, over the strip; `None` if a decision of the hop is open.
    pub fn square(&self, alpha: f64) -> Option<Enclosure> {
        Some(self.reached(alpha)?.square)
    }

    /// Where the hops from one speed lead, over the strip; `None` if a decision of the hop is open.
    pub(crate) fn reached(&self, alpha: f64) -> Option<Reached> {
        let speed = Enclosure::from(alpha);
        if let Some(joint) = self.joint(speed) {
            return Some(Reached { square: joint?, loss: Enclosure::WHOLE });
        }
        let part = SpeedPart::of(speed)?;
        let all = HopEnclosure::plain(speed, part, &self.strip)?;
        if self.strip.kappa.width() <= 4.0 * f64::EPSILON {
            return Some(all.reached);
        }
        if let SpeedPart::Contact(_) = part {
            return Some(all.reached); // α is a point, and F is linear in μ: nothing is lost
        }
        let middle = HopEnclosure::plain(speed, part, &self.middle)?.reached.square;
        let form = Enclosure::mean_value(middle, all.by_kappa, self.strip.kappa, self.strip.middle);
        let Reached { square, loss } = all.reached;
        Some(Reached { square: form.intersection(&square)?, loss })
    }

    /// F over an interval that reaches to a multiple of π, for M < 1, where F is continuous (docs/theory.md,
    /// Theorem 23): by the formulas of both sides. `None` if the interval does not reach there, `Some(None)` if F
    /// is open.
    fn joint(&self, alpha: Enclosure) -> Option<Option<Enclosure>> {
        let k = (alpha.high() / std::f64::consts::PI).round();
        let joint = PI * k;
        let next_to = k >= 1.0 && alpha.low() >= joint.low() && alpha.high() <= joint.high();
        next_to.then(|| {
            let light = self.strip.mass_ratios.high() < 1.0;
            let side =
                |part| HopEnclosure::plain(alpha, part, &self.strip).map(|hop| hop.reached.square);
            let n = k as u64;
            let both = || Some(side(SpeedPart::Contact(n - 1))?.hull(&side(SpeedPart::Window(n))?));
            if light { both() } else { None }
        })
    }

    /// F is proved to rise on an interval of a window, by a theorem.
    fn rises_by_theorem(&self, alpha: Enclosure, n: u64) -> bool {
        let heaviest = self.strip.mass_ratios.high();
        let below = fixed_point(n).low() - alpha.low();
        let near = if heaviest <= 1.0 { RISES_BELOW_STAR_LIGHT } else { RISES_BELOW_STAR };
        below <= near
            || rising_window(n).is_some_and(|window| heaviest <= window.largest_mass_ratio)
    }

    /// The image of an interval by its ends and the turns inside, if the map is monotone between these: `None` if
    /// that is not known.
    fn by_turns(&self, a: &ImagedSpeed, b: &ImagedSpeed) -> Option<SpeedImage> {
        let pi = std::f64::consts::PI;
        let (first, last) = ((a.speed / pi) as usize, (b.speed / pi) as usize);
        // F is continuous at the multiples of π for M < 1 (docs/theory.md, Theorem 23).
        let continuous = self.strip.mass_ratios.high() < 1.0;
        let mut image = a.reached.with(b.reached);
        // One more on both sides, as the quotients are rounded.
        for n in first.saturating_sub(1)..=last + 1 {
            let star = fixed_point(n as u64);
            let begin = if n == 0 { 0.0 } else { (PI * n as f64).low() };
            let end = (PI * (n + 1) as f64).high();
            if b.speed < begin || a.speed > end {
                continue;
            }
            let joined = n > 0 && a.speed <= (PI * n as f64).high() && b.speed >= begin;
            if joined && !continuous {
                return None;
            }
            if n > 0 && a.speed < star.high() {
                let window = Enclosure::new(a.speed.max(begin), b.speed.min(star.low()));
                if b.speed > star.low() || !self.rises_by_theorem(window, n as u64) {
                    return None;
                }
            }
            if b.speed > star.low() {
                let Turns::All(turns) = self.turns.get(n)? else { return None };
                let inside = turns
                    .iter()
                    .filter(|turn| a.speed <= turn.speeds.right && b.speed >= turn.speeds.left);
                image = inside.fold(image, |image, turn| image.with(turn.image));
            }
        }
        Some(image)
    }

    /// F over an interval of one part, by bounds on its slope.
    fn square_between(&self, alpha: Enclosure) -> Option<Enclosure> {
        let part = SpeedPart::of(alpha)?;
        let all = HopEnclosure::plain(alpha, part, &self.strip)?;
        let (low, high) = (self.square(alpha.low())?, self.square(alpha.high())?);
        if all.by_speed.sign().is_some() {
            return Some(low.hull(&high));
        }
        // Along α from either end; the mean value form holds at each κ.
        let from = |at: Enclosure, end: f64| {
            Enclosure::mean_value(at, all.by_speed, alpha, Enclosure::from(end))
        };
        let form = from(low, alpha.low()).intersection(&from(high, alpha.high()))?;
        form.intersection(&all.reached.square)
    }

    /// F over an interval that contains at most one multiple of π.
    fn square_across(&self, a: f64, b: f64) -> Option<Enclosure> {
        let joint = PI * (b / std::f64::consts::PI).floor();
        if !(joint.low() > 0.0 && joint.low() >= a && joint.low() < b) {
            return self.square_between(Enclosure::new(a, b));
        }
        // Up to the multiple of π, next to it, and beyond it.
        let mut all = self.joint(joint)??;
        for (from, to) in [(a, joint.low()), (joint.high(), b)] {
            if from < to {
                all = all.hull(&self.square_between(Enclosure::new(from, to))?);
            }
        }
        Some(all)
    }
}

impl SpeedImages for ProvedImages {
    fn of_speed(&self, speed: f64) -> SpeedImage {
        self.reached(speed).map_or(SpeedImage::Unknown, |reached| reached.image(speed))
    }

    fn of_all_between(&self, a: &ImagedSpeed, b: &ImagedSpeed) -> SpeedImage {
        let by_slope =
            || self.square_across(a.speed, b.speed).map_or(SpeedImage::Unknown, image_of);
        self.by_turns(a, b).unwrap_or_else(by_slope)
    }

    fn are_sharper_on_halves(&self) -> bool {
        true
    }

    fn critical_points(&self) -> &[f64] {
        &self.cuts
    }

    fn rises_up_to_fixed_point(&self, speed: f64) -> bool {
        let Ok(n) = index_below(speed) else { return false };
        let star = fixed_point(n + 1);
        let window = (PI * (n + 1) as f64).high();
        speed >= window && self.rises_by_theorem(Enclosure::new(speed, star.low()), n + 1)
    }
}
