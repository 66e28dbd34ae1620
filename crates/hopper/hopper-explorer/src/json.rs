//! JSON text from numbers, names and lists. A number has all its digits: the page reads the same double.

/// A JSON object or list under construction.
#[derive(Debug)]
pub(crate) struct Json {
    text: String,
    close: char,
}

impl Json {
    pub(crate) fn object() -> Self {
        Json { text: "{".into(), close: '}' }
    }

    pub(crate) fn list() -> Self {
        Json { text: "[".into(), close: ']' }
    }

    /// The comma before all elements but the first.
    fn next(&mut self) {
        if self.text.len() > 1 {
            self.text.push(',');
        }
    }

    fn key(&mut self, key: &str) {
        self.next();
        quote(&mut self.text, key);
        self.text.push(':');
    }

    /// A field with a number; `null` for one that JSON does not have.
    pub(crate) fn number(mut self, key: &str, value: f64) -> Self {
        self.key(key);
        number(&mut self.text, value);
        self
    }

    pub(crate) fn optional(self, key: &str, value: Option<f64>) -> Self {
        self.number(key, value.unwrap_or(f64::NAN))
    }

    pub(crate) fn integer(mut self, key: &str, value: u64) -> Self {
        self.key(key);
        self.text.push_str(&value.to_string());
        self
    }

    pub(crate) fn text(mut self, key: &str, value: &str) -> Self {
        self.key(key);
        quote(&mut self.text, value);
        self
    }

    pub(crate) fn truth(mut self, key: &str, value: bool) -> Self {
        self.key(key);
        self.text.push_str(if value { "true" } else { "false" });
        self
    }

    pub(crate) fn json(mut self, key: &str, value: Json) -> Self {
        self.key(key);
        self.text.push_str(&value.finish());
        self
    }

    pub(crate) fn null(mut self, key: &str) -> Self {
        self.key(key);
        self.text.push_str("null");
        self
    }

    /// An element of a list.
    pub(crate) fn push(&mut self, value: Json) {
        self.next();
        self.text.push_str(&value.finish());
    }

    /// A number as an element of a list.
    pub(crate) fn push_number(&mut self, value: f64) {
        self.next();
        number(&mut self.text, value);
    }

    pub(crate) fn finish(mut self) -> String {
        self.text.push(self.close);
        self.text
    }
}

/// A list of numbers.
pub(crate) fn numbers(values: impl IntoIterator<Item = f64>) -> Json {
    let mut list = Json::list();
    values.into_iter().for_each(|value| list.push_number(value));
    list
}

/// A list of objects.
pub(crate) fn objects(values: impl IntoIterator<Item = Json>) -> Json {
    let mut list = Json::list();
    values.into_iter().for_each(|value| list.push(value));
    list
}

fn number(text: &mut String, value: f64) {
    if value.is_finite() {
        text.push_str(&format!("{value:?}"));
    } else {
        text.push_str("null");
    }
}

fn quote(text: &mut String, value: &str) {
    text.push('"');
    for letter in value.chars() {
        match letter {
            '"' | '\\' => text.extend(['\\', letter]),
            control if control < ' ' => text.push_str(&format!("\\u{:04x}", control as u32)),
            other => text.push(other),
        }
    }
    text.push('"');
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_their_digits_and_texts_their_letters() {
        let inner = numbers([0.1, 1e-100, f64::NAN]);
        let json = Json::object().json("x", inner).text("y", "a \"b\"\n").integer("z", 3).finish();
        assert_eq!(json, r#"{"x":[0.1,1e-100,null],"y":"a \"b\"\u000a","z":3}"#);
        assert_eq!(Json::list().finish(), "[]");
    }
}
