//! The programs that compute forces as lists of numbers, and the meaning of these numbers.

use super::equilibrium::Equilibrium;
use super::free_bodies::FreeBodies;
use super::kinds::acts;
use super::load::Acting;
use super::reactions::{Effort, ReactionForce, ReactionWriter};
use super::transpose::transpose;
use crate::constraint::{Assembly, Frame, indexed};
use crate::expr::{ExprId, Graph, Symbol, velocity_derivatives};
use crate::mechanism::Mechanism;
use crate::plan::{Linear, ZeroTest};
use crate::program::{Program, Slot, lower};
use crate::system::KinematicSystem;
use crate::vocabulary::{LoadKind, StatementKind};

/// The results of a spring: length or angle, its rate, tension or torque on the second body, energy, damper power.
#[derive(Clone, Debug, PartialEq)]
pub struct SpringForce {
    /// Its name.
    pub name: String,
    /// True for a torsion spring.
    pub turns: bool,
    /// The index of its first number among the results.
    pub place: usize,
    /// Its numbers.
    pub numbers: [ExprId; 5],
}

/// A mass and its moment of inertia, which must not be negative.
#[derive(Clone, Debug, PartialEq)]
pub struct MassValues {
    /// Its body.
    pub on: Frame,
    /// The index of its first number among the results.
    pub place: usize,
}

/// The force or couple of gravity, an applied load or a spring on a body.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadForce {
    /// Its name; `gravity` for the weight of a mass.
    pub name: String,
    /// The body.
    pub on: Frame,
    /// The index of its first number among those of all loads.
    pub place: usize,
    /// True for a force: four numbers, its point and its components. Otherwise a couple: one number.
    pub is_force: bool,
}

/// The programs that compute the forces of a mechanism.
///
/// The order of the results is: the shaking force and its moment about the origin, the same of the inertia forces
/// alone; the energies (kinetic, of gravity, of springs); the powers of drivers, of applied loads and of dampers; the
/// rate of the total energy; λ; efforts, reactions, springs; masses with their moments of inertia.
#[derive(Clone, Debug)]
pub struct Forces {
    /// r = Q − M q̈, one number for each coordinate, for a numerical solution of Φ_qᵀ λ = r.
    pub generalized: Program,
    /// All results. λ is computed along the plan if possible; otherwise it is an argument, which is passed as the
    /// right-hand sides.
    pub results: Program,
    /// All results with λ as an argument, if `results` computes λ.
    pub of_multipliers: Option<Program>,
    /// The number of results.
    pub count: usize,
    /// Efforts.
    pub efforts: Vec<Effort>,
    /// Reactions.
    pub reactions: Vec<ReactionForce>,
    /// Springs.
    pub springs: Vec<SpringForce>,
    /// Masses.
    pub masses: Vec<MassValues>,
    /// The forces and couples of loads on bodies, for pictures.
    pub exerted: Program,
    /// The meaning of the numbers of `exerted`.
    pub loads: Vec<LoadForce>,
}

/// The number of results before λ: shaking, inertia, energies, powers, the rate of the total energy.
const TOTALS: usize = 13;

/// The forces of a mechanism; `None` if it has neither masses nor loads. `linear` is the solution of Φ_q x = b along
/// the plan, if there is one.
pub fn forces(mechanism: &Mechanism, system: &KinematicSystem, linear: Option<Linear>) -> Option<Forces> {
    if mechanism.loads.is_empty() {
        return None;
    }
    let set = &system.set;
    let (graph, solution) = match linear {
        Some(Linear { graph, solution }) => (graph, Some(solution)),
        None => (set.graph.clone(), None),
    };
    let mut bodies = FreeBodies::new(mechanism, set, graph);
    let (acting, mut springs) = all_acting(&mut bodies);
    let (loads, exerted) = on_bodies(&acting);
    let equilibrium = Equilibrium::new(&mut bodies, set, &acting);
    let rows = set.rows.len();
    // With more rows than coordinates λ is not unique, and the plan does not determine it.
    let along_plan = solution.filter(|x| x.len() == rows);
    let solved = along_plan.and_then(|x| transpose(&mut bodies.a.graph, &x, &equilibrium.posed, rows));
    let is_solved = solved.is_some();
    let given: Vec<ExprId> = (0..rows).map(|row| bodies.a.graph.symbol(Symbol::Right(row as u32))).collect();
    let zero_test = ZeroTest::new(set.coordinates.len());
    let mut writer =
        ReactionWriter { bodies: &mut bodies, system, equilibrium: &equilibrium, multipliers: Vec::new(), zero_test };
    let lambda = solved.unwrap_or_else(|| given.clone());
    let of_multipliers = is_solved.then(|| writer.results(&given, &acting, &mut springs.clone()).list);
    let Results { list: results, efforts, reactions, masses } = writer.results(&lambda, &acting, &mut springs);
    let graph = &bodies.a.graph;
    let program = |list: &[ExprId]| {
        lower(graph, &list.iter().enumerate().map(|(k, id)| (Slot::Entry(k), *id)).collect::<Vec<_>>())
    };
    Some(Forces {
        generalized: program(&equilibrium.posed),
        results: program(&results),
        of_multipliers: of_multipliers.map(|list| program(&list)),
        count: results.len(),
        efforts,
        reactions,
        springs,
        masses,
        exerted: program(&exerted),
        loads,
    })
}

