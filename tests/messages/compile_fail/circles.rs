//! Cyclic definitions.

use kin_runtime::mechanism;

#[mechanism]
#[bodies(crank)]
#[define(a = b + 1, b = 2 * c, c = sin(a))]
#[define(own = own + 1)]
#[point(tip = crank @ (size, 0))]
#[define(size = tip.x)]
#[revolute(A: ground @ (0, 0), crank @ (a, own))]
#[driver(drive: crank.phi = size + t)]
struct Defines;

#[mechanism]
#[body(first, origin = second @ (0, 0))]
#[body(second, origin = third @ (0, 0))]
#[body(third, origin = first @ (0, 0))]
#[body(selfish, origin = selfish @ (1, 0))]
#[angle(A: first = t)]
struct Origins;

fn main() {}
