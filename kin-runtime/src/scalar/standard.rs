//! Functions of the standard library, or of `libm` where there is none, that lanes and single numbers share.

/// Sine and cosine by `std`, or `libm` where there is none.
#[inline(always)]
pub(crate) fn sin_cos(angle: f64) -> (f64, f64) {
    #[cfg(feature = "std")]
    return f64::sin_cos(angle);
    #[cfg(not(feature = "std"))]
    return libm::sincos(angle);
}

/// The same in `f32`.
#[inline(always)]
pub(crate) fn sin_cos_single(angle: f32) -> (f32, f32) {
    #[cfg(feature = "std")]
    return f32::sin_cos(angle);
    #[cfg(not(feature = "std"))]
    return libm::sincosf(angle);
}

/// The angle of the vector (x, y).
#[inline(always)]
pub(crate) fn atan2(y: f64, x: f64) -> f64 {
    #[cfg(feature = "std")]
    return f64::atan2(y, x);
    #[cfg(not(feature = "std"))]
    return libm::atan2(y, x);
}

/// The same in `f32`.
#[inline(always)]
pub(crate) fn atan2_single(y: f32, x: f32) -> f32 {
    #[cfg(feature = "std")]
    return f32::atan2(y, x);
    #[cfg(not(feature = "std"))]
    return libm::atan2f(y, x);
}
