// SPDX-License-Identifier: MIT OR Apache-2.0
//! From text to a program, by the "shunting yard" of E. W. Dijkstra, Algol 60 translation, Mathematisch Centrum
//! report MR 35, 1961: values go straight to the program, operators wait on a stack until a weaker one, a
//! comma, a parenthesis or the end comes. Nothing recurses; errors name the place.

use super::number::Function;
use super::program::{Builder, DEEPEST, Program, Step};
use crate::error::{Error, Result};
use std::f64::consts::{E, PI};

/// Longest text in bytes.
const LONGEST: usize = 65536;
/// Most parentheses within each other.
const PARENTHESES: usize = 200;
/// Functions of two numbers and, where it is greater, of how many more.
const BINARY: [(&str, Step, usize); 4] = [
    ("min", Step::Min, usize::MAX),
    ("max", Step::Max, usize::MAX),
    ("pow", Step::Power, 2),
    ("atan2", Step::Angle, 2),
];

/// A function with its open parenthesis.
struct Call {
    name: &'static str,
    /// Joins two arguments, or takes one.
    step: Step,
    /// Most arguments, and those begun.
    most: usize,
    begun: usize,
}

impl Call {
    fn of(name: &str) -> Option<Call> {
        let one = Function::ALL.iter().map(|(name, f)| (*name, Step::Function(*f), 1));
        let (name, step, most) = one.chain(BINARY).find(|(known, ..)| *known == name)?;
        Some(Call { name, step, most, begun: 1 })
    }
}

/// What waits for its last operand or its end.
enum Waiting {
    Operator(Step),
    /// An open parenthesis.
    Open(Option<Call>),
}

/// How strongly an operator binds: a sign stronger than *, so that 2*-x reads, and weaker than ^.
fn priority(operator: Step) -> u8 {
    match operator {
        Step::Add | Step::Subtract => 1,
        Step::Multiply | Step::Divide => 2,
        Step::Negative => 3,
        _ => 4,
    }
}

struct Reader<'a> {
    text: &'a str,
    /// Where the next token begins.
    at: usize,
    waiting: Vec<Waiting>,
    /// How many of them are open parentheses.
    parentheses: usize,
    out: Builder,
}

/// The program of a text.
pub(super) fn parse(text: &str) -> Result<Program> {
    if text.len() > LONGEST {
        return Err(Error::invalid(format!("expression: {} bytes are more than {LONGEST}", text.len())));
    }
    if text.trim().is_empty() {
        return Err(Error::invalid("expression: the text is empty"));
    }
    let mut reader = Reader { text, at: 0, waiting: Vec::new(), parentheses: 0, out: Builder::default() };
    loop {
        reader.value()?;
        if !reader.after_value()? {
            return Ok(reader.out.program());
        }
    }
}

/// How many bytes from the start satisfy `is`.
fn run(text: &str, is: impl Fn(u8) -> bool) -> usize {
    text.bytes().take_while(|b| is(*b)).count()
}

/// The length of the number that the text begins with, 0 if none: digits, a point, an exponent.
fn number_length(text: &str) -> usize {
    let digits = |from: usize| run(text.get(from..).unwrap_or(""), |b| b.is_ascii_digit());
    let byte = |i: usize| text.as_bytes().get(i).copied();
    let mut n = digits(0);
    let mut any = n;
    if byte(n) == Some(b'.') {
        any += digits(n + 1);
        n += 1 + digits(n + 1);
    }
    if any == 0 {
        return 0;
    }
    if matches!(byte(n), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(byte(n + 1), Some(b'+' | b'-')));
        let exponent = digits(n + 1 + sign);
        n += if exponent > 0 { 1 + sign + exponent } else { 0 };
    }
    n
}

