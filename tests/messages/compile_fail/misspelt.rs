//! Misspelt names in every position in which a name can occur.

use kin_runtime::mechanism;

#[mechanism(cross_chek)]
#[bodies(crank, coupler, link[3])]
#[coordinates(reach)]
#[revolute(A: ground @ (0, 0), crnk @ (0, 0))]
#[revolute(B: crank @ (lenght, 0), couplr @ (0, 0))]
#[revolute(C: grund @ (0, 0), link[0] @ (0, 0))]
#[revolute(D: tpi, link[1] @ (l[0], 0))]
#[revolute(N[i in 0..2]: link[i] @ (l[j], 0), link[i + 1] @ (0, 0))]
#[point_on_line(E: tip, ground @ (0, 0), axes = (1, 0))]
#[translational(F: tip, ground @ (0, 0), axis = (1, 0), angel = 0)]
#[distance(G: tip, ground @ (0, 0), lenght = 1)]
#[angle(H: copler = strok)]
#[driver(drive: crank.phi = omga * T)]
#[driver(extend: raech = speed.sqr() + sine(t))]
#[driver(turn: crank.ph = tip.z + couplers.x)]
#[point(tip = coupelr @ (length, 0))]
#[define(stroke = lengt - reach)]
#[guess(crnak.phi = 0.1, recah = length, coupler.theta = 1)]
struct Misspelt {
    #[param(0.1, units = "m")]
    length: f64,
    #[param(2)]
    omega: f64,
    #[parm(3)]
    speed: f64,
    #[param(0.1)]
    l: [f64; 3],
}

#[mechanism]
#[body(crank, origen = ground @ (0, 0))]
#[angl(A: crank = t)]
#[revolut(B: crank @ (0, 0), ground @ (0, 0))]
#[drive(C: crank.phi = t)]
struct Attributes;

#[mechanism]
#[bodies(crank)]
#[hinge(A: crank @ (0, 0), ground @ (0, 0))]
#[prismatic(B: crank @ (0, 0), ground @ (0, 0), axis = (1, 0))]
#[motor(C: crank.phi = t)]
#[equation(D: crank.x = 0)]
struct Synonyms {
    #[parameter(1)]
    l: f64,
}

#[mechanism]
#[bodies(crank)]
#[x(A: tip = PI)]
#[y(B: crnk = 0)]
#[guess(crank.phi = 1, u = 1)]
struct NoneDeclared;

#[mechanism]
#[body(crank, x = lenght)]
#[angle(A: length = 0)]
#[y(B: cranc = Length)]
struct OtherKind {
    #[param(1)]
    length: f64,
}

#[mechanism]
#[bodys(crank)]
#[revolute(A: crank @ (0, 0), ground @ (0, 0))]
struct Declaration;

fn main() {
    let _ = Misspelt { speed: 1.0, ..Misspelt::default() };
}
