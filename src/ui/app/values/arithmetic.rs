//! Arithmetic in typed numbers: `2*pi/3`, `sqrt(2)`, `-(1 + 0.5)^2`. Angles are in degrees.

/// Maximum depth of nesting, so that no typed or pasted text exhausts the stack.
const DEPTH: usize = 64;

/// Why an expression has no value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Fault {
    /// The place in the expression, as a number of characters before it.
    pub(crate) at: usize,
    /// The reason.
    pub(crate) reason: String,
}

/// Returns the value of an expression, which is always finite: numbers, `pi` and `e`, with
/// `+ - * / ^`, signs, parentheses and functions of one number. A power binds more tightly than a
/// sign and groups to the right; other operators group to the left.
pub(crate) fn evaluate(text: &str) -> Result<f64, Fault> {
    let mut reader = Reader {
        text: text.chars().collect(),
        at: 0,
        depth: 0,
    };
    let value = reader.sum()?;
    match reader.next() {
        None => Ok(value),
        Some(_) => Err(reader.unexpected("an operator")),
    }
}

type Function = fn(f64) -> f64;

const FUNCTIONS: [(&str, Function); 8] = [
    ("sqrt", libm::sqrt),
    ("sin", |angle| sin_cos(angle).0),
    ("cos", |angle| sin_cos(angle).1),
    ("tan", |angle| {
        let (sin, cos) = sin_cos(angle);
        sin / cos
    }),
    ("asin", |sin| libm::asin(sin).to_degrees()),
    ("acos", |cos| libm::acos(cos).to_degrees()),
    ("atan", |tan| libm::atan(tan).to_degrees()),
    ("abs", f64::abs),
];