/// The forces and couples of loads on bodies: the meaning of the numbers, and the numbers.
fn on_bodies(acting: &[Acting]) -> (Vec<LoadForce>, Vec<ExprId>) {
    let (mut loads, mut numbers) = (Vec::new(), Vec::new());
    for acting in acting {
        for exerted in acting.exerted.iter().filter(|exerted| exerted.on != Frame::Ground) {
            let (on, place, is_force) = (exerted.on, numbers.len(), exerted.force.is_some());
            loads.push(LoadForce { name: acting.name.clone(), on, place, is_force });
            numbers.extend(exerted.force.iter().flatten().flatten());
            numbers.extend(exerted.couple);
        }
    }
    (loads, numbers)
}

/// All results, and the efforts, reactions and masses among them.
struct Results {
    list: Vec<ExprId>,
    efforts: Vec<Effort>,
    reactions: Vec<ReactionForce>,
    masses: Vec<MassValues>,
}

impl ReactionWriter<'_, '_> {
    /// The results for multipliers λ; stores the index of its first number in every spring.
    fn results(&mut self, lambda: &[ExprId], acting: &[Acting], springs: &mut [SpringForce]) -> Results {
        let of_holds = self.equilibrium.multipliers_of_holds(self.bodies, lambda);
        self.multipliers = lambda.iter().copied().chain(of_holds).collect();
        let (mut efforts, mut reactions) = (self.efforts(), self.reactions());
        let mut list = totals(&mut self.bodies.a.graph, acting, &efforts).to_vec();
        list.extend(lambda);
        for effort in &mut efforts {
            effort.place = list.len();
            list.extend(effort.numbers);
        }
        for reaction in &mut reactions {
            reaction.place = list.len();
            list.extend(reaction.force.iter().flatten().flatten());
            list.extend(reaction.moment);
            list.extend(reaction.couples.iter().map(|(_, couple)| *couple));
            list.extend(&reaction.generalized);
            list.extend(reaction.normal.iter().chain(&reaction.tangential).chain(&reaction.tension));
        }
        for spring in springs {
            spring.place = list.len();
            list.extend(spring.numbers);
        }
        let mut masses = Vec::new();
        for (on, numbers) in acting.iter().filter_map(|acting| acting.mass) {
            masses.push(MassValues { on, place: list.len() });
            list.extend(numbers);
        }
        Results { list, efforts, reactions, masses }
    }
}

/// The actions of all masses and loads, and the springs among them. Gravity comes first, because masses use its field.
pub(super) fn all_acting(bodies: &mut FreeBodies<'_>) -> (Vec<Acting>, Vec<SpringForce>) {
    let (mut all, mut springs) = (Vec::new(), Vec::new());
    let loads = &bodies.a.mechanism.loads;
    let is_field = |kind| kind == StatementKind::Load(LoadKind::Gravity);
    let (fields, other_loads): (Vec<_>, Vec<_>) = loads.iter().partition(|load| is_field(load.operands.kind()));
    for load in fields.into_iter().chain(other_loads) {
        for (shown, index) in Assembly::instances(load.range) {
            bodies.a.index = index;
            let Some(mut acting) = acts(bodies, &load.operands) else { continue };
            acting.name = match load.operands.kind() {
                StatementKind::Load(LoadKind::Mass) => LoadKind::Gravity.keyword().to_owned(),
                _ => indexed(&load.name, shown.is_some(), index),
            };
            if let Some(numbers) = acting.spring {
                let turns = load.operands.kind() == StatementKind::Load(LoadKind::TorsionSpring);
                springs.push(SpringForce { name: acting.name.clone(), turns, place: 0, numbers });
            }
            all.push(acting);
        }
    }
    (all, springs)
}

/// Shaking, inertia, energies and powers.
fn totals(graph: &mut Graph, acting: &[Acting], efforts: &[Effort]) -> [ExprId; TOTALS] {
    let zero = graph.zero();
    let mut totals = [zero; TOTALS];
    let mut add = |index: usize, value: ExprId| totals[index] = graph.add(totals[index], value);
    for acting in acting {
        for c in 0..3 {
            add(c, acting.outside[c]);
            add(c, acting.inertia[c]);
            add(3 + c, acting.inertia[c]);
        }
        add(6, acting.kinetic);
        add(7, acting.gravity);
        add(8, acting.elastic);
        add(10, acting.applied_power);
        add(11, acting.damper_power);
    }
    for effort in efforts {
        let power = graph.mul(effort.numbers[0], effort.numbers[1]);
        totals[9] = graph.add(totals[9], power);
    }
    let elastic = graph.add(totals[7], totals[8]);
    let energy = graph.add(totals[6], elastic);
    totals[12] = rate(graph, energy);
    totals
}

/// The time derivative of an expression in q, q̇ and t.
fn rate(graph: &mut Graph, value: ExprId) -> ExprId {
    let Some(jet) = velocity_derivatives(graph, &[value]).pop() else { return graph.zero() };
    jet.gradient.into_iter().fold(jet.rest, |sum, (k, coefficient)| {
        let q_ddot = graph.symbol(Symbol::Acceleration(k));
        let product = graph.mul(coefficient, q_ddot);
        graph.add(sum, product)
    })
}
