//! A motion as carriers and their parts.

use super::arrows::{Arrows, ForceScale};
use super::carrier::Carrier;
use super::links::Links;
use super::palette::Palette;
use super::part::{LabelKind, Part};
use super::subject::{Pose, Subject, distance};
use super::{joints, outlines, paths, slides};
use crate::model::Frame;

/// A motion that can be drawn.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Scene {
    /// The times of the instants.
    pub(crate) times: Vec<f64>,
    /// The carriers, from back to front.
    pub(crate) carriers: Vec<Carrier>,
    /// The colours of its bodies and points.
    pub(super) palette: Palette,
    /// The scale of forces, where they are shown.
    pub(crate) forces: Option<ForceScale>,
}

impl Scene {
    /// A scene without carriers.
    #[cfg(test)]
    pub(super) fn empty(times: Vec<f64>) -> Self {
        Self { times, carriers: Vec::new(), palette: Palette::default(), forces: None }
    }

    /// The drawing of a motion.
    pub(crate) fn new(subject: &Subject<'_>) -> Self {
        let model = subject.model;
        let (mut behind, mut front) = (Vec::new(), Vec::new());
        let mut links = Links::new(subject, &mut front);
        for (place, joint) in model.joints.iter().enumerate() {
            joints::draw(subject, joint, &mut links, &mut behind, &mut front);
            outlines::draw(subject, place, joint, &mut links);
        }
        for (body, info) in model.bodies.iter().enumerate() {
            slides::held(subject, body, info, &mut links, &mut front);
        }
        let mut paths = paths::paths(subject, &mut links);
        paths.extend(subject.targets.iter().map(|&place| Part::Target(place)));
        let names = names(subject, &links);
        let arrows = Arrows::new(subject, &links);
        let mut carriers = vec![ground(links.take_ground(), paths)];
        carriers.extend(behind);
        carriers.extend(links.into_carriers(subject));
        carriers.extend(front);
        carriers.extend(arrows.carriers);
        carriers.extend(names);
        carriers.retain(|carrier| carrier.body.is_some() || !carrier.parts.is_empty());
        let times = subject.snapshots.iter().map(|snapshot| snapshot.t).collect();
        Self { times, carriers, palette: Palette::of(model), forces: arrows.scale }
    }

    /// The pose of a carrier at an instant.
    pub(crate) fn pose(&self, carrier: &Carrier, instant: usize) -> Pose {
        *carrier.poses.get(instant).or(carrier.poses.last()).unwrap_or(&[0.0; 3])
    }
}

fn ground(parts: Vec<Part>, paths: Vec<Part>) -> Carrier {
    Carrier::new(vec![[0.0; 3]], paths.into_iter().chain(parts).collect())
}

/// A name, and its place at every instant.
struct NamedTrack<'a> {
    names: Vec<&'a str>,
    kind: LabelKind,
    track: Vec<[f64; 2]>,
}

/// Names of bodies, pins and points, each upright on a carrier of its own.
fn names(subject: &Subject<'_>, links: &Links) -> Vec<Carrier> {
    let model = subject.model;
    let bodies = model.bodies.iter().enumerate().filter_map(|(body, info)| {
        let place = links.middle(body)?;
        let poses = subject.instants().map(|k| {
            let [x, y] = super::subject::placed(subject.pose(k, Frame::Body(body)), place);
            [x, y, 0.0]
        });
        Some(label(poses.collect(), info.name, LabelKind::Body))
    });
    // Names of the same place share a label.
    let mut places: Vec<NamedTrack<'_>> = Vec::new();
    let pins = links.pins().iter().map(|(name, track)| (name.as_str(), LabelKind::Joint, track.clone()));
    let points = model.points.iter().enumerate().map(|(place, info)| {
        let at = |k: usize| subject.snapshots[k].points.get(place).copied().unwrap_or_default();
        (info.name, LabelKind::Point, subject.instants().map(at).collect())
    });
    for (name, kind, track) in pins.chain(points) {
        let same = |other: &[[f64; 2]]| {
            other.len() == track.len() && other.iter().zip(&track).all(|(&a, &b)| distance(a, b) <= 1e-6 * links.size())
        };
        match places.iter_mut().find(|place| same(&place.track)) {
            Some(place) => {
                place.kind = kind;
                if !place.names.contains(&name) {
                    place.names.push(name);
                }
            }
            None => places.push(NamedTrack { names: vec![name], kind, track }),
        }
    }
    let places = places.into_iter().map(|NamedTrack { names, kind, track }| {
        label(track.into_iter().map(|[x, y]| [x, y, 0.0]).collect(), &together(&names), kind)
    });
    bodies.chain(places).collect()
}

/// The label for several names of one place; if they are many, members of families are written without their indices.
fn together(names: &[&str]) -> String {
    if names.len() < 3 {
        return names.join(", ");
    }
    let mut families: Vec<&str> = Vec::new();
    for name in names.iter().map(|name| name.split_once('[').map_or(*name, |(family, _)| family)) {
        if !families.contains(&name) {
            families.push(name);
        }
    }
    families.join(", ")
}

fn label(poses: Vec<Pose>, name: &str, kind: LabelKind) -> Carrier {
    Carrier::new(poses, vec![Part::Name(name.to_owned(), kind)])
}
