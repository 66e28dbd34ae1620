//! Which chords of two curves may cross: by boxes about runs of them.

use super::curve::ManifoldCurve;

/// A box about some neighbouring chords.
struct Run {
    /// The number of the first point.
    from: usize,
    low: [f64; 2],
    high: [f64; 2],
}

/// The runs of one curve: those of single chords first, then those of pairs of runs, and so on.
pub(super) struct Runs {
    levels: Vec<Vec<Run>>,
}

impl ManifoldCurve {
    /// The chords between neighbouring points, without the one at the saddle and without jumps.
    pub(super) fn chords(&self) -> Runs {
        let mut own = Vec::new();
        for k in 1..self.points.len().saturating_sub(1) {
            let ([x, y], [u, v]) = match (&self.points[k][..], &self.points[k + 1][..]) {
                (&[x, y, ..], &[u, v, ..]) => ([x, y], [u, v]),
                _ => continue,
            };
            if !self.cuts.iter().any(|cut| cut.after == k) {
                let (low, high) = ([x.min(u), y.min(v)], [x.max(u), y.max(v)]);
                own.push(Run { from: k, low, high });
            }
        }
        let mut levels = vec![own];
        while let Some(last) = levels.last().filter(|last| last.len() > 1) {
            levels.push(last.chunks(2).map(Run::about).collect());
        }
        Runs { levels }
    }
}

impl Runs {
    fn run(&self, (level, place): (usize, usize)) -> Option<&Run> {
        self.levels.get(level)?.get(place)
    }
}

impl Run {
    fn about(runs: &[Run]) -> Run {
        let (low, high) = ([f64::INFINITY; 2], [-f64::INFINITY; 2]);
        let mut all = Run { from: usize::MAX, low, high };
        for run in runs {
            all.from = all.from.min(run.from);
            for axis in [0, 1] {
                all.low[axis] = all.low[axis].min(run.low[axis]);
                all.high[axis] = all.high[axis].max(run.high[axis]);
            }
        }
        all
    }

    fn meets(&self, other: &Run) -> bool {
        [0, 1].iter().all(|&k| self.low[k] <= other.high[k] && other.low[k] <= self.high[k])
    }
}

/// The pairs of chords whose boxes meet, as the numbers of their first points, in the order of the first curve.
pub(super) fn meeting(first: &Runs, second: &Runs) -> Vec<(usize, usize)> {
    let mut found = Vec::new();
    let top = |runs: &Runs| (runs.levels.len() - 1, 0);
    let mut todo = vec![(top(first), top(second))];
    while let Some((a, b)) = todo.pop() {
        let runs = (first.run(a), second.run(b));
        let (Some(one), Some(two)) = runs else { continue };
        if !one.meets(two) {
            continue;
        }
        // The longer run is divided.
        match (a.0, b.0) {
            (0, 0) => found.push((one.from, two.from)),
            (i, j) if i >= j => todo.extend([0, 1].map(|k| ((i - 1, 2 * a.1 + k), b))),
            (_, j) => todo.extend([0, 1].map(|k| (a, (j - 1, 2 * b.1 + k)))),
        }
    }
    found.sort_unstable();
    found
}
