//! Laws of results: the numbers in a state, as columns, as text and as JSON, agree with the analyses.

use crate::motion::swept;
use kin_runtime::model::{Body, Component, Point};
use kin_runtime::{PointMotion, Rates};
use kin_tests::compare::assert_shows;
use kin_tests::subject::Subject;

/// The bodies and points in states agree with [`Solver::motion`](kin_runtime::Solver::motion), and columns contain
/// these numbers.
pub(crate) fn states_show_the_motion(mechanism: &dyn Subject, from: f64, to: f64) {
    let trajectory = swept(mechanism, &[from, 0.7 * from + 0.3 * to, to]);
    let model = mechanism.model();
    let column = |name: String| trajectory.column(&name).unwrap_or_else(|| panic!("no column {name}"));
    for (place, state) in trajectory.iter().enumerate() {
        let motion = mechanism.solver().motion(state).unwrap();
        assert_shows(state, &motion);
        let columns = |name: String, shown: Rates| {
            let found = ["", "_dot", "_ddot"].map(|end| column(format!("{name}{end}"))[place]);
            assert_eq!(found, [shown.value, shown.rate, shown.acceleration], "{name}");
        };
        for (k, info) in model.bodies.iter().enumerate() {
            for component in [Component::X, Component::Y, Component::Phi] {
                columns(format!("{}.{component}", info.name), state[Body(k)].rates(component));
            }
        }
        for (k, info) in model.points.iter().enumerate() {
            let PointMotion { r, v, a } = state[Point(k)];
            for (axis, name) in ["x", "y"].iter().enumerate() {
                let rates = Rates { value: r[axis], rate: v[axis], acceleration: a[axis] };
                columns(format!("{}.{name}", info.name), rates);
            }
        }
        let text = state.to_string();
        assert_eq!(1 + model.coordinates.len(), text.lines().count(), "{text}");
        let json = serde_json::to_value(state).unwrap();
        assert_eq!(Some(model.bodies.len()), json["bodies"].as_object().map(serde_json::Map::len));
        for (info, body) in model.bodies.iter().zip(&state.bodies) {
            assert_eq!(Some(body.phi_dot), json["bodies"][info.name]["phi_dot"].as_f64(), "{json}");
        }
    }
    let json = serde_json::to_value(&trajectory).unwrap();
    for (state, record) in trajectory.iter().zip(json["states"].as_array().unwrap()) {
        assert_eq!(serde_json::json!(state.q_ddot), record["q_ddot"]);
        assert_eq!(serde_json::to_value(&state.points).unwrap(), record["points"]);
    }
}
