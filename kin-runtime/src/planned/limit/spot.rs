//! The place at which a margin is zero or has its minimum.

/// Rounding error of a margin that is zero.
pub(super) const NO_MARGIN: f64 = 1e-13;

/// The first step of the search for a limit, relative to the length of the course, large enough not to be lost in
/// rounding.
const FIRST_STEP: f64 = 1e-6;

/// How many times as far a limit may be as the place at which a margin with the present slope would be zero: twice at a
/// crossing, and with a reserve.
const SEARCH_REACH: f64 = 8.0;

/// Numbers of bisections, and of golden sections in the search for a minimum, that suffice for all digits of a number.
const HALVINGS: usize = 80;
const SECTIONS: usize = 90;

/// A place at which a margin is zero or has its minimum.
pub(super) struct Spot {
    pub(super) s: f64,
    /// The margin at that place.
    pub(super) margin: f64,
    /// The smallest margin found.
    pub(super) least: f64,
}

impl Spot {
    /// The first place beyond `from` at which the margin is zero or has its minimum. `refused` is the next place, which
    /// could not be reached; `start` and `end` are the ends of the course. If `knows_past`, the motion before the course
    /// is known. Where the margin only grows from the end of the course, its minimum lies before. The last evaluations of
    /// the margin are those beside the place found.
    pub(super) fn beyond(
        [from, refused]: [f64; 2],
        ([start, end], knows_past): ([f64; 2], bool),
        margin: &mut dyn FnMut(f64) -> f64,
    ) -> Self {
        let direction = if end < start { -1.0 } else { 1.0 };
        let at_from = margin(from);
        // A margin may be zero at one place alone, as where the pins of two equal links coincide.
        if refused != from && margin(refused) <= 0.0 {
            let least = depth(margin, (refused, 0.0), FIRST_STEP * (refused - from));
            let (s, margin) = root(margin, from, refused);
            return Self { s, margin, least };
        }
        // The limit may lie beyond the end of the course; it is searched up to a course length beyond, or up to where
        // the margin, which is quadratic near a crossing, would be zero several times over.
        let slope = (margin(start) - at_from) / (from - start).abs();
        let ahead = if slope > 0.0 { SEARCH_REACH * at_from / slope } else { 0.0 };
        let least = FIRST_STEP * (end + (end - start) - from).abs();
        let end = end + direction * (end - start).abs().max(ahead);
        let stride = direction * (refused - from).abs().max(least).max(4.0 * f64::EPSILON * from.abs());
        let mut descent = Descent::from(margin, (from, at_from), end, stride);
        // Where the margin only grows from the end of a course, the motion has passed the minimum.
        if descent.at_c > 0.0 && descent.b == from && refused == from {
            let behind = if slope < 0.0 { SEARCH_REACH * at_from / -slope } else { 0.0 };
            let earliest = from - direction * behind;
            let back = if (start - earliest) * direction > 0.0 && knows_past { earliest } else { start };
            descent = Descent::from(margin, (from, at_from), back, -stride);
        }
        let Descent { a, b, c, at_c, stride } = descent;
        if at_c <= 0.0 {
            let least = depth(margin, (c, at_c), FIRST_STEP * stride);
            let (s, margin) = root(margin, b, c);
            return Self { s, margin, least };
        }
        let (lowest, least) = minimum(margin, a, c);
        let (s, margin) = if least < 0.0 { root(margin, a, lowest) } else { (lowest, least) };
        Self { s, margin, least }
    }
}

/// The way down from a place in growing strides, until the function is not positive or grows again: the last three places
/// of the way.
struct Descent {
    a: f64,
    b: f64,
    c: f64,
    at_c: f64,
    /// The last stride, with its sign.
    stride: f64,
}

