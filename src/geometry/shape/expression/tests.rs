// SPDX-License-Identifier: MIT OR Apache-2.0
//! Expressions against closures, differences and dense sampling; and whatever text may come.

use super::*;
use crate::geometry::shape::samples::Random;
use crate::math::length;

type Closure = fn(f64, f64, f64) -> f64;

/// Expressions with the closures that they should be.
fn pairs() -> Vec<(&'static str, Closure)> {
    vec![
        ("sqrt(x^2+y^2) - 0.3*sin(4*z)", |x, y, z| (x * x + y * y).sqrt() - 0.3 * libm::sin(4.0 * z)),
        ("sqrt(x^2+y^2+z^2)-1", |x, y, z| (x * x + y * y + z * z).sqrt() - 1.0),
        ("-x^2", |x, _, _| -(x * x)),
        ("y - -x^3*2", |x, y, _| y - -(x * (x * x)) * 2.0),
        ("x/-y^2+3", |x, y, _| x / -(y * y) + 3.0),
        ("2^-x", |x, _, _| libm::pow(2.0, -x)),
        ("--x - + -y", |x, y, _| x + y),
        ("1e-3*x + .5*y + 2.E+1", |x, y, _| 1e-3 * x + 0.5 * y + 20.0),
        ("max(abs(x)-1, max(abs(y)-1, abs(z)-1))", |x, y, z| (x.abs() - 1.0).max((y.abs() - 1.0).max(z.abs() - 1.0))),
        ("min(x, y, z)", |x, y, z| x.min(y).min(z)),
        ("max(z,min(x,y))^2", |x, y, z| z.max(x.min(y)) * z.max(x.min(y))),
        ("x - y - z", |x, y, z| x - y - z),
        ("x / y / z", |x, y, z| x / y / z),
        ("atan2(y, x) + atan(z)", |x, y, z| libm::atan2(y, x) + libm::atan(z)),
        ("exp(-x^2)*cos(pi*y) + e", |x, y, _| {
            libm::exp(-(x * x)) * libm::cos(std::f64::consts::PI * y) + std::f64::consts::E
        }),
        ("tanh(x)+sinh(y)*cosh(z)", |x, y, z| libm::tanh(x) + libm::sinh(y) * libm::cosh(z)),
        ("ln(1+x^2) + log10(2+y^2)", |x, y, _| libm::log(1.0 + x * x) + libm::log10(2.0 + y * y)),
        ("tan(x/4)*asin(y/9) - acos(z/9)", |x, y, z| libm::tan(x / 4.0) * libm::asin(y / 9.0) - libm::acos(z / 9.0)),
        ("(x*x+y*y)^1.5", |x, y, _| libm::pow(x * x + y * y, 1.5)),
        ("pow(1+abs(x), y) ", |x, y, _| libm::pow(1.0 + x.abs(), y)),
        ("sin(x)*cos(y)+sin(y)*cos(z)+sin(z)*cos(x)", |x, y, z| {
            libm::sin(x) * libm::cos(y) + libm::sin(y) * libm::cos(z) + libm::sin(z) * libm::cos(x)
        }),
        ("x^-2+z^0", |x, _, _| 1.0 / (x * x) + 1.0),
        ("2*-x*-y", |x, y, _| 2.0 * -x * -y),
        ("2^-x^2^1*y", |x, y, _| libm::pow(2.0, -libm::pow(x, 2.0)) * y),
        ("max(x-1, -y^2, z/2-1)", |x, y, z| (x - 1.0).max(-(y * y)).max(z / 2.0 - 1.0)),
    ]
}

fn cube(size: f64) -> Aabb {
    Aabb::new(Vec3::splat(-size), Vec3::splat(size))
}

fn compiled(text: &str, bounds: Aabb) -> Expression {
    Expression::new(text, &ExpressionOptions { bounds, lipschitz: 0.0 }).unwrap_or_else(|e| panic!("{text}: {e}"))
}

#[test]
fn values_are_those_of_the_closures() {
    let mut random = Random(1);
    for (text, closure) in pairs() {
        let expression = compiled(text, Aabb::ALL);
        for _ in 0..500 {
            let p = random.point(cube(3.0));
            assert_eq!(expression.value(p).to_bits(), closure(p.x, p.y, p.z).to_bits(), "{text} at {p}");
        }
    }
}

