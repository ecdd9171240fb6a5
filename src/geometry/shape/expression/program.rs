// SPDX-License-Identifier: MIT OR Apache-2.0
//! An expression as a flat program in postfix order. exmex parses the text and evaluates it once, over
//! programs: each operator joins those of its operands. What comes out runs over any kind of number.

use super::number::{Function, Number};
use super::text::{NEGATIVE, conform, number_length};
use crate::error::{Error, Result};
use exmex::{BinOp, Express, FlatEx, MakeOperators, MatchLiteral, Operator};
use std::str::FromStr;

/// Whole exponents up to this size are multiplied out.
const EXPONENT: f64 = 64.0;
/// Most values that wait for an operator.
const DEEPEST: usize = 1024;

/// One step: takes its operands from the stack's top and leaves the result there.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Step {
    Constant(f64),
    Coordinate(usize),
    Function(Function),
    Negative,
    Add,
    Subtract,
    Multiply,
    Divide,
    Min,
    Max,
    Power,
    Angle,
    Whole(i32),
    /// The root of the sum of the squares of so many values.
    Norm(usize),
}

impl Step {
    fn operands(self) -> usize {
        match self {
            Step::Constant(_) | Step::Coordinate(_) => 0,
            Step::Function(_) | Step::Negative | Step::Whole(_) => 1,
            Step::Norm(n) => n,
            _ => 2,
        }
    }
}

/// What runs.
pub(super) struct Program {
    steps: Vec<Step>,
    /// Values on the stack at most.
    depth: usize,
}

impl Program {
    pub(super) fn new(text: &str) -> Result<Program> {
        let conformed = conform(text)?;
        let failed = |e: exmex::ExError| {
            let message: String = e.to_string().chars().take(200).collect();
            Error::invalid(format!("expression: {message}"))
        };
        let parsed = FlatEx::<Part, Operators, Literals>::parse_wo_compile(&conformed).map_err(failed)?;
        // exmex takes the variables that there are, in order of their names.
        let variable =
            |name: &String| Part(vec![Step::Coordinate(["x", "y", "z"].iter().position(|c| c == name).unwrap_or(0))]);
        let variables: Vec<Part> = parsed.var_names().iter().map(variable).collect();
        let Part(steps) = parsed.eval(&variables).map_err(failed)?;
        let (mut depth, mut deepest) = (0usize, 0);
        for step in &steps {
            // An operator without its operands would be a defect of the parse.
            let Some(rest) = depth.checked_sub(step.operands()) else {
                return Err(Error::invalid("expression: an operator lacks a value"));
            };
            depth = rest + 1;
            deepest = deepest.max(depth);
        }
        match (depth, deepest) {
            (1, 0..=DEEPEST) => Ok(Program { steps, depth: deepest }),
            (1, _) => Err(Error::invalid(format!("expression: more than {DEEPEST} values wait for an operator"))),
            _ => Err(Error::invalid("expression: an operator is missing")),
        }
    }

    /// How many steps.
    pub(super) fn len(&self) -> usize {
        self.steps.len()
    }

    /// Memory on the heap.
    pub(super) fn bytes(&self) -> usize {
        self.steps.capacity() * size_of::<Step>()
    }

    /// The value where the coordinates have these values. Allocates nothing.
    pub(super) fn evaluate<N: Number>(&self, p: [N; 3]) -> N {
        match self.depth {
            0..=8 => self.run::<N, 8>(p),
            9..=64 => self.run::<N, 64>(p),
            _ => self.run::<N, DEEPEST>(p),
        }
    }

    fn run<N: Number, const DEPTH: usize>(&self, p: [N; 3]) -> N {
        let mut stack = [p[0]; DEPTH];
        let mut top = 0;
        for step in &self.steps {
            // Operands were counted when the program was made: `top` is in range throughout.
            top -= step.operands();
            let (a, b) = (stack[top], stack[(top + 1).min(DEPTH - 1)]);
            stack[top] = match *step {
                Step::Constant(x) => N::constant(x),
                Step::Coordinate(k) => p[k],
                Step::Function(f) => a.function(f),
                Step::Negative => -a,
                Step::Add => a + b,
                Step::Subtract => a - b,
                Step::Multiply => a * b,
                Step::Divide => a / b,
                Step::Min => a.min(b),
                Step::Max => a.max(b),
                Step::Power => a.pow(b),
                Step::Angle => N::atan2(a, b),
                Step::Whole(n) => a.whole(n),
                Step::Norm(n) => N::norm(&stack[top..top + n]),
            };
            top += 1;
        }
        stack[0]
    }
}

/// The program of a part of the text.
#[derive(Clone, Debug, Default)]
struct Part(Vec<Step>);

