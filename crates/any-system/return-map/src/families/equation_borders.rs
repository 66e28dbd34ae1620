//! Where the orbits of equations come near to surfaces, and what lies between two pieces of a return map.

use super::border::{Border, BorderSite, Clearance};
use super::equation_returns::EquationReturns;
use super::equation_ways::Way;
use super::family::{Image, MapFamily};
use super::formula_values::FormulaValues;
use super::return_arcs::{ReturnArcs, name_of, named_border};
use crate::error::Error;
use equations::Jet;
use hybrid_system::{Along, Arc, Direction, Equations, Label, Turn};
use nalgebra::DVector;

/// How far a state is moved to see if a guard stays zero along a field, in parts of its size; and what is zero then.
const MOVED: f64 = 0.01;
const STAYS: f64 = 1e-9;

/// Return maps with observers of the turns of all guards.
#[derive(Debug)]
pub(super) struct Observed {
    returns: EquationReturns,
    turns: Vec<(Turn, FormulaValues)>,
}

/// The nearest turn of one guard on one side in one passage.
struct Nearest {
    place: usize,
    turn: usize,
    arc: usize,
    side: f64,
    value: f64,
}

impl Observed {
    pub(super) fn new(
        of: &EquationReturns,
        (equations, turns): (Equations, Vec<Turn>),
        mode: Label,
    ) -> Result<Observed, Error> {
        let turns = turns.into_iter().map(|turn| {
            let map = FormulaValues::new(&turn.guard, "formulas of a guard", (1, 1))?;
            Ok((turn, map))
        });
        let turns = turns.collect::<Result<_, Error>>()?;
        Ok(Observed { returns: of.with_equations(equations, mode), turns })
    }

    fn is_turn(&self, surface: Label) -> bool {
        self.turns.iter().any(|(turn, _)| turn.observer == surface)
    }

    /// The value of a guard at a state, with derivatives.
    fn value<const T: usize>(
        &self,
        map: &FormulaValues,
        state: &[Jet<T>],
        parameter: Jet<T>,
    ) -> Result<Jet<T>, Error> {
        let count = self.returns.components();
        // A model whose formulas use the time has it behind the components.
        let time = state.get(count).copied().unwrap_or(Jet::number(0.0));
        let state = &state[..count.min(state.len())];
        Ok(map.values((state, time), self.returns.parameters(parameter))?[0])
    }

    /// The nearest turns of all guards. `sides` are those on which an orbit can be: that of the guard's value, unless another one is
    /// given, as for an orbit that goes on beyond a border.
    fn nearest(
        &self,
        arcs: &ReturnArcs,
        parameter: f64,
        given: Option<f64>,
    ) -> Result<Vec<Nearest>, Error> {
        let mut found: Vec<Nearest> = Vec::new();
        let mut place = 0;
        for (arc_place, arc) in arcs.iter().enumerate() {
            let Some(event) = arc.event() else { continue };
            let observed = |(turn, _): &(Turn, FormulaValues)| {
                turn.mode == arc.mode && turn.observer == event.surface
            };
            let Some(turn) = self.turns.iter().position(observed) else {
                place += 1;
                continue;
            };
            let state: Vec<_> = event.before.iter().map(|x| Jet::<1>([*x])).collect();
            let map = &self.turns[turn].1;
            let own = self.value(map, &state, Jet([parameter]))?.value();
            let side = given.unwrap_or(own.signum());
            // On the positive side of a surface its guard has a minimum where it is nearest.
            let is_nearest = (event.direction == Some(Direction::Rising)) == (side > 0.0);
            let value = side * own;
            if event.direction.is_none() || !is_nearest {
                continue;
            }
            let known = found
                .iter_mut()
                .find(|known| (known.place, known.turn, known.side) == (place, turn, side));
            let new = Nearest { place, turn, arc: arc_place, side, value };
            match known {
                Some(known) if known.value <= value => {}
                Some(known) => *known = new,
                None => found.push(new),
            }
        }
        Ok(found)
    }

    /// The clearances of the orbits of a curve.
    pub(super) fn clearances(
        &self,
        curve: &[Jet<4>],
        parameter: Jet<4>,
    ) -> Result<Vec<Clearance>, Error> {
        let first = |jet: &Jet<4>| Jet::<2>([jet.0[0], jet.0[1]]);
        let curve: Vec<Jet<2>> = curve.iter().map(first).collect();
        let parameter = first(&parameter);
        let point: Vec<f64> = curve.iter().map(Jet::value).collect();
        let Way { arcs, model, .. } = self.returns.way(&point, parameter.value())?;
        let (mut start, begin) = self.returns.start(&curve, parameter)?;
        if arcs.first().is_some_and(|arc| arc.start.len() > start.len()) {
            start.push(begin);
        }
        let along = Along::curve(&start).and_parameter_curve(&self.returns.parameter, parameter);
        let of = |near: Nearest| {
            let until = &arcs[..=near.arc];
            let at = model.jet::<2>(until, &along)?;
            let (turn, map) = &self.turns[near.turn];
            let mut value = self.value(map, &at.state, parameter)?;
            value.0.iter_mut().for_each(|part| *part *= near.side);
            let surface = name_of(turn.mode, turn.surface);
            Ok(Clearance { place: near.place, surface, side: near.side, value })
        };
        self.nearest(&arcs, parameter.value(), None)?.into_iter().map(of).collect()
    }
}

