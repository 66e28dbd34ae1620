//! The compared programs as a table and as CSV.

use super::peer::Peer;
use crate::error::Error;
use crate::text::{digit, duration, markdown_table};
use journal_figures::{DataFile, csv_text};

/// A table with the slowest program first; ratios are to the fastest one.
pub(crate) fn markdown(peers: &[Peer]) -> String {
    let fastest = fastest(peers);
    let row = |peer: &Peer| {
        let Peer { name, seconds, compared, wrong, errors, .. } = peer;
        let time = duration(*seconds);
        let ratio = seconds / fastest;
        // Two digits: 9.95 is where one decimal would round to 10.0.
        let ratio = if ratio < 9.95 { format!("{ratio:.1}") } else { format!("{ratio:.0}") };
        let (median, worst, wrong, compared) = match errors {
            Some((median, worst)) => {
                (digit(*median), digit(*worst), wrong.to_string(), compared.to_string())
            }
            None => ("–".into(), "–".into(), "–".into(), "–".into()),
        };
        format!("{name} | {time} | {ratio} | {median} | {worst} | {wrong} | {compared}")
    };
    let columns =
        "program | time a hop: | times the fastest: | median error: | worst error: | wrong: | of:";
    markdown_table(columns, sorted(peers).into_iter().map(row))
}

/// Seconds for a hop by the fastest program.
fn fastest(peers: &[Peer]) -> f64 {
    peers.iter().map(|peer| peer.seconds).fold(f64::INFINITY, f64::min)
}

fn sorted(peers: &[Peer]) -> Vec<&Peer> {
    let mut sorted: Vec<_> = peers.iter().collect();
    sorted.sort_by(|a, b| b.seconds.total_cmp(&a.seconds));
    sorted
}

/// One line for each program.
pub(crate) fn csv(peers: &[Peer]) -> Result<DataFile, Error> {
    let fastest = fastest(peers);
    let header = [
        "name",
        "seconds_per_hop",
        "times_the_fastest",
        "compared",
        "wrong",
        "median_error",
        "worst_error",
    ];
    let error = |value: Option<f64>| value.map_or(String::new(), |v| format!("{v:e}"));
    let rows = sorted(peers).into_iter().map(|peer| {
        vec![
            peer.name.clone(),
            format!("{:e}", peer.seconds),
            format!("{}", peer.seconds / fastest),
            peer.compared.to_string(),
            peer.wrong.to_string(),
            error(peer.errors.map(|e| e.0)),
            error(peer.errors.map(|e| e.1)),
        ]
    });
    Ok(csv_text("peers.csv", &header, rows)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slowest_first_and_ratios_to_the_fastest() {
        let peer = |name: &str, seconds, errors| Peer {
            name: name.into(),
            ours: false,
            seconds,
            compared: 10,
            wrong: 0,
            errors,
        };
        let peers = [peer("quick", 2e-8, Some((1e-16, 2e-15))), peer("slow", 5e-3, None)];
        let text = markdown(&peers);
        let lines: Vec<_> = text.lines().collect();
        assert_eq!(lines[2], "| slow | 5.0 ms | 250000 | – | – | – | – |");
        assert_eq!(lines[3], "| quick | 20 ns | 1.0 | 1e-16 | 2e-15 | 0 | 10 |");
        let bytes = csv(&peers).unwrap().bytes;
        assert_eq!(String::from_utf8(bytes).unwrap().lines().count(), 3);
    }
}
