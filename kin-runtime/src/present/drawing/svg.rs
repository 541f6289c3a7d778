//! A scene as SVG: every part is written once, with animations that move it.

use super::arrows::ForceScale;
use super::carrier::Carrier;
use super::labels::{self, Side};
use super::palette::Palette;
use super::part::{Ink, LabelKind, Part, Stroke};
use super::scene::Scene;
use super::view::{Pixels, View, short};
use crate::present::number::rounded;
use core::fmt::Write;

/// Colour of the ground, of pins and of massless links.
const GROUND: &str = "#4b5563";

/// Colour of forces of joints.
const REACTION: &str = "#dc2626";
/// Colour of forces of drivers.
const EFFORT: &str = "#7c3aed";
/// Colour of loads.
const LOAD: &str = "#0284c7";
/// The head of an arrow, its tip at the origin.
const HEAD: &str = "M0,0L-10,4L-8,0L-10,-4Z";
/// The radius of the arrow of the largest couple.
const COUPLE_RADIUS: f64 = 18.0;

/// Largest length of the arrow that shows the scale of forces, relative to the picture.
const MAX_SCALE_ARROW: f64 = 0.2;

/// Style of names.
const STYLE: &str = "<style>.name{font:12px system-ui,sans-serif;paint-order:stroke;stroke:#fff;stroke-width:3px;\
stroke-linejoin:round;fill:#1f2937}.joint{font-size:10px;fill:#6b7280}</style>\n";

/// A picture of one instant.
pub(crate) struct Still {
    /// Its carriers, one group each, in the order of the scene.
    pub(crate) groups: Vec<String>,
}

/// Every carrier as a group that has no pose yet.
pub(crate) fn still(scene: &Scene, view: &View) -> Still {
    let symbol = view.symbol(scene);
    let sides = labels::sides(scene, view, symbol);
    let groups = scene.carriers.iter().zip(sides).map(|(carrier, side)| {
        let pen = Pen { view, symbol, palette: &scene.palette, side };
        let mut out = String::new();
        carrier.parts.iter().for_each(|one| pen.part(&mut out, one));
        out
    });
    Still { groups: groups.collect() }
}

/// An animated picture, which repeats the motion every `duration` seconds; `unit` is that of forces.
pub(crate) fn animated(
    scene: &Scene,
    view: &View,
    title: &str,
    duration: f64,
    names: bool,
    unit: Option<&str>,
) -> String {
    let [width, height] = view.size.map(short);
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
         height=\"{height}\" role=\"img\">\n<title>{}</title>\n{}\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n",
        escaped(title),
        if names { STYLE } else { "" }
    );
    let Still { groups } = still(scene, view);
    let shown = |carrier: &Carrier| names || !matches!(carrier.parts[..], [Part::Name(..)]);
    for (carrier, group) in scene.carriers.iter().zip(groups).filter(|(carrier, _)| shown(carrier)) {
        let [x, y, angle] = view.pose(scene.pose(carrier, 0)).map(short);
        let _ = write!(out, "<g transform=\"translate({x},{y})\">");
        if moves(carrier) {
            let place = |k| {
                let [x, y, _] = view.pose(scene.pose(carrier, k)).map(short);
                format!("{x},{y}")
            };
            out.push_str(&animation("translate", scene, duration, &place));
        }
        let _ = write!(out, "<g transform=\"rotate({angle})\">");
        if turns(carrier) {
            let turned = |k| short(view.pose(scene.pose(carrier, k))[2]).to_string();
            out.push_str(&animation("rotate", scene, duration, &turned));
        }
        let Some(size) = carrier.sizes.first() else {
            let _ = writeln!(out, "{group}</g></g>");
            continue;
        };
        let grows = animation("scale", scene, duration, &|k| exact(carrier.size(k)));
        let _ = writeln!(out, "<g transform=\"scale({})\">{grows}{group}</g></g></g>", exact(*size));
    }
    if let Some(scale) = &scene.forces {
        out.push_str(&force_scale(view, scale, unit));
    }
    out.push_str("</svg>\n");
    out
}

/// A number without a unit, such as a share of the largest force.
fn exact(x: f64) -> String {
    ((x * 1e4).round() / 1e4).to_string()
}

