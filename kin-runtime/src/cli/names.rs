//! Looks up names that a user gave, and suggests corrections.

use super::failure::Failure;
use crate::measure::Measure;
use crate::model::Model;
use crate::present::table::wrapped;

/// Largest number of names that an error lists.
const LISTED: usize = 24;

/// The kind of a name that is looked up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NameKind {
    Parameter,
    Coordinate,
    Input,
    Mode,
    Quantity,
    Driver,
    #[cfg(feature = "design")]
    Point,
    #[cfg(feature = "equations")]
    Joint,
}

impl NameKind {
    fn singular(self) -> &'static str {
        match self {
            Self::Parameter => "parameter",
            Self::Coordinate => "coordinate",
            Self::Input => "input",
            Self::Mode => "mode",
            Self::Quantity => "quantity",
            Self::Driver => "driver",
            #[cfg(feature = "design")]
            Self::Point => "point",
            #[cfg(feature = "equations")]
            Self::Joint => "joint",
        }
    }
}

impl NameKind {
    /// All names of this kind; none for quantities, which [`find_quantity`] looks up.
    pub(super) fn names(self, model: &Model) -> Vec<&'static str> {
        match self {
            Self::Parameter => model.parameters.iter().map(|parameter| parameter.name).collect(),
            Self::Coordinate => model.coordinates.iter().map(|coordinate| coordinate.name).collect(),
            Self::Input => model.inputs.to_vec(),
            Self::Mode => model.plan.modes.iter().map(|mode| mode.name).collect(),
            Self::Driver => {
                let driving = model.rows.iter().filter(|row| row.driving || row.rheonomic);
                let mut names: Vec<&str> = driving.filter_map(|row| Some(model.joints.get(row.joint)?.name)).collect();
                names.dedup();
                names
            }
            #[cfg(feature = "design")]
            Self::Point => model.points.iter().map(|point| point.name).collect(),
            #[cfg(feature = "equations")]
            Self::Joint => model.joints.iter().map(|joint| joint.name).collect(),
            Self::Quantity => Vec::new(),
        }
    }

    /// For modes, the mode that a joint with this name belongs to.
    fn of_joint<'n>(self, name: &str, names: &[&'n str]) -> Option<&'n str> {
        let has = |mode: &&&str| mode.split('-').any(|joint| joint == name);
        names.iter().find(has).copied().filter(|_| self == Self::Mode)
    }

    /// Whether rates are among the names.
    fn has_rates(self) -> bool {
        self == Self::Quantity
    }

    fn plural(self) -> String {
        match self {
            Self::Quantity => "quantities".to_owned(),
            other => format!("{}s", other.singular()),
        }
    }
}

/// The quantity of this name.
pub(super) fn find_quantity(model: &'static Model, option: &str, name: &str) -> Result<Measure, Failure> {
    if let Some(found) = Measure::named(model, name) {
        return Ok(found);
    }
    let drivers = Measure::drivers(model);
    if let Some((quantity, driver)) = name.rsplit_once('/') {
        let quantity = find_quantity(model, option, quantity)?;
        search(option, NameKind::Driver, driver, &drivers, None)?;
        let message = format!(
            "`{}` has no velocity ratio; only coordinates, points, defines and joint quantities have one",
            quantity.name()
        );
        return Err(Failure::option(option, message));
    }
    // Transmission angles, which are few, are listed before points and forces, which may be many.
    let (angles, other_quantities): (Vec<_>, Vec<_>) =
        Measure::all(model).into_iter().partition(Measure::is_transmission);
    let coordinates = other_quantities.len().min(1 + 3 * model.coordinates.len());
    let (first, rest) = other_quantities.split_at(coordinates);
    let all: Vec<&str> = first.iter().chain(&angles).chain(rest).map(Measure::name).collect();
    let is_force = |(_, suffix): (&str, &str)| ["effort", "force", "force_x", "force_y", "moment"].contains(&suffix);
    let forces = (model.forces.is_none() && name.rsplit_once('.').is_some_and(is_force))
        .then_some("forces need masses or loads in the description: #[mass(…)], #[force(…)], …");
    let Err(failure) = search(option, NameKind::Quantity, name, &all, forces) else {
        return Err(Failure::option(option, format!("`{name}` is no quantity")));
    };
    let mut text = failure.to_string();
    if !drivers.is_empty() {
        text.push_str(&format!("\n{}", listing("  velocity ratios NAME/DRIVER to ", &drivers)));
    }
    Err(Failure::usage(text))
}

/// The index of `name` among the names of a kind. If the model has it as a name of another kind, the error says so.
pub(super) fn find(model: &Model, option: &str, kind: NameKind, name: &str) -> Result<usize, Failure> {
    search(option, kind, name, &kind.names(model), other_kind(model, kind, name))
}

