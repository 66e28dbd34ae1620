//! Several guards at the same instant: no event is lost.

use hybrid_system::*;
use nalgebra::Vector4;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Wall {
    Left,
    Below,
}

/// A point that flies straight into a corner. Each wall reverses its own component of the velocity.
struct Corner {
    /// The guards are given as quasi-polynomials; otherwise they are sampled.
    bounds: bool,
    /// The left wall reverses both components.
    left_reverses_both: bool,
}

impl HybridSystem for Corner {
    type State = State<4>;
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
        self.bounds.then(|| QuasiPolynomial::polynomial(&[x[axis], x[axis + 2]]))
    }
    fn reset(&self, (): (), wall: Wall, x: &State<4>) -> Reset<(), State<4>> {
        let mut after = *x;
        let axis = if wall == Wall::Left { 0 } else { 1 };
        (after[axis], after[axis + 2]) = (0.0, -x[axis + 2]);
        if self.left_reverses_both && wall == Wall::Left {
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

/// From many places on the diagonal of the corner, with rounded numbers: both walls reverse the point, in the order
/// of the rounded zeros.
#[test]
fn both_walls_reverse_a_point_in_the_corner() {
    for bounds in [true, false] {
        for k in 1..200 {
            let (x, v) = (0.01 * f64::from(k), 0.7 + 0.013 * f64::from(k));
            let corner = Corner { bounds, left_reverses_both: false };
            let start = Vector4::new(x, x / 3.0, -v, -v / 3.0);
            let (mut walls, end) = run(&corner, start);
            walls.sort_by_key(|wall| *wall == Wall::Below);
            assert_eq!(walls, [Wall::Left, Wall::Below], "{bounds} {start}");
            assert!(end[0] > 0.0 && end[1] > 0.0, "{end}");
        }
    }
}

/// If the first reset reverses the point away from the other wall, there is no second event.
#[test]
fn the_first_reset_may_prevent_the_second_event() {
    let corner = Corner { bounds: true, left_reverses_both: true };
    let (walls, end) = run(&corner, Vector4::new(1.0, 1.0, -1.0, -1.0));
    assert_eq!(walls, [Wall::Left]);
    assert!(end[0] > 0.0 && end[1] > 0.0);
}

/// Two walls that are reached a little apart give two events at different times.
#[test]
fn walls_reached_a_little_apart_give_two_events() {
    let corner = Corner { bounds: true, left_reverses_both: false };
    for offset in [1e-15, 1e-12, 1e-6] {
        for sign in [1.0, -1.0] {
            let start = Vector4::new(1.0, 1.0 + sign * offset, -1.0, -1.0);
            let (walls, end) = run(&corner, start);
            assert_eq!(walls.len(), 2, "{offset} {sign}: {walls:?}");
            assert!(end[0] > 0.0 && end[1] > 0.0);
        }
    }
}