#[test]
fn gradients_are_those_of_differences() {
    let mut random = Random(2);
    for (text, _) in pairs() {
        let expression = compiled(text, Aabb::ALL);
        for _ in 0..200 {
            let p = random.point(cube(3.0));
            let step = 1e-6;
            let along =
                |d: Vec3, step: f64| (expression.value(p + d * step) - expression.value(p - d * step)) / (2.0 * step);
            let numeric = |step: f64| Vec3::new(along(Vec3::X, step), along(Vec3::Y, step), along(Vec3::Z, step));
            let (fine, coarse, own) = (numeric(step), numeric(4.0 * step), expression.gradient(p));
            // Not across kinks and jumps, nor next to poles, where differences differ among themselves.
            let scale = 1.0 + length(own);
            if length(fine - coarse) < 1e-5 * scale && length(fine) < 1e3 && fine != Vec3::ZERO {
                assert!(length(fine - own) < 1e-4 * scale, "{text} at {p}: {fine} {own}");
            }
        }
    }
}

#[test]
fn ranges_hold_every_value() {
    let mut random = Random(3);
    for (text, _) in pairs() {
        for bounds in [Aabb::ALL, cube(1.5), Aabb::new(Vec3::splat(-1.0), Vec3::INFINITY)] {
            let expression = compiled(text, bounds);
            for _ in 0..60 {
                let b = random.aabb(cube(3.0));
                let range = expression.range(b);
                for k in 0..200 {
                    let p = match k {
                        0 => b.lo,
                        1 => b.hi,
                        _ => random.point(b).clamp(b.lo, b.hi),
                    };
                    let value = expression.value(p);
                    assert!(range == Interval::ALL || range.contains(value), "{text} at {p}: {value} {range:?}");
                    let facts = expression.facts();
                    assert!(value > 0.0 || value.is_nan() || facts.bounds.contains(p));
                }
            }
        }
    }
}

#[test]
fn ranges_are_of_use() {
    let tube = compiled("sqrt(x^2+y^2) - 0.3*sin(4*z)", Aabb::ALL);
    let range = tube.range(Aabb::new(Vec3::new(1.0, 1.0, 0.0), Vec3::splat(1.1)));
    assert!(range.lo > 1.0 && range.hi < 2.0, "{range:?}");
    let square = compiled("x*x + y^2 - 1", Aabb::ALL).range(cube(0.5));
    assert!(square.lo >= -1.0 - 1e-15 && square.hi <= -0.5 + 1e-15, "{square:?}");
    // Where some of the values may be none, nothing is claimed.
    assert_eq!(compiled("sqrt(x)", Aabb::ALL).range(cube(0.5)), Interval::ALL);
    assert_eq!(compiled("exp(-1/x)", Aabb::ALL).range(cube(0.5)), Interval::ALL);
    assert!(compiled("sqrt(x)", Aabb::ALL).value(Vec3::splat(-1.0)).is_nan());
    assert!(compiled("max(1, sqrt(x))", Aabb::ALL).value(Vec3::splat(-1.0)).is_nan());
}

#[test]
fn lipschitz_constants_hold_everywhere() {
    let mut random = Random(5);
    let mut known = 0;
    for (text, _) in pairs() {
        let expression = compiled(text, cube(1.3));
        let facts = expression.facts();
        known += usize::from(facts.lipschitz.is_finite());
        for _ in 0..5000 {
            let p = random.point(cube(2.5));
            let q = p + random.point(cube(1.0)) * random.unit();
            let difference = (expression.value(p) - expression.value(q)).abs();
            let most = facts.lipschitz * length(p - q) + facts.rounding.0 * 10.0;
            assert!(difference <= most || most == f64::INFINITY || difference.is_nan(), "{text}: {difference} {most}");
        }
    }
    assert!(known >= 14, "{known}");
}

