//! The description as the user wrote it: parsed, with spans, and with names that are not resolved yet.
//!
//! A part that could not be parsed is a hole ([`ExprKind::Hole`], [`PointExpr::Hole`]): its error has been reported,
//! and the rest of its statement is still checked.

use kin_core::mechanism::{Function, OperandType, Relation, StatementForm};
use proc_macro2::Span;
use syn::ext::IdentExt;
use syn::{Ident, Type};

/// The contents of the attributes and fields of one mechanism.
pub(crate) struct Description {
    /// The name of the struct.
    pub(crate) name: Ident,
    /// The declarations and rows in the attributes of the struct, in order.
    pub(crate) items: Vec<Item>,
    /// The fields of the struct, in order.
    pub(crate) fields: Vec<FieldDecl>,
    /// The flags of `#[mechanism(…)]`.
    pub(crate) flags: Flags,
    /// The first paragraph of the struct's documentation.
    pub(crate) doc: String,
    /// True if the struct derives `Default`.
    pub(crate) derives_default: bool,
    /// True if a declaration could not be read, so that an unknown name may be one that it declares.
    pub(crate) names_missing: bool,
}

/// The flags of `#[mechanism(…)]`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Flags {
    /// Write the comparison with dual numbers as a test in the user's crate.
    pub(crate) cross_check: bool,
    /// Accept redundant rows.
    pub(crate) allow_redundant: bool,
    /// Without effect, because units are always checked; accepted for compatibility.
    pub(crate) check_units: bool,
}

/// One declaration or statement of a description.
#[derive(Debug)]
pub(crate) enum Item {
    /// A member of `bodies(…)` or a `body(…)`.
    Body(BodyDecl),
    /// A member of `coordinates(…)`.
    Scalar(ScalarDecl),
    /// A member of `input(…)`.
    Input(InputDecl),
    /// `point(p = …)`.
    Point(PointDecl),
    /// `define(e = …)`.
    Define(DefineDecl),
    /// A member of `function(…)`: a field that holds a supplied function.
    Function(FunctionDecl),
    /// A joint, driver, equation, mass or load.
    Statement(Box<Statement>),
    /// `unilateral(N: a > b)`.
    Condition(Box<ConditionDecl>),
    /// One entry of `guess(…)`.
    Guess(GuessDecl),
}

/// The name in a declaration, with its documentation and the contents of its brackets.
#[derive(Clone, Debug)]
pub(crate) struct NewName {
    /// The name.
    pub(crate) ident: Ident,
    /// The brackets after the name: `[10]` or `[i in 0..10]`.
    pub(crate) bracket: Option<Bracket>,
    /// The first paragraph of the doc comment before the name.
    pub(crate) doc: String,
}

/// The contents of the brackets after a declared name.
#[derive(Clone, Debug)]
pub(crate) enum Bracket {
    /// A length: `[10]`.
    Len(usize, Span),
    /// An index with its range: `[i in 0..10]`.
    Range(RangeDecl),
    /// Contents that could not be read, which is reported, with the words at their beginnings, which may be index
    /// variables.
    Hole(Vec<String>),
}

/// `i in start..end`.
#[derive(Clone, Debug)]
pub(crate) struct RangeDecl {
    /// The index variable.
    pub(crate) variable: Ident,
    /// The first index.
    pub(crate) start: i64,
    /// The last index plus one.
    pub(crate) end: i64,
    /// The span of the range.
    pub(crate) span: Span,
}

/// A body and the prescribed parts of its pose.
#[derive(Debug)]
pub(crate) struct BodyDecl {
    pub(crate) name: NewName,
    /// The held components with their keys: `x`, `y`, `phi`.
    pub(crate) held: Vec<(Ident, Expr)>,
    /// The point of `origin = …`, with its key.
    pub(crate) carried: Option<(Ident, PointExpr)>,
}

/// A scalar coordinate.
#[derive(Debug)]
pub(crate) struct ScalarDecl {
    pub(crate) name: NewName,
    pub(crate) unit: Option<String>,
}

