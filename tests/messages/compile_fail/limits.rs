//! Sizes that exceed a limit, and lengths that are not numbers.

use kin_runtime::mechanism;

#[mechanism]
#[bodies(link[3])]
#[coordinates(u)]
#[constraint(deep: u = ((((((((((((((((((((((((((((((((((((((((((((((((((1)))))))))))))))))))))))))))))))))))))))))))))))))))]
struct Brackets;

#[mechanism]
#[bodies(link[3])]
#[coordinates(u)]
#[angle(A[i in 0..3]: link[i] = t)]
#[constraint(signs: u = ----------------------------------------------------------------------------------------------------------------------------------------------------------------------------------------------------------------1)]
#[constraint(methods: u = u.sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin())]
#[angle(B: link[99999999999999999999] = 0)]
#[angle(C: link[1000000 * 2] = 0)]
#[angle(D: link[1usize] = 0)]
#[angle(E[i in 0..2]: link[i + j] = 0)]
#[angle(F[i in -1..2]: link[i] = 0)]
#[angle(G: 1 = 0)]
#[angle(H: link[0] = none[0])]
struct Sizes {
    #[param(1)]
    none: [f64; 0],
    #[param(length(2))]
    called: f64,
    #[param(distance(a, b))]
    between: f64,
}

fn main() {}
