//! An atlas of coupler curves: which four-bar draws a curve like this one?
//!
//! The study keeps the paths of coupler points of random Grashof four-bars, all of one size and in one direction. The search
//! compares a curve with all of them, wherever it begins, in both directions and mirrored, and draws the nearest ones. The
//! same table is a data set in the style of LINKS (Heyrani Nobari et al., 2022): `--rows 1e6` makes a million of them.
//!
//! ```text
//! cargo run --release --example atlas -- run examples/atlas.toml --out target/atlas
//! cargo run --release --example atlas -- search target/atlas nearest.svg
//! cargo run --release --example atlas -- search target/atlas nearest.svg curve.csv
//! ```
//!
//! The last line searches for a curve of your own, x and y of a point in every line; without one it is a half circle that is
//! closed by a straight line.

use kin_runtime::mechanism;
use kin_study::arrow::array::AsArray;
use kin_study::arrow::datatypes::{Float32Type, Float64Type, UInt64Type};
use kin_study::{normalise, query};
use std::error::Error;
use std::fmt::Write;
use std::path::Path;
use std::process::ExitCode;

/// A four-bar with a coupler point, on a ground of length 1.
#[mechanism]
#[bodies(crank, coupler, rocker)]
#[revolute(C: ground @ (0, 0), crank @ (0, 0))]
#[revolute(A: crank @ (l1, 0), coupler @ (0, 0))]
#[revolute(B: coupler @ (l2, 0), rocker @ (0, 0))]
#[revolute(D: rocker @ (l3, 0), ground @ (1, 0))]
#[driver(drive: crank.phi = t)]
#[point(tip = coupler @ (u, v))]
#[guess(coupler.phi = 0.9, rocker.phi = 5.0)]
pub struct FourBar {
    /// Crank
    #[param(0.4)]
    pub l1: f64,
    /// Coupler
    #[param(0.9)]
    pub l2: f64,
    /// Rocker
    #[param(0.8)]
    pub l3: f64,
    /// The coupler point, along the coupler
    #[param(0.5)]
    pub u: f64,
    /// The coupler point, across
    #[param(0.5)]
    pub v: f64,
}

/// Points of a curve when curves are compared.
const POINTS: usize = 64;
/// Curves that are drawn.
const NEAREST: usize = 8;

/// A curve by points at equal distances along it, normalised.
#[derive(Clone, Debug)]
pub struct Curve(Vec<[f64; 2]>);

impl Curve {
    /// The closed curve through these points.
    pub fn new(points: &[[f64; 2]]) -> Self {
        let next = |k: usize| points[(k + 1) % points.len()];
        let length = |k: usize| (next(k)[0] - points[k][0]).hypot(next(k)[1] - points[k][1]);
        let whole: f64 = (0..points.len()).map(length).sum();
        let (mut k, mut passed) = (0, 0.0);
        let mut path = Vec::with_capacity(2 * POINTS);
        for place in 0..POINTS {
            let wanted = whole * place as f64 / POINTS as f64;
            while k + 1 < points.len() && passed + length(k) <= wanted {
                passed += length(k);
                k += 1;
            }
            let share = ((wanted - passed) / length(k).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
            let ([x, y], [to_x, to_y]) = (points[k], next(k));
            path.extend([x + share * (to_x - x), y + share * (to_y - y)]);
        }
        normalise(&mut path);
        Self(path.as_chunks().0.to_vec())
    }

    /// Its points.
    pub fn points(&self) -> &[[f64; 2]] {
        &self.0
    }

    /// The root of the mean square of the distances of corresponding points, where the curves fit best: wherever the other one
    /// begins, in both directions, turned by π and mirrored.
    pub fn distance(&self, other: &Self) -> f64 {
        self.fit(other).0
    }

    /// The distance, and the signs of x and y with which the other curve fits best.
    fn fit(&self, other: &Self) -> (f64, [f64; 2]) {
        let signs = [[1.0, 1.0], [-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0]];
        let mut least = (f64::INFINITY, [1.0; 2]);
        for (shift, backwards) in (0..POINTS).flat_map(|shift| [(shift, false), (shift, true)]) {
            let place = |k: usize| (if backwards { 2 * POINTS - k - shift - 1 } else { k + shift }) % POINTS;
            let product = |axis: usize| (0..POINTS).map(|k| self.0[k][axis] * other.0[place(k)][axis]).sum::<f64>();
            let products = [product(0), product(1)];
            for [x, y] in signs {
                // Both have the mean square 1.
                let square = 2.0 - 2.0 * (x * products[0] + y * products[1]) / POINTS as f64;
                if square < least.0 {
                    least = (square, [x, y]);
                }
            }
        }
        (least.0.max(0.0).sqrt(), least.1)
    }
}

/// A row of an atlas.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// Its number.
    pub row: u64,
    /// l1, l2, l3, u and v.
    pub dimensions: [f64; 5],
    /// Its curve.
    pub curve: Curve,
}