fn search(option: &str, kind: NameKind, name: &str, names: &[&str], elsewhere: Option<&str>) -> Result<usize, Failure> {
    if let Some(index) = names.iter().position(|n| *n == name) {
        return Ok(index);
    }
    let noun = kind.singular();
    if names.is_empty() {
        let hint = elsewhere.map_or(String::new(), |hint| format!("; {hint}"));
        return Err(Failure::option(option, format!("`{name}`: this mechanism has no {}{hint}", kind.plural())));
    }
    let mut text = format!("no {noun} named `{name}`");
    let starts = |mark: char| names.iter().find(|n| n.strip_prefix(name).is_some_and(|rest| rest.starts_with(mark)));
    if let Some(element) = starts('[') {
        text.push_str(&format!("; it is an array: name its elements, `{element}`"));
    } else if let Some(hint) = elsewhere {
        text.push_str(&format!("; {hint}"));
    } else if let Some(near) = nearest(name, names).or(starts('.').copied()).or(kind.of_joint(name, names)) {
        text.push_str(&format!("; did you mean `{near}`?"));
    }
    text.push('\n');
    // Rates and accelerations are not listed one by one.
    let is_rate = |name: &str| {
        let base = name.strip_suffix("_ddot").or(name.strip_suffix("_dot"));
        kind.has_rates() && base.is_some_and(|base| names.contains(&base))
    };
    let listed: Vec<&str> = names.iter().copied().filter(|name| !is_rate(name)).collect();
    let lead = format!("  {}: ", kind.plural());
    if !kind.has_rates() {
        text.push_str(&listing(&lead, &listed));
    } else {
        // The whole list is printed, because no other output has it.
        let all = listed.iter().map(|name| (*name).to_owned());
        text.push_str(wrapped(&lead, all, ",", 96).trim_end());
        text.push_str("\n  with their rates NAME_dot and accelerations NAME_ddot; plots also take points and bodies, for their paths");
    }
    Err(Failure::option(option, text))
}

/// A hint for a name of another kind, with the option that takes it.
fn other_kind(model: &Model, kind: NameKind, name: &str) -> Option<&'static str> {
    let coordinate = model.coordinates.iter().any(|c| c.name == name);
    let parameter = model.parameters.iter().any(|p| p.name == name);
    let input = model.inputs.contains(&name);
    let mode = model.plan.modes.iter().any(|mode| mode.name == name);
    match kind {
        NameKind::Coordinate if parameter => Some("it is a parameter, which --set sets"),
        NameKind::Parameter if coordinate => {
            Some("it is a coordinate: --guess says where it starts, --given prescribes it")
        }
        NameKind::Parameter | NameKind::Coordinate if input => Some("it is an input, which --input gives"),
        NameKind::Parameter | NameKind::Coordinate if mode => Some("it is an assembly mode, which --mode chooses"),
        NameKind::Input if parameter => Some("it is a parameter, which --set sets"),
        NameKind::Input if coordinate => Some("it is a coordinate, which --given prescribes"),
        _ => None,
    }
}

/// The names, wrapped, without a final line break.
pub(super) fn listing(lead: &str, names: &[&str]) -> String {
    let shown = names.iter().take(LISTED).map(|n| (*n).to_owned());
    let rest = names.len().saturating_sub(LISTED);
    let more = (rest > 0).then(|| format!("… and {rest} more (`info --format json` has them all)"));
    wrapped(lead, shown.chain(more), ",", 96).trim_end().to_owned()
}

/// The most similar name, when one is similar enough to be what was meant.
pub(super) fn nearest<'n>(name: &str, names: &[&'n str]) -> Option<&'n str> {
    let lower = name.to_lowercase();
    names
        .iter()
        .map(|n| (n.to_lowercase(), *n))
        .map(|(other, n)| (strsim::osa_distance(&lower, &other), strsim::jaro(&lower, &other), n))
        .filter(|(edits, _, n)| *edits <= n.chars().count().max(3) / 3)
        .min_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)))
        .map(|(_, _, n)| n)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::fixture::{CrossHead, DRIVEN};
    use crate::mechanism::Mechanism;

    const NAMES: &[&str] = &["crank.x", "crank.phi", "coupler.phi", "l[0]", "l[1]"];

    fn message(name: &str) -> String {
        let model = CrossHead::<DRIVEN>::model();
        let found = search("--set", NameKind::Parameter, name, NAMES, other_kind(model, NameKind::Parameter, name));
        found.map_or_else(|e| e.to_string(), |i| format!("found {i}"))
    }

    #[test]
    fn finds_and_suggests() {
        assert_eq!(message("crank.phi"), "found 1");
        assert!(message("crnak.phi").starts_with("--set: no parameter named `crnak.phi`; did you mean `crank.phi`?\n"));
        assert!(message("Crank.Phi").contains("did you mean `crank.phi`?"));
        assert!(!message("something").contains("did you mean"));
        assert!(message("something").ends_with("\n  parameters: crank.x, crank.phi, coupler.phi, l[0], l[1]"));
        assert!(message("crank").contains("did you mean `crank.x`?"));
        assert!(message("s").contains("`s`; it is a coordinate: --guess"));
        let modes = |name| search("--mode", NameKind::Mode, name, &["A-B-D", "E-F-G"], None);
        assert!(modes("F").is_err_and(|e| e.to_string().contains("did you mean `E-F-G`?")));
        assert!(message("l").contains("it is an array: name its elements, `l[0]`"));
    }

    #[test]
    fn says_so_when_there_are_none() {
        let error = |name| find(CrossHead::<DRIVEN>::model(), "--input", NameKind::Input, name);
        assert_eq!(error("u"), Err(Failure::usage("--input: `u`: this mechanism has no inputs")));
        let set = "--input: `r`: this mechanism has no inputs; it is a parameter, which --set sets";
        assert_eq!(error("r"), Err(Failure::usage(set)));
    }
}
