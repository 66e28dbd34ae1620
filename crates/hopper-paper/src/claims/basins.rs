//! Claims about the humps of the map, its crisis, and the measures of the basins.

use super::claim::Claim;
use crate::error::Error;
use basin_of_attraction::monotone_branches;
use hopper_basin::{BasinFractions, Fates, basin_fractions, branches, crisis, first_humps};
use passive_hopper::{LiftOffMap, MassRatio, alpha_star};
use repository_tools::Progress;

pub(super) fn check(progress: &Progress) -> Result<Vec<Claim>, Error> {
    let mut claims = vec![multimodal()?, above_first()?, falls_through()?];
    claims.extend(measures(progress)?);
    claims.push(finer_scales()?);
    Ok(claims)
}

fn multimodal() -> Result<Claim, Error> {
    let fates = Fates::new(MassRatio::new(0.2)?)?;
    let mut turns = Vec::new();
    for n in 1..=5 {
        let hump = branches(&fates, n, n + 1, 2001)?;
        turns.push(
            hump.windows(2).filter(|pair| pair[0].increases() != pair[1].increases()).count(),
        );
    }
    // An independent check: the whole window is sampled, without any theory of the humps.
    let blind = monotone_branches(&fates, first_humps(5), 40_001)?;
    let blind_turns =
        blind.windows(2).filter(|pair| pair[0].increases() != pair[1].increases()).count();
    Ok(Claim::new("Secs. I, III, Fig. 2", "multimodality")
        .paper("the map has many humps, one between any two neighbouring fixed points")
        .ours(format!("at $M$ = 0.2 each of the first five humps has one maximum and one minimum; {blind_turns} turning points in [$α$^{{∗}}_{{1}}, $α$^{{∗}}_{{6}}]"))
        .error("–")
        .how("critical points 4$μ$ sin $h$ (sin $h$ − $h$ cos $h$) = 1 on the contact parts, and a search at 40 001 points that knows nothing of them")
        .holds(turns.iter().all(|&t| t == 2) && blind_turns == 10))
}

/// The lowest value of the map on [α*₁, α*₆], and the lowest value without the first branch, whose left end is α*₁
/// itself.
fn lowest(mass_ratio: f64) -> Result<(f64, f64), Error> {
    let fates = Fates::new(MassRatio::new(mass_ratio)?)?;
    let branches = branches(&fates, 1, 6, 2001)?;
    let least = |skip: usize| {
        let ends = branches.iter().skip(skip).flat_map(|b| [b.at_left, b.at_right]);
        ends.fold(f64::INFINITY, f64::min)
    };
    Ok((least(0), least(1)))
}

fn above_first() -> Result<Claim, Error> {
    let star = alpha_star(1);
    let (light, heavy) = (lowest(0.05)?, lowest(0.1)?);
    Ok(Claim::new("Sec. V", "small M: the whole map is above α*₁")
        .paper("for low $M$ the entire map lies above the line $α$′ = $α$^{∗}_{1}: the whole range is attracted")
        .ours(format!("on [$α$^{{∗}}_{{1}}, $α$^{{∗}}_{{6}}] the map is at least $α$^{{∗}}_{{1}} + {:.4} at $M$ = 0.05 and + {:.4} at $M$ = 0.1, but for the fixed point itself", light.1 - star, heavy.1 - star))
        .error("–")
        .how("least value over the ends of all monotone branches")
        .holds([light.0, heavy.0].iter().all(|&v| v >= star - 1e-15)))
}

/// M_c(1), computed with mpmath to 34 digits, without this code.
const CRISIS: f64 = 0.103_457_755_336_137_07;

