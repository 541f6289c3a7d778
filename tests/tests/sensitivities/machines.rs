//! Test mechanisms in which coordinates of some points are parameters, for example `crank_O_x` for x of the point O of
//! the crank. The reference files have derivatives with respect to these.

use kin_runtime::mechanism;

/// Bogie with two wheel centres on a sine rail that is fixed in the ground.
#[mechanism]
#[bodies(bogie)]
#[coordinates(u1, u2)]
#[point(M = bogie @ (0.01, bogie_m_y))]
#[point(C = ground @ (ground_c_x, ground_c_y))]
#[on_curve(front: C, bogie @ (-0.16, -0.06), parametric(u1) = (a * u1, b * sin(k * u1)))]
#[on_curve(rear: C, bogie @ (0.15, -0.05), parametric(u2) = (a * u2, b * sin(k * u2)))]
#[driver(drive: M.x = 0.4 + 0.7*t + 0.1*sin(2*t))]
#[guess(bogie.x = 0.4, bogie.y = 0.15, bogie.phi = 0.1, u1 = 0.3, u2 = 0.9)]
pub(crate) struct BogieOnRail {
    #[param(0.5, unit = "m")]
    pub(crate) a: f64,
    #[param(0.08, unit = "m")]
    pub(crate) b: f64,
    #[param(1.9)]
    pub(crate) k: f64,
    #[param(0.1)]
    pub(crate) bogie_m_y: f64,
    #[param(0.1)]
    pub(crate) ground_c_x: f64,
    #[param(0.05)]
    pub(crate) ground_c_y: f64,
}

/// Elliptic cam with a translating knife follower whose guide is offset from the cam's axis.
#[mechanism]
#[bodies(cam, follower)]
#[point(Q = follower @ (0.01, -0.1))]
#[revolute(O: ground @ (0.01, ground_o_y), cam @ (cam_o_x, -0.03))]
#[translational(guide: ground @ (0.04, 0.5), Q, axis = (0, 1), angle = 0.1)]
#[on_curve(contact: cam @ (0.05, 0.01), Q, implicit(X, Y) = (X / a).powi(2) + (Y / b).powi(2) - 1)]
#[driver(drive: cam.phi = 0.2 + w*t + 0.15*sin(t))]
#[guess(follower.y = 0.32)]
pub(crate) struct CamEllipseImplicit {
    #[param(0.23, unit = "m")]
    pub(crate) a: f64,
    #[param(0.17, unit = "m")]
    pub(crate) b: f64,
    #[param(0.03, unit = "m")]
    pub(crate) e: f64,
    #[param(2.05, unit = "rad/s")]
    pub(crate) w: f64,
    #[param(0.02)]
    pub(crate) cam_o_x: f64,
    #[param(0)]
    pub(crate) ground_o_y: f64,
}

/// Cam with an oscillating roller follower: the roller's centre runs on the pitch curve.
#[mechanism]
#[bodies(cam, follower)]
#[point(Q = follower @ (0.19, 0.05))]
#[revolute(O: ground @ (0, 0), cam @ (0.01, 0.02))]
#[revolute(F: ground @ (ground_fp_x, 0.05), follower @ (follower_fp_x, 0.03))]
#[on_curve(contact: cam @ (0.03, -0.01), Q, polar(theta) = a + b*cos(theta) + c*sin(2*theta))]
#[driver(drive: cam.phi = 0.3 + w * t)]
#[guess(follower.phi = 2.4)]
pub(crate) struct CamOscillatingFollower {
    #[param(0.2, unit = "m")]
    pub(crate) a: f64,
    #[param(0.03, unit = "m")]
    pub(crate) b: f64,
    #[param(0.012, unit = "m")]
    pub(crate) c: f64,
    #[param(2.4, unit = "rad/s")]
    pub(crate) w: f64,
    #[param(-0.12)]
    pub(crate) follower_fp_x: f64,
    #[param(0.35)]
    pub(crate) ground_fp_x: f64,
}