/// An input: a signal known only at run time.
#[derive(Debug)]
pub(crate) struct InputDecl {
    pub(crate) name: NewName,
    pub(crate) unit: Option<String>,
    pub(crate) default: Option<f64>,
}

/// A named point.
#[derive(Debug)]
pub(crate) struct PointDecl {
    pub(crate) name: NewName,
    pub(crate) place: PointExpr,
}

/// A named expression.
#[derive(Debug)]
pub(crate) struct DefineDecl {
    pub(crate) name: NewName,
    pub(crate) value: Expr,
    pub(crate) unit: Option<String>,
}

/// A field that holds a supplied function, or an array of them.
#[derive(Debug)]
pub(crate) struct FunctionDecl {
    pub(crate) name: NewName,
}

/// The start value for the assembly of one coordinate, or of the same coordinate of every member of a family.
#[derive(Debug)]
pub(crate) struct GuessDecl {
    /// The body or scalar coordinate.
    pub(crate) target: NameUse,
    /// The range `[i in 0..10]`, if the target has one.
    pub(crate) range: Option<RangeDecl>,
    /// The component `x`, `y` or `phi` of a body.
    pub(crate) component: Option<Ident>,
    pub(crate) value: Expr,
}

/// A unilateral condition.
#[derive(Debug)]
pub(crate) struct ConditionDecl {
    pub(crate) keyword: Ident,
    pub(crate) name: NewName,
    /// The text of both sides as written.
    pub(crate) text: String,
    pub(crate) left: Expr,
    /// The relation; `None` if it could not be read, which is reported.
    pub(crate) relation: Option<Relation>,
    pub(crate) right: Expr,
}

/// A joint, driver, equation, mass or load.
#[derive(Debug)]
pub(crate) struct Statement {
    pub(crate) keyword: Ident,
    pub(crate) name: NewName,
    /// The form of its kind, which defines its slots.
    pub(crate) form: &'static StatementForm,
    /// The operands in the slots of the form.
    pub(crate) operands: Vec<OperandExpr>,
}

/// An operand of a joint; see [`kin_core::mechanism::Operand`].
#[derive(Debug)]
pub(crate) enum OperandExpr {
    Point(PointExpr),
    Points(Vec<PointExpr>),
    Body(BodyExpr),
    /// One or two bodies.
    Bodies(Vec<BodyExpr>),
    /// A scalar coordinate; `None` if it could not be read, which is reported.
    Scalar(Option<NameUse>),
    /// A vector, an axis or two radii.
    Pair(PairExpr),
    Value(Expr),
    Curve(CurveExpr),
}

impl OperandExpr {
    /// A placeholder for an operand that could not be read.
    pub(crate) const fn hole(takes: OperandType, span: Span) -> Self {
        match takes {
            OperandType::Point | OperandType::Points => Self::Point(PointExpr::Hole),
            OperandType::Body | OperandType::Carrier | OperandType::Bodies => Self::Body(BodyExpr::Hole),
            OperandType::Scalar(_) => Self::Scalar(None),
            OperandType::Vector | OperandType::Axis | OperandType::Radii => {
                Self::Pair(PairExpr { x: Expr::hole(span), y: Expr::hole(span), span })
            }
            OperandType::Curve => Self::Curve(CurveExpr::Hole),
            _ => Self::Value(Expr::hole(span)),
        }
    }
}

/// A curve; see [`kin_core::mechanism::Curve`].
#[derive(Debug)]
pub(crate) enum CurveExpr {
    Polar(Expr),
    Implicit(Expr),
    Parametric(Box<PathExpr>),
    /// A curve that could not be read, which is reported.
    Hole,
}

/// A parametric curve: `parametric(u) = (ex, ey), roller = R`.
#[derive(Debug)]
pub(crate) struct PathExpr {
    pub(crate) parameter: NameUse,
    pub(crate) x: Expr,
    pub(crate) y: Expr,
    /// The span of the pair.
    pub(crate) span: Span,
    pub(crate) roller: Option<Expr>,
}