impl Descent {
    /// From a place, with the value there, to `end` at most.
    fn from(f: &mut dyn FnMut(f64) -> f64, (from, at_from): (f64, f64), end: f64, mut stride: f64) -> Self {
        let (mut a, mut b, mut at_b) = (from, from, at_from);
        let (mut c, mut at_c) = (b, at_b);
        for _ in 0..HALVINGS {
            c = b + stride;
            let beyond = if stride > 0.0 { c >= end } else { c <= end };
            if beyond {
                c = end;
            }
            at_c = f(c);
            if at_c <= 0.0 || at_c > at_b + NO_MARGIN || beyond {
                break;
            }
            // Over the first strides the function may change by less than its rounding error.
            if at_c < at_b - NO_MARGIN {
                (a, b, at_b) = (b, c, at_c);
            }
            stride *= 2.0;
        }
        Self { a, b, c, at_c, stride }
    }
}

/// The value at a place or, if it is zero but for rounding, the least one to which the function falls beyond it, in
/// growing strides.
fn depth(f: &mut dyn FnMut(f64) -> f64, (mut s, mut least): (f64, f64), mut stride: f64) -> f64 {
    for _ in 0..HALVINGS {
        s += stride;
        if least < -NO_MARGIN || !s.is_finite() {
            break;
        }
        let value = f(s);
        if value > least + NO_MARGIN {
            break;
        }
        (least, stride) = (least.min(value), 2.0 * stride);
    }
    least
}

/// The place between `a`, where the function is positive, and `b`, where it is not, at which its sign changes; and its
/// value there.
fn root(f: &mut dyn FnMut(f64) -> f64, mut a: f64, mut b: f64) -> (f64, f64) {
    let mut at_b = f(b);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (a + b);
        if middle == a || middle == b {
            break;
        }
        let found = f(middle);
        if found > 0.0 {
            a = middle;
        } else {
            (b, at_b) = (middle, found);
        }
    }
    (b, at_b)
}