/// An open chain of ten links: the first angle driven, the others relative to the link before.
/// Frames alternate between the joint and the middle of the link.
#[mechanism]
#[bodies(link1, link2, link3, link4, link5, link6, link7, link8, link9, link10)]
#[point(E = link10 @ (0.18, 0))]
#[revolute(J1: ground @ (0.1, -0.2), link1 @ (-0.31/2, 0.01))]
#[revolute(J2: link1 @ (0.31/2, 0.01), link2 @ (link2_j_x, 0))]
#[revolute(J3: link2 @ (link2_e_x, 0), link3 @ (-0.27/2, 0.01))]
#[revolute(J4: link3 @ (0.27/2, 0.01), link4 @ (link4_j_x, link4_j_y))]
#[revolute(J5: link4 @ (0.33, 0), link5 @ (-0.24/2, 0.01))]
#[revolute(J6: link5 @ (0.24/2, 0.01), link6 @ (0, 0))]
#[revolute(J7: link6 @ (link6_e_x, 0), link7 @ (-0.3/2, 0.01))]
#[revolute(J8: link7 @ (0.3/2, 0.01), link8 @ (0, 0))]
#[revolute(J9: link8 @ (link8_e_x, 0), link9 @ (-0.21/2, 0.01))]
#[revolute(J10: link9 @ (0.21/2, 0.01), link10 @ (0, 0))]
#[driver(d1: link1.phi = 0.3 + 0.7 * t)]
#[driver(d2: link2.phi - link1.phi = 0.2 * sin(1.1 * t))]
#[relative_angle(d3: link2, link3 = -0.4 + 0.3 * pow(t, 2))]
#[relative_angle(d4: link3, link4 = 0.25)]
#[relative_angle(d5: link4, link5 = 0.5 * cos(2 * t))]
#[driver(d6: link6.phi - link5.phi = 0.1 * t + 0.2 * sin(3 * t))]
#[relative_angle(d7: link6, link7 = -0.6 * t)]
#[driver(d8: link8.phi - link7.phi = 0.3 * sin(t) * cos(2 * t))]
#[relative_angle(d9: link8, link9 = 0.2 + 0.05 * pow(t, 3))]
#[driver(d10: link10.phi - link9.phi = -0.35 * sin(1.7 * t) - 0.1 * t)]
#[guess(
    link2.phi = 0.3, link3.phi = -0.1, link4.phi = 0.1, link5.phi = 0.7, link6.phi = 0.7,
    link7.phi = 0.7, link8.phi = 0.7, link9.phi = 0.8, link10.phi = 0.8
)]
pub(crate) struct Chain10 {
    #[param(0.29)]
    pub(crate) link2_e_x: f64,
    #[param(0)]
    pub(crate) link2_j_x: f64,
    #[param(0)]
    pub(crate) link4_j_x: f64,
    #[param(0)]
    pub(crate) link4_j_y: f64,
    #[param(0.22)]
    pub(crate) link6_e_x: f64,
    #[param(0.26)]
    pub(crate) link8_e_x: f64,
}

/// Elliptic trammel: a bar with two points kept on a vertical and a horizontal line; the tracer `C` draws an ellipse.
#[mechanism]
#[bodies(bar)]
#[point(C = bar @ (0.5, 0.1))]
#[x(vertical: bar @ (bar_a_x, bar_a_y) = 0.02)]
#[y(horizontal: bar @ (bar_b_x, bar_b_y) = -0.03)]
#[driver(drive: bar.phi = 0.4 + 1.7 * t - 0.3 * cos(2.1 * t))]
pub(crate) struct EllipticTrammel {
    #[param(-0.21)]
    pub(crate) bar_a_x: f64,
    #[param(0.03)]
    pub(crate) bar_a_y: f64,
    #[param(0.34)]
    pub(crate) bar_b_x: f64,
    #[param(-0.05)]
    pub(crate) bar_b_y: f64,
}

/// Excavator arm: boom, stick, lever and bucket moved by three hydraulic cylinders, which are distance drivers.
/// The bucket link is massless, a constant distance.
#[mechanism]
#[bodies(boom, stick, lever, bucket)]
#[point(tip = bucket @ (0.5, -0.2))]
#[revolute(O: ground @ (0, 0.2), boom @ (0, boom_o_y))]
#[revolute(S: boom @ (boom_s_x, 0.2), stick @ (0, stick_s_y))]
#[revolute(L: stick @ (1.25, stick_l_y), lever @ (-0.21, 0))]
#[revolute(B: stick @ (1.6, 0), bucket @ (-0.4, bucket_b_y))]
#[distance(bucket_link: lever @ (0.19, 0.05), bucket @ (-0.15, 0.1), length = 0.4)]
#[driver(cyl_boom: distance(ground @ (0.45, -0.05), boom @ (1.4, boom_c1_y)) = 1.42 + 0.12 * sin(0.8 * t))]
#[driver(cyl_stick: distance(boom @ (1.5, 0.8), stick @ (-0.6, 0.15)) = 1.94 - 0.15 * t + 0.05 * pow(t, 2))]
#[driver(cyl_bucket: distance(stick @ (0.25, 0.3), lever @ (0.21, 0)) = 1.11 + 0.06 * cos(1.1 * t))]
#[guess(boom.phi = 0.6, stick.phi = -1.3, lever.phi = -0.1, bucket.phi = -0.7)]
pub(crate) struct Excavator {
    #[param(0.35)]
    pub(crate) boom_c1_y: f64,
    #[param(0)]
    pub(crate) boom_o_y: f64,
    #[param(3.1)]
    pub(crate) boom_s_x: f64,
    #[param(-0.1)]
    pub(crate) bucket_b_y: f64,
    #[param(0.1)]
    pub(crate) stick_l_y: f64,
    #[param(0)]
    pub(crate) stick_s_y: f64,
}

