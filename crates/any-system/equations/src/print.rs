//! Formulas as plain text, which can be read again, and as LaTeX.

use crate::constant::Constant;
use crate::formulas::Formulas;
use crate::node::{BINARY, Binary, Node, UNARY, Unary};
use std::fmt;

/// The longest text of a part. Parts that occur often make texts that grow without bound.
const LONGEST: usize = 100_000;

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
    /// Each formula as plain text, in the names of the user; `…` stands for what would be longer than 100 000
    /// characters.
    pub fn texts(&self) -> Vec<String> {
        self.outputs.iter().map(|&place| self.part(place)).collect()
    }

    /// Each formula in LaTeX, for mathematical mode.
    pub fn latex(&self) -> Vec<String> {
        self.outputs.iter().map(|&place| self.written(place, Form::Latex).0).collect()
    }

    /// A part as plain text.
    pub(crate) fn part(&self, place: usize) -> String {
        self.written(place, Form::Plain).0
    }

    /// The texts of the parts that one needs, from the first on: there is no recursion, however deep the formula is.
    fn written(&self, place: usize, form: Form) -> (String, Strength) {
        let mut needed = vec![false; place + 1];
        needed[place] = true;
        for at in (0..=place).rev() {
            if needed[at] {
                self.nodes[at].operands().for_each(|operand| needed[operand] = true);
            }
        }
        let mut texts: Vec<(String, Strength)> = Vec::with_capacity(place + 1);
        for (at, is_needed) in needed.into_iter().enumerate() {
            let (text, strength) = match is_needed {
                true => self.write(at, &texts, form),
                false => (String::new(), Strength::Name),
            };
            let fits = text.len() <= LONGEST;
            texts.push(if fits { (text, strength) } else { ("…".to_owned(), Strength::Name) });
        }
        texts.swap_remove(place)
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
                (format!("-{}", held(*a, Strength::Sign)), Strength::Sign)
            }
            Node::Unary(function, a) => (unary(*function, &texts[*a].0, form), Strength::Name),
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
                    let sign = if form == Form::Plain { "*" } else { " \\, " };
                    let text = format!(
                        "{}{sign}{}",
                        held(*a, Strength::Product),
                        held(*b, Strength::Power)
                    );
                    (text, Strength::Product)
                }
                Binary::Quotient if form == Form::Latex => {
                    (format!("\\frac{{{}}}{{{}}}", texts[*a].0, texts[*b].0), Strength::Name)
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
                    let found = BINARY.iter().find(|(_, known)| known == function);
                    let name = found.map_or("", |(name, _)| name);
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
    let text = constant.to_string();
    let strength = if text.starts_with('-') { Strength::Sign } else { Strength::Name };
    let text = match (constant, form) {
        (Constant::Pi, Form::Latex) => "\\pi".to_owned(),
        (_, Form::Latex) => match text.split_once(['e', 'E']) {
            Some((digits, exponent)) if !digits.is_empty() => {
                format!("{digits} \\cdot 10^{{{exponent}}}")
            }
            _ => text,
        },
        (_, Form::Plain) => text,
    };
    let strength = if text.contains("cdot") { Strength::Product } else { strength };
    (text, strength)
}

fn unary(function: Unary, argument: &str, form: Form) -> String {
    let found = UNARY.iter().find(|(_, known)| *known == function);
    let name = found.map_or("", |(name, _)| name);
    match form {
        Form::Plain => format!("{name}({argument})"),
        Form::Latex => match function {
            Unary::SquareRoot => format!("\\sqrt{{{argument}}}"),
            Unary::Absolute => format!("\\left|{argument}\\right|"),
            _ => format!("\\operatorname{{{name}}}\\left({argument}\\right)"),
        },
    }
}

/// A name in LaTeX: one letter in italics, more of them upright; what stands behind `_` is an index.
fn latex_name(name: &str) -> String {
    let (name, index) =
        name.split_once('_').map_or((name, None), |(name, index)| (name, Some(index)));
    let upright = |text: &str| match text.chars().count() {
        0 | 1 => text.to_owned(),
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