#[test]
fn lipschitz_constants_are_tight() {
    for (text, least, most) in [
        ("sqrt(x^2+y^2+z^2)-1", 1.0, 1.0),
        ("sqrt((x-0.5)^2+y*y)-1", 1.0, 1.0),
        ("abs(z)-0.2", 1.0, 1.0),
        ("min(x, sqrt(y^2+z^2)-0.4)", 1.0, 1.0),
        ("sqrt((sqrt(x^2+y^2)-1)^2+z^2)-0.25", 1.0, 1.5),
        ("sqrt(x^2+y^2) - 0.3*sin(4*z)", 1.56, 1.57),
        ("x^2+y^2+z^2-1", 4.0 * 3.0f64.sqrt(), 4.01 * 3.0f64.sqrt()),
        ("-0.5", 0.0, 0.0),
    ] {
        let found = compiled(text, cube(2.0)).lipschitz;
        assert!((least..=most).contains(&found), "{text}: {found}");
    }
    assert_eq!(compiled("x^2", Aabb::ALL).lipschitz, f64::INFINITY);
    assert_eq!(compiled("1/x", cube(1.0)).lipschitz, f64::INFINITY);
    assert_eq!(compiled("atan2(y,x)", cube(1.0)).lipschitz, f64::INFINITY);
    let given = ExpressionOptions { lipschitz: 3.0, ..ExpressionOptions::default() };
    assert_eq!(Expression::new("z", &given).unwrap().facts().lipschitz, 3.0);
}

#[test]
fn bounds_cut_the_body_and_leave_the_rest() {
    let ball = compiled("sqrt(x^2+y^2+z^2)-1", cube(1.2));
    let mut random = Random(6);
    for _ in 0..2000 {
        let p = random.point(cube(1.2));
        assert_eq!(ball.value(p), (p.x * p.x + p.y * p.y + p.z * p.z).sqrt() - 1.0);
        let far = random.point(cube(9.0));
        assert!(ball.value(far) <= length(far) - 1.0 + 1e-14);
    }
    assert_eq!(ball.value(Vec3::new(5.2, 0.0, 0.0)), 4.0);
    assert_eq!(ball.gradient(Vec3::new(5.2, 0.0, 0.0)), Vec3::X);
    let slab = compiled("abs(z)-0.5", cube(1.0));
    assert!(slab.value(Vec3::new(1.5, 0.0, 0.0)) == 0.5 && slab.value(Vec3::new(0.9, 0.0, 0.0)) + 0.1 < 1e-15);
    assert!(compiled("-1", cube(1.0)).value(Vec3::ZERO) == -1.0);
}

#[test]
fn unfit_text_is_named() {
    for (text, message) in [
        ("", "the text is empty"),
        ("  ", "the text is empty"),
        ("x + foo", "unknown name 'foo' at byte 4"),
        ("foo(x)", "unknown function 'foo' at byte 0"),
        ("x + é", "unknown name 'é' at byte 4"),
        ("x +", "a value is missing at the end"),
        ("x y", "an operator is missing at byte 2, 'y'"),
        ("2x", "an operator is missing at byte 1, 'x'"),
        ("(x", "a ')' is missing at the end"),
        ("x)", "a '(' is missing before at byte 1, ')'"),
        ("x,y", "a comma is out of place at byte 1, ',y'"),
        ("min(x)", "min takes more than one number, at byte 5, ')'"),
        ("pow(x,y,z)", "pow takes 2 numbers, at byte 7, ',z)'"),
        ("sin x", "a '(' is missing after the function at byte 0, 'sin x'"),
        ("sin(x,y)", "sin takes 1 number, at byte 5, ',y)'"),
        ("(x,y)", "a comma is out of place at byte 2, ',y)'"),
        ("1e999", "a number is not finite at byte 0, '1e999'"),
        ("x # y", "an operator is missing at byte 2, '# y'"),
        ("{x}", "a value is missing at byte 0, '{x}'"),
        ("()", "a value is missing at byte 1, ')'"),
    ] {
        let error = Expression::new(text, &ExpressionOptions::default()).err().unwrap_or_else(|| panic!("{text}"));
        assert_eq!(error.message(), format!("expression: {message}"));
    }
    let options = |b: Aabb, lipschitz: f64| Expression::new("x", &ExpressionOptions { bounds: b, lipschitz }).is_err();
    assert!(options(Aabb::EMPTY, 0.0) && options(Aabb::ALL, -1.0) && options(Aabb::ALL, f64::NAN));
}