/// The rows of an atlas whose curves are nearest, with their distances.
///
/// # Errors
/// Where the directory holds no atlas.
pub fn nearest(atlas: &Path, curve: &Curve, count: usize) -> Result<Vec<(f64, Drawn)>, Box<dyn Error>> {
    let mut found: Vec<(f64, Drawn)> = Vec::new();
    for batch in query(atlas, "select row, l1, l2, l3, u, v, curve from study")?.batches {
        let rows = batch.column(0).as_primitive::<UInt64Type>();
        let dimensions: [_; 5] = std::array::from_fn(|k| batch.column(k + 1).as_primitive::<Float64Type>());
        let curves = batch.column(6).as_fixed_size_list();
        for k in 0..batch.num_rows() {
            let numbers = curves.value(k);
            let numbers: Vec<f64> =
                numbers.as_primitive::<Float32Type>().values().iter().copied().map(f64::from).collect();
            let other = Curve::new(numbers.as_chunks().0);
            let distance = curve.distance(&other);
            let place = found.partition_point(|(known, _)| *known <= distance);
            if place < count {
                let dimensions = dimensions.each_ref().map(|column| column.value(k));
                found.insert(place, (distance, Drawn { row: rows.value(k), dimensions, curve: other }));
                found.truncate(count);
            }
        }
    }
    Ok(found)
}

/// A picture of a curve and of those that are nearest to it.
fn picture(curve: &Curve, found: &[(f64, Drawn)]) -> Result<String, std::fmt::Error> {
    const CELL: f64 = 180.0;
    let mut svg = String::new();
    let rows = (found.len() + 1).div_ceil(3);
    let (width, height) = (3.0 * CELL, rows as f64 * (CELL + 20.0));
    writeln!(svg, "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {width} {height}' font-family='sans-serif'>")?;
    writeln!(svg, "<rect width='100%' height='100%' fill='white'/>")?;
    let titles = found.iter().map(|(distance, drawn)| (format!("row {}: {distance:.3}", drawn.row), &drawn.curve));
    for (k, (title, other)) in std::iter::once(("wanted".to_owned(), curve)).chain(titles).enumerate() {
        let (x, y) = ((k % 3) as f64 * CELL + CELL / 2.0, (k / 3) as f64 * (CELL + 20.0) + CELL / 2.0);
        for (drawn, colour, stroke) in [(curve, "#cccccc", 5.0), (other, "#0072b2", 2.0)] {
            let signs = curve.fit(drawn).1;
            let at = |p: &[f64; 2]| [x + 0.2 * CELL * signs[0] * p[0], y - 0.2 * CELL * signs[1] * p[1]];
            let place = |p: &[f64; 2]| at(p).map(|number| format!("{number:.1}")).join(",");
            let points: Vec<String> = drawn.0.iter().map(place).collect();
            let points = points.join(" ");
            writeln!(svg, "<polygon points='{points}' fill='none' stroke='{colour}' stroke-width='{stroke}'/>")?;
        }
        writeln!(svg, "<text x='{x}' y='{}' text-anchor='middle' font-size='13'>{title}</text>", y + CELL / 2.0 + 5.0)?;
    }
    svg.push_str("</svg>\n");
    Ok(svg)
}

/// The points of a file with x and y in every line.
fn points(path: &Path) -> Result<Vec<[f64; 2]>, Box<dyn Error>> {
    let text = std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
    let lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    let points = lines.map(|(number, line)| {
        let pair = line.split_once(',').and_then(|(x, y)| Some([x.trim().parse().ok()?, y.trim().parse().ok()?]));
        pair.ok_or_else(|| format!("{}:{}: x and y are expected, as in 0.5, 1.2", path.display(), number + 1))
    });
    let points = points.collect::<Result<Vec<_>, _>>()?;
    if points.len() < 3 {
        Err(format!("{}: a curve has three points at least", path.display()).into())
    } else {
        Ok(points)
    }
}

/// A half circle, closed by a straight line.
fn half_circle() -> Vec<[f64; 2]> {
    (0..=100).map(|k| f64::from(k) * std::f64::consts::PI / 100.0).map(|angle| [angle.cos(), angle.sin()]).collect()
}

fn search(words: &[String]) -> Result<(), Box<dyn Error>> {
    let ([atlas, out], curve) = match words {
        [atlas, out] => ([atlas, out], half_circle()),
        [atlas, out, curve] => ([atlas, out], points(Path::new(curve))?),
        _ => return Err("write: search ATLAS PICTURE.svg [CURVE.csv]".into()),
    };
    let curve = Curve::new(&curve);
    let found = nearest(Path::new(atlas), &curve, NEAREST)?;
    for (distance, Drawn { row, dimensions: [l1, l2, l3, u, v], .. }) in &found {
        println!("{distance:.4}  row {row}: l1 {l1:.4}, l2 {l2:.4}, l3 {l3:.4}, tip ({u:.4}, {v:.4})");
    }
    std::fs::write(out, picture(&curve, &found)?).map_err(|error| format!("{out}: {error}"))?;
    Ok(())
}

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().collect();
    if words.get(1).is_none_or(|word| word != "search") {
        return kin_study::main::<FourBar>();
    }
    match search(&words[2..]) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
