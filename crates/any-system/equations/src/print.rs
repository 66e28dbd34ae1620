//! Formulas as plain text, which can be read again, and as LaTeX.

use crate::constant::Constant;
use crate::formulas::Formulas;
use crate::node::{BINARY, Binary, Node, UNARY, Unary, name_in, uses};
use std::fmt;

/// The longest text of a part, in bytes. Parts that occur often make texts that grow without bound.
const LONGEST: usize = 10_000;

/// How strongly a text holds together: a sum, a product, a sign, a power, a name.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Strength {
    Sum,
    Product,
    Sign,
    Power,
    Name,
}

/// How formulas are written.
#[derive(Clone, Copy, PartialEq)]
enum Form {
    Plain,
    Latex,
}

impl Formulas {
    /// Each formula as plain text, in the names of the user. [`from_text`](Self::from_text) reads it again, unless it is
    /// nested more than 200 deep, or has `…` for a part that is longer than 10 000 bytes: JSON has no such limits.
    pub fn texts(&self) -> Vec<String> {
        self.written(&self.outputs, Form::Plain)
    }

    /// Each formula in LaTeX, for mathematical mode.
    pub fn latex(&self) -> Vec<String> {
        self.written(&self.outputs, Form::Latex)
    }

    /// A part as plain text.
    pub(crate) fn part(&self, place: usize) -> String {
        self.written(&[place], Form::Plain).pop().unwrap_or_default()
    }

    /// The texts of some parts. All parts that they need are written from the first on, without recursion, and dropped
    /// behind their last use.
    fn written(&self, wanted: &[usize], form: Form) -> Vec<String> {
        let count = wanted.iter().max().map_or(0, |last| last + 1);
        let mut uses = uses(&self.nodes[..count], wanted);
        let mut texts: Vec<(String, Strength)> = Vec::with_capacity(count);
        for at in 0..count {
            if uses[at] == 0 {
                texts.push((String::new(), Strength::Name));
                continue;
            }
            let (text, strength) = self.write(at, &texts, form);
            for operand in self.nodes[at].operands() {
                uses[operand] -= 1;
                if uses[operand] == 0 {
                    texts[operand].0 = String::new();
                }
            }
            let fits = text.len() <= LONGEST;
            texts.push(if fits { (text, strength) } else { ("…".to_owned(), Strength::Name) });
        }
        wanted.iter().map(|&place| texts[place].0.clone()).collect()
    }

    fn write(&self, at: usize, texts: &[(String, Strength)], form: Form) -> (String, Strength) {
        let held = |operand: usize, least: Strength| -> String {
            let (text, strength) = &texts[operand];
            match (*strength >= least, form) {
                (true, _) => text.clone(),
                (false, Form::Plain) => format!("({text})"),
                (false, Form::Latex) => format!("\\left({text}\\right)"),
            }
        };
        let name = |name: &str| match form {
            Form::Plain => name.to_owned(),
            Form::Latex => latex_name(name),
        };
        match &self.nodes[at] {
            Node::Time => ("t".to_owned(), Strength::Name),
            Node::State(at) => (name(&self.names.states[*at]), Strength::Name),
            Node::Parameter(at) => (name(&self.names.parameters[*at]), Strength::Name),
            Node::Constant(constant) => number(constant, form),
            Node::Unary(Unary::Negative, a) => {
                let least = if form == Form::Plain { Strength::Sign } else { Strength::Power };
                (format!("-{}", held(*a, least)), Strength::Sign)
            }
            Node::Unary(function, a) => (unary(*function, &texts[*a].0, form), Strength::Name),
            Node::Call(function, a) => (call(function.name(), &texts[*a].0, form), Strength::Name),
            Node::Binary(function, a, b) => match function {
                Binary::Sum => {
                    let text =
                        format!("{} + {}", held(*a, Strength::Sum), held(*b, Strength::Product));
                    (text, Strength::Sum)
                }
                Binary::Difference => {
                    let text =
                        format!("{} - {}", held(*a, Strength::Sum), held(*b, Strength::Product));
                    (text, Strength::Sum)
                }
                Binary::Product if a == b => match form {
                    Form::Plain => (format!("{}^2", held(*a, Strength::Name)), Strength::Power),
                    Form::Latex => {
                        (format!("{{{}}}^{{2}}", held(*a, Strength::Name)), Strength::Power)
                    }
                },
                Binary::Product => {
                    let sign = if form == Form::Plain { "*" } else { " \\cdot " };
                    let text = format!(
                        "{}{sign}{}",
                        held(*a, Strength::Product),
                        held(*b, Strength::Power)
                    );
                    (text, Strength::Product)
                }
                Binary::Quotient if form == Form::Latex => {
                    (format!("\\frac{{{}}}{{{}}}", texts[*a].0, texts[*b].0), Strength::Product)
                }
                Binary::Quotient => {
                    let text =
                        format!("{}/{}", held(*a, Strength::Product), held(*b, Strength::Power));
                    (text, Strength::Product)
                }
                Binary::Power => match form {
                    Form::Plain => {
                        let text =
                            format!("{}^{}", held(*a, Strength::Name), held(*b, Strength::Name));
                        (text, Strength::Power)
                    }
                    Form::Latex => {
                        let text = format!("{{{}}}^{{{}}}", held(*a, Strength::Name), texts[*b].0);
                        (text, Strength::Power)
                    }
                },
                Binary::ArcTangent2 | Binary::Minimum | Binary::Maximum => {
                    let name = name_in(&BINARY, function).unwrap_or_default();
                    let arguments = format!("({}, {})", texts[*a].0, texts[*b].0);
                    let text = match form {
                        Form::Plain => format!("{name}{arguments}"),
                        Form::Latex => format!("\\operatorname{{{name}}}{arguments}"),
                    };
                    (text, Strength::Name)
                }
            },
        }
    }
}