/// Sine and cosine of an angle in degrees; 0 and ±1 at multiples of 90.
fn sin_cos(degrees: f64) -> (f64, f64) {
    let angle = libm::fmod(degrees, 360.0);
    let quarters = libm::round(angle / 90.0);
    let (sin, cos) = libm::sincos((angle - 90.0 * quarters).to_radians());
    match (quarters as i32).rem_euclid(4) {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

/// A recursive-descent parser that evaluates what it reads.
struct Reader {
    text: Vec<char>,
    /// The index of the next character.
    at: usize,
    depth: usize,
}

impl Reader {
    /// The next character that is not a blank.
    fn next(&mut self) -> Option<char> {
        while self.text.get(self.at).is_some_and(|c| c.is_whitespace()) {
            self.at += 1;
        }
        self.text.get(self.at).copied()
    }

    /// Takes the next character if it is one of these.
    fn take(&mut self, wanted: &[char]) -> Option<(char, usize)> {
        let next = self.next().filter(|next| wanted.contains(next))?;
        self.at += 1;
        Some((next, self.at - 1))
    }

    fn sum(&mut self) -> Result<f64, Fault> {
        let mut value = self.product()?;
        while let Some((sign, at)) = self.take(&['+', '-']) {
            let term = self.product()?;
            let signed = if sign == '+' { term } else { -term };
            value = finite(value + signed, at, "the sum")?;
        }
        Ok(value)
    }

    fn product(&mut self) -> Result<f64, Fault> {
        let mut value = self.signed()?;
        while let Some((operator, at)) = self.take(&['*', '/']) {
            let factor = self.signed()?;
            value = match operator {
                '*' => finite(value * factor, at, "the product")?,
                _ if factor == 0.0 => return Err(fault(at, "division by 0")),
                _ => finite(value / factor, at, "the quotient")?,
            };
        }
        Ok(value)
    }

    fn signed(&mut self) -> Result<f64, Fault> {
        self.depth += 1;
        if DEPTH < self.depth {
            return Err(fault(self.at, "nested too deeply"));
        }
        let value = match self.take(&['+', '-']) {
            Some(('-', _)) => -self.signed()?,
            Some(_) => self.signed()?,
            None => self.power()?,
        };
        self.depth -= 1;
        Ok(value)
    }

    fn power(&mut self) -> Result<f64, Fault> {
        let base = self.primary()?;
        let Some((_, at)) = self.take(&['^']) else {
            return Ok(base);
        };
        let exponent = self.signed()?;
        finite(libm::pow(base, exponent), at, "the power")
    }

    fn primary(&mut self) -> Result<f64, Fault> {
        match self.next() {
            Some('(') => self.parenthesis(),
            Some(c) if c.is_ascii_digit() || c == '.' => self.number(),
            Some(c) if c.is_alphabetic() => self.word(),
            _ => Err(self.unexpected("a number")),
        }
    }

    fn parenthesis(&mut self) -> Result<f64, Fault> {
        if self.take(&['(']).is_none() {
            return Err(self.unexpected("`(`"));
        }
        let value = self.sum()?;
        match self.take(&[')']) {
            Some(_) => Ok(value),
            None => Err(self.unexpected("`)`")),
        }
    }

    fn number(&mut self) -> Result<f64, Fault> {
        let start = self.at;
        self.digits();
        if self.text.get(self.at) == Some(&'.') {
            self.at += 1;
            self.digits();
        }
        // Otherwise the letter does not belong to the number.
        if let Some('e' | 'E') = self.text.get(self.at) {
            let sign = matches!(self.text.get(self.at + 1), Some('+' | '-'));
            let exponent = self.at + 1 + usize::from(sign);
            if self.text.get(exponent).is_some_and(char::is_ascii_digit) {
                self.at = exponent;
                self.digits();
            }
        }
        let digits: String = self.text[start..self.at].iter().collect();
        let value = digits.parse();
        let value = value.map_err(|_| fault(start, "expected a number"))?;
        finite(value, start, "the number")
    }

    fn digits(&mut self) {
        while self.text.get(self.at).is_some_and(char::is_ascii_digit) {
            self.at += 1;
        }
    }

    fn word(&mut self) -> Result<f64, Fault> {
        let start = self.at;
        while self.text.get(self.at).is_some_and(|c| c.is_alphanumeric()) {
            self.at += 1;
        }
        let word: String = self.text[start..self.at].iter().collect();
        match &word[..] {
            "pi" => return Ok(std::f64::consts::PI),
            "e" => return Ok(std::f64::consts::E),
            _ => {}
        }
        let mut functions = FUNCTIONS.iter();
        let Some((name, function)) = functions.find(|(name, _)| *name == word) else {
            let names = FUNCTIONS.map(|(name, _)| name).join(" ");
            let reason = format!("`{word}` is none of pi e {names}");
            return Err(fault(start, &reason));
        };
        let value = self.parenthesis()?;
        finite(function(value), start, name)
    }

    fn unexpected(&mut self, wanted: &str) -> Fault {
        let reason = match self.next() {
            Some(found) => format!("expected {wanted}, not `{found}`"),
            None => format!("expected {wanted} at the end"),
        };
        fault(self.at, &reason)
    }
}

fn finite(value: f64, at: usize, what: &str) -> Result<f64, Fault> {
    if value.is_nan() {
        return Err(fault(at, &format!("{what} is undefined here")));
    }
    if value.is_infinite() {
        return Err(fault(at, &format!("{what} is too large")));
    }
    Ok(value)
}

/// What is wrong at a place.
pub(super) fn fault(at: usize, reason: &str) -> Fault {
    Fault {
        at,
        reason: reason.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn expressions_have_the_usual_meaning() {
        for (text, value) in [
            ("1/4", 0.25),
            ("1 + 2*3 - 4", 3.0),
            ("2-3-4", -5.0),
            ("8/4/2", 1.0),
            ("-2^2", -4.0),
            ("2^-1", 0.5),
            ("2^3^2", 512.0),
            ("--1", 1.0),
            ("-(1+.5)*2", -3.0),
            ("2*pi", 2.0 * std::f64::consts::PI),
            ("e", std::f64::consts::E),
            ("1e3", 1000.0),
            ("1e-3*1E+3", 1.0),
            ("2*e-1", 2.0 * std::f64::consts::E - 1.0),
            ("sqrt(16)", 4.0),
            ("sin(180)", 0.0),
            ("cos(90) + sin(-90)", -1.0),
            ("tan(-180)", 0.0),
            ("asin(1)+acos(1)", 90.0),
            ("atan(1)", 45.0),
            ("abs(-3)", 3.0),
        ] {
            assert_eq!(evaluate(text), Ok(value), "{text}");
        }
    }

    #[test]
    fn faults_have_a_place_and_a_reason() {
        for (text, at, reason) in [
            ("", 0, "expected a number at the end"),
            ("1+", 2, "expected a number at the end"),
            ("1 + * 2", 4, "expected a number, not `*`"),
            ("(1", 2, "expected `)` at the end"),
            ("1 2", 2, "expected an operator, not `2`"),
            ("2e", 1, "expected an operator, not `e`"),
            ("1/(2-2)", 1, "division by 0"),
            ("2*sqrt(0-1)", 2, "sqrt is undefined here"),
            ("asin(2)", 0, "asin is undefined here"),
            ("tan(90)", 0, "tan is too large"),
            ("sqrt 2", 5, "expected `(`, not `2`"),
            ("10^999", 2, "the power is too large"),
            ("1e999", 0, "the number is too large"),
            (".", 0, "expected a number"),
            (
                "1+é",
                2,
                "`é` is none of pi e sqrt sin cos tan asin acos atan abs",
            ),
        ] {
            let reason = reason.to_owned();
            assert_eq!(evaluate(text), Err(Fault { at, reason }), "{text}");
        }
        for deep in ["(", "-", "sqrt("] {
            let fault = evaluate(&deep.repeat(100_000)).expect_err("it is incomplete");
            assert_eq!(fault.reason, "nested too deeply");
        }
    }

    /// An expression as a tree.
    #[derive(Clone, Debug)]
    enum Tree {
        Number(u16),
        Negative(Box<Self>),
        Pair(char, Box<Self>, Box<Self>),
        Root(Box<Self>),
    }

    impl Tree {
        fn value(&self) -> f64 {
            match self {
                Self::Number(number) => f64::from(*number) / 8.0,
                Self::Negative(inner) => -inner.value(),
                Self::Pair('+', a, b) => a.value() + b.value(),
                Self::Pair('-', a, b) => a.value() - b.value(),
                Self::Pair('*', a, b) => a.value() * b.value(),
                Self::Pair('/', a, b) => a.value() / b.value(),
                Self::Pair(_, a, b) => libm::pow(a.value(), b.value()),
                Self::Root(inner) => inner.value().sqrt(),
            }
        }

        /// Rank of the loosest operator outside parentheses.
        fn rank(&self) -> u8 {
            match self {
                Self::Pair('+' | '-', ..) => 0,
                Self::Pair('*' | '/', ..) => 1,
                Self::Negative(_) => 2,
                Self::Pair(..) => 3,
                Self::Number(_) | Self::Root(_) => 4,
            }
        }

        /// Spells the expression with parentheses only where they are necessary.
        fn text(&self) -> String {
            let within = |tree: &Self, rank| {
                if tree.rank() < rank {
                    format!("({})", tree.text())
                } else {
                    tree.text()
                }
            };
            match self {
                Self::Number(number) => (f64::from(*number) / 8.0).to_string(),
                Self::Negative(inner) => format!("-{}", within(inner, 2)),
                Self::Pair('^', a, b) => format!("{}^{}", within(a, 4), within(b, 2)),
                Self::Pair(sign, a, b) => {
                    let rank = self.rank();
                    format!("{} {sign} {}", within(a, rank), within(b, rank + 1))
                }
                Self::Root(inner) => format!("sqrt({})", inner.text()),
            }
        }
    }

    fn trees() -> impl Strategy<Value = Tree> {
        let leaf = any::<u16>().prop_map(Tree::Number);
        leaf.prop_recursive(5, 24, 2, |inner| {
            let operator = prop::sample::select(vec!['+', '-', '*', '/', '^']);
            prop_oneof![
                inner.clone().prop_map(|tree| Tree::Negative(tree.into())),
                inner.clone().prop_map(|tree| Tree::Root(tree.into())),
                (operator, inner.clone(), inner).prop_map(|(sign, a, b)| Tree::Pair(
                    sign,
                    a.into(),
                    b.into()
                )),
            ]
        })
    }

    proptest! {
        #![proptest_config(repeatable::config())]

        #[test]
        fn values_equal_those_of_the_tree(tree in trees()) {
            if let Ok(value) = evaluate(&tree.text()) {
                prop_assert_eq!(value.to_bits(), tree.value().to_bits(), "{}", tree.text());
            } else {
                // Subexpressions must be finite too, which the value need not show.
                prop_assume!(!tree.value().is_finite());
            }
        }

        #[test]
        fn no_text_makes_it_panic(text in "[-+*/^().0-9episqrtan é]{0,24}") {
            prop_assert!(evaluate(&text).is_ok_and(f64::is_finite) || evaluate(&text).is_err());
        }
    }
}
