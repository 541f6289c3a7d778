//! Wrong lengths, ranges and indices of families.

use kin_runtime::mechanism;

#[mechanism]
#[bodies(crank, link[4])]
#[coordinates(u[3])]
#[point(p[i in 0..2] = link[2*i + 1] @ (l[i], 0))]
#[define(s[i in 1..4] = link[i].phi - link[i - 1].phi)]
#[revolute(A: ground @ (0, 0), link @ (l, 0))]
#[revolute(B[i in 0..4]: link[i] @ (l[i], 0), link[i + 1] @ (0, 0))]
#[revolute(C[i in 0..3]: link[i - 1] @ (0, 0), link[j] @ (0, 0))]
#[revolute(D: link[i] @ (0, 0), link[l] @ (0, 0))]
#[revolute(E[i in 0..3]: link[i*i] @ (0, 0), link[i/2] @ (0, 0))]
#[revolute(F[i in 0..3]: link[1.5] @ (0, 0), link[] @ (0, 0))]
#[revolute(G[i in 0..3]: link[i] @ (i, 0), link[i, 1] @ (0, 0))]
#[angle(H: link[4] = t)]
#[angle(I: link[-1] = l[4])]
#[angle(J: crank[0] = n[0])]
#[x(K: p[2] = s[0])]
#[x(L: p = s)]
#[driver(M[i in 0..4]: u[i] = t)]
#[driver(N[i in 0..3]: u[i + 1] = l[2*i])]
#[guess(link[i in 0..5].phi = 1, u[3] = 2, link.phi = 3, u = 4)]
struct Indices {
    #[param(0.1)]
    l: [f64; 4],
    #[param(0.1)]
    n: f64,
}

#[mechanism]
#[bodies(none[0], many[99999], unknown[N], negative[-1], real[1.5], typed[3usize], two[2, 3])]
#[coordinates(later[i in 1..3], b[i in 0..N])]
#[point(p[3] = many[0] @ (0, 0))]
#[define(s[2] = 1)]
#[angle(A[3]: many[0] = t)]
#[angle(B[i in 3..3]: many[i] = t)]
#[angle(C[i in 0..=3]: many[i] = t)]
#[angle(D[i in 0..n]: many[i] = t)]
#[angle(E[i in 0...3]: many[i] = t)]
#[angle(F[i in 0,3]: many[i] = t)]
#[angle(G[i = 0..3]: many[i] = t)]
#[angle(H[0..3]: many[i] = t)]
#[angle(I[i in 0..99999]: many[i] = t)]
#[angle(J: many[i in 0..3] = t)]
struct Ranges;

#[mechanism]
#[bodies(link[3])]
#[revolute(A[i in 0..2]: link[i] @ (0, 0), link[2 * i] @ (1, 0))]
#[angle(B[i in 0..2]: link[i] = t)]
struct Itself;

#[mechanism]
#[bodies(link[3], wheel[2])]
#[coordinates(u[4])]
#[angle(A[i in 0..2]: link[i] = t)]
struct Untouched;

fn main() {
    let _ = Indices { l: [0.1; 4], n: 0.1 };
    let _ = (Indices::link[3], Indices::p[1], Indices::s[2], Indices::u[2], Untouched::wheel[1]);
}
