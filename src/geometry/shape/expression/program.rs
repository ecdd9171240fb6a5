// SPDX-License-Identifier: MIT OR Apache-2.0
//! An expression as a flat program in postfix order, which runs over any kind of number.

use super::number::{Function, Number};

/// Whole exponents up to this size are multiplied out.
const EXPONENT: f64 = 64.0;
/// Most values that wait for an operator.
pub(super) const DEEPEST: usize = 1024;

/// One step: takes its operands from the stack's top and leaves the result there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Step {
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
            // The parser emits no operator without its operands: `top` is in range throughout.
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

/// A program in the making: takes the steps in postfix order and folds some of them.
#[derive(Default)]
pub(super) struct Builder {
    steps: Vec<Step>,
    /// Where the steps of each value that waits for an operator begin.
    starts: Vec<usize>,
    depth: usize,
}

impl Builder {
    pub(super) fn program(self) -> Program {
        Program { steps: self.steps, depth: self.depth }
    }

    /// Adds a constant or a coordinate; whether so many values may wait.
    pub(super) fn value(&mut self, step: Step) -> bool {
        self.starts.push(self.steps.len());
        self.steps.push(step);
        self.depth = self.depth.max(self.starts.len());
        self.depth <= DEEPEST
    }

    /// Applies a step to the last value, or to the last two.
    pub(super) fn apply(&mut self, step: Step) {
        let last = if step.operands() == 2 { self.starts.pop() } else { self.starts.last().copied() }.unwrap_or(0);
        let first = self.starts.last().copied().unwrap_or(0);
        let (before, operand) = self.steps.split_at(last);
        let folded = match (step, operand) {
            (Step::Negative, [Step::Constant(x)]) => Some(vec![Step::Constant(-x)]),
            // The square of one thing: an interval does better than with a product of two.
            (Step::Multiply, _) if before[first..] == *operand => Some(vec![Step::Whole(2)]),
            (Step::Power, [Step::Constant(n)]) if *n == n.trunc() && n.abs() <= EXPONENT => {
                Some(vec![Step::Whole(*n as i32)])
            }
            (Step::Function(Function::Sqrt), _) => norm(operand),
            _ => None,
        };
        match folded {
            Some(steps) => drop(self.steps.splice(last.., steps)),
            None => self.steps.push(step),
        }
    }
}

/// sqrt(a^2 + b^2) and sqrt(a^2 + b^2 + c^2) become norms, whose slope is known around zero too.
fn norm(mut sum: &[Step]) -> Option<Vec<Step>> {
    let mut squares = Vec::new();
    // ((a^2 + b^2) + c^2): the last summand first.
    while squares.len() < 2
        && let [summands @ .., Step::Add] = sum
    {
        let mut needed = 1;
        let start = summands.iter().rposition(|step| {
            needed = needed + step.operands() - 1;
            needed == 0
        });
        let (rest, last) = summands.split_at(start?);
        squares.push(last.strip_suffix(&[Step::Whole(2)])?);
        sum = rest;
    }
    squares.push(sum.strip_suffix(&[Step::Whole(2)])?);
    squares.reverse();
    let mut steps = squares.concat();
    steps.push(Step::Norm(squares.len()));
    Some(steps)
}
