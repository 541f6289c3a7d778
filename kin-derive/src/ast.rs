//! The description as the user wrote it: parsed, spanned, no name resolved yet.
//!
//! What could not be parsed is a hole ([`ExprKind::Hole`], [`PointExpr::Hole`]): its error is already reported,
//! and the rest of its row is still read for mistakes.

use kin_core::mechanism::{Function, Relation, StatementForm};
use proc_macro2::Span;
use syn::ext::IdentExt;
use syn::{Ident, Type};

/// Everything that the attributes and fields of one mechanism say.
pub(crate) struct Description {
    /// The struct's name.
    pub(crate) name: Ident,
    /// Attributes of the struct, in order.
    pub(crate) items: Vec<Item>,
    /// Fields of the struct, in order.
    pub(crate) fields: Vec<FieldDecl>,
    /// What `#[mechanism(…)]` asks for.
    pub(crate) flags: Flags,
    /// First paragraph of the struct's documentation.
    pub(crate) doc: String,
    /// `Default` stands in a `derive`.
    pub(crate) derives_default: bool,
    /// A declaration could not be read, so that an unknown name may be one that it declares.
    pub(crate) names_missing: bool,
}

/// The flags of `#[mechanism(…)]`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Flags {
    /// Write the comparison with dual numbers into the user's tests.
    pub(crate) cross_check: bool,
    /// Redundant rows are no error.
    pub(crate) allow_redundant: bool,
    /// Check units for consistency.
    pub(crate) check_units: bool,
}

/// One declaration or row.
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
    /// A joint, driver or equation.
    Row(Box<Row>),
    /// `unilateral(N: a > b)`.
    Condition(Box<ConditionDecl>),
    /// One entry of `guess(…)`.
    Guess(GuessDecl),
}

/// The name of a new thing, with its documentation and what stands in its brackets.
#[derive(Clone, Debug)]
pub(crate) struct NewName {
    /// The name.
    pub(crate) ident: Ident,
    /// `[10]` or `[i in 0..10]`.
    pub(crate) bracket: Option<Bracket>,
    /// First paragraph of the doc comment before it.
    pub(crate) doc: String,
}

/// What stands in the brackets of a new name.
#[derive(Clone, Debug)]
pub(crate) enum Bracket {
    /// `[10]`.
    Len(usize, Span),
    /// `[i in 0..10]`.
    Range(RangeDecl),
    /// Could not be read; reported.
    Hole,
}

/// `i in start..end`.
#[derive(Clone, Debug)]
pub(crate) struct RangeDecl {
    /// The index variable.
    pub(crate) variable: Ident,
    /// First index.
    pub(crate) start: i64,
    /// One past the last index.
    pub(crate) end: i64,
    /// The range.
    pub(crate) span: Span,
}

/// A body and what is given of its pose.
#[derive(Debug)]
pub(crate) struct BodyDecl {
    pub(crate) name: NewName,
    /// Held components with their keys: `x`, `y`, `phi`.
    pub(crate) held: Vec<(Ident, Expr)>,
    /// `origin = …` with its key.
    pub(crate) carried: Option<(Ident, PointExpr)>,
}

/// A scalar coordinate.
#[derive(Debug)]
pub(crate) struct ScalarDecl {
    pub(crate) name: NewName,
    pub(crate) unit: Option<String>,
}

/// A signal known only at run time.
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

/// The start of assembly of one coordinate, or of one in every member of a family.
#[derive(Debug)]
pub(crate) struct GuessDecl {
    /// Body or scalar coordinate.
    pub(crate) target: NameUse,
    /// `[i in 0..10]`, when the target carries one.
    pub(crate) range: Option<RangeDecl>,
    /// `x`, `y` or `phi` of a body.
    pub(crate) component: Option<Ident>,
    pub(crate) value: Expr,
}

/// A unilateral condition.
#[derive(Debug)]
pub(crate) struct ConditionDecl {
    pub(crate) keyword: Ident,
    pub(crate) name: NewName,
    /// Both sides as they are written.
    pub(crate) text: String,
    pub(crate) left: Expr,
    /// `None` where it could not be read, which is reported.
    pub(crate) relation: Option<Relation>,
    pub(crate) right: Expr,
}

