//! Formulas from text: names, numbers, operators, functions.

use crate::constant::{Constant, Decimal};
use crate::error::Error;
use crate::formulas::Formulas;
use crate::graph::Graph;
use crate::names::{Names, check_name};
use crate::node::{BINARY, Binary, Node, UNARY, Unary, named};

/// The deepest nesting of a text. Each level takes some hundred bytes of the stack.
const DEEPEST: usize = 200;

/// The longest text, in bytes.
const LONGEST: usize = 1_000_000;

/// How much of a text an error shows, in characters.
const SHOWN: usize = 80;

/// What marks a number as its `f64`, see [`Constant`].
const DOUBLE: &str = "f64";

/// True for a name of a function.
pub(crate) fn is_function(name: &str) -> bool {
    name == DOUBLE || named(&UNARY, name).is_some() || named(&BINARY, name).is_some()
}

/// True for a letter of any script, or _, and letters, digits and _ behind it.
pub(crate) fn is_name(text: &str) -> bool {
    text.starts_with(begins_name) && text.chars().all(continues_name)
}

fn begins_name(c: char) -> bool {
    c.is_alphabetic() || c == '_'
}

fn continues_name(c: char) -> bool {
    begins_name(c) || c.is_alphanumeric()
}

impl Formulas {
    /// Formulas that are written as text, one for each output.
    ///
    /// From the weakest to the strongest: `+` and `-`; `*` and `/`; a sign; `^`, also written `**`. A power takes its
    /// exponent from the right: `2^3^2` is 2⁹, and `-x^2` is −(x²). The functions are `sqrt`, `exp`, `ln`, `sin`, `cos`,
    /// `tan`, `asin`, `acos`, `atan`, `atan2(y, x)`, `sinh`, `cosh`, `tanh`, `sech`, `asinh`, `acosh`, `atanh`, `abs`, `sign`,
    /// `min(a, b)`, `max(a, b)`. `t` is the time, `pi` or `π`, and `e` are constants. A number is the decimal that is
    /// written; `f64(0.1)` is its nearest `f64`, exactly. A power with an integer exponent is made of products.
    ///
    /// ```
    /// use equations::{Formulas, Names};
    /// let names = Names::new(&["x", "v"], &[("μ", "5")])?;
    /// let field = Formulas::from_text(names, &["v", "μ*(1 - x^2)*v - x"])?;
    /// assert_eq!(field.values(0.0, &[2.0, 0.1])?, [0.1, -3.5]);
    /// let error = Formulas::from_text(Names::default(), &["2*(3 + y)"]).unwrap_err();
    /// assert_eq!(error.to_string(), "column 8 of \"2*(3 + y)\": no variable or parameter has the name y");
    /// # Ok::<(), equations::Error>(())
    /// ```
    ///
    /// A text `name = …` gives a name to a value, which later texts use; it is no formula itself:
    ///
    /// ```
    /// # use equations::{Formulas, Names};
    /// let names = Names::new(&["x", "y", "u", "v"], &[])?;
    /// let texts = ["pull = (x^2 + y^2)^(-1.5)", "u", "v", "-pull*x", "-pull*y"];
    /// assert_eq!(Formulas::from_text(names, &texts)?.count(), 4);
    /// # Ok::<(), equations::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Text`] with the column of what is wrong; [`Error::Name`]; [`Error::TooLarge`].
    pub fn from_text(names: Names, texts: &[&str]) -> Result<Formulas, Error> {
        names.check()?;
        let (mut graph, mut defined) = (Graph::default(), Vec::new());
        let outputs = texts.iter().map(|text| read(text, &names, &mut graph, &mut defined));
        let outputs =
            outputs.filter_map(Result::transpose).collect::<Result<Vec<usize>, Error>>()?;
        Formulas::of_parts(names, graph.into_nodes(), outputs)
    }
}

