//! The hops from all speeds of an interval, at all mass ratios of a strip.

use crate::fixed_points::fixed_point;
use crate::hop::first_landing::FirstLanding;
use crate::hop::following::Following;
use crate::hop::part::SpeedPart;
use crate::hop::strip::Strip;
use hopper_basin::SpeedImage;
use interval_arithmetic::Enclosure;

/// Most sudden lift-offs of a hop that are followed. Orbits with more, at large M, stay open.
const MOST_SUDDEN: usize = 64;

/// Where a hop leads.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Reached {
    /// F = α′², below zero where the hopper is grounded.
    pub(crate) square: Enclosure,
    /// α² − F.
    pub(crate) loss: Enclosure,
}

impl Reached {
    fn by_loss(alpha: Enclosure, loss: Enclosure) -> Self {
        // A loss is never negative.
        let loss = Enclosure::new(loss.low().max(0.0), loss.high());
        Reached { square: alpha.squared() - loss, loss }
    }

    /// α′ of the hop from α, from 0 up where the hopper may be grounded.
    ///
    /// It is √F where F is positive, and α − (α² − F)/(α + α′) as well: small losses keep their digits.
    pub(crate) fn speed(&self, alpha: f64) -> Option<Enclosure> {
        let positive = Enclosure::new(self.square.low().max(0.0), self.square.high().max(0.0));
        let root = positive.sqrt()?;
        if self.square.is_positive() {
            let by_loss = Enclosure::from(alpha).sharp_difference(self.loss / (root + alpha));
            root.intersection(&by_loss)
        } else {
            Some(root)
        }
    }

    /// The image of α.
    pub(crate) fn image(&self, alpha: f64) -> SpeedImage {
        match image_of(self.square) {
            SpeedImage::Within(..) => self
                .speed(alpha)
                .map_or(SpeedImage::Unknown, |speed| SpeedImage::Within(speed.low(), speed.high())),
            image => image,
        }
    }
}

/// The image of an enclosed F = α′².
pub(crate) fn image_of(square: Enclosure) -> SpeedImage {
    if square.is_negative() {
        return SpeedImage::Grounded;
    }
    match square.sqrt() {
        Some(speed) if square.is_positive() && speed.high().is_finite() => {
            SpeedImage::Within(speed.low(), speed.high())
        }
        _ => SpeedImage::Unknown,
    }
}

/// The hops of an interval, with their derivatives.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HopEnclosure {
    pub(crate) reached: Reached,
    /// ∂F/∂α.
    pub(crate) by_speed: Enclosure,
    /// ∂F/∂κ.
    pub(crate) by_kappa: Enclosure,
    /// The hops of the [middle](Enclosure::middle) speed, where they were followed as well.
    pub(crate) at_middle: Option<Reached>,
}

/// The hop from the middle of an interval of speeds, from which the mean value form encloses the others.
struct Centre {
    speed: f64,
    /// α − the middle, over the interval.
    distance: Enclosure,
    state: Following,
}

impl Centre {
    /// `None` for a single speed, which is narrow as it is, and for a middle that is not in the window.
    fn of(alpha: Enclosure, part: SpeedPart, kappa: Enclosure) -> Option<Self> {
        let speed = alpha.middle();
        let middle = Enclosure::from(speed);
        if alpha.low() == alpha.high() || SpeedPart::of(middle) != Some(part) {
            return None;
        }
        let state = Following::from_window(middle, &FirstLanding::over(middle, part)?, kappa)?;
        Some(Centre { speed, distance: alpha - middle, state })
    }

    fn next(self, kappa: Enclosure) -> Option<Self> {
        Some(Centre { state: self.state.next(kappa)?.0, ..self })
    }
}

