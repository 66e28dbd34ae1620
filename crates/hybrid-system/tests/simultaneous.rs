//! Several guards at the same instant: none is lost, the first listed comes first.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use hybrid_system::*;
use nalgebra::Vector4;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Wall {
    Left,
    Below,
}

/// A point that flies straight into a corner; each wall turns its own component of the velocity.
struct Corner {
    signals: bool,
    sticky: bool,
}

impl HybridSystem<4> for Corner {
    type Mode = ();
    type Surface = Wall;
    fn flow(&self, (): (), x: &State<4>, t: f64) -> State<4> {
        Vector4::new(x[0] + t * x[2], x[1] + t * x[3], x[2], x[3])
    }
    fn guards(&self, (): ()) -> &[Guard<Wall>] {
        const { &[Guard::falling(Wall::Left), Guard::falling(Wall::Below)] }
    }
    fn guard_value(&self, wall: Wall, x: &State<4>) -> f64 {
        if wall == Wall::Left { x[0] } else { x[1] }
    }
    fn guard_quasi_polynomial(&self, (): (), wall: Wall, x: &State<4>) -> Option<QuasiPolynomial> {
        let axis = if wall == Wall::Left { 0 } else { 1 };
        self.signals.then(|| QuasiPolynomial::polynomial(&[x[axis], x[axis + 2]]))
    }
    fn reset(&self, (): (), wall: Wall, x: &State<4>) -> Reset<(), 4> {
        let mut after = *x;
        let axis = if wall == Wall::Left { 0 } else { 1 };
        (after[axis], after[axis + 2]) = (0.0, -x[axis + 2]);
        if self.sticky && wall == Wall::Left {
            // The left wall turns both components.
            after[3] = -x[3];
        }
        Reset::Jump { mode: (), state: after }
    }
}

fn run(corner: &Corner, start: State<4>) -> (Vec<Wall>, State<4>) {
    let mut walls = Vec::new();
    let mut end = start;
    for arc in Execution::new(corner, (), start, Limits::sampled(5.0, 100, 0.3)) {
        let arc = arc.unwrap();
        walls.extend(arc.event().map(|event| event.surface));
        end = arc.state(corner, arc.duration).unwrap();
    }
    (walls, end)
}

/// At any place of the corner's diagonal, in units that round: both walls turn the point, the left one first.
#[test]
fn both_walls_of_a_corner() {
    for signals in [true, false] {
        for k in 1..200 {
            let (x, v) = (0.01 * f64::from(k), 0.7 + 0.013 * f64::from(k));
            let corner = Corner { signals, sticky: false };
            let start = Vector4::new(x, x / 3.0, -v, -v / 3.0);
            let (walls, end) = run(&corner, start);
            assert_eq!(walls, [Wall::Left, Wall::Below], "{signals} {start}");
            assert!(end[0] > 0.0 && end[1] > 0.0, "{end}");
        }
    }
}

/// A first reset that turns the point away from the other wall leaves nothing to do.
#[test]
fn the_first_reset_may_settle_the_second() {
    let corner = Corner { signals: true, sticky: true };
    let (walls, end) = run(&corner, Vector4::new(1.0, 1.0, -1.0, -1.0));
    assert_eq!(walls, [Wall::Left]);
    assert!(end[0] > 0.0 && end[1] > 0.0);
}

/// A little apart they are two events like any other.
#[test]
fn a_little_apart() {
    let corner = Corner { signals: true, sticky: false };
    for offset in [1e-15, 1e-12, 1e-6] {
        for sign in [1.0, -1.0] {
            let start = Vector4::new(1.0, 1.0 + sign * offset, -1.0, -1.0);
            let (walls, end) = run(&corner, start);
            assert_eq!(walls.len(), 2, "{offset} {sign}: {walls:?}");
            assert!(end[0] > 0.0 && end[1] > 0.0);
        }
    }
}