fn number(constant: &Constant, form: Form) -> (String, Strength) {
    let plain = constant.to_string();
    let sign = if plain.starts_with('-') { Strength::Sign } else { Strength::Name };
    match (constant, form) {
        (_, Form::Plain) => (plain, sign),
        (Constant::Pi, Form::Latex) => ("\\pi".to_owned(), Strength::Name),
        (Constant::Euler, Form::Latex) => ("\\mathrm{e}".to_owned(), Strength::Name),
        (Constant::Decimal(_) | Constant::Double(_), Form::Latex) => {
            // A reader of a page sees the digits of a double, without its mark.
            let digits = plain.trim_start_matches("f64(").trim_end_matches(')');
            let sign = if digits.starts_with('-') { Strength::Sign } else { Strength::Name };
            match digits.split_once(['e', 'E']) {
                Some((digits, "0")) => (digits.to_owned(), sign),
                Some((digits, exponent)) => {
                    let power = exponent.trim_start_matches('+');
                    (format!("{digits} \\cdot 10^{{{power}}}"), Strength::Sum)
                }
                None => (digits.to_owned(), sign),
            }
        }
    }
}

fn unary(function: Unary, argument: &str, form: Form) -> String {
    match (function, form) {
        (Unary::SquareRoot, Form::Latex) => format!("\\sqrt{{{argument}}}"),
        (Unary::Absolute, Form::Latex) => format!("\\left|{argument}\\right|"),
        _ => call(name_in(&UNARY, &function).unwrap_or_default(), argument, form),
    }
}

fn call(name: &str, argument: &str, form: Form) -> String {
    match form {
        Form::Plain => format!("{name}({argument})"),
        Form::Latex => {
            let name = name.replace('_', "\\_");
            format!("\\operatorname{{{name}}}\\left({argument}\\right)")
        }
    }
}

/// A name in LaTeX: one letter in italics, more of them upright; what stands behind `_` is an index.
fn latex_name(name: &str) -> String {
    let parts = name.split_once('_').filter(|(name, index)| !name.is_empty() && !index.is_empty());
    let (name, index) = parts.map_or((name, None), |(name, index)| (name, Some(index)));
    let upright = |text: &str| match text.chars().count() {
        1 if text != "_" => text.to_owned(),
        _ => format!("\\mathrm{{{}}}", text.replace('_', "\\_")),
    };
    match index {
        None => upright(name),
        Some(index) => format!("{}_{{{}}}", upright(name), upright(index)),
    }
}

impl fmt::Display for Formulas {
    /// One formula a line.
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.texts().iter().try_for_each(|text| writeln!(out, "{text}"))
    }
}