/// A pair: `(vx, vy)`.
#[derive(Debug)]
pub(crate) struct PairExpr {
    pub(crate) x: Expr,
    pub(crate) y: Expr,
    pub(crate) span: Span,
}

/// A body as an operand.
#[derive(Debug)]
pub(crate) enum BodyExpr {
    Named(NameUse),
    /// No body is written, which means the ground.
    NotGiven,
    /// A body that could not be read, which is reported.
    Hole,
}

/// A use of a name, with its index if it has one.
#[derive(Clone, Debug)]
pub(crate) struct NameUse {
    pub(crate) ident: Ident,
    pub(crate) index: Option<IndexExpr>,
}

impl NameUse {
    /// The name for messages: `r#type` is called `type`.
    pub(crate) fn text(&self) -> String {
        text(&self.ident)
    }
}

/// The name of an identifier for messages and comparisons.
pub(crate) fn text(ident: &Ident) -> String {
    ident.unraw().to_string()
}

/// An index: `scale * variable + offset`.
#[derive(Clone, Debug)]
pub(crate) struct IndexExpr {
    pub(crate) scale: i64,
    pub(crate) variable: Option<Ident>,
    pub(crate) offset: i64,
    pub(crate) span: Span,
}

/// A point.
#[derive(Debug)]
pub(crate) enum PointExpr {
    /// `body @ (x, y)`.
    At { body: NameUse, x: Box<Expr>, y: Box<Expr> },
    /// A named point.
    Named(NameUse),
    /// A point that could not be read, which is reported.
    Hole,
}

/// An expression; `height` bounds the depth of recursions over it.
#[derive(Debug)]
pub(crate) struct Expr {
    pub(crate) kind: ExprKind,
    pub(crate) span: Span,
    pub(crate) height: usize,
}

/// The kinds of expressions.
#[derive(Debug)]
pub(crate) enum ExprKind {
    Number(f64),
    /// `t`, `pi`, a parameter, a scalar coordinate, an input, or a define.
    Name(NameUse),
    /// A component of a body or a point: `crank.phi`, `tip.x`.
    Component(NameUse, Ident),
    Distance(PointExpr, PointExpr),
    Neg(Box<Expr>),
    Binary(Operator, Box<Expr>, Box<Expr>),
    Pow(Box<Expr>, f64),
    Call(Function, Box<Expr>),
    Atan2(Box<Expr>, Box<Expr>),
    /// `dot(e)`, with the identifier `dot`.
    Dot(Ident, Box<Expr>),
    /// A call of a name that is not a function of the language: a supplied function, or an error.
    Apply(Box<NameUse>, Vec<Expr>),
    /// An expression that could not be read, which is reported.
    Hole,
}

/// The binary operators.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Operator {
    Add,
    Sub,
    Mul,
    Div,
}

impl Expr {
    /// The largest accepted height: higher expressions would overflow the stack in a later stage.
    pub(crate) const MAX_HEIGHT: usize = 200;

    /// A placeholder for an expression that could not be read.
    pub(crate) const fn hole(span: Span) -> Self {
        Self { kind: ExprKind::Hole, span, height: 0 }
    }

    /// A literal number.
    pub(crate) const fn number(value: f64, span: Span) -> Self {
        Self { kind: ExprKind::Number(value), span, height: 0 }
    }
}

/// A field of the struct.
pub(crate) struct FieldDecl {
    pub(crate) ident: Ident,
    pub(crate) ty: Type,
    /// True if `function(…)` declares this field.
    pub(crate) is_function: bool,
    /// The number of elements of an array field.
    pub(crate) len: Option<usize>,
    /// True if the length of an array has an error, which is reported.
    pub(crate) is_len_unknown: bool,
    /// The type parameter that is the type of the field's numbers.
    pub(crate) scalar: Option<Ident>,
    /// The default value of every element.
    pub(crate) default: Option<Vec<f64>>,
    pub(crate) unit: Option<String>,
    pub(crate) doc: String,
}