impl FromStr for Part {
    type Err = std::num::ParseFloatError;
    fn from_str(text: &str) -> std::result::Result<Part, Self::Err> {
        Ok(Part(vec![Step::Constant(text.parse()?)]))
    }
}

impl Part {
    fn then(mut self, step: Step) -> Part {
        self.0.push(step);
        self
    }

    fn joined(mut self, mut other: Part, step: Step) -> Part {
        self.0.append(&mut other.0);
        self.then(step)
    }

    fn negative(self) -> Part {
        match self.0[..] {
            [Step::Constant(x)] => Part(vec![Step::Constant(-x)]),
            _ => self.then(Step::Negative),
        }
    }

    fn product(self, other: Part) -> Part {
        // The square of one thing: an interval does better than with a product of two.
        if self.0 == other.0 { self.then(Step::Whole(2)) } else { self.joined(other, Step::Multiply) }
    }

    fn power(self, exponent: Part) -> Part {
        match exponent.0[..] {
            [Step::Constant(n)] if n == n.trunc() && n.abs() <= EXPONENT => self.then(Step::Whole(n as i32)),
            _ => self.joined(exponent, Step::Power),
        }
    }

    /// Where the steps of the value that ends before `end` begin.
    fn start(steps: &[Step], end: usize) -> Option<usize> {
        let mut needed = 1;
        for at in (0..end).rev() {
            needed = needed - 1 + steps[at].operands();
            if needed == 0 {
                return Some(at);
            }
        }
        None
    }

    /// sqrt(a^2 + b^2) and sqrt(a^2 + b^2 + c^2) become norms, whose slope is known around zero too.
    fn root(self) -> Part {
        Part::norm(&self.0).unwrap_or_else(|| self.then(Step::Function(Function::Sqrt)))
    }

    fn norm(steps: &[Step]) -> Option<Part> {
        let square = |from: usize, to: usize| (steps[to - 1] == Step::Whole(2)).then(|| steps[from..to - 1].to_vec());
        let mut squares = Vec::new();
        let mut end = steps.len();
        // ((a^2 + b^2) + c^2): the last summand first.
        while squares.len() < 2 && end > 0 && steps[end - 1] == Step::Add {
            let start = Part::start(steps, end - 1)?;
            squares.push(square(start, end - 1)?);
            end = start;
        }
        if end == 0 {
            return None;
        }
        squares.push(square(0, end)?);
        squares.reverse();
        let n = squares.len();
        Some(Part(squares.concat()).then(Step::Norm(n)))
    }
}

/// The numbers that `text::conform` lets through.
#[derive(Clone, Debug)]
struct Literals;

impl MatchLiteral for Literals {
    fn is_literal(text: &str) -> Option<&str> {
        text.get(..number_length(text)).filter(|digits| !digits.is_empty())
    }
}

#[derive(Clone, Debug)]
struct Operators;

impl MakeOperators<Part> for Operators {
    fn make<'a>() -> Vec<Operator<'a, Part>> {
        // Nothing is commutative for exmex: it would reorder, and change the bits.
        let binary = |prio: i64, apply: fn(Part, Part) -> Part| BinOp { apply, prio, is_commutative: false };
        let minus = binary(1, |a, b| a.joined(b, Step::Subtract));
        let mut operators = vec![
            Operator::make_bin("+", binary(1, |a, b| a.joined(b, Step::Add))),
            Operator::make_bin_unary("-", minus, Part::negative),
            Operator::make_bin("*", binary(2, Part::product)),
            Operator::make_bin("/", binary(2, |a, b| a.joined(b, Step::Divide))),
            Operator::make_bin(NEGATIVE, binary(3, |_, b| b.negative())),
            Operator::make_bin("^", binary(4, Part::power)),
            Operator::make_bin("pow", binary(5, Part::power)),
            Operator::make_bin("min", binary(5, |a, b| a.joined(b, Step::Min))),
            Operator::make_bin("max", binary(5, |a, b| a.joined(b, Step::Max))),
            Operator::make_bin("atan2", binary(5, |a, b| a.joined(b, Step::Angle))),
        ];
        operators.extend(Function::ALL.map(|(name, f)| Operator::make_unary(name, apply(f))));
        operators
    }
}

/// exmex takes bare functions, which cannot hold which one they are.
fn apply(f: Function) -> fn(Part) -> Part {
    macro_rules! pick {
        ($($name:ident)*) => { match f { Function::Sqrt => Part::root, $(Function::$name => |a| a.then(Step::Function(Function::$name)),)* } };
    }
    pick!(Abs Exp Ln Log10 Sin Cos Tan Asin Acos Atan Sinh Cosh Tanh)
}
