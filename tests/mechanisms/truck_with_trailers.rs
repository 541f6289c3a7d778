//! A chain of trailers.

use kin_runtime::mechanism;

/// A truck with a steered wheel of its own and two trailers, each hitched to what is before it.
#[mechanism]
#[bodies(truck, trailer[2])]
#[body(wheel, origin = truck @ (1.8, 0))]
#[revolute(hitch: truck @ (-0.4, 0), trailer[0] @ (1.2, 0))]
#[revolute(coupling: trailer[0] @ (-0.3, 0), trailer[1] @ (1.1, 0))]
#[knife_edge(rear: truck @ (0, 0))]
#[knife_edge(front: wheel @ (0, 0))]
#[knife_edge(axle[i in 0..2]: trailer[i] @ (0, 0))]
#[relative_angle(steering: truck, wheel = 0.5 * sin(0.9 * t))]
#[speed(engine: wheel @ (0, 0), value = 1 + 0.2 * t)]
#[guess(trailer[0].x = -1.5, trailer[0].phi = 0.1, trailer[1].x = -2.8, trailer[1].phi = 0.3)]
pub struct TruckWithTrailers;