impl HopEnclosure {
    /// All hops from the speeds of `alpha` that are in `part`, by the mean value form from the middle one. `None`
    /// if the intervals do not tell the number of sudden lift-offs.
    pub(crate) fn plain(alpha: Enclosure, part: SpeedPart, strip: &Strip) -> Option<Self> {
        let first = FirstLanding::over(alpha, part)?;
        let (kappa, mu) = (strip.kappa, strip.mu);
        let tilt = Enclosure::ONE - 2.0 * kappa;
        if let SpeedPart::Contact(n) = part {
            let square = first.closing_speed().squared();
            return Some(HopEnclosure {
                reached: Reached::by_loss(alpha, mu * square),
                by_speed: 2.0 * alpha * (Enclosure::ONE - 4.0 * mu * w_over(&first, n)),
                by_kappa: -(tilt * square),
                at_middle: None,
            });
        }
        let narrowed = |centre: &Option<Centre>, all: Following| {
            let centre = centre.as_ref();
            centre.and_then(|own| all.narrowed(&own.state, own.distance)).unwrap_or(all)
        };
        let mut centre = Centre::of(alpha, part, kappa);
        let mut state = narrowed(&centre, Following::from_window(alpha, &first, kappa)?);
        for _ in 0..MOST_SUDDEN {
            let (next, again) = state.next(kappa)?;
            centre = centre.and_then(|centre| centre.next(kappa));
            state = narrowed(&centre, next);
            if !again {
                let of_middle = |centre: &Centre| {
                    Reached::by_loss(Enclosure::from(centre.speed), mu * centre.state.losses)
                };
                return Some(HopEnclosure {
                    reached: Reached::by_loss(alpha, mu * state.losses),
                    at_middle: centre.as_ref().map(of_middle),
                    by_speed: 2.0 * alpha - mu * state.by_speed.losses,
                    by_kappa: -(tilt * state.losses) - mu * state.by_kappa.losses,
                });
            }
        }
        None
    }
}

/// W over a contact part: it rises to h = ½ α*_{2n+1} and then falls, and its maximum is (R+1)²/(4R) with R² = 1 +
/// α*²_{2n+1} (docs/theory.md, Lemma 27).
pub(crate) fn w_over(first: &FirstLanding, n: u64) -> Enclosure {
    let [begin, end] = first.w_at_ends();
    let ends = begin.hull(&end);
    let twice = fixed_point(2 * n + 1);
    let steepest = 0.5 * twice;
    if first.half.high() < steepest.low() || first.half.low() > steepest.high() {
        return ends;
    }
    ends.hull(&largest_w(n))
}

/// The largest W of hump n.
pub(crate) fn largest_w(n: u64) -> Enclosure {
    let Some(root) = (Enclosure::ONE + fixed_point(2 * n + 1).squared()).sqrt() else {
        return Enclosure::WHOLE;
    };
    (root + Enclosure::ONE).squared() / (4.0 * root)
}

#[cfg(test)]
mod tests {
    use super::*;
    use interval_arithmetic::PI;

    /// Intervals of speeds in windows 1 to 6, of widths from 10⁻³ to 10⁻⁸.
    fn intervals() -> impl Iterator<Item = Enclosure> {
        let place = |k: u32| (f64::from(k) * 0.618_033_988_749_895).fract();
        (0..3000).map(move |k| {
            let n = u64::from(1 + k % 6);
            let (begin, star) = ((PI * n as f64).high(), fixed_point(n).low());
            let low = begin + 0.999 * (star - begin) * place(k);
            Enclosure::new(low, low + 10f64.powi(-3 - (k / 6 % 6) as i32))
        })
    }

    /// F and its slopes at single speeds lie in the enclosures over an interval; and the slopes of the interval are
    /// hardly more than those of its speeds, also after many sudden lift-offs.
    #[test]
    fn slopes_over_intervals_are_those_of_their_speeds() {
        const SPEEDS: u32 = 8;
        for (ratio, at_least) in [(0.5, 2990), (3.0, 2980), (5.0, 2950), (10.0, 2900)] {
            let strip = Strip::at(ratio).unwrap();
            let mut excess = Vec::new();
            for alpha in intervals() {
                let Some(part) = SpeedPart::of(alpha) else { continue };
                let Some(all) = HopEnclosure::plain(alpha, part, &strip) else { continue };
                let mut slopes: Option<Enclosure> = None;
                for k in 0..=SPEEDS {
                    let speed = alpha.low() + alpha.width() * f64::from(k) / f64::from(SPEEDS);
                    let own = Enclosure::from(speed.min(alpha.high()));
                    let own = HopEnclosure::plain(own, part, &strip).unwrap();
                    for (one, all) in [
                        (own.reached.square, all.reached.square),
                        (own.by_speed, all.by_speed),
                        (own.by_kappa, all.by_kappa),
                    ] {
                        assert!(
                            one.intersection(&all).is_some(),
                            "M = {ratio}, {alpha:?}: {one:?} {all:?}"
                        );
                    }
                    slopes = Some(slopes.map_or(own.by_speed, |slopes| slopes.hull(&own.by_speed)));
                }
                excess.push(all.by_speed.width() / slopes.unwrap().width());
            }
            excess.sort_by(f64::total_cmp);
            assert!(excess.len() > at_least, "M = {ratio}: {}", excess.len());
            let [median, high] = [5, 9].map(|tenths| excess[excess.len() * tenths / 10]);
            assert!(median < 1.1 && high < 2.0, "M = {ratio}: {median} {high}");
        }
    }
}