/// An arrow that is as long as a force of 1, 2 or 5 times a power of ten, in the lower right corner.
pub(crate) fn force_scale(view: &View, scale: &ForceScale, unit: Option<&str>) -> String {
    let by_force = scale.length / scale.largest * view.scale;
    let force = round_below((MAX_SCALE_ARROW * view.size[0] / by_force).min(scale.largest));
    let (long, [right, low]) = (force * by_force, view.size.map(|size| size.round() - 10.0));
    let [from, text] = [right - long, low - 6.0].map(short);
    let shaft = short(right - 5.0);
    let label = format!("{}{}{}", rounded(force), if unit.is_some() { " " } else { "" }, escaped(unit.unwrap_or("")));
    format!(
        "<g class=\"force\"><path d=\"M{from},{low}H{shaft}\" stroke=\"{REACTION}\" stroke-width=\"2.5\"/>\
         <path d=\"{HEAD}\" transform=\"translate({right},{low})\" fill=\"{REACTION}\"/><text x=\"{right}\" y=\"{text}\" \
         text-anchor=\"end\" style=\"font:11px system-ui,sans-serif;fill:#1f2937\">{label}</text></g>\n"
    )
}

/// The greatest number that is 1, 2 or 5 times a power of ten and not greater than `most`.
pub(crate) fn round_below(most: f64) -> f64 {
    let power = 10_f64.powf(most.log10().floor());
    [5.0, 2.0, 1.0].into_iter().map(|digit| digit * power).find(|value| *value <= most).unwrap_or(power)
}

/// A transformation with its value at every instant; nothing if there is only one.
fn animation(kind: &str, scene: &Scene, duration: f64, value: &dyn Fn(usize) -> String) -> String {
    if scene.times.len() < 2 {
        return String::new();
    }
    let values: Vec<String> = (0..scene.times.len()).map(value).collect();
    let (first, last) = (scene.times.first().copied().unwrap_or(0.0), scene.times.last().copied().unwrap_or(1.0));
    let times: Vec<f64> = scene.times.iter().map(|t| ((t - first) / (last - first) * 1e5).round() / 1e5).collect();
    // SVG animations assume equal steps of time.
    let step = 1.0 / (times.len().max(2) - 1) as f64;
    let even = times.iter().enumerate().all(|(k, time)| (time - k as f64 * step).abs() < 2e-5);
    let times: Vec<String> = times.iter().map(f64::to_string).collect();
    let key_times = if even { String::new() } else { format!("keyTimes=\"{}\" ", times.join(";")) };
    format!(
        "<animateTransform attributeName=\"transform\" type=\"{kind}\" dur=\"{duration}s\" repeatCount=\"indefinite\" \
         {key_times}values=\"{}\"/>",
        values.join(";")
    )
}

fn moves(carrier: &Carrier) -> bool {
    carrier.poses.iter().any(|pose| pose[..2] != carrier.poses[0][..2])
}

fn turns(carrier: &Carrier) -> bool {
    carrier.poses.iter().any(|pose| pose[2] != carrier.poses[0][2])
}

/// The settings with which the parts of a carrier are drawn.
struct Pen<'a> {
    view: &'a View,
    /// Half the width of pins and blocks.
    symbol: f64,
    palette: &'a Palette,
    /// The position of the carrier's name.
    side: Side,
}