/// The minimum of a function between two places by golden section search (Kiefer 1953), and its value there.
fn minimum(f: &mut dyn FnMut(f64) -> f64, mut a: f64, mut b: f64) -> (f64, f64) {
    const GOLDEN_SECTION: f64 = 0.618_033_988_749_894_9;
    let (mut c, mut d) = (b - GOLDEN_SECTION * (b - a), a + GOLDEN_SECTION * (b - a));
    let (mut at_c, mut at_d) = (f(c), f(d));
    for _ in 0..SECTIONS {
        if at_c < at_d {
            (b, d, at_d) = (d, c, at_c);
            c = b - GOLDEN_SECTION * (b - a);
            at_c = f(c);
        } else {
            (a, c, at_c) = (c, d, at_d);
            d = a + GOLDEN_SECTION * (b - a);
            at_d = f(d);
        }
    }
    if at_c < at_d { (c, at_c) } else { (d, at_d) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_root_is_found_to_the_last_digit_from_either_side() {
        for (a, b) in [(0.1, 0.7), (0.7, 0.1), (0.3, 0.7), (-1e3, 1e3)] {
            let towards = f64::signum(b - a);
            let mut f = |s: f64| (0.3 - s) * towards;
            let (s, value) = root(&mut f, a, b);
            assert!(value <= 0.0 && value == f(s), "{a} {b}: {value}");
            assert!((s - 0.3).abs() <= f64::EPSILON, "{a} {b}: {s}");
        }
        // For a jump across 0 the result is the first place after it.
        let (s, value) = root(&mut |s| if s < 0.3 { 1.0 } else { -5.0 }, 0.0, 1.0);
        assert_eq!((0.3, -5.0), (s, value));
    }

    #[test]
    fn a_minimum_is_found_wherever_it_is() {
        for least in [0.0, 0.01, 0.3, 0.5, 0.99, 1.0] {
            for (a, b) in [(0.0, 1.0), (1.0, 0.0)] {
                let (s, value) = minimum(&mut |s| 2.0 + (s - least).abs(), a, b);
                assert!((s - least).abs() < 1e-12, "{least} from {a} to {b}: {s}");
                assert_eq!(2.0 + (s - least).abs(), value);
            }
        }
    }

    /// Margins with a fold at 0.3 and another one δ behind it, with rounding errors, from places before it.
    #[test]
    fn the_first_of_two_close_folds_is_found_in_spite_of_rounding() {
        for apart in [1e-3, 1e-4, 1e-5, 1e-6] {
            let exact = |s: f64| (0.3 - s) * (0.3 + apart - s);
            let mut noisy = |s: f64| 1.0 - (1.0 - exact(s));
            for before in [2e-3, 4e-4, 1e-5, 1e-7] {
                for refused in [0.0, 1e-9, 1e-6] {
                    let from = 0.3 - before;
                    let spot = Spot::beyond([from, from + refused], ([from - 6e-4, from], true), &mut noisy);
                    let off = (spot.s - 0.3).abs() / (1e-14 / apart).max(4e-16);
                    assert!(off < 1.0 && spot.margin <= 0.0, "{apart} {before} {refused}: {} {}", spot.s, spot.margin);
                }
            }
        }
    }

    /// The margin of a fold becomes clearly negative beyond it, wherever the search has met it; one that is touched does not.
    #[test]
    fn the_depth_beyond_a_root_tells_a_fold_from_a_crossing() {
        for met in [1e-16, 1e-13, 1e-9] {
            let refused = 0.3 + met;
            let fold = Spot::beyond([0.2, refused], ([0.1, 0.2], true), &mut |s| (0.3 - s) * (0.301 - s));
            assert!((fold.s - 0.3).abs() < 1e-15 && fold.least < -NO_MARGIN, "{met}: {}", fold.least);
            let touched = Spot::beyond([0.2, refused], ([0.1, 0.2], true), &mut |s| (0.3 - s) * (0.3 - s) - 1e-15);
            assert!((touched.s - 0.3).abs() < 1e-7 && touched.least >= -1e-15, "{met}: {}", touched.least);
        }
    }

    /// A step has passed the minimum, and its end is refused.
    #[test]
    fn a_minimum_that_has_been_passed_is_found_behind() {
        for least in [0.0, 1e-10, 1e-9] {
            for (start, end) in [(0.299, 0.301), (0.301, 0.2995), (0.2, 0.3001), (0.3003, 0.3005), (0.2996, 0.299)] {
                let mut noisy = |s: f64| 1.0 - (1.0 - (least + (s - 0.3) * (s - 0.3)));
                let spot = Spot::beyond([end, end], ([start, end], start != 0.301), &mut noisy);
                assert!((spot.s - 0.3).abs() < 1e-7 && spot.margin < least + 1e-14, "{least} {start}: {}", spot.s);
            }
        }
    }

    /// The margin of a divisor has the same size on both sides of its zero, so that its slope says nothing.
    #[test]
    fn a_change_of_sign_is_found_at_its_place() {
        for rounding in [0.0, 1e-15, -1e-15] {
            let mut divisor = |s: f64| if s < 0.3 { 0.999 - rounding * s } else { -0.999 };
            let spot = Spot::beyond([0.29, 0.299], ([0.2, 0.31], true), &mut divisor);
            assert!((spot.s - 0.3).abs() < 1e-15 && spot.margin == -0.999, "{rounding}: {}", spot.s);
        }
    }

    #[test]
    fn a_margin_that_is_zero_at_one_place_alone_is_found_there() {
        for from in [0.3 - 1e-15, 0.3 - 1e-6, 0.3 + 1e-9] {
            let mut alone = |s: f64| if s == 0.3 { 0.0 } else { 0.9 - s };
            let spot = Spot::beyond([from, 0.3], ([0.2 * from, from], true), &mut alone);
            assert_eq!([0.3, 0.0], [spot.s, spot.margin], "{from}");
        }
    }

    #[test]
    fn a_margin_that_touches_zero_or_stays_above_it_is_followed_to_its_minimum() {
        for least in [0.0, 1e-12, 1e-9, 1e-3] {
            let mut noisy = |s: f64| 1.0 - (1.0 - (least + (s - 0.3) * (s - 0.3)));
            for before in [2e-3, 4e-4, 1e-5] {
                let from = 0.3 - before;
                let spot = Spot::beyond([from, from], ([from - 6e-4, from], true), &mut noisy);
                assert!((spot.s - 0.3).abs() < 1e-7 && spot.margin < least + 1e-14, "{least} {before}: {}", spot.s);
            }
        }
    }
}
