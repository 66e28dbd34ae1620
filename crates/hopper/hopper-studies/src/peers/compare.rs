//! The same hops by each program, in one run.

use super::peer::Peer;
use super::python::{Python, results};
use crate::error::Error;
use crate::reference::{ReferenceHop, window_hops};
use crate::repository::Progress;
use crate::work_precision::{Case, Method};
use std::path::Path;

/// The results of one program for all hops, in their order.
#[derive(Debug, Clone, serde::Deserialize)]
struct ProgramResults {
    name: String,
    seconds: f64,
    next: Vec<Option<f64>>,
}

/// All programs on the hops of the paper's window.
pub(crate) fn measure(
    python: &Python,
    folder: &Path,
    progress: &Progress,
) -> Result<Vec<Peer>, Error> {
    let bar = progress.bar("peers", 2);
    let hops = window_hops()?;
    let found = theirs(python, folder, &hops)?;
    bar.set(1);
    let mut peers: Vec<Peer> = found
        .into_iter()
        .map(|found| {
            let ours = found.name.starts_with("passive_hopper");
            peer(found, ours, &hops)
        })
        .collect();
    for method in [Method::HybridSearched, Method::HybridExact, Method::Stable, Method::AtOnce] {
        peers.push(peer(ours(method, &hops), true, &hops));
    }
    bar.finish();
    Ok(peers)
}

/// The other programs' results, measured by a script in a process of its own.
fn theirs(
    python: &Python,
    folder: &Path,
    hops: &[ReferenceHop],
) -> Result<Vec<ProgramResults>, Error> {
    let (input, output) = (folder.join("hops.json"), folder.join("results.json"));
    let pairs: Vec<_> = hops.iter().map(|hop| (hop.mass_ratio.value(), hop.alpha)).collect();
    let understood = |error: serde_json::Error| Error::Peers { reason: error.to_string() };
    let text = serde_json::to_string(&pairs).map_err(understood)?;
    resumable_job::write_atomically(&input, text.as_bytes())?;
    python.run(include_str!("peers.py"), &[&input, &output])?;
    results(&output)
}

/// The results of one of our methods.
fn ours(method: Method, hops: &[ReferenceHop]) -> ProgramResults {
    let cases: Vec<Case> = hops.iter().map(Case::of).collect();
    let next = |case: &Case| method.hop(case).and_then(|answer| answer.next);
    ProgramResults {
        name: format!("ours: {}", method.name()),
        seconds: method.time(&cases.iter().collect::<Vec<_>>()).as_secs_f64(),
        next: cases.iter().map(next).collect(),
    }
}

fn peer(found: ProgramResults, ours: bool, hops: &[ReferenceHop]) -> Peer {
    let (mut errors, mut wrong) = (Vec::new(), 0);
    for (&next, hop) in found.next.iter().zip(hops) {
        match (next, hop.next) {
            (Some(next), Some(exact)) => errors.push(((next - exact) / exact).abs()),
            (None, None) => {}
            _ => wrong += 1,
        }
    }
    errors.sort_by(f64::total_cmp);
    let errors = errors.last().map(|&worst| (errors[errors.len() / 2], worst));
    let compared = found.next.len();
    Peer { name: found.name, ours, seconds: found.seconds, compared, wrong, errors }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_and_wrong_decisions_are_counted_separately() {
        let hops = window_hops().unwrap();
        let mut next: Vec<_> = hops.iter().map(|hop| hop.next).collect();
        let grounded = hops.iter().position(|hop| hop.next.is_none()).unwrap();
        next[grounded] = Some(1.0);
        let found = ProgramResults { name: "a peer".into(), seconds: 1.0, next };
        let peer = peer(found, false, &hops);
        assert_eq!((peer.compared, peer.wrong, peer.errors), (1000, 1, Some((0.0, 0.0))));
    }

    #[test]
    fn our_methods_give_the_reference_values() {
        let hops = window_hops().unwrap();
        for method in [Method::Stable, Method::AtOnce] {
            let peer = peer(ours(method, &hops), true, &hops);
            assert!(peer.wrong == 0 && peer.errors.unwrap().0 < 4e-16, "{peer:?}");
        }
    }
}