/// The map of one sequence of events, beyond its borders too, with the distance from a border as one component more.
#[derive(Debug)]
pub(super) struct Passages {
    observed: Observed,
    watch: Option<Watch>,
    itinerary: Vec<String>,
}

/// The number that is zero at a border: the value of a guard where it turns in a passage, on one side of its surface, or at the event
/// that ends the passage.
#[derive(Debug)]
struct Watch {
    passage: Label,
    surface: Label,
    guard: FormulaValues,
    at_turn: Option<f64>,
}

impl Passages {
    /// What is watched; `None` if the guard does not turn, or the passage does not end.
    fn watched(
        &self,
        watch: &Watch,
        arcs: &ReturnArcs,
        parameter: f64,
    ) -> Result<Option<f64>, Error> {
        let Some(side) = watch.at_turn else {
            let event = in_passage(arcs, watch.passage).filter_map(Arc::event);
            let mut event = event.filter(|event| !self.observed.is_turn(event.surface));
            let value = event.next().map(|event| self.guard(watch, &event.before, parameter));
            return value.transpose();
        };
        let near = self.observed.nearest(arcs, parameter, Some(side))?;
        let is_own = |near: &&Nearest| {
            let turn = &self.observed.turns[near.turn].0;
            turn.mode == watch.passage && turn.surface == watch.surface
        };
        Ok(near.iter().find(is_own).map(|near| near.value))
    }

    fn guard(&self, watch: &Watch, state: &DVector<f64>, parameter: f64) -> Result<f64, Error> {
        let state: Vec<_> = state.iter().map(|x| Jet::<1>([*x])).collect();
        Ok(self.observed.value(&watch.guard, &state, Jet([parameter]))?.value())
    }

    /// How far a point is from the border, in parts of the size of the guard in the passage.
    fn distance(&self, (point, parameter): (&[f64], f64)) -> Option<f64> {
        let watch = self.watch.as_ref()?;
        let Way { arcs, .. } = self.observed.returns.way(point, parameter).ok()?;
        let value = self.watched(watch, &arcs, parameter).ok()??;
        let mut size = 0.0;
        for arc in in_passage(&arcs, watch.passage) {
            let ends = [&arc.start, &arc.event()?.before];
            for at in ends {
                size = f64::max(size, self.guard(watch, at, parameter).ok()?.abs());
            }
        }
        Some(value.abs() / size)
    }
}

/// The arcs of a passage.
fn in_passage(
    arcs: &ReturnArcs,
    passage: Label,
) -> impl Iterator<Item = &Arc<Label, Label, DVector<f64>>> {
    arcs.iter().filter(move |arc| arc.mode == passage)
}

impl MapFamily for Passages {
    fn dimension(&self) -> usize {
        self.observed.returns.dimension()
    }

    fn image(&self, point: &[f64], parameter: f64) -> Result<Image, Error> {
        let way = self.observed.returns.way(point, parameter)?;
        let mut image = self.observed.returns.image_after(&way, parameter)?;
        image.itinerary.clone_from(&self.itinerary);
        if let Some(watch) = &self.watch {
            let value = self.watched(watch, &way.arcs, parameter)?;
            image
                .point
                .push(value.ok_or_else(|| Error::NoImage { point: point.to_vec(), parameter })?);
        }
        Ok(image)
    }
}

impl EquationReturns {
    /// The mode and the surface of a piece's name.
    fn event_of(&self, name: &str) -> Option<(Label, Label)> {
        self.equations.surfaces().find(|(mode, surface)| name_of(*mode, *surface) == name)
    }

    /// The map of a sequence of events, with what is watched; `None` for a sequence with other things than events.
    pub(super) fn passages(
        &self,
        itinerary: &[String],
        site: Option<&BorderSite>,
    ) -> Result<Passages, Error> {
        let no_event = |name: &String| Error::NoPassage { event: name.clone() };
        let events = itinerary.iter().map(|name| self.event_of(name).ok_or_else(|| no_event(name)));
        let along = self.equations.along_events(&events.collect::<Result<Vec<_>, _>>()?)?;
        let observed = Observed::new(self, along, Label::new("passage 0")?)?;
        let watch = match site {
            Some(site) => Some(self.watch(site)?),
            None => None,
        };
        Ok(Passages { observed, watch, itinerary: itinerary.to_vec() })
    }

