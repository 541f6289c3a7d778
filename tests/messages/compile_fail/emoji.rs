//! Emoji, which the compiler passes to macros as names.

#![allow(uncommon_codepoints)]

use kin_runtime::mechanism;

#[mechanism]
#[bodies(🚗)]
#[define(🔩 = 2*🧭)]
#[revolute(📍: ground @ (0, 0), 🚗 @ (0, 0))]
#[driver(drive: 🚗.📐 = t)]
struct 🏭 {
    #[param(0.1)]
    📏: f64,
}

fn main() {}
