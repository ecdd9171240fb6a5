// SPDX-License-Identifier: MIT OR Apache-2.0
//! From the text that users write to the text that exmex reads alike: names and numbers checked, errors that
//! name the place, `f(a, b)` as `((a) f (b))`, and signs with the usual priority. exmex would read -x^2 as
//! (-x)^2, knows no 1e-3 and takes no call within the second argument of a call.

use super::number::Function;
use crate::error::{Error, Result};
use std::f64::consts::{E, PI};

/// Longest text in bytes.
const LONGEST: usize = 65536;
/// Most parentheses within each other: exmex recurses.
const DEEPEST: usize = 200;
/// Functions of two numbers and, where it is greater, of how many more.
const BINARY: [(&str, usize); 4] = [("min", usize::MAX), ("max", usize::MAX), ("pow", 2), ("atan2", 2)];

/// A sign before a value, as an operator between a number that does not count and the value.
pub(super) const NEGATIVE: &str = "~";

/// An open parenthesis.
struct Open {
    /// The function of several numbers that it belongs to, most arguments, and those begun.
    call: Option<(&'static str, usize, usize)>,
    /// Whether it stands in an exponent.
    in_exponent: bool,
}

struct Reader<'a> {
    text: &'a str,
    /// Where the next token begins.
    at: usize,
    out: String,
    open: Vec<Open>,
    /// Whether the last operator was ^ or within its right side: another ^ would be ambiguous.
    exponent: bool,
}

/// The text for exmex.
pub(super) fn conform(text: &str) -> Result<String> {
    if text.len() > LONGEST {
        return Err(Error::invalid(format!("expression: {} bytes are more than {LONGEST}", text.len())));
    }
    if text.trim().is_empty() {
        return Err(Error::invalid("expression: the text is empty"));
    }
    let mut reader = Reader { text, at: 0, out: String::new(), open: Vec::new(), exponent: false };
    loop {
        reader.value()?;
        if !reader.after_value()? {
            return Ok(reader.out);
        }
    }
}

/// How many bytes from the start satisfy `is`.
fn run(text: &str, is: impl Fn(u8) -> bool) -> usize {
    text.bytes().take_while(|b| is(*b)).count()
}

