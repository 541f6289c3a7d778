//! The polynomial of fifth degree with given values, first and second derivatives at both ends of the interval 0 … 1:
//!
//! ```text
//! p(x) = p₀ + p′₀ x + ½ p″₀ x² + x³ (c₃ + c₄ x + c₅ x²)
//! ```

/// c₃, c₄ and c₅ from the deviations, at x = 1, of value, first and second derivative from those of the parabola
/// p₀ + p′₀ x + ½ p″₀ x².
#[inline(always)]
pub(crate) fn coefficients([value, first, second]: [f64; 3]) -> [f64; 3] {
    [
        10.0 * value - 4.0 * first + 0.5 * second,
        -15.0 * value + 7.0 * first - second,
        6.0 * value - 3.0 * first + 0.5 * second,
    ]
}

/// p, p′ and p″ at x from those at both ends.
pub(crate) fn quintic([start, end]: [[f64; 3]; 2], x: f64) -> [f64; 3] {
    let [p, v, w] = start;
    let [c3, c4, c5] = coefficients([end[0] - p - v - 0.5 * w, end[1] - v - w, end[2] - w]);
    [
        p + x * (v + x * (0.5 * w + x * (c3 + x * (c4 + x * c5)))),
        v + x * (w + x * (3.0 * c3 + x * (4.0 * c4 + x * 5.0 * c5))),
        w + x * (6.0 * c3 + x * (12.0 * c4 + x * 20.0 * c5)),
    ]
}