/// Geared five-bar: two cranks in the ground, coupled by an external gear pair, move the joint of two links.
#[mechanism]
#[bodies(crank1, crank2, link1, link2)]
#[point(C = link2 @ (link2_c_x, link2_c_y))]
#[revolute(O1: ground @ (0, 0), crank1 @ (0, 0))]
#[revolute(O2: ground @ (0.33, 0.02), crank2 @ (0.02, 0.01))]
#[revolute(A: crank1 @ (0.12, 0), link1 @ (-0.145, 0))]
#[revolute(B: crank2 @ (0.12, 0.01), link2 @ (0.3, 0))]
#[revolute(C: link1 @ (0.145, 0), C)]
#[gear(mesh: crank1, crank2, radii = (r1, r2), offset = c0)]
#[driver(drive: crank1.phi = 0.5 + w * t)]
#[guess(crank2.phi = 1.2, link1.phi = 1.4, link2.phi = -0.9)]
pub(crate) struct GearedFivebar {
    #[param(0.11, unit = "m")]
    pub(crate) r1: f64,
    #[param(0.22, unit = "m")]
    pub(crate) r2: f64,
    #[param(0.33)]
    pub(crate) c0: f64,
    #[param(2.5, unit = "rad/s")]
    pub(crate) w: f64,
    #[param(0)]
    pub(crate) link2_c_x: f64,
    #[param(0)]
    pub(crate) link2_c_y: f64,
}

/// Klann's walking leg: a Stephenson six-bar with a ternary connecting rod and a ternary leg, foot `F`.
#[mechanism]
#[bodies(crank, rod, rocker_low, rocker_up, leg)]
#[point(F = leg @ (1.35, -0.5))]
#[revolute(O: ground @ (ground_o_x, 0), crank @ (crank_o_x, crank_o_y))]
#[revolute(M: crank @ (0.2, 0), rod @ (0.57, 0))]
#[revolute(C: rod @ (0, rod_c_y), rocker_low @ (0.34, 0))]
#[revolute(B: ground @ (-0.59, -0.176), rocker_low @ (0, 0))]
#[revolute(D: rod @ (-0.52, 0.06), leg @ (0.66, 0.02))]
#[revolute(E: leg @ (0, 0), rocker_up @ (0.31, rocker_up_e_y))]
#[revolute(A: ground @ (-0.233, 0.616), rocker_up @ (-0.31, 0))]
#[driver(drive: crank.phi = 0.7 + w * t)]
#[guess(rocker_low.phi = 1.0, rocker_up.phi = -1.7, leg.phi = 2.9)]
pub(crate) struct KlannLeg {
    #[param(-1.6, unit = "rad/s")]
    pub(crate) w: f64,
    #[param(0)]
    pub(crate) crank_o_x: f64,
    #[param(0)]
    pub(crate) crank_o_y: f64,
    #[param(0)]
    pub(crate) ground_o_x: f64,
    #[param(0)]
    pub(crate) rocker_up_e_y: f64,
    #[param(0)]
    pub(crate) rod_c_y: f64,
}

/// MacPherson strut: the wheel carrier slides in a strut that turns; the height of the wheel centre `W` is driven.
/// The sliding joint stands between two moving bodies, and its axis is not given as a unit vector.
#[mechanism]
#[bodies(arm, knuckle, strut)]
#[point(W = knuckle @ (0.1, 0.05))]
#[point(K = knuckle @ (0, 0))]
#[revolute(G: ground @ (ground_g_x, 0), arm @ (-0.17, 0))]
#[revolute(K: arm @ (0.17, 0), K)]
#[translational(slide: knuckle @ (knuckle_s_x, knuckle_s_y), strut @ (0, strut_t_y), axis = (-0.2, 1), angle = 0.07)]
#[revolute(T: ground @ (ground_t_x, 0.62), strut @ (0, strut_t_y))]
#[driver(drive: W.y = 0.05 + 0.06 * sin(w * t) + 0.01 * t)]
#[guess(strut.phi = 0.1)]
pub(crate) struct MacphersonStrut {
    #[param(2.1, unit = "rad/s")]
    pub(crate) w: f64,
    #[param(0)]
    pub(crate) ground_g_x: f64,
    #[param(0.21)]
    pub(crate) ground_t_x: f64,
    #[param(-0.02)]
    pub(crate) knuckle_s_x: f64,
    #[param(0.1)]
    pub(crate) knuckle_s_y: f64,
    #[param(0.02)]
    pub(crate) strut_t_y: f64,
}

