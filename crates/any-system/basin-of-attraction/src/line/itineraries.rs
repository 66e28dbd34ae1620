//! How many itineraries do the points have that never enter a trap: finitely many, countably many, or as many as a Cantor set?

use crate::line::branches::Branch;
use crate::line::preimage_tree::PreimageTree;
use crate::line::scalar_map::{Image, ScalarMap};
use crate::space::interval::Interval;
use crate::statistics::bounds::Bounds;

/// The number of itineraries through the pieces that the levels of a tree leave.
///
/// ```text
///   no piece can be visited for ever            none
///   no way leads from one cycle to another      finitely many: each ends in one of the cycles
///   ways lead from cycle to cycle, never back   countably many
///   two cycles lead to each other               as many as a Cantor set, with at least this entropy
/// ```
///
/// Where the map expands, each itinerary has one point, so that these are the numbers of points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Itineraries {
    /// All points enter the trap, or leave the branches: certain up to rounding.
    None,
    /// Finitely many: certain up to rounding.
    Finite,
    /// Countably many at most: certain up to rounding. They are infinitely many unless a way between two cycles that seems open is not.
    Countable,
    /// A Cantor set of them: pieces whose images cover each other. The bounds are those of the topological entropy on the points that stay.
    Cantor {
        /// From pieces that are covered, and from all that can be reached.
        entropy: Bounds,
    },
    /// The pieces do not decide it: more levels would.
    Undecided,
}

/// Which pieces the image of each piece reaches.
type Ways = Vec<Vec<usize>>;

impl PreimageTree {
    /// How many itineraries the points have that no level up to this one contains, by the pieces that these levels leave on the branches.
    ///
    /// `map` and `branches` are those of the tree. A piece leads to each piece that its image meets, and covers those that its image contains. Where an image
    /// reaches a part of a branch outside the tree's window, nothing is known, and the answer is undecided.
    ///
    /// ```
    /// use basin_of_attraction::{Branch, Interval, Itineraries, PreimageTree};
    /// // The points that never leave [0, 1] under the tent map of slope 3 have the entropy ln 2.
    /// let tent = |x: f64| Some(if x < 0.5 { 3.0 * x } else { 3.0 * (1.0 - x) });
    /// let left = Branch { domain: Interval::new(0.0, 0.5)?, at_left: 0.0, at_right: 1.5 };
    /// let right = Branch { domain: Interval::new(0.5, 1.0)?, at_left: 1.5, at_right: 0.0 };
    /// let (window, above) = (Interval::new(0.0, 1.0)?, Interval::new(1.0 + 1e-12, 1.5)?);
    /// let tree = PreimageTree::grow_from_known(&tent, &[left, right], above, window, 6)?;
    /// let Itineraries::Cantor { entropy } = tree.itineraries(&tent, &[left, right], 6) else { panic!() };
    /// assert!(entropy.covers(2f64.ln()) && entropy.half_width() < 1e-9);
    /// # Ok::<(), basin_of_attraction::Error>(())
    /// ```
    pub fn itineraries(
        &self,
        map: &impl ScalarMap,
        branches: &[Branch],
        level: usize,
    ) -> Itineraries {
        let gaps = self.gaps(level);
        // The parts of the branches that the window leaves out.
        let window = self.window;
        let left_out = |branch: &Branch| {
            let Interval { left, right } = branch.domain;
            let below = Interval { left, right: right.min(window.left) };
            let above = Interval { left: left.max(window.right), right };
            [below, above].into_iter().filter(|part| part.left < part.right)
        };
        let unknown: Vec<Interval> = branches.iter().flat_map(left_out).collect();
        let (mut pieces, mut images) = (Vec::new(), Vec::new());
        for branch in branches {
            for piece in gaps.intervals().iter().filter_map(|gap| gap.intersection(&branch.domain))
            {
                let Some(image) = image_of(map, branch, piece) else {
                    return Itineraries::Undecided;
                };
                if unknown.iter().any(|part| meets(&image, part)) {
                    return Itineraries::Undecided;
                }
                pieces.push(piece);
                images.push(image);
            }
        }
        let ways = |leads: fn(&Interval, &Interval) -> bool| -> Ways {
            let to = |image: &Interval| {
                (0..pieces.len()).filter(|&other| leads(image, &pieces[other])).collect()
            };
            images.iter().map(to).collect()
        };
        let (possible, certain) = (ways(meets), ways(covers));
        let (components, is_cyclic) = components(&possible);
        if !is_cyclic.iter().any(|cyclic| *cyclic) {
            return Itineraries::None;
        }
        // The logarithm of the growth of the number of ways.
        let (least, most) = (growth(&certain).0, growth(&possible).1);
        if least > 0.0 {
            return Itineraries::Cantor { entropy: Bounds { lower: least, upper: most } };
        }
        // A component with one way on from each piece is one cycle.
        let goes_on_in_it = |from: usize| {
            let same = possible[from].iter().filter(|to| components[**to] == components[from]);
            same.count()
        };
        if (0..pieces.len()).any(|piece| goes_on_in_it(piece) > 1) {
            return Itineraries::Undecided;
        }
        match leads_on(&possible, &components, &is_cyclic) {
            true => Itineraries::Countable,
            false => Itineraries::Finite,
        }
    }
}