    fn watch(&self, site: &BorderSite) -> Result<Watch, Error> {
        let refused = || Error::BorderNotFollowed { border: format!("{:?}", site.border) };
        let (surface, at_turn) = match &site.border {
            Border::Grazing { surface } => (surface, Some(site.side)),
            Border::Corner { surfaces: [_, other] } => (other, None),
            _ => return Err(refused()),
        };
        let (mode, surface) = self.event_of(surface).ok_or_else(refused)?;
        let guard = self.equations.guard_formula(mode, surface).ok_or_else(refused)?;
        let guard = FormulaValues::new(guard, "formulas of a guard", (1, 1))?;
        let passage = Label::new(&format!("passage {}", site.place))?;
        Ok(Watch { passage, surface, guard, at_turn })
    }

    /// What lies between two sequences of events that differ first at a place, beside a point.
    ///
    /// One of them is met by the point. Each possible border has a number that is zero on it: the nearest one is the border.
    pub(super) fn border_at<'s>(
        &self,
        at: (&[f64], f64),
        (own, beyond): (&'s [String], &'s [String]),
        place: usize,
        within: f64,
    ) -> BorderSite {
        let site = |border: Border, itinerary: &[String], side: f64| BorderSite {
            border,
            itinerary: itinerary.to_vec(),
            place,
            side,
        };
        let piece = site(Border::Piece, own, 1.0);
        if let Some(named) = named_border(own, beyond, place) {
            return named;
        }
        // Of an orbit of several returns, those behind this one do not matter.
        let comes_back =
            |name: &String| self.event_of(name).is_some_and(|(_, s)| s == self.surface);
        let one = |names: &'s [String]| {
            let rest = names.iter().skip(place).position(comes_back);
            rest.map_or(names, |rest| &names[..=place + rest])
        };
        let (own, beyond) = (one(own), one(beyond));
        let (Some(a), Some(b)) = (own.get(place), beyond.get(place)) else { return piece };
        let graze = |surface: &String| Border::Grazing { surface: surface.clone() };
        let corner = |a: &String, b: &String| Border::Corner { surfaces: [a.clone(), b.clone()] };
        let mut nearest = (within, piece);
        for candidate in [
            site(graze(b), own, 1.0),
            site(graze(b), own, -1.0),
            site(graze(a), beyond, 1.0),
            site(graze(a), beyond, -1.0),
            site(corner(a, b), own, 1.0),
            site(corner(b, a), beyond, 1.0),
        ] {
            let itinerary = &candidate.itinerary;
            let map = self.passages(itinerary, Some(&candidate));
            let Some(distance) = map.ok().and_then(|map| map.distance(at)) else { continue };
            if distance < nearest.0 {
                nearest = (distance, candidate);
            }
        }
        let mut found = nearest.1;
        // Two events of one guard, of which one stays on its surface.
        let guard = |name| {
            let (mode, surface) = self.event_of(name)?;
            self.equations.guard_formula(mode, surface)
        };
        if matches!(found.border, Border::Corner { .. }) && guard(a) == guard(b) {
            let [first, second] = [a, b].map(|name| self.stays(at, own, name).unwrap_or(false));
            if first != second {
                let surface = if first { a } else { b }.clone();
                found.border = Border::Sliding { surface };
            }
        }
        found
    }

    /// True if the guard of an event stays zero in the mode to which it leads, along its field.
    fn stays(&self, (point, parameter): (&[f64], f64), own: &[String], name: &str) -> Option<bool> {
        let (mode, surface) = self.event_of(name)?;
        let guard = self.equations.guard_formula(mode, surface)?;
        let field = self.equations.field(self.equations.leads_to(mode, surface)?).ok()?;
        let rate = guard.rate(field).ok()?;
        let rate = FormulaValues::new(&rate, "formulas of a guard", (1, 1)).ok()?;
        let along = self.passages(own, None).ok()?;
        let Way { arcs, .. } = along.observed.returns.way(point, parameter).ok()?;
        let state = &arcs.last()?.event()?.before;
        let zero = (0..3).all(|k| {
            let moved = |(axis, x): (usize, &f64)| {
                let by = if (axis + k).is_multiple_of(3) { MOVED } else { -MOVED };
                Jet::<1>([x + by * x.abs().max(1.0)])
            };
            let state: Vec<_> = state.iter().enumerate().map(moved).collect();
            let value = along.observed.value(&rate, &state, Jet([parameter]));
            value.is_ok_and(|value| value.value().abs() <= STAYS)
        });
        Some(zero)
    }
}