/// Peaucellier–Lipkin inversor: `Q` draws an exact straight line, perpendicular to OC at (a² − b²)/(2c) from O.
#[mechanism]
#[bodies(crank, OA, OB, AP, PB, BQ, QA)]
#[point(Q = BQ @ (b/2, 0))]
#[revolute(C: ground @ (0.96 * c, 0.28 * c), crank @ (-c/2, 0))]
#[revolute(O_OA: ground @ (0, 0), OA @ (0, 0))]
#[revolute(O_OB: ground @ (0, 0), OB @ (-a/2, 0))]
#[revolute(A_AP: OA @ (a, oa_a_y), AP @ (-b/2, 0))]
#[revolute(A_QA: OA @ (a, oa_a_y), QA @ (b/2, 0))]
#[revolute(B_PB: OB @ (a/2, 0), PB @ (b/2, 0))]
#[revolute(B_BQ: OB @ (a/2, 0), BQ @ (-b/2, 0))]
#[revolute(P_AP: crank @ (c/2, crank_p_y), AP @ (b/2, ap_p_y))]
#[revolute(P_PB: crank @ (c/2, crank_p_y), PB @ (-b/2, 0))]
#[revolute(Q: Q, QA @ (-b/2, 0))]
#[driver(drive: crank.phi = 0.1 + 0.9 * sin(1.3 * t) + 0.05 * t)]
#[guess(OA.phi = 0.6, OB.phi = -0.2, AP.phi = -1.7, PB.phi = -1.1, BQ.phi = 1.5, QA.phi = 2.0)]
pub(crate) struct Peaucellier {
    #[param(0.53, unit = "m")]
    pub(crate) a: f64,
    #[param(0.23, unit = "m")]
    pub(crate) b: f64,
    #[param(0.21, unit = "m")]
    pub(crate) c: f64,
    #[param(0)]
    pub(crate) ap_p_y: f64,
    #[param(0)]
    pub(crate) oa_a_y: f64,
    #[param(0)]
    pub(crate) crank_p_y: f64,
}

/// 3-RRR planar parallel robot: a platform on three legs, each with a driven crank.
#[mechanism]
#[bodies(crank1, rod1, crank2, rod2, crank3, rod3, platform)]
#[point(P3 = platform @ (0, platform_p3_y))]
#[revolute(B1: ground @ (ground_b1_x, ground_b1_y), crank1 @ (0, 0))]
#[revolute(A1: crank1 @ (0.38, crank1_a_y), rod1 @ (-0.42/2, 0))]
#[revolute(P1: rod1 @ (0.42/2, 0), platform @ (-0.15, -0.1))]
#[revolute(B2: ground @ (1.2, 0.05), crank2 @ (0, 0))]
#[revolute(A2: crank2 @ (0.4, 0), rod2 @ (-0.4/2, 0))]
#[revolute(P2: rod2 @ (0.4/2, 0), platform @ (platform_p2_x, -0.09))]
#[revolute(B3: ground @ (0.55, 1.1), crank3 @ (0, 0))]
#[revolute(A3: crank3 @ (0.36, crank3_a_y), rod3 @ (-0.44/2, 0))]
#[revolute(P3: rod3 @ (0.44/2, 0), P3)]
#[driver(d1: crank1.phi = 1.49 - 0.2 * sin(1.3 * t))]
#[driver(d2: crank2.phi = 3.48 - 0.2 * t + 0.1 * pow(t, 2))]
#[driver(d3: crank3.phi = -0.73 - 0.15 * sin(0.9 * t) + 0.1 * cos(2 * t))]
#[guess(rod1.phi = -0.3, rod2.phi = 1.8, rod3.phi = -2.3, platform.phi = 0.1)]
pub(crate) struct Robot3rrr {
    #[param(0)]
    pub(crate) crank1_a_y: f64,
    #[param(0)]
    pub(crate) crank3_a_y: f64,
    #[param(0)]
    pub(crate) ground_b1_x: f64,
    #[param(0)]
    pub(crate) ground_b1_y: f64,
    #[param(0.16)]
    pub(crate) platform_p2_x: f64,
    #[param(0.18)]
    pub(crate) platform_p3_y: f64,
}