impl Pen<'_> {
    fn ink(&self, ink: Ink) -> &'static str {
        match ink {
            Ink::Body(body) => self.palette.body(body),
            Ink::Ground => GROUND,
            Ink::Path(point) => self.palette.point(point),
            Ink::Reaction => REACTION,
            Ink::Effort => EFFORT,
            Ink::Load => LOAD,
        }
    }

    /// Errors are ignored: writing to a `String` never fails.
    fn part(&self, out: &mut String, part: &Part) {
        let (view, s) = (self.view, self.symbol);
        let _ = match part {
            Part::Bar { points, ink: own } => {
                let (c, w) = (self.ink(*own), short(2.0 * s));
                let fill = if points.len() > 2 { c } else { "none" };
                write!(
                    out,
                    "<path d=\"{}\" fill=\"{fill}\" fill-opacity=\".25\" stroke=\"{c}\" stroke-opacity=\".8\" \
                 stroke-width=\"{w}\" stroke-linejoin=\"round\" stroke-linecap=\"round\"/>",
                    path(points, view, points.len() > 2)
                )
            }
            Part::Line { points, ink: own, stroke, closed } => {
                let c = self.ink(*own);
                let (width, more) = match stroke {
                    Stroke::Full => (2.5, if *closed { " fill-opacity=\".2\"" } else { "" }),
                    Stroke::Thin => (1.0, ""),
                    Stroke::Dashed => (0.8, " stroke-dasharray=\"6 3 1 3\""),
                };
                let fill = if *closed && *stroke == Stroke::Full { c } else { "none" };
                write!(
                    out,
                    "<path d=\"{}\" fill=\"{fill}\" stroke=\"{c}\" stroke-width=\"{width}\" stroke-linejoin=\"round\"{more}/>",
                    path(points, view, *closed)
                )
            }
            Part::Path { points, controls, ink: own } => {
                let (c, curve) = (self.ink(*own), smooth(points, controls, view));
                write!(
                    out,
                    "<path d=\"{curve}\" fill=\"none\" stroke=\"{c}\" stroke-width=\"1.5\" stroke-linejoin=\"round\" \
                 stroke-opacity=\".85\" class=\"path\"/>"
                )
            }
            Part::Pin(p) => circle(out, view.local(*p), 0.6 * s, "#fff", GROUND, 1.5),
            Part::Foot(p) => foot(out, view.local(*p), s),
            Part::Weld(p) => {
                let [x, y] = view.local(*p).0.map(|x| short(x - 0.7 * s));
                let side = short(1.4 * s);
                write!(out, "<rect x=\"{x}\" y=\"{y}\" width=\"{side}\" height=\"{side}\" fill=\"{GROUND}\"/>")
            }
            Part::Hatching { from, to } => hatching(out, view.local(*from).0, view.local(*to).0),
            Part::Slot { from, to, ink: own } => {
                let (c, line) = (self.ink(*own), path(&[*from, *to], view, false));
                let wide = short(2.4 * s);
                let narrow = short(1.4 * s);
                write!(
                    out,
                    "<path d=\"{line}\" stroke=\"{c}\" stroke-width=\"{wide}\" stroke-linecap=\"round\"/>\
                 <path d=\"{line}\" stroke=\"#fff\" stroke-width=\"{narrow}\" stroke-linecap=\"round\"/>"
                )
            }
            Part::Block(own) => {
                let (w, h) = (short(3.6 * s), short(2.2 * s));
                let (x, y, c) = (short(-1.8 * s), short(-1.1 * s), self.ink(*own));
                write!(
                    out,
                    "<rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\" rx=\"1.5\" fill=\"#fff\" stroke=\"{c}\" \
                 stroke-width=\"2\"/><rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\" rx=\"1.5\" fill=\"{c}\" \
                 fill-opacity=\".45\"/>"
                )
            }
            Part::Disc { centre, radius, ink: own } => {
                let [x, y] = view.local(*centre).0.map(short);
                let (r, c) = (short(radius.abs() * view.scale), self.ink(*own));
                let opacity = if *radius < 0.0 { 0.0 } else { 0.18 };
                let edge = short(x + r);
                write!(
                    out,
                    "<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\" fill=\"{c}\" fill-opacity=\"{opacity}\" stroke=\"{c}\" \
                 stroke-width=\"2.5\"/><path d=\"M{x},{y}L{edge},{y}\" stroke=\"{c}\" stroke-width=\"1.5\"/>"
                )
            }
            Part::Dot(p, own) => circle(out, view.local(*p), 0.55 * s, self.ink(*own), "#fff", 1.0),
            Part::Target(p) => {
                let [x, y] = view.local(*p).0;
                let [left, right, top, bottom] = [x - 0.8 * s, x + 0.8 * s, y - 0.8 * s, y + 0.8 * s].map(short);
                write!(
                    out,
                    "<path d=\"M{left},{top}L{right},{bottom}M{left},{bottom}L{right},{top}\" fill=\"none\" \
                 stroke=\"#000\" stroke-width=\"1.2\" class=\"target\"/>"
                )
            }
            Part::Tread => {
                let (w, h) = (short(4.0 * s), short(1.4 * s));
                let (x, y) = (short(-2.0 * s), short(-0.7 * s));
                write!(out, "<rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\" rx=\"3\" fill=\"{GROUND}\"/>")
            }
            Part::Shaft(length, own) => {
                let (c, l) = (self.ink(*own), short(length * view.scale));
                write!(
                    out,
                    "<path d=\"M0,0H{l}\" stroke=\"{c}\" stroke-width=\"2.5\" vector-effect=\"non-scaling-stroke\" \
                 class=\"force\"/>"
                )
            }
            Part::Head(own) => write!(out, "<path d=\"{HEAD}\" fill=\"{}\" class=\"force\"/>", self.ink(*own)),
            Part::Turn { clockwise, ink: own } => {
                // Three quarters of a circle, from its right; y points down.
                let (c, r, up) = (self.ink(*own), COUPLE_RADIUS, if *clockwise { 1.0 } else { -1.0 });
                let (sweep, y) = (u8::from(*clockwise), -up * r);
                let head = 6.0 * up;
                write!(
                    out,
                    "<path d=\"M{r},0A{r},{r} 0 1 {sweep} 0,{y}\" fill=\"none\" stroke=\"{c}\" stroke-width=\"2.5\" \
                 vector-effect=\"non-scaling-stroke\" class=\"force\"/>\
                 <path d=\"M9,{y}L-1,{}V{}Z\" fill=\"{c}\" class=\"force\"/>",
                    y - head,
                    y + head
                )
            }
            Part::Name(name, kind) => {
                let class = match kind {
                    LabelKind::Body => "name body",
                    LabelKind::Joint => "name joint",
                    LabelKind::Point => "name point",
                };
                let Side { at, anchor } = self.side;
                let [x, y] = at.map(short);
                let anchor = if anchor == "start" { String::new() } else { format!(" text-anchor=\"{anchor}\"") };
                write!(out, "<text x=\"{x}\" y=\"{y}\"{anchor} class=\"{class}\">{}</text>", escaped(name))
            }
        };
    }
}

