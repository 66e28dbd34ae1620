//! The methods that compute a hop.

use super::case::{Answer, Case};
use super::hybrid_hopper::{exact_landings, searched_landings};
use super::ode_hopper::integrated_hop;
use crate::timing::median_time;
use hopper_asymptotics::{
    LEFT_RANGE, LeftExpansion, RIGHT_RANGE, RightExpansion, SMALL_ALPHA_RANGE, small_hop_loss,
};
use passive_hopper::{FixedPointSpeed, LiftOffMap, printed_image};
use std::time::Duration;

/// A method.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Method {
    /// `LiftOffMap::hop`.
    Stable,
    /// `LiftOffMap::images_of_pairs`, all hops of a class at once.
    AtOnce,
    /// `LiftOffMap::hop_near_fixed_point`.
    Local,
    /// The expansions near fixed points and for small α, inside their ranges.
    Asymptotics,
    /// `printed_image`: the equations as the paper prints them.
    Printed,
    /// The hybrid system, with landings that the model solves for.
    HybridExact,
    /// The hybrid system, with landings and lift-offs found by sampling the guards.
    HybridSearched,
    /// The differential equations, integrated at a tolerance of 10^−k.
    Integrated(u8),
}

/// All methods, the cheapest first.
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
    /// The name in tables.
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

    /// The hop; `None` if the method refuses the input.
    pub(crate) fn hop(self, case: &Case) -> Option<Answer> {
        let map = LiftOffMap::new(case.mass_ratio);
        match self {
            Method::Stable => {
                let hop = map.hop(case.alpha).ok()?;
                let (next, loss, sudden) = (hop.next, hop.loss, Some(hop.sudden));
                Some(Answer { next, loss, offset: None, sudden })
            }
            Method::AtOnce => {
                // From 16 hops on the map computes hops together; 32 fill whole vectors on any processor.
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

    /// The median time of a hop over these cases.
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

    /// A bound on the relative error for a hop without a sudden lift-off and far from every fixed point.
    ///
    /// The values were chosen by measurement on the hop of the test that uses them. An integration may have an error of
    /// a hundred times its tolerance, because the tolerance is for one step.
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
    // Outside the ranges the method refuses before it computes any coefficient, so that a refusal takes no time.
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