/// The image of a piece of a branch, which is monotone.
fn image_of(map: &impl ScalarMap, branch: &Branch, piece: Interval) -> Option<Interval> {
    let end = |x: f64| match map.image(x) {
        // The map may jump there, or have no value.
        _ if x == branch.domain.left => Some(branch.at_left),
        _ if x == branch.domain.right => Some(branch.at_right),
        Image::Point(image) if image.is_finite() => Some(image),
        _ => None,
    };
    let (a, b) = (end(piece.left)?, end(piece.right)?);
    Some(Interval { left: a.min(b), right: a.max(b) })
}

/// Ends of pieces are wrong by an ulp or two of the map, and their images by as many times its slope.
const ULPS: f64 = 64.0;

/// How far ends may be off.
fn rounding(image: &Interval, piece: &Interval) -> f64 {
    let largest = [image.left, image.right, piece.left, piece.right];
    ULPS * f64::EPSILON * largest.into_iter().fold(0.0, |most: f64, x| most.max(x.abs()))
}

/// Whether they may have a point in common.
fn meets(image: &Interval, piece: &Interval) -> bool {
    let off = rounding(image, piece);
    image.left <= piece.right + off && piece.left <= image.right + off
}

/// Whether the piece lies in the image, up to rounding.
fn covers(image: &Interval, piece: &Interval) -> bool {
    let off = rounding(image, piece);
    image.left <= piece.left + off && piece.right <= image.right + off
}

/// The strongly connected component of each piece, and whether each component has a cycle.
fn components(ways: &Ways) -> (Vec<usize>, Vec<bool>) {
    // R. Tarjan's algorithm is recursive; two searches (S. R. Kosaraju) with stacks of their own are not.
    let mut back: Ways = vec![Vec::new(); ways.len()];
    for (from, to) in
        ways.iter().enumerate().flat_map(|(from, all)| all.iter().map(move |to| (from, *to)))
    {
        back[to].push(from);
    }
    let mut order = Vec::new();
    let mut seen = vec![false; ways.len()];
    for first in 0..ways.len() {
        let mut stack = vec![(first, 0)];
        while let Some((at, next)) = stack.pop() {
            if next == 0 && std::mem::replace(&mut seen[at], true) {
                continue;
            }
            match ways[at].get(next) {
                Some(&to) => {
                    stack.push((at, next + 1));
                    if !seen[to] {
                        stack.push((to, 0));
                    }
                }
                None => order.push(at),
            }
        }
    }
    let mut component = vec![usize::MAX; ways.len()];
    let mut is_cyclic = Vec::new();
    for &first in order.iter().rev() {
        if component[first] != usize::MAX {
            continue;
        }
        let (number, mut stack, mut size) = (is_cyclic.len(), vec![first], 0);
        component[first] = number;
        while let Some(at) = stack.pop() {
            size += 1;
            for &from in &back[at] {
                if component[from] == usize::MAX {
                    component[from] = number;
                    stack.push(from);
                }
            }
        }
        is_cyclic.push(size > 1 || ways[first].contains(&first));
    }
    (component, is_cyclic)
}

/// Whether a way leads from a cycle to another one.
fn leads_on(ways: &Ways, component: &[usize], is_cyclic: &[bool]) -> bool {
    let mut from_cycle: Vec<bool> = component.iter().map(|own| is_cyclic[*own]).collect();
    let mut stack: Vec<usize> = (0..ways.len()).filter(|at| from_cycle[*at]).collect();
    while let Some(at) = stack.pop() {
        for &to in &ways[at] {
            if component[to] == component[at] {
                continue;
            }
            if is_cyclic[component[to]] {
                return true;
            }
            if !std::mem::replace(&mut from_cycle[to], true) {
                stack.push(to);
            }
        }
    }
    false
}

/// Bounds on the logarithm of the largest eigenvalue of the matrix of ways, by L. Collatz's quotients of a positive vector; 0 without a cycle, or with
/// disjoint ones.
fn growth(ways: &Ways) -> (f64, f64) {
    /// Steps of the power method. The bounds hold after each of them.
    const STEPS: usize = 200;
    let (component, is_cyclic) = components(ways);
    let mut bounds = (0.0f64, 0.0f64);
    for number in (0..is_cyclic.len()).filter(|number| is_cyclic[*number]) {
        let own: Vec<usize> = (0..ways.len()).filter(|at| component[*at] == number).collect();
        let mut vector = vec![0.0; ways.len()];
        own.iter().for_each(|at| vector[*at] = 1.0);
        let (mut least, mut most) = (1.0f64, f64::INFINITY);
        for _ in 0..STEPS {
            // With the vector itself added the eigenvalue grows by 1, and no cycle makes the quotients oscillate.
            let next =
                |at: &usize| vector[*at] + ways[*at].iter().map(|to| vector[*to]).sum::<f64>();
            let images: Vec<(usize, f64)> = own.iter().map(|at| (*at, next(at))).collect();
            let quotients = images.iter().map(|(at, image)| image / vector[*at] - 1.0);
            let (low, high) =
                quotients.fold((f64::INFINITY, 0.0f64), |(low, high), q| (low.min(q), high.max(q)));
            (least, most) = (least.max(low), most.min(high));
            let scale = images.iter().fold(0.0f64, |largest, (_, image)| largest.max(*image));
            images.iter().for_each(|(at, image)| vector[*at] = image / scale);
        }
        bounds = (bounds.0.max(pxfm::f_log(least)), bounds.1.max(pxfm::f_log(most)));
    }
    // Quotients are sums of some products: a few roundings each.
    const ROUNDING: f64 = 1e-13;
    (if bounds.0 > ROUNDING { bounds.0 - ROUNDING } else { 0.0 }, bounds.1 + ROUNDING)
}
