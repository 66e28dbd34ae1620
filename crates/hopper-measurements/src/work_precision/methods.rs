//! The ways to compute a hop.

use super::case::{Answer, Case};
use super::hybrid_hopper::{exact_landings, searched_landings};
use super::ode_hopper::integrated_hop;
use crate::timing::median_time;
use hopper_asymptotics::{
    LEFT_RANGE, LeftExpansion, RIGHT_RANGE, RightExpansion, SMALL_ALPHA_RANGE, small_hop_loss,
};
use passive_hopper::{FixedPointSpeed, LiftOffMap, printed_image};
use std::time::Duration;

/// One of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Method {
    /// `LiftOffMap::hop`.
    Stable,
    /// `LiftOffMap::images_of_pairs`, all hops of a class at once.
    AtOnce,
    /// `LiftOffMap::hop_near_fixed_point`.
    Local,
    /// Expansions, inside their ranges.
    Asymptotics,
    /// `printed_image`.
    Printed,
    /// The hybrid system with its own landings.
    HybridExact,
    /// The hybrid system with landings and lift-offs searched for at an interval.
    HybridSearched,
    /// The differential equations at a tolerance of 10^−k.
    Integrated(u8),
}

/// All of them, the cheapest first.
pub(crate) const ALL: &[Method] = &[
    Method::Asymptotics,
    Method::AtOnce,
    Method::Stable,
    Method::Local,
    Method::HybridExact,
    Method::Printed,
    Method::HybridSearched,
    Method::Integrated(3),
    Method::Integrated(4),
    Method::Integrated(5),
    Method::Integrated(6),
    Method::Integrated(7),
    Method::Integrated(8),
    Method::Integrated(9),
    Method::Integrated(10),
    Method::Integrated(11),
    Method::Integrated(12),
];

impl Method {
    /// Its name in tables.
    pub(crate) fn name(self) -> String {
        match self {
            Method::Stable => "stable form".into(),
            Method::AtOnce => "stable form, at once".into(),
            Method::Local => "(n, δ) form".into(),
            Method::Asymptotics => "asymptotics, in range".into(),
            Method::Printed => "printed form, Brent".into(),
            Method::HybridExact => "hybrid system, own landings".into(),
            Method::HybridSearched => "hybrid system, guard search".into(),
            Method::Integrated(k) => format!("ODE flows, tolerance 1e-{k}"),
        }
    }

    /// The hop; nothing where the method refuses.
    pub(crate) fn hop(self, case: &Case) -> Option<Answer> {
        let map = LiftOffMap::new(case.mass_ratio);
        match self {
            Method::Stable => {
                let hop = map.hop(case.alpha).ok().filter(|hop| hop.certain)?;
                let (next, loss, sudden) = (hop.next, hop.loss, Some(hop.sudden));
                Some(Answer { next, loss, offset: None, sudden })
            }
            Method::AtOnce => {
                // Enough of them to be taken at once.
                let mut hops = [(&map, Some(case.alpha)); 32];
                LiftOffMap::images_of_pairs(&mut hops).ok()?;
                Some(Answer { next: hops[0].1, ..Answer::default() })
            }
            Method::Local => {
                let (n, delta) = case.local?;
                let hop = map.hop_near_fixed_point(n, delta).ok()?;
                let star = FixedPointSpeed::new(n);
                let next = hop.next.map(|offset| star.value() + (star.rest() + offset));
                let sudden = Some(hop.sudden);
                Some(Answer { next, loss: None, offset: hop.next, sudden })
            }
            Method::Asymptotics => asymptotics(case),
            Method::Printed => {
                let next = printed_image(case.mass_ratio, case.alpha).ok()?;
                Some(Answer { next, ..Answer::default() })
            }
            Method::HybridExact => exact_landings(case),
            Method::HybridSearched => searched_landings(case),
            Method::Integrated(k) => integrated_hop(case, 10f64.powi(-i32::from(k))),
        }
    }

    /// The time of a hop.
    pub(crate) fn time(self, cases: &[&Case]) -> Duration {
        if self != Method::AtOnce {
            return median_time(cases.len(), |k| self.hop(cases[k]).and_then(|a| a.next));
        }
        let maps: Vec<_> = cases.iter().map(|case| LiftOffMap::new(case.mass_ratio)).collect();
        let all = || {
            let mut hops: Vec<_> =
                maps.iter().zip(cases).map(|(map, case)| (map, Some(case.alpha))).collect();
            LiftOffMap::images_of_pairs(&mut hops).is_ok()
        };
        median_time(1, |_| all()) / cases.len() as u32
    }

    /// A bound on its relative error on a plain hop, for the test that each does what it should.
    #[cfg(test)]
    pub(crate) fn expected_error(self) -> f64 {
        match self {
            Method::Stable | Method::AtOnce | Method::Local => 4e-16,
            Method::Asymptotics => 2e-4,
            Method::Printed | Method::HybridExact => 1e-14,
            Method::HybridSearched => 1e-12,
            Method::Integrated(k) => 100.0 * 10f64.powi(-i32::from(k)),
        }
    }
}

fn asymptotics(case: &Case) -> Option<Answer> {
    let Case { mass_ratio, alpha, .. } = *case;
    if alpha <= SMALL_ALPHA_RANGE {
        let loss = small_hop_loss(mass_ratio, alpha).ok()?.value;
        return Some(Answer { next: Some(alpha - loss), loss: Some(loss), ..Answer::default() });
    }
    let (n, delta) = case.local?;
    // Outside any range nothing has to be prepared.
    if !(-LEFT_RANGE..=RIGHT_RANGE).contains(&delta) {
        return None;
    }
    let offset = if delta >= 0.0 {
        RightExpansion::new(n, mass_ratio).ok()?.displacement(delta).ok()?.value
    } else {
        LeftExpansion::new(n, mass_ratio).ok()?.displacement(delta).ok()?.value
    };
    let star = FixedPointSpeed::new(n);
    let next = Some(star.value() + (star.rest() + offset));
    Some(Answer { next, offset: Some(offset), ..Answer::default() })
}
