//! Notes about motions: where they end, the events that they meet, and what could not be watched.

use super::followed::Moved;
use super::force_notes::contact;
use super::session::Session;
use crate::arc::{ArcEnd, ArcPlace, SolutionArc};
use crate::present::condition;
use crate::present::text::count;
use crate::trajectory::Trajectory;

/// Prints the notes about a motion, with its name if there are several: `event: r = 0.2: t = 0.5: …`.
pub(super) fn note_motion(session: &mut Session<'_>, moved: &Moved, name: Option<&str>) {
    let trajectory = &moved.trajectory;
    let mut notes = moved.notes.clone();
    note_events(&mut notes, trajectory);
    notes.extend(moved.contacts.iter().map(contact));
    note_unwatched(&mut notes, trajectory);
    note_fallbacks(&mut notes, trajectory);
    for note in notes {
        match (name, note.split_once(": ")) {
            (Some(name), Some((kind, text))) => session.note(&format!("{kind}: {name}: {text}")),
            _ => session.note(&note),
        }
    }
}

/// Notes where unilateral conditions met their limits.
fn note_events(notes: &mut Vec<String>, trajectory: &Trajectory) {
    let violated: Vec<&str> = trajectory.violated_at_start().map(|condition| condition.name).collect();
    if !violated.is_empty() {
        notes.push(format!("note: violated at the first instant: {}", violated.join(", ")));
    }
    for event in &trajectory.events {
        notes.push(condition::line(trajectory.model, event));
    }
    if trajectory.stopped {
        notes.push("note: the sweep stopped there; the last row is the event".to_owned());
    }
}

/// Stretches that are listed one by one; further ones are counted.
const MAX_LISTED_STRETCHES: usize = 3;

/// Notes where unilateral conditions changed too fast to be watched, or the motion could not be solved.
fn note_unwatched(notes: &mut Vec<String>, trajectory: &Trajectory) {
    for unwatched in trajectory.unwatched.iter().take(MAX_LISTED_STRETCHES) {
        notes.push(format!(
            "note: condition {unwatched}: it changes too fast there, or branches meet, and it may have met its limit more \
             often than reported; try more instants (--steps)"
        ));
    }
    if trajectory.unwatched.len() > MAX_LISTED_STRETCHES {
        notes.push(format!(
            "note: the same in {}",
            count(trajectory.unwatched.len() - MAX_LISTED_STRETCHES, "more place")
        ));
    }
}

/// Notes where full Newton took over from the plan. A motion that ended at a limit has no such note: there it always
/// takes over in the last steps, and the error has the reason.
fn note_fallbacks(notes: &mut Vec<String>, trajectory: &Trajectory) {
    if trajectory.q_at_limit.is_some() {
        return;
    }
    if let Some(first) = trajectory.fallbacks.first() {
        let steps = count(trajectory.fallbacks.len(), "internal step");
        notes.push(format!("note: full Newton took over from the plan on {steps}, first {first}"));
    }
}

/// Notes about the ends of an arc and what it passes.
pub(super) fn arc_notes(arc: &SolutionArc) -> Vec<String> {
    let place = |place: &ArcPlace| match place.drivers.as_slice() {
        [] => format!("note: {place}"),
        drivers => format!("note: {place}: {} turns back", drivers.join(", ")),
    };
    let mut notes: Vec<String> = arc.places.iter().map(place).collect();
    let end = |which: &str, end: ArcEnd| {
        let hint = if end == ArcEnd::TooLong { "; --to says where it ends" } else { "" };
        format!("note: {which}: {end}{hint}")
    };
    match arc.ends {
        [ArcEnd::Closed, _] => {
            notes.push("note: the curve is closed: all its dead centres and cusps are listed".to_owned())
        }
        [first, last] => notes.extend([end("at the first row", first), end("at the last row", last)]),
    }
    notes
}