impl<'a> Reader<'a> {
    fn rest(&self) -> &'a str {
        self.text.get(self.at..).unwrap_or("")
    }

    fn error(&self, what: &str) -> Error {
        let near: String = self.rest().chars().take(20).collect();
        let place = if near.is_empty() { "at the end".to_owned() } else { format!("at byte {}, '{near}'", self.at) };
        Error::invalid(format!("expression: {what} {place}"))
    }

    fn unknown(&self, what: &str, name: &str, at: usize) -> Error {
        let name: String = name.chars().take(40).collect();
        let hint = if name == "log" { ": ln or log10" } else { "" };
        Error::invalid(format!("expression: unknown {what} '{name}' at byte {at}{hint}"))
    }

    /// The next byte that is no space; 0 at the end.
    fn next(&mut self) -> u8 {
        self.at += run(self.rest(), |b| b.is_ascii_whitespace());
        self.rest().bytes().next().unwrap_or(0)
    }

    fn enter(&mut self, call: Option<Call>) -> Result<()> {
        self.at += 1;
        if self.parentheses == PARENTHESES {
            return Err(Error::invalid(format!("expression: more than {PARENTHESES} parentheses within each other")));
        }
        self.parentheses += 1;
        self.waiting.push(Waiting::Open(call));
        Ok(())
    }

    /// Applies the operators that wait since the last parenthesis, back to one weaker than `weakest`.
    fn settle(&mut self, weakest: u8) {
        while let Some(Waiting::Operator(step)) = self.waiting.last()
            && priority(*step) >= weakest
        {
            self.out.apply(*step);
            self.waiting.pop();
        }
    }

    /// Signs, opening parentheses and functions, up to and including a number, a coordinate or a constant.
    fn value(&mut self) -> Result<()> {
        loop {
            let mut negative = false;
            while let sign @ (b'+' | b'-') = self.next() {
                negative ^= sign == b'-';
                self.at += 1;
            }
            if negative {
                self.waiting.push(Waiting::Operator(Step::Negative));
            }
            if let Some(value) = self.item()? {
                let fits = self.out.value(value);
                let many = || self.error(&format!("more than {DEEPEST} values wait for an operator"));
                return fits.then_some(()).ok_or_else(many);
            }
        }
    }

    /// One item of a value; the step if it is the last.
    fn item(&mut self) -> Result<Option<Step>> {
        let first = self.next();
        if first == b'(' {
            return self.enter(None).map(|()| None);
        }
        let length = number_length(self.rest());
        if length > 0 {
            let number = self.rest().get(..length).and_then(|digits| digits.parse().ok());
            let Some(number) = number.filter(|x: &f64| x.is_finite()) else {
                return Err(self.error("a number is not finite"));
            };
            self.at += length;
            return Ok(Some(Step::Constant(number)));
        }
        if !(first.is_ascii_alphabetic() || first == b'_') {
            let name: String = self.rest().chars().take_while(|c| c.is_alphabetic()).collect();
            let what = if self.text.get(..self.at).is_some_and(|before| before.ends_with('*')) {
                "a value is missing (a power is ^)"
            } else {
                "a value is missing"
            };
            return Err(if name.is_empty() { self.error(what) } else { self.unknown("name", &name, self.at) });
        }
        let length = run(self.rest(), |b| b.is_ascii_alphanumeric() || b == b'_');
        let name = self.rest().get(..length).unwrap_or("");
        let before = self.at;
        self.at += length;
        if self.next() == b'(' {
            let Some(call) = Call::of(name) else { return Err(self.unknown("function", name, before)) };
            return self.enter(Some(call)).map(|()| None);
        }
        match name {
            "x" => Ok(Some(Step::Coordinate(0))),
            "y" => Ok(Some(Step::Coordinate(1))),
            "z" => Ok(Some(Step::Coordinate(2))),
            "pi" => Ok(Some(Step::Constant(PI))),
            "e" => Ok(Some(Step::Constant(E))),
            _ if Call::of(name).is_some() => {
                self.at = before;
                Err(self.error("a '(' is missing after the function"))
            }
            _ => Err(self.unknown("name", name, before)),
        }
    }

    /// What follows a value: closing parentheses, then an operator or a comma; whether there is one.
    fn after_value(&mut self) -> Result<bool> {
        loop {
            let operator = match self.next() {
                0 if self.rest().is_empty() => {
                    self.settle(0);
                    return if self.parentheses == 0 { Ok(false) } else { Err(self.error("a ')' is missing")) };
                }
                b')' => {
                    self.close()?;
                    continue;
                }
                b',' => return self.comma().map(|()| true),
                b'+' => Step::Add,
                b'-' => Step::Subtract,
                b'*' => Step::Multiply,
                b'/' => Step::Divide,
                b'^' => Step::Power,
                _ => return Err(self.error("an operator is missing")),
            };
            // a^b^c is a^(b^c), and nothing binds stronger: ^ settles nothing.
            if operator != Step::Power {
                self.settle(priority(operator));
            }
            self.waiting.push(Waiting::Operator(operator));
            self.at += 1;
            return Ok(true);
        }
    }

    fn close(&mut self) -> Result<()> {
        self.settle(0);
        let Some(Waiting::Open(call)) = self.waiting.pop() else { return Err(self.error("a '(' is missing before")) };
        if let Some(Call { name, step, most, begun }) = call {
            if begun == 1 && most > 1 {
                return Err(self.error(&format!("{name} takes more than one number,")));
            }
            self.out.apply(step);
        }
        self.parentheses -= 1;
        self.at += 1;
        Ok(())
    }

    fn comma(&mut self) -> Result<()> {
        self.settle(0);
        let Some(Waiting::Open(Some(call))) = self.waiting.last_mut() else {
            return Err(self.error("a comma is out of place"));
        };
        let Call { name, step, most, begun } = *call;
        if begun == most {
            let plural = if most > 1 { "s" } else { "" };
            return Err(self.error(&format!("{name} takes {most} number{plural},")));
        }
        call.begun += 1;
        if begun > 1 {
            self.out.apply(step);
        }
        self.at += 1;
        Ok(())
    }
}