fn falls_through() -> Result<Claim, Error> {
    let found = crisis(1)?;
    let step = 1e-6;
    let around = [found.mass_ratio * (1.0 - step), found.mass_ratio * (1.0 + step)];
    let mut signs = Vec::new();
    for m in around {
        let image = LiftOffMap::new(MassRatio::new(m)?).image(found.alpha)?;
        signs.push(image.is_some_and(|image| image > alpha_star(1)));
    }
    Ok(Claim::new("Secs. V, VI", "where that ends")
        .paper("as $M$ grows, larger and larger parts of the map drop below $α$^{∗}_{1}, between $M$ = 0.1 and 0.2")
        .ours(format!("hump 1 touches $α$^{{∗}}_{{1}} at $M$_{{c}} = {:.14} (and 1/$M$_{{c}}), at $α$ = {:.9}", found.mass_ratio, found.alpha))
        .error(format!("{:.1e} from the 34-digit value, which was computed without this code", (found.mass_ratio / CRISIS - 1.0).abs()))
        .how("$Γ$^{2} = 4$W$($A$^{2} − $α$^{∗2}), one root; the map at that $α$ is above for $M$_{c}(1 − 10^{−6}) and below for $M$_{c}(1 + 10^{−6})")
        .holds(signs == [true, false] && (found.mass_ratio / CRISIS - 1.0).abs() < 1e-13 && found.mass_ratio > 0.1 && found.mass_ratio < 0.2))
}

fn measures(progress: &Progress) -> Result<Vec<Claim>, Error> {
    const POINTS: usize = 10_000;
    let ratios = [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0];
    let bar = progress.bar("measures", ratios.len() as u64);
    let mut results = Vec::new();
    for (k, m) in ratios.into_iter().enumerate() {
        results.push(basin_fractions(MassRatio::new(m)?, 1, 6, POINTS)?);
        bar.set(k as u64 + 1);
    }
    bar.finish();
    let total: Vec<f64> = results.iter().map(BasinFractions::incessant).collect();
    let first = results[0].of(1);
    let how = "10 000 equally spaced points, the middles of equal parts, on each of the five intervals [$α$^{∗}_{i}, $α$^{∗}_{i+1}], fractions averaged; fates by traps. (The paper does not say whether it takes the ends: the double nearest to $α$^{∗}_{i} may lie on its left, which is another basin.)";
    let claim = |name: &str, paper: &str, value: f64, printed: f64, digit: f64| {
        Claim::new("Sec. VI B", name)
            .paper(paper)
            .ours(format!("{value:.5}"))
            .error(format!("{:+.1e}", value - printed))
            .how(how)
            .holds((value - printed).abs() <= digit)
    };
    let table: Vec<String> =
        ratios.iter().zip(&total).map(|(m, t)| format!("{t:.4} at {m}")).collect();
    Ok(vec![
        claim("measure at M = 0.1, all basins", "1", total[0], 1.0, 0.0),
        claim("measure at M = 0.1, first basin", "0.953", first, 0.953, 0.0005),
        claim("measure at M = 0.2, all basins", "0.037 (one digit is lost in our copy)", total[1], 0.037, 0.0005),
        Claim::new("Sec. VI B", "fall and recovery of the measure")
            .paper("the measure decreases rapidly as $M$ increases, then increases again for very large $M$")
            .ours(table.join(", "))
            .error("–")
            .how(how)
            .holds(total[..4].windows(2).all(|p| p[0] > p[1]) && total[3..].windows(2).all(|p| p[0] < p[1])),
    ])
}

/// Changes of fate along α at M = 0.175, in the windows of Figs. 6, 8 and 9.
fn finer_scales() -> Result<Claim, Error> {
    let fates = Fates::new(MassRatio::new(0.175)?)?;
    let windows = [
        (first_humps(5).left, first_humps(5).right),
        (14.066, 20.371),
        (17.0, 17.8),
        (17.25, 17.33),
    ];
    let mut changes = Vec::new();
    for (left, right) in windows {
        let labels: Result<Vec<u16>, _> = (0..10_000)
            .map(|k| {
                fates.fate(left + (right - left) * ((f64::from(k) + 0.5) / 1e4)).map(|f| f.label())
            })
            .collect();
        changes.push(labels?.windows(2).filter(|pair| pair[0] != pair[1]).count());
    }
    let counts: Vec<String> = changes.iter().map(ToString::to_string).collect();
    Ok(Claim::new("Sec. VI, Figs. 6–9", "structure at finer scales")
        .paper("the basins show structure at ever finer scales")
        .ours(format!("{} changes of fate along $M$ = 0.175 in the windows of Figs. 6, 8 and 9 and in [17.25, 17.33]", counts.join(", ")))
        .error("–")
        .how("10 000 equally spaced points a window; down to the scales one can plot it looks so, though the boundary is countable (see the construction)")
        .holds(changes.iter().all(|&count| count >= 20)))
}