fn circle(out: &mut String, p: Pixels, r: f64, fill: &str, stroke: &str, width: f64) -> core::fmt::Result {
    let ([x, y], r) = (p.0.map(short), short(r));
    write!(
        out,
        "<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\" fill=\"{fill}\" stroke=\"{stroke}\" stroke-width=\"{width}\"/>"
    )
}

/// A pin on its foot, the foot hatched underneath.
fn foot(out: &mut String, p: Pixels, s: f64) -> core::fmt::Result {
    let [x, y] = p.0;
    let (left, right, down) = (x - 1.5 * s, x + 1.5 * s, y + 2.0 * s);
    write!(
        out,
        "<path d=\"M{}L{}L{}Z\" fill=\"#fff\" stroke=\"{GROUND}\" stroke-width=\"1.5\" stroke-linejoin=\"round\"/>",
        Pixels([x, y]),
        Pixels([left, down]),
        Pixels([right, down])
    )?;
    hatching(out, [left - 0.5 * s, down], [right + 0.5 * s, down])?;
    circle(out, p, 0.6 * s, "#fff", GROUND, 1.5)
}

/// A line with strokes on its right, in the directions of a drawing whose y points up.
fn hatching(out: &mut String, from: [f64; 2], to: [f64; 2]) -> core::fmt::Result {
    let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
    let length = dx.hypot(dy).max(1e-9);
    let (ux, uy) = (dx / length, dy / length);
    let count = (length / 7.0).ceil().clamp(1.0, 400.0) as usize;
    let mut strokes = format!("M{}L{}", Pixels(from), Pixels(to));
    for k in 0..count {
        let along = (k as f64 + 0.9) / count as f64 * length;
        let [x, y] = [from[0] + along * ux, from[1] + along * uy];
        let end = Pixels([x - 5.0 * ux - 5.0 * uy, y - 5.0 * uy + 5.0 * ux]);
        let _ = write!(strokes, "M{}L{end}", Pixels([x, y]));
    }
    write!(out, "<path d=\"{strokes}\" fill=\"none\" stroke=\"{GROUND}\" stroke-width=\"1.2\"/>")
}

fn path(points: &[[f64; 2]], view: &View, closed: bool) -> String {
    let mut out = String::new();
    for (k, &point) in points.iter().enumerate() {
        let _ = write!(out, "{}{}", if k == 0 { "M" } else { "L" }, view.local(point));
    }
    if closed {
        out.push('Z');
    }
    out
}

/// A curve through points, piece by piece.
fn smooth(points: &[[f64; 2]], controls: &[[[f64; 2]; 2]], view: &View) -> String {
    let mut out = points.first().map_or_else(String::new, |&first| format!("M{}", view.local(first)));
    for ([from, to], &end) in controls.iter().zip(points.iter().skip(1)) {
        let _ = write!(out, "C{} {} {}", view.local(*from), view.local(*to), view.local(end));
    }
    out
}

/// A text with `<`, `>`, `&` and quotes escaped.
pub(crate) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
