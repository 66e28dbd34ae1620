//! Names of modes and surfaces in models that are data.

use crate::error::Error;
use std::fmt;
use std::hash::{Hash, Hasher};

/// The longest name in bytes: 31, so that a label with its length fills half a line of cache. It is copied and compared at
/// every evaluation of a guard.
const LONGEST: usize = 31;

/// The name of a mode or of a surface: a text of at most 31 bytes that is copied like a number.
///
/// ```
/// use hybrid_system::Label;
/// let on = Label::new("heater on")?;
/// assert!(on == "heater on" && on.to_string() == "heater on");
/// assert!(Label::new("a name of more than thirty-one bytes").is_err());
/// # Ok::<(), hybrid_system::Error>(())
/// ```
#[derive(Clone, Copy, Eq, PartialOrd, Ord)]
pub struct Label {
    /// The text, zeros, and its length.
    bytes: [u8; LONGEST + 1],
}

impl Label {
    /// The label with this text.
    ///
    /// # Errors
    /// [`Error::BadEquations`] for a text of more than 31 bytes.
    pub fn new(text: &str) -> Result<Label, Error> {
        let mut bytes = [0; LONGEST + 1];
        let too_long = || Error::BadEquations {
            what: format!("the name {text:?}"),
            reason: "it has more than 31 bytes: shorten it",
        };
        let place = bytes[..LONGEST].get_mut(..text.len());
        place.ok_or_else(too_long)?.copy_from_slice(text.as_bytes());
        bytes[LONGEST] = text.len() as u8;
        Ok(Label { bytes })
    }

    /// The text.
    pub fn as_str(&self) -> &str {
        // It was a text, which is read to its own end.
        std::str::from_utf8(&self.bytes[..usize::from(self.bytes[LONGEST])]).unwrap_or_default()
    }
}

/// By eight bytes at a time: a call that compares any number of bytes takes longer.
impl PartialEq for Label {
    #[inline]
    fn eq(&self, other: &Label) -> bool {
        let (own, others) = (self.bytes.as_chunks::<8>().0, other.bytes.as_chunks::<8>().0);
        own.iter().zip(others).all(|(a, b)| u64::from_ne_bytes(*a) == u64::from_ne_bytes(*b))
    }
}

impl Hash for Label {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.bytes.hash(state);
    }
}

impl fmt::Display for Label {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.pad(self.as_str())
    }
}

impl fmt::Debug for Label {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        fmt::Debug::fmt(self.as_str(), formatter)
    }
}

impl PartialEq<str> for Label {
    fn eq(&self, text: &str) -> bool {
        self.as_str() == text
    }
}

impl PartialEq<&str> for Label {
    fn eq(&self, text: &&str) -> bool {
        self.as_str() == *text
    }
}

#[cfg(feature = "serde")]
impl serde::Serialize for Label {
    fn serialize<W: serde::Serializer>(&self, writer: W) -> Result<W::Ok, W::Error> {
        writer.serialize_str(self.as_str())
    }
}

#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for Label {
    fn deserialize<R: serde::Deserializer<'de>>(reader: R) -> Result<Self, R::Error> {
        let text = <std::borrow::Cow<'de, str>>::deserialize(reader)?;
        Label::new(&text).map_err(serde::de::Error::custom)
    }
}
