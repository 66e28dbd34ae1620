//! A part of a job: the pieces K, K + N, K + 2N, … of all.

use crate::error::Error;
use std::fmt;
use std::str::FromStr;

/// Most parts of a job. A cluster starts at most some ten thousand processes of one job; the limit keeps the numbers in
/// names of files short.
const MOST_PARTS: usize = 1_000_000;

/// Part K of N of a job, written K/N.
///
/// Its pieces are each N-th one, from the K-th on. Neighbouring pieces of a job often cost about the same, so that the
/// parts take about the same time.
///
/// ```
/// use resumable_job::Part;
/// let part: Part = "2/3".parse()?;
/// assert_eq!(part.pieces(8).collect::<Vec<_>>(), [1, 4, 7]);
/// assert!("4/3".parse::<Part>().is_err());
/// # Ok::<(), resumable_job::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Part {
    number: usize,
    of: usize,
}

impl Part {
    /// Part `number` of `of`, counted from 1.
    ///
    /// # Errors
    /// [`Error::NoPart`] unless 1 ≤ `number` ≤ `of` ≤ 10⁶.
    pub fn new(number: usize, of: usize) -> Result<Self, Error> {
        if (1..=of).contains(&number) && of <= MOST_PARTS {
            Ok(Part { number, of })
        } else {
            Err(Error::NoPart { text: format!("{number}/{of}"), most: MOST_PARTS })
        }
    }

    /// The number of this part, from 1.
    pub fn number(self) -> usize {
        self.number
    }

    /// The number of parts.
    pub fn of(self) -> usize {
        self.of
    }

    /// The pieces of this part among `count`; none if there are fewer pieces than parts.
    pub fn pieces(self, count: usize) -> impl Iterator<Item = usize> + Clone {
        (self.number - 1..count).step_by(self.of)
    }

    /// The part that has a piece.
    ///
    /// # Errors
    /// As [`Part::new`], for the number of parts.
    pub fn with(piece: usize, of: usize) -> Result<Self, Error> {
        let number = piece.checked_rem(of).map_or(0, |rest| rest + 1);
        Part::new(number, of)
    }

    /// The name of this part in names of files.
    pub(crate) fn name(self) -> String {
        format!("part-{}-of-{}", self.number, self.of)
    }
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

impl FromStr for Part {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let no_part = || Error::NoPart { text: text.to_owned(), most: MOST_PARTS };
        let (number, of) = text.split_once('/').ok_or_else(no_part)?;
        match (number.parse(), of.parse()) {
            (Ok(number), Ok(of)) => Part::new(number, of).map_err(|_| no_part()),
            _ => Err(no_part()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_piece_is_in_one_part() {
        for (count, of) in [(0, 1), (1, 1), (1, 5), (64, 4), (65, 4), (7, 7)] {
            let parts: Vec<Part> = (1..=of).map(|k| Part::new(k, of).unwrap()).collect();
            let mut all: Vec<usize> = parts.iter().flat_map(|part| part.pieces(count)).collect();
            all.sort_unstable();
            assert_eq!(all, (0..count).collect::<Vec<_>>());
            for part in parts {
                assert!(part.pieces(count).all(|piece| Part::with(piece, of).unwrap() == part));
            }
        }
    }

    #[test]
    fn parts_that_do_not_exist_are_errors_with_their_text() {
        for text in
            ["0/4", "5/4", "1/0", "0/0", "1", "1/", "/4", "-1/4", "1/1000001", "a/b", "1/2/3", ""]
        {
            let error = text.parse::<Part>().unwrap_err().to_string();
            assert!(error.contains(&format!("'{text}'")) && error.contains("1/4"), "{error}");
        }
        assert!(Part::with(3, 0).is_err());
        assert_eq!("3/4".parse::<Part>().unwrap().to_string(), "3/4");
    }
}
