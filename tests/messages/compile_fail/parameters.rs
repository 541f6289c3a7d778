//! Errors in fields and their defaults.

use kin_runtime::mechanism;

#[mechanism(flag, cross_check, cross_check, check_units = true, 3)]
#[coordinates(u)]
#[driver(drive: u = t)]
struct Parameters<'a> {
    #[param(0.1, 0.2)]
    two: f64,
    #[param(two)]
    named: f64,
    #[param(2 * two.sin())]
    computed: f64,
    #[param(1/0)]
    infinite: f64,
    #[param(sqrt(-1))]
    imaginary: f64,
    #[param("0.1")]
    text: f64,
    #[param(0,1)]
    comma: f64,
    #[param(0.1, unit = m)]
    unquoted: f64,
    #[param(0.1, "m")]
    keyless: f64,
    #[param(0.1 "m")]
    separated: f64,
    #[param(0.1, m)]
    word: f64,
    #[param(0.1, unit: "m")]
    colon: f64,
    #[param(0.1, unit = "m", unit = "mm")]
    two_units: f64,
    #[param(default = 0.1)]
    keyed: f64,
    #[param(0.1)]
    #[param(0.2)]
    twice: f64,
    #[param = 0.1]
    assigned: f64,
    #[param[0.1]]
    bracketed: f64,
    #[param([0.1, 0.2])]
    single: f64,
    #[param([0.1, 0.2])]
    three: [f64; 3],
    #[param([0.1; 3])]
    repeated: [f64; 3],
    #[param([0.1 0.2])]
    uncommaed: [f64; 2],
    #[param()]
    empty: f64,
    #[param(0.1)]
    matrix: [[f64; 2]; 2],
    #[param(0.1)]
    generic: [f64; N],
    #[param(0.1)]
    borrowed: &'a f64,
    #[param(0.1)]
    pair: (f64, f64),
    #[param(0.1)]
    huge: [f64; 99999],
    #[param(0.1)]
    integer: u32,
    #[param(0.1)]
    name: String,
    #[param(0.1)]
    list: Vec<f64>,
    #[param(0.1)]
    integers: [i32; 3],
    #[point(tip = ground @ (0, 0))]
    point: f64,
    #[cfg(all())]
    #[param(0.1)]
    sometimes: f64,
    #[cfg_attr(all(), param(0.1))]
    conditional: f64,
    #[params(0.1)]
    misspelt: f64,
    #[mechanism]
    nested: f64,
}

const N: usize = 3;

fn main() {}
