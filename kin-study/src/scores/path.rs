//! Normalised paths, which are equal for paths that differ only in position, size and direction.

/// Moves, turns and scales a path, x and y of one point after another, as [`Score::Path`](crate::Score::Path)
/// describes. If all points are the same, or a number is not finite, all numbers become 0.
pub fn normalise(path: &mut [f64]) {
    let (points, _) = path.as_chunks_mut::<2>();
    let count = points.len() as f64;
    let mean = |part: &dyn Fn(&[f64; 2]) -> f64, points: &[[f64; 2]]| points.iter().map(part).sum::<f64>() / count;
    let centre = [mean(&|p| p[0], points), mean(&|p| p[1], points)];
    points.iter_mut().for_each(|p| *p = [p[0] - centre[0], p[1] - centre[1]]);
    let [xx, xy, yy] = [mean(&|p| p[0] * p[0], points), mean(&|p| p[0] * p[1], points), mean(&|p| p[1] * p[1], points)];
    let size = (xx + yy).sqrt();
    if !(size > 0.0 && size.is_finite()) {
        path.fill(0.0);
        return;
    }
    // The axis of the greater moment makes this angle with x.
    let (sin, cos) = (0.5 * (2.0 * xy).atan2(xx - yy)).sin_cos();
    let turned = |p: &[f64; 2]| [(cos * p[0] + sin * p[1]) / size, (cos * p[1] - sin * p[0]) / size];
    points.iter_mut().for_each(|p| *p = turned(p));
    if mean(&|p| p[0].powi(3), points) < 0.0 {
        points.iter_mut().flatten().for_each(|number| *number = -*number);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_of_one_shape_become_one() {
        let shape: Vec<[f64; 2]> = (0..60)
            .map(|k| f64::from(k) / 60.0 * std::f64::consts::TAU)
            .map(|a| [3.0 * a.cos() + 0.7 * (2.0 * a).cos(), a.sin() + 0.1 * (3.0 * a).cos()])
            .collect();
        let placed = |angle: f64, scale: f64, [x, y]: [f64; 2]| -> Vec<f64> {
            let (sin, cos) = angle.sin_cos();
            let place = |p: &[f64; 2]| [x + scale * (cos * p[0] - sin * p[1]), y + scale * (sin * p[0] + cos * p[1])];
            let mut path: Vec<f64> = shape.iter().flat_map(place).collect();
            normalise(&mut path);
            path
        };
        let first = placed(0.0, 1.0, [0.0, 0.0]);
        let squares: f64 = first.iter().map(|number| number * number).sum();
        assert!((squares / 60.0 - 1.0).abs() < 1e-12 && first.iter().sum::<f64>().abs() < 1e-12);
        for (angle, scale, to) in [(1.0, 0.01, [5.0, -3.0]), (2.5, 7.0, [0.0, 1.0]), (-2.0, 1.0, [1e3, 0.0])] {
            let other = placed(angle, scale, to);
            assert!(first.iter().zip(&other).all(|(a, b)| (a - b).abs() < 1e-8), "{angle}");
        }
    }

    #[test]
    fn a_point_has_no_shape() {
        let mut path = [2.0, 3.0, 2.0, 3.0];
        normalise(&mut path);
        assert_eq!(path, [0.0; 4]);
    }
}