/// The place of a text's formula. A text that gives a name to a value adds the name, and is no formula itself.
fn read(
    text: &str,
    names: &Names,
    graph: &mut Graph,
    defined: &mut Vec<(String, usize)>,
) -> Result<Option<usize>, Error> {
    let characters: Vec<char> = text.chars().take(LONGEST + 1).collect();
    let mut reader = Reader { text, characters, at: 0, depth: 0, names, graph, defined };
    if text.len() > LONGEST {
        return Err(reader.wrong(format!("the text is longer than {LONGEST} bytes")));
    }
    let name = reader.name_of_value()?;
    let place = reader.sum()?;
    reader.space();
    if let Some(other) = reader.peek() {
        return Err(reader.wrong(format!("{other:?} is not expected here")));
    }
    Ok(match name {
        None => Some(place),
        Some(name) => {
            defined.push((name, place));
            None
        }
    })
}

struct Reader<'a> {
    text: &'a str,
    characters: Vec<char>,
    at: usize,
    depth: usize,
    names: &'a Names,
    graph: &'a mut Graph,
    /// Values with names, of earlier texts.
    defined: &'a [(String, usize)],
}

impl Reader<'_> {
    /// Takes `name =`, which gives a name to the value behind it.
    fn name_of_value(&mut self) -> Result<Option<String>, Error> {
        self.space();
        let begin = self.at;
        while self.peek().is_some_and(continues_name) {
            self.at += 1;
        }
        let name: String = self.characters[begin..self.at].iter().collect();
        if self.take(&['=']).is_none() {
            self.at = begin;
            return Ok(None);
        }
        check_name(&name).map_err(|error| self.wrong_at(begin, error.to_string()))?;
        let defined = self.defined.iter().map(|(name, _)| name.as_str());
        match self.names.all().chain(defined).any(|known| known == name) {
            true => Err(self.wrong_at(begin, format!("{name} has a meaning already"))),
            false => Ok(Some(name)),
        }
    }

    fn wrong(&self, reason: String) -> Error {
        self.wrong_at(self.at, reason)
    }

    fn wrong_at(&self, at: usize, reason: String) -> Error {
        // An error shows the beginning of a long text.
        Error::Text { column: at + 1, text: self.text.chars().take(SHOWN).collect(), reason }
    }

    fn peek(&self) -> Option<char> {
        self.characters.get(self.at).copied()
    }

    fn space(&mut self) {
        while self.peek().is_some_and(char::is_whitespace) {
            self.at += 1;
        }
    }

    /// Takes one of the characters, with the space before it.
    fn take(&mut self, wanted: &[char]) -> Option<char> {
        self.space();
        let found = self.peek().filter(|c| wanted.contains(c))?;
        self.at += 1;
        Some(found)
    }

    fn demand(&mut self, wanted: char) -> Result<(), Error> {
        match self.take(&[wanted]) {
            Some(_) => Ok(()),
            None => Err(self.wrong(match self.peek() {
                Some(found) => format!("{wanted:?} is expected, not {found:?}"),
                None => format!("{wanted:?} is expected at the end"),
            })),
        }
    }

    /// Takes `*`, unless it is the first half of `**`.
    fn product_sign(&mut self) -> Option<Binary> {
        self.space();
        let next = self.characters.get(self.at + 1).copied();
        let sign = match self.peek()? {
            '*' if next == Some('*') => return None,
            '*' | '·' | '×' => Binary::Product,
            '/' => Binary::Quotient,
            _ => return None,
        };
        self.at += 1;
        Some(sign)
    }

    fn power_sign(&mut self) -> bool {
        self.space();
        if self.characters[self.at..].starts_with(&['*', '*']) {
            self.at += 2;
            return true;
        }
        self.take(&['^']).is_some()
    }

    fn sum(&mut self) -> Result<usize, Error> {
        let mut left = self.product()?;
        while let Some(sign) = self.take(&['+', '-', '−']) {
            let right = self.product()?;
            let function = if sign == '+' { Binary::Sum } else { Binary::Difference };
            left = self.graph.binary(function, left, right);
        }
        Ok(left)
    }

    fn product(&mut self) -> Result<usize, Error> {
        let mut left = self.signed()?;
        while let Some(function) = self.product_sign() {
            let right = self.signed()?;
            left = self.graph.binary(function, left, right);
        }
        Ok(left)
    }

    fn signed(&mut self) -> Result<usize, Error> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(self.wrong(format!("the text is nested more than {DEEPEST} deep")));
        }
        let found = match self.take(&['+', '-', '−']) {
            None => self.power()?,
            Some('+') => self.signed()?,
            Some(_) => {
                let size = self.signed()?;
                self.graph.unary(Unary::Negative, size)
            }
        };
        self.depth -= 1;
        Ok(found)
    }

    fn power(&mut self) -> Result<usize, Error> {
        let base = self.atom()?;
        if !self.power_sign() {
            return Ok(base);
        }
        let exponent = self.signed()?;
        Ok(self.graph.power(base, exponent))
    }

    fn atom(&mut self) -> Result<usize, Error> {
        if self.take(&['(']).is_some() {
            let found = self.sum()?;
            self.demand(')')?;
            return Ok(found);
        }
        match self.peek() {
            Some(c) if begins_name(c) => self.named(),
            Some(c) if c.is_ascii_digit() || c == '.' => {
                let number = self.decimal()?;
                Ok(self.graph.place(Node::Constant(Constant::Decimal(number))))
            }
            Some(c) => Err(self.wrong(format!("a number, a name or ( is expected, not {c:?}"))),
            None => Err(self.wrong("a number, a name or ( is expected at the end".to_owned())),
        }
    }

    fn decimal(&mut self) -> Result<Decimal, Error> {
        self.space();
        let begin = self.at;
        let digits = |reader: &mut Self| {
            while reader.peek().is_some_and(|c| c.is_ascii_digit() || c == '.') {
                reader.at += 1;
            }
        };
        digits(self);
        // An exponent has a digit behind it: `2e` is no number, and `2*e` a product.
        if self.peek().is_some_and(|c| "eE".contains(c)) {
            let sign = self.characters.get(self.at + 1).is_some_and(|c| "+-".contains(*c));
            self.at += 1 + usize::from(sign);
            digits(self);
        }
        let text: String = self.characters[begin..self.at].iter().collect();
        if text.is_empty() {
            return Err(self.wrong_at(begin, "a number is expected".to_owned()));
        }
        let shown: String = text.chars().take(SHOWN).collect();
        let reason = || format!("{shown} is no decimal with a finite f64");
        Decimal::new(&text).ok_or_else(|| self.wrong_at(begin, reason()))
    }

    fn named(&mut self) -> Result<usize, Error> {
        let begin = self.at;
        while self.peek().is_some_and(continues_name) {
            self.at += 1;
        }
        let name: String = self.characters[begin..self.at].iter().collect();
        if is_function(&name) {
            return self.function(&name);
        }
        if let Some(function) = self.names.functions.iter().find(|known| known.name() == name) {
            self.demand('(')?;
            let argument = self.sum()?;
            self.demand(')')?;
            return Ok(self.graph.place(Node::Call(function.clone(), argument)));
        }
        if let Some((_, place)) = self.defined.iter().find(|(known, _)| *known == name) {
            return Ok(*place);
        }
        let place = |names: &[String]| names.iter().position(|known| *known == name);
        let node = match name.as_str() {
            "t" => Node::Time,
            "pi" | "π" => Node::Constant(Constant::Pi),
            "e" => Node::Constant(Constant::Euler),
            _ => match (place(&self.names.states), place(&self.names.parameters)) {
                (Some(at), _) => Node::State(at),
                (None, Some(at)) => Node::Parameter(at),
                (None, None) => {
                    let shown: String = name.chars().take(SHOWN).collect();
                    let reason = format!("no variable or parameter has the name {shown}");
                    return Err(self.wrong_at(begin, reason));
                }
            },
        };
        Ok(self.graph.place(node))
    }

    fn function(&mut self, name: &str) -> Result<usize, Error> {
        self.demand('(')?;
        if name == DOUBLE {
            let sign = if self.take(&['-', '−']).is_some() { -1.0 } else { 1.0 };
            let number = sign * Constant::Decimal(self.decimal()?).value();
            self.demand(')')?;
            return Ok(self.graph.number(number));
        }
        let first = self.sum()?;
        let place = match named(&BINARY, name) {
            Some(function) => {
                self.demand(',')?;
                let second = self.sum()?;
                self.graph.binary(function, first, second)
            }
            None => {
                // One of the two tables has the name.
                let function = named(&UNARY, name).unwrap_or(Unary::Negative);
                self.graph.unary(function, first)
            }
        };
        self.demand(')')?;
        Ok(place)
    }
}