/// Scotch yoke: the crank pin on the inclined slot of a yoke that slides along an inclined axis.
#[mechanism]
#[bodies(crank, yoke)]
#[point(S = yoke @ (0.3, -0.06))]
#[revolute(O: ground @ (ground_o_x, ground_o_y), crank @ (-0.05, 0.01))]
#[translational(guide: ground @ (ground_g_x, 0.04), yoke @ (0.11, 0.02), axis = (0.96, 0.28), angle = c0)]
#[point_on_line(pin: S, crank @ (-0.05 + r, 0.01), axis = (0.2, 1))]
#[driver(drive: crank.phi = 0.6 + w * t)]
#[guess(yoke.phi = 0.2)]
pub(crate) struct ScotchYoke {
    #[param(0.19, unit = "m")]
    pub(crate) r: f64,
    #[param(0.25, unit = "rad")]
    pub(crate) c0: f64,
    #[param(2.7, unit = "rad/s")]
    pub(crate) w: f64,
    #[param(-0.1)]
    pub(crate) ground_g_x: f64,
    #[param(0.03)]
    pub(crate) ground_o_x: f64,
    #[param(-0.02)]
    pub(crate) ground_o_y: f64,
}

/// Toggle press: a crank and its rod move a knee. The lower knee link is massless, a distance; the ram is guided by
/// `x` and `angle`.
#[mechanism]
#[bodies(crank, rod, upper, ram)]
#[point(K = ram @ (0.01, 0.06))]
#[revolute(O: ground @ (-0.35, 0.4), crank @ (0, 0))]
#[revolute(A: crank @ (r, 0), rod @ (-lr/2, 0))]
#[revolute(J: rod @ (lr/2, 0), upper @ (lu, 0))]
#[revolute(T: ground @ (0, 0.71), upper @ (0, upper_t_y))]
#[distance(knee: upper @ (lu, 0), K, length = ll)]
#[x(guide: K = 0.01)]
#[angle(upright: ram = 0.05)]
#[driver(drive: crank.phi = -0.4 + w * t)]
#[guess(rod.phi = 0.1, upper.phi = -1.3, ram.y = 0.0)]
pub(crate) struct TogglePress {
    #[param(0.08, unit = "m")]
    pub(crate) r: f64,
    #[param(0.37, unit = "m")]
    pub(crate) lr: f64,
    #[param(0.31, unit = "m")]
    pub(crate) lu: f64,
    #[param(0.33, unit = "m")]
    pub(crate) ll: f64,
    #[param(2.2, unit = "rad/s")]
    pub(crate) w: f64,
    #[param(0)]
    pub(crate) upper_t_y: f64,
}

/// Watt-I six-bar: a four-bar whose ternary coupler and ternary rocker carry a second dyad.
#[mechanism]
#[bodies(crank, coupler, rocker, link5, link6)]
#[point(G = link6 @ (0.27, 0))]
#[revolute(O: ground @ (ground_o_x, 0), crank @ (crank_o_x, 0))]
#[revolute(A: crank @ (0.15, 0), coupler @ (coupler_a_x, -0.04))]
#[revolute(B: coupler @ (0.19, -0.03), rocker @ (rocker_b_x, 0.03))]
#[revolute(D: ground @ (0.42, 0.05), rocker @ (0, 0))]
#[revolute(E: coupler @ (0.02, 0.17), link5 @ (-0.15, 0.01))]
#[revolute(F: rocker @ (rocker_f_x, -0.14), link6 @ (0, 0))]
#[revolute(G: link5 @ (0.16, 0), G)]
#[driver(drive: crank.phi = 0.3 + w * t + 0.2 * sin(2 * t))]
#[guess(coupler.phi = 0.8, rocker.phi = 1.6, link5.phi = 0.4, link6.phi = 2.2)]
pub(crate) struct WattSixbar {
    #[param(1.7, unit = "rad/s")]
    pub(crate) w: f64,
    #[param(-0.18)]
    pub(crate) coupler_a_x: f64,
    #[param(0)]
    pub(crate) crank_o_x: f64,
    #[param(0)]
    pub(crate) ground_o_x: f64,
    #[param(0.28)]
    pub(crate) rocker_b_x: f64,
    #[param(0.17)]
    pub(crate) rocker_f_x: f64,
}