#[test]
fn long_and_deep_text_neither_overflows_nor_panics() {
    let parses = |text: &str| Expression::new(text, &ExpressionOptions::default()).map(|e| e.value(Vec3::ONE)).ok();
    let n = 60_000;
    assert_eq!(parses(&"(".repeat(n)), None);
    assert_eq!(parses(&"-".repeat(n)), None);
    assert_eq!(parses(&("-".repeat(n) + "x")), Some(1.0));
    assert_eq!(parses(&"sin(".repeat(n / 4)), None);
    assert_eq!(parses(&"min(x,".repeat(n / 6)), None);
    assert_eq!(parses(&"x)".repeat(n / 2)), None);
    assert_eq!(parses(&vec!["x"; 30_000].join("+")), Some(30_000.0));
    assert_eq!(parses(&vec!["x"; 30_000].join("*")), Some(1.0));
    assert_eq!(parses(&vec!["x"; 1024].join("^-")), Some(1.0));
    assert_eq!(parses(&vec!["x"; 1025].join("^-")), None);
    assert_eq!(parses(&format!("min({})", vec!["x"; 30_000].join(","))), Some(1.0));
    assert_eq!(parses(&"x".repeat(65_537)), None);
    let deep = |open: &str, close: &str, n: usize| parses(&(open.repeat(n) + "x" + &close.repeat(n)));
    assert_eq!(deep("(", ")", 200), Some(1.0));
    assert_eq!(deep("(", ")", 201), None);
    assert_eq!(deep("abs(", ")", 200), Some(1.0));
    assert_eq!(deep("max(x,", ")", 200), Some(1.0));
    assert_eq!(deep("max(", ",x)", 200), Some(1.0));
    assert_eq!(deep("1+1*1^(", ")", 200), Some(2.0));
    assert_eq!(deep("-(1-0*1^min(x,", "))", 100), Some(-1.0));
}

#[test]
fn no_text_panics() {
    let tokens = [
        "x", "y", "z", "pi", "e", "1", "2.5", "1e3", ".", "1.", ".5", "+", "-", "*", "/", "^", "(", ")", ",", "min(",
        "max(", "pow(", "atan2(", "sqrt(", "abs(", "sin(", "exp(", "ln(", "foo", "foo(", "min", "~", "{", "}", "é",
        " ", "\t", "\0",
    ];
    let mut random = Random(99);
    let mut good = 0;
    for _ in 0..200_000 {
        let count = (random.unit() * 14.0) as usize;
        // Mostly text that may well be right.
        let most = if random.unit() < 0.7 { 24.0 } else { tokens.len() as f64 };
        let text: String = (0..count).map(|_| tokens[(random.unit() * most) as usize]).collect();
        match Expression::new(&text, &ExpressionOptions::default()) {
            Ok(expression) => {
                let p = random.point(cube(2.0));
                let range = expression.range(Aabb::new(p, p + 0.1));
                let value = expression.value(p);
                assert!(range == Interval::ALL || range.contains(value), "{text}");
                assert!(!expression.gradient(p).is_nan());
                good += 1;
            }
            Err(e) => assert!(e.message().starts_with("expression: "), "{e}"),
        }
    }
    assert!(good > 1000, "{good}");
}

/// Some expression with parentheses around each operator, which leaves no priorities to mistake.
fn unambiguous(random: &mut Random, depth: usize) -> String {
    let pick = |random: &mut Random, of: &[&str]| of[(random.unit() * of.len() as f64) as usize].to_owned();
    if depth == 0 || random.unit() < 0.1 {
        return pick(random, &["x", "y", "z", "0.5", "3", "1.25"]);
    }
    let a = unambiguous(random, depth - 1);
    if random.unit() < 0.3 {
        return format!("{}({a})", pick(random, &["sqrt", "abs", "sin", "cos", "atan", "tanh"]));
    }
    format!("({a}{}{})", pick(random, &["+", "-", "*", "/"]), unambiguous(random, depth - 1))
}

#[test]
fn values_are_those_of_another_parser() {
    use exmex::Express;
    let mut random = Random(7);
    let mut numbers = 0;
    for _ in 0..2000 {
        // All three coordinates, so that exmex takes three numbers.
        let text = format!("({}+((x+y)+z))", unambiguous(&mut random, 5));
        let (own, other) = (compiled(&text, Aabb::ALL), exmex::parse::<f64>(&text).unwrap());
        for p in std::iter::repeat_with(|| random.point(cube(2.0))).take(10) {
            let (a, b) = (own.value(p), other.eval(&p.to_array()).unwrap());
            let same = a == b || a.is_nan() && b.is_nan() || (a - b).abs() <= 1e-12 * a.abs();
            assert!(same, "{text} at {p}: {a} {b}");
            numbers += usize::from(a.is_finite());
        }
    }
    assert!(numbers > 10_000, "{numbers}");
}