/// The length of the number that the text begins with, 0 if none: digits, a point, an exponent.
pub(super) fn number_length(text: &str) -> usize {
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

impl Reader<'_> {
    fn rest(&self) -> &str {
        self.text.get(self.at..).unwrap_or("")
    }

    fn error(&self, what: &str) -> Error {
        let near: String = self.rest().chars().take(20).collect();
        let place = if near.is_empty() { "at the end".to_owned() } else { format!("at byte {}, '{near}'", self.at) };
        Error::invalid(format!("expression: {what} {place}"))
    }

    fn unknown(&self, what: &str, name: &str) -> Error {
        let (name, text): (String, String) = (name.chars().take(40).collect(), self.text.chars().take(60).collect());
        Error::invalid(format!("expression: unknown {what} '{name}' in '{text}'"))
    }

    /// The next byte that is no space; 0 at the end.
    fn next(&mut self) -> u8 {
        self.at += run(self.rest(), |b| b.is_ascii_whitespace());
        self.rest().bytes().next().unwrap_or(0)
    }

    fn enter(&mut self, call: Option<(&'static str, usize, usize)>) -> Result<()> {
        self.at += 1;
        if self.open.len() == DEEPEST {
            return Err(Error::invalid(format!("expression: more than {DEEPEST} parentheses within each other")));
        }
        self.out.push_str(if call.is_some() { "((" } else { "(" });
        self.open.push(Open { call, in_exponent: self.exponent });
        self.exponent = false;
        Ok(())
    }

    /// Signs, opening parentheses and functions, up to and including a number, a coordinate or a constant.
    fn value(&mut self) -> Result<()> {
        let mut negative = false;
        loop {
            match self.next() {
                b'-' => negative = !negative,
                b'+' => {}
                _ => {
                    if negative {
                        // In an exponent exmex's own sign is right: it takes the next value alone.
                        self.out.push_str(if self.exponent { "-" } else { "0~" });
                        negative = false;
                    }
                    if self.item()? {
                        return Ok(());
                    }
                    continue;
                }
            }
            self.at += 1;
        }
    }

    /// One item of a value; whether it is the last.
    fn item(&mut self) -> Result<bool> {
        let first = self.next();
        if first == b'(' {
            self.enter(None)?;
            return Ok(false);
        }
        let length = number_length(self.rest());
        if length > 0 {
            let digits = self.rest().get(..length).unwrap_or("").to_owned();
            if !digits.parse::<f64>().is_ok_and(f64::is_finite) {
                return Err(self.error("a number is not finite"));
            }
            self.out.push_str(&digits);
            self.at += length;
            return Ok(true);
        }
        if !(first.is_ascii_alphabetic() || first == b'_') {
            let name: String = self.rest().chars().take_while(|c| c.is_alphabetic()).collect();
            return Err(if name.is_empty() { self.error("a value is missing") } else { self.unknown("name", &name) });
        }
        let length = run(self.rest(), |b| b.is_ascii_alphanumeric() || b == b'_');
        let name = self.rest().get(..length).unwrap_or("").to_owned();
        let before = self.at;
        self.at += length;
        if self.next() == b'(' {
            if let Some((name, most)) = BINARY.iter().find(|(known, _)| *known == name) {
                self.enter(Some((name, *most, 1)))?;
            } else if Function::ALL.iter().any(|(known, _)| *known == name) {
                self.out.push_str(&name);
                self.enter(None)?;
            } else {
                return Err(self.unknown("function", &name));
            }
            return Ok(false);
        }
        match name.as_str() {
            "x" | "y" | "z" => self.out.push_str(&name),
            "pi" => self.out.push_str(&format!("{PI}")),
            "e" => self.out.push_str(&format!("{E}")),
            _ => {
                self.at = before;
                let function = Function::ALL.iter().any(|(f, _)| *f == name) || BINARY.iter().any(|(f, _)| *f == name);
                return Err(if function {
                    self.error("a '(' is missing after the function")
                } else {
                    self.unknown("name", &name)
                });
            }
        }
        Ok(true)
    }

    /// What follows a value: closing parentheses, then an operator or a comma; whether there is one.
    fn after_value(&mut self) -> Result<bool> {
        loop {
            let next = self.next();
            match next {
                0 if self.rest().is_empty() => {
                    return if self.open.is_empty() { Ok(false) } else { Err(self.error("a ')' is missing")) };
                }
                b')' => {
                    let Some(open) = self.open.pop() else { return Err(self.error("a '(' is missing before")) };
                    if let Some((name, _, 1)) = open.call {
                        return Err(self.error(&format!("{name} takes more than one number,")));
                    }
                    self.out.push_str(if open.call.is_some() { "))" } else { ")" });
                    self.exponent = open.in_exponent;
                    self.at += 1;
                    continue;
                }
                b',' => {
                    let call = self.open.last_mut().and_then(|open| open.call.as_mut());
                    let Some((name, most, begun)) = call else { return Err(self.error("a comma is out of place")) };
                    if begun == most {
                        let what = format!("{name} takes {most} numbers,");
                        return Err(self.error(&what));
                    }
                    *begun += 1;
                    let name = *name;
                    self.out.push_str(&format!("){name}("));
                    self.exponent = false;
                }
                b'^' if self.exponent => return Err(self.error("a^b^c needs parentheses")),
                b'+' | b'-' | b'*' | b'/' | b'^' => {
                    self.exponent = next == b'^';
                    self.out.push(char::from(next));
                }
                _ => return Err(self.error("an operator is missing")),
            }
            self.at += 1;
            return Ok(true);
        }
    }
}
