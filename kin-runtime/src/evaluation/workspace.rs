//! Arguments and results of an evaluation: instants, subsets, and the caller's workspaces.

use crate::model::Pattern;
use crate::scalar::Scalar;
#[doc(no_inline)]
use crate::text::{numbers, separated};
use core::fmt;

/// The parts among Φ, Φ_q, Φ_t and γ that an evaluation must compute; the others may be left unchanged.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Subset {
    /// Φ, s numbers.
    pub phi: bool,
    /// Φ_q, its non-zeros.
    pub phi_q: bool,
    /// Φ_t, s numbers.
    pub phi_t: bool,
    /// γ, s numbers.
    pub gamma: bool,
}

impl Subset {
    /// Φ alone.
    pub const PHI: Self = Self { phi: true, phi_q: false, phi_t: false, gamma: false };
    /// Φ_q alone.
    pub const JACOBIAN: Self = Self { phi: false, phi_q: true, phi_t: false, gamma: false };
    /// Φ_t alone.
    pub const TIME_DERIVATIVE: Self = Self { phi: false, phi_q: false, phi_t: true, gamma: false };
    /// γ alone.
    pub const GAMMA: Self = Self { phi: false, phi_q: false, phi_t: false, gamma: true };
    /// Φ and Φ_q, for a Newton step.
    pub const POSITION: Self = Self { phi: true, phi_q: true, phi_t: false, gamma: false };
    /// Φ_q and Φ_t, for the velocity equations.
    pub const VELOCITY: Self = Self { phi: false, phi_q: true, phi_t: true, gamma: false };
    /// All four.
    pub const ALL: Self = Self { phi: true, phi_q: true, phi_t: true, gamma: true };
}

/// An array `[T; N]` of any length N.
#[doc(hidden)]
pub trait Array<T>: Copy + AsRef<[T]> + AsMut<[T]> {
    /// The array of `f(0), f(1), …`. It is filled with `zero` first, because a loop compiles faster than a function that
    /// builds an array.
    fn generate(zero: T, f: impl FnMut(usize) -> T) -> Self;
    /// The array filled with `value`.
    fn filled(value: T) -> Self;
    /// The list as an array, if it has the right length.
    fn view(list: &[T]) -> Option<&Self>;
}

impl<T: Copy, const N: usize> Array<T> for [T; N] {
    #[inline(always)]
    fn generate(zero: T, mut f: impl FnMut(usize) -> T) -> Self {
        let mut out = [zero; N];
        let mut k = 0;
        while k < N {
            out[k] = f(k);
            k += 1;
        }
        out
    }

    #[inline(always)]
    fn filled(value: T) -> Self {
        [value; N]
    }

    #[inline(always)]
    fn view(list: &[T]) -> Option<&Self> {
        list.try_into().ok()
    }
}

/// The values of a set of rows, the non-zeros of their Jacobian, their time derivatives and acceleration right-hand
/// sides.
///
/// The constraints and the observables of a mechanism have the same shape: for rows e(q, t) this holds e, the non-zeros
/// of e_q in the order of the [`Pattern`], e_t, and γ = −(e_q q̇)_q q̇ − 2 e_qt q̇ − e_tt, so that ė = e_q q̇ + e_t and
/// ë = e_q q̈ − γ. Entries of e_q that are literal constants are written once, when the workspace is created.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evaluation<R, J> {
    phi: R,
    phi_q: J,
    phi_t: R,
    gamma: R,
}

impl<R, J> Evaluation<R, J> {
    /// A workspace for rows with this pattern: constant entries are set, all others are zero.
    pub fn new<T: Scalar>(pattern: &Pattern) -> Self
    where
        R: Array<T>,
        J: Array<T>,
    {
        let zero = T::from_f64(0.0);
        let (rows, mut phi_q) = (R::filled(zero), J::filled(zero));
        for &(index, value) in pattern.constants {
            if let Some(entry) = phi_q.as_mut().get_mut(index) {
                *entry = T::from_f64(value);
            }
        }
        Self { phi: rows, phi_q, phi_t: rows, gamma: rows }
    }

    /// Φ, or the values of the observables.
    pub fn phi<T>(&self) -> &[T]
    where
        R: AsRef<[T]>,
    {
        self.phi.as_ref()
    }

    /// The non-zeros of Φ_q, in the order of the pattern's entries.
    pub fn phi_q<T>(&self) -> &[T]
    where
        J: AsRef<[T]>,
    {
        self.phi_q.as_ref()
    }

    /// Φ_t.
    pub fn phi_t<T>(&self) -> &[T]
    where
        R: AsRef<[T]>,
    {
        self.phi_t.as_ref()
    }

    /// γ.
    pub fn gamma<T>(&self) -> &[T]
    where
        R: AsRef<[T]>,
    {
        self.gamma.as_ref()
    }

    /// The four parts as mutable references, for generated code.
    #[doc(hidden)]
    pub fn parts_mut(&mut self) -> (&mut R, &mut J, &mut R, &mut R) {
        (&mut self.phi, &mut self.phi_q, &mut self.phi_t, &mut self.gamma)
    }
}

/// The parts, for example `Φ, Φ_q`.
impl fmt::Display for Subset {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts = [(self.phi, "Φ"), (self.phi_q, "Φ_q"), (self.phi_t, "Φ_t"), (self.gamma, "γ")];
        if parts.iter().all(|(wanted, _)| !wanted) {
            return f.write_str("nothing");
        }
        separated(f, parts.iter().filter(|(wanted, _)| *wanted), |f, (_, part)| f.write_str(part))
    }
}

/// Φ, the non-zeros of Φ_q, Φ_t and γ.
impl<R: AsRef<[f64]>, J: AsRef<[f64]>> fmt::Display for Evaluation<R, J> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts = [("Φ", self.phi()), ("Φ_q", self.phi_q()), ("Φ_t", self.phi_t()), ("γ", self.gamma())];
        separated(f, parts, |f, (name, values)| {
            write!(f, "{name} = ")?;
            numbers(f, values)
        })
    }
}
