//! Instructions, symbols and slots of a program as tokens.

use kin_core::expr::Symbol;
use kin_core::mechanism::Function;
use kin_core::program::{Instruction, Slot, ValueId};
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{ToTokens, format_ident, quote};

/// The arguments of a kernel for supplied function `number` and its derivatives.
pub(crate) fn function_names(number: u32) -> [Ident; 2] {
    [format_ident!("__function{number}"), format_ident!("__derivatives{number}")]
}

/// The local variable of a value; see `kin_runtime::private::locals` for the reason why no constant of the user may
/// have its name.
pub(super) fn name(prefix: char, value: ValueId) -> Ident {
    Ident::new(&format!("__{prefix}{}", value.0), Span::call_site())
}

/// The local variables that a statement defines for the result of an instruction.
pub(super) fn names_of(value: ValueId, instruction: &Instruction) -> Vec<Ident> {
    match instruction {
        Instruction::SinCos(_) => vec![name('s', value), name('c', value)],
        Instruction::Supplied(..) => vec![name('d', value), name('e', value), name('f', value)],
        _ => vec![name('v', value)],
    }
}

/// `let … = …;` for an instruction, with operands printed by `v`; `None` for instructions that are printed where they
/// are used.
pub(super) fn definition(
    value: ValueId,
    instruction: &Instruction,
    v: impl Fn(ValueId) -> TokenStream,
) -> Option<TokenStream> {
    let expression = match *instruction {
        Instruction::Number(_)
        | Instruction::Load(_)
        | Instruction::SinOf(_)
        | Instruction::CosOf(_)
        | Instruction::SuppliedOf(..)
        // Computed in one call with others.
        | Instruction::SinCos(_)
        | Instruction::Atan2(..) => return None,
        Instruction::Neg(a) => {
            let a = v(a);
            quote! { -#a }
        }
        Instruction::Add(a, b) => binary(v(a), quote! { + }, v(b)),
        Instruction::Sub(a, b) => binary(v(a), quote! { - }, v(b)),
        // The square of an interval has no negative numbers, as its product with another one may have.
        Instruction::Mul(a, b) if a == b => {
            let a = v(a);
            quote! { __kin::Scalar::square(#a) }
        }
        Instruction::Mul(a, b) => binary(v(a), quote! { * }, v(b)),
        Instruction::Div(a, b) => binary(v(a), quote! { / }, v(b)),
        Instruction::Call(f, a) => {
            let (f, a) = (function(f), v(a));
            quote! { __kin::Scalar::#f(#a) }
        }
        Instruction::Sign(a) => {
            let a = v(a);
            quote! { __kin::Scalar::signum(#a) }
        }
        Instruction::Nearest(a, b) => {
            let (a, b) = (v(a), v(b));
            quote! { __kin::Scalar::nearest(#a, #b) }
        }
        Instruction::Powi(a, n) => {
            let (a, n) = (v(a), Literal::i32_suffixed(n));
            quote! { __kin::Scalar::powi(#a, #n) }
        }
        Instruction::Powf(a, n) => {
            let (a, n) = (v(a), literal(n.value()));
            quote! { __kin::Scalar::powf(#a, #n) }
        }
        Instruction::Supplied(f, a) => {
            let ([function, derivatives], a, number) = (function_names(f), v(a), Literal::usize_unsuffixed(f as usize));
            quote! { __kin::Scalar::compose(#a, #number, #function, #derivatives) }
        }
    };
    let names = names_of(value, instruction);
    Some(match instruction {
        Instruction::Supplied(..) => quote! { let [#(#names),*] = #expression; },
        _ => quote! { let #(#names)* = #expression; },
    })
}

fn binary(a: TokenStream, operator: TokenStream, b: TokenStream) -> TokenStream {
    quote! { #a #operator #b }
}

/// A finite literal with its sign.
pub(crate) fn literal(value: f64) -> TokenStream {
    let plain = Literal::f64_suffixed(value.abs());
    // Without an exponent, a very small or large number would have hundreds of digits.
    let magnitude = match value.abs() {
        0.0 | 1e-4..1e16 => plain,
        far => format!("{far:e}f64").parse().unwrap_or(plain),
    };
    if value.is_sign_negative() && value != 0.0 {
        quote! { -#magnitude }
    } else {
        quote! { #magnitude }
    }
}

pub(super) fn number(value: f64) -> TokenStream {
    let value = literal(value);
    quote! { <__T as __kin::Scalar>::from_f64(#value) }
}

/// The argument of a kernel from which a symbol is read.
pub(super) fn argument(symbol: Symbol) -> &'static str {
    match symbol {
        Symbol::Time => "t",
        Symbol::ARGUMENT => "s",
        Symbol::Parameter(_) => "p",
        Symbol::Input(..) => "u",
        Symbol::Coordinate(_) => "q",
        Symbol::Rate(_) => "q_dot",
        Symbol::Acceleration(_) => "q_ddot",
        Symbol::Mode(_) => "modes",
        Symbol::Start(_) => "start",
        Symbol::Unknown(_) => "unknowns",
        Symbol::Saved(_) => "saved",
        Symbol::Right(_) => "right",
        Symbol::Coarseness => "",
    }
}

/// The expression that reads a symbol of this kind at an index.
pub(super) fn load_at(symbol: Symbol, at: &TokenStream) -> TokenStream {
    let argument = || Ident::new(argument(symbol), Span::call_site());
    match symbol {
        Symbol::Coarseness => quote! { <__T as __kin::Scalar>::from_f64(__kin::coarseness::<__T>()) },
        Symbol::Time | Symbol::ARGUMENT => argument().into_token_stream(),
        Symbol::Input(_, order) => {
            let (inputs, part) = (argument(), part_of_input(order));
            quote! { #inputs[#at].#part }
        }
        _ => {
            let array = argument();
            quote! { #array[#at] }
        }
    }
}

/// The expression that reads a symbol whose element of an array has a name.
pub(super) fn load_of(symbol: Symbol, element: &Ident) -> TokenStream {
    match symbol {
        Symbol::Input(_, order) => {
            let part = part_of_input(order);
            quote! { #element.#part }
        }
        _ => quote! { *#element },
    }
}

/// The field of an input that holds its derivative of this order.
fn part_of_input(order: u8) -> Ident {
    Ident::new(["value", "rate", "acceleration"][usize::from(order.min(2))], Span::call_site())
}

fn function(f: Function) -> Ident {
    Ident::new(f.name(), Span::call_site())
}

/// The expression that writes to a slot of this array at an index.
pub(super) fn target_at(slot: Slot, at: &TokenStream) -> TokenStream {
    let array = Ident::new(target_name(slot), Span::call_site());
    quote! { #array[#at] }
}

/// The array to which a slot belongs.
pub(super) fn target_name(slot: Slot) -> &'static str {
    match slot {
        Slot::Phi(_) => "phi",
        Slot::PhiQ(_) => "phi_q",
        Slot::PhiT(_) => "phi_t",
        Slot::Gamma(_) => "gamma",
        Slot::Entry(_) => "out",
        Slot::Position(_) => "position",
        Slot::Velocity(_) => "velocity",
        Slot::Acceleration(_) => "acceleration",
        Slot::Margin(_) => "margins",
        Slot::Saved(_) => "saved",
    }
}