/// A joint, driver or equation.
#[derive(Debug)]
pub(crate) struct Row {
    pub(crate) keyword: Ident,
    pub(crate) name: NewName,
    /// How its kind is written.
    pub(crate) form: &'static StatementForm,
    /// What stands in the slots of its form.
    pub(crate) operands: Vec<OperandExpr>,
}

/// An operand of a joint; see [`kin_core::mechanism::Operand`].
#[derive(Debug)]
pub(crate) enum OperandExpr {
    Point(PointExpr),
    Points(Vec<PointExpr>),
    Body(BodyExpr),
    /// One body, or two.
    Bodies(Vec<BodyExpr>),
    /// A vector.
    Vector(AxisExpr),
    /// A scalar coordinate; `None` could not be read, which is reported.
    Scalar(Option<NameUse>),
    Axis(AxisExpr),
    Value(Expr),
    Radii(RadiiExpr),
    Curve(CurveExpr),
}

/// A curve; see [`kin_core::mechanism::Curve`].
#[derive(Debug)]
pub(crate) enum CurveExpr {
    Polar(Expr),
    Implicit(Expr),
    Parametric(Box<PathExpr>),
    /// Could not be read; reported.
    Hole,
}

/// `parametric(u) = (ex, ey), roller = R`.
#[derive(Debug)]
pub(crate) struct PathExpr {
    pub(crate) parameter: NameUse,
    pub(crate) x: Expr,
    pub(crate) y: Expr,
    /// The pair.
    pub(crate) span: Span,
    pub(crate) roller: Option<Expr>,
}

/// `(vx, vy)`, an axis or a vector.
#[derive(Debug)]
pub(crate) struct AxisExpr {
    pub(crate) x: Expr,
    pub(crate) y: Expr,
    pub(crate) span: Span,
}

impl AxisExpr {
    /// What stands for a pair that could not be read.
    pub(crate) const fn hole(span: Span) -> Self {
        Self { x: Expr::hole(span), y: Expr::hole(span), span }
    }
}

/// `(ra, rb)`.
#[derive(Debug)]
pub(crate) struct RadiiExpr {
    pub(crate) i: Expr,
    pub(crate) j: Expr,
    pub(crate) span: Span,
}

/// A body as an operand.
#[derive(Debug)]
pub(crate) enum BodyExpr {
    Named(NameUse),
    /// The ground, where no body is given.
    NotGiven,
    /// Could not be read; reported.
    Hole,
}

/// A use of a name, with an index when it has one.
#[derive(Clone, Debug)]
pub(crate) struct NameUse {
    pub(crate) ident: Ident,
    pub(crate) index: Option<IndexExpr>,
}

impl NameUse {
    /// The name for people: `r#type` is called `type`.
    pub(crate) fn text(&self) -> String {
        text(&self.ident)
    }
}

/// The name of an identifier for people and for comparison.
pub(crate) fn text(ident: &Ident) -> String {
    ident.unraw().to_string()
}

/// `scale * variable + offset`.
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
    /// Could not be read; reported.
    Hole,
}

/// An expression; `height` bounds the recursion of whoever walks it.
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
    /// `t`, `pi`, a parameter, a scalar coordinate, an input, a define.
    Name(NameUse),
    /// `crank.phi`, `tip.x`.
    Component(NameUse, Ident),
    Distance(PointExpr, PointExpr),
    Neg(Box<Expr>),
    Binary(Operator, Box<Expr>, Box<Expr>),
    Pow(Box<Expr>, f64),
    Call(Function, Box<Expr>),
    Atan2(Box<Expr>, Box<Expr>),
    /// `dot(e)`, with the word.
    Dot(Ident, Box<Expr>),
    /// A call of something that is no function of the language: a supplied function, or a mistake.
    Apply(Box<NameUse>, Vec<Expr>),
    /// Could not be read; reported.
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
    /// The tallest expression that is accepted: deeper ones would exhaust a stack somewhere on the way.
    pub(crate) const MAX_HEIGHT: usize = 200;

    /// What stands for an expression that could not be read.
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
    /// Declared by `function(…)`.
    pub(crate) is_function: bool,
    /// Number of elements of an array field.
    pub(crate) len: Option<usize>,
    /// The type parameter that its numbers are of.
    pub(crate) scalar: Option<Ident>,
    /// Default of every element.
    pub(crate) default: Option<Vec<f64>>,
    pub(crate) unit: Option<String>,
    pub(crate) doc: String,
}
