//! Slips of people who know other languages, other units or other tools; and errors that do not hide one another.

use kin_runtime::mechanism;

/// A lead is a length per turn: a length, or a length per revolution.
#[mechanism]
#[bodies(jaw, plate)]
#[body(handle, x = 0, y = 0)]
#[translational(guide: ground @ (0, 0), jaw @ (0, 0), axis = (1, 0))]
#[screw(spindle: ground @ (0, 0), jaw @ (0, 0), axis = (1, 0), lead = per_radian, nut = handle)]
#[translational(other: ground @ (0, 0), plate @ (0, l), axis = (1, 0))]
#[screw(second: ground @ (0, 0), plate @ (0, 0), axis = (1, 0), lead = per_turn, nut = handle)]
#[driver(turns: handle.phi = t)]
struct Leads {
    #[param(1, unit = "mm")]
    l: f64,
    #[param(4, unit = "mm/rad")]
    per_radian: f64,
    #[param(4, unit = "mm/rev")]
    per_turn: f64,
}

/// Factors between units that are written down as they are named.
#[mechanism]
#[coordinates(u[4])]
#[define(turned = u[3], unit = "deg")]
#[constraint(speed: u[0] = a + b)]
#[constraint(followed: u[1] = a + b/(60*1000))]
#[constraint(length: u[2] = l + inch)]
#[constraint(angle: u[3] = atan2(l, l) + t)]
#[define(right = pi/2 + u[3]*0, unit = "rad")]
#[define(wrong = atan2(l, l), unit = "deg")]
struct Factors {
    #[param(1, unit = "m/s")]
    a: f64,
    #[param(1, unit = "mm/min")]
    b: f64,
    #[param(1, unit = "mm")]
    l: f64,
    #[param(1, unit = "in")]
    inch: f64,
}

/// A length in the unit of a stiffness.
#[mechanism]
#[bodies(arm)]
#[revolute(O: ground @ (0, 0), arm @ (l, 0))]
#[distance(D: ground @ (l, 0), arm @ (0, l), length = l)]
#[torsion_spring(S: ground, arm, stiffness = k, free_angle = 0)]
struct Stiffness {
    #[param(1, unit = "N*m/rad")]
    k: f64,
    #[param(1, unit = "mm")]
    l: f64,
}

/// Functions of other languages, and misspelt ones.
#[mechanism]
#[bodies(a)]
#[coordinates(u[6])]
#[revolute(O: ground @ (0, 0), a @ (0, 0))]
#[driver(drive: a.phi = t)]
#[constraint(near: u[0] = dist(ground @ (0, 0), a @ (1, 0)))]
#[constraint(misspelt: u[1] = distnace(ground @ (0, 0), a @ (1, 0)))]
#[constraint(capital: u[2] = Distance(ground @ (0, 0), a @ (1, 0)))]
#[constraint(cotangent: u[3] = cot(a.phi))]
#[constraint(area: u[4] = asinh(a.phi))]
#[constraint(power: u[5] = exp2(a.phi))]
struct Functions;

/// The start of a coordinate.
#[mechanism]
#[coordinates(z, default = 3)]
#[driver(drive: z = t)]
struct Start;

/// A field whose length is wrong is not said to be a single number, too.
#[mechanism]
#[bodies(a)]
#[revolute(O: ground @ (0, 0), a @ (l[0], m[1]))]
#[driver(drive: a.phi = t)]
struct Lengths {
    #[param(1)]
    l: [f64; N],
    #[param(1)]
    m: [f64; 100000],
}

const N: usize = 3;

/// What is degenerate is said beside names that are wrong.
#[mechanism]
#[bodies(a, b)]
#[revolute(O: ground @ (0, 0), a @ (1 - 1, 0))]
#[revolute(P: a @ (1, 0), b @ (0, l5))]
#[gear(G: a, b, radii = (1, r - r))]
#[distance(D: a @ (0, 0), b @ (1, 0), length = 1 - 1)]
#[rope(R: a @ (0, 0), a @ (1 - 1, 0), b @ (1, 0), length = l)]
#[driver(drive: a.phi = t)]
struct Both {
    #[param(1)]
    l: f64,
    #[param(1)]
    r: f64,
}

/// A range whose bounds are too large.
#[mechanism]
#[bodies(a[10])]
#[revolute(R[i in 3000000..5000000]: ground @ (0, 0), a[i] @ (0, 0))]
struct Large;

/// Not a struct.
#[mechanism]
/// With words above.
#[allow(dead_code)]
trait Machine {}

/// Two rows of one joint.
#[mechanism]
#[bodies(slide)]
#[translational(T: ground @ (0, 0), slide @ (0, 0), axis = (1, 0))]
#[fixed(F: ground @ (0, 0), slide @ (0, 0))]
#[driver(drive: slide.x = t)]
struct Rows;

fn main() {}
