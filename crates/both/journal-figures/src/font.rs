//! The built-in font: from text to placed glyphs and their outlines.

use crate::path::{Path, Point, Segment};
use std::sync::LazyLock;
use thiserror::Error;
use ttf_parser::gpos::{PairAdjustment, PositioningSubtable};
use ttf_parser::gsub::{LigatureSubstitution, SubstitutionSubtable};
use ttf_parser::opentype_layout::{LayoutTable, LookupSubtable};
use ttf_parser::{Face, FaceParsingError, GlyphId, OutlineBuilder, Tag};

/// STIX has upright and mathematical italic letters, Latin and Greek, in one file.
const STIX: &[u8] = include_bytes!("../assets/STIX-Regular.otf");

/// Why a text cannot be set.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub(crate) enum FontError {
    /// The font has no glyph for a character.
    #[error("the font has no glyph for '{0}' (U+{code:04X})", code = u32::from(*.0))]
    MissingGlyph(char),
    /// The font file is damaged.
    #[error("the font cannot be read: {0}")]
    Unreadable(#[from] FaceParsingError),
}

/// A font with the parts of its layout tables that Latin and Greek labels need.
pub(crate) struct Font {
    face: Face<'static>,
    /// Glyph sequences drawn as one glyph, such as fi.
    ligatures: Vec<LigatureSubstitution<'static>>,
    /// Corrections of the distance between two glyphs.
    kerning: Vec<PairAdjustment<'static>>,
}

impl Font {
    /// The built-in font, parsed once.
    pub(crate) fn shipped() -> Result<&'static Font, FontError> {
        static SHIPPED: LazyLock<Result<Font, FontError>> = LazyLock::new(|| Font::parse(STIX));
        SHIPPED.as_ref().map_err(|&error| error)
    }

    fn parse(bytes: &'static [u8]) -> Result<Self, FontError> {
        let face = Face::parse(bytes, 0)?;
        let tables = face.tables();
        let ligatures =
            subtables(tables.gsub, b"liga").into_iter().filter_map(|table| match table {
                SubstitutionSubtable::Ligature(ligatures) => Some(ligatures),
                _ => None,
            });
        let kerning = subtables(tables.gpos, b"kern").into_iter().filter_map(|table| match table {
            PositioningSubtable::Pair(pairs) => Some(pairs),
            _ => None,
        });
        let (ligatures, kerning) = (ligatures.collect(), kerning.collect());
        Ok(Font { face, ligatures, kerning })
    }

    /// Adds the outlines of `text` to `path`, from `start` on its baseline, and returns the x at
    /// which the text ends.
    pub(crate) fn set(
        &self,
        text: &str,
        size: f64,
        start: Point,
        path: &mut Path,
    ) -> Result<f64, FontError> {
        let scale = size / f64::from(self.face.units_per_em());
        let mut x = start.0;
        let glyphs = self.glyphs(text)?;
        for (k, &glyph) in glyphs.iter().enumerate() {
            let mut pen = GlyphPen { path, scale, origin: (x, start.1), at: (0.0, 0.0) };
            // A space has no outline. This `None` is no error.
            let _ = self.face.outline_glyph(glyph, &mut pen);
            let advance = self.face.glyph_hor_advance(glyph).unwrap_or(0);
            let kern = glyphs.get(k + 1).map_or(0, |&next| self.kern(glyph, next));
            x += scale * (f64::from(advance) + f64::from(kern));
        }
        Ok(x)
    }

    /// The glyphs of a text, ligatures formed.
    fn glyphs(&self, text: &str) -> Result<Vec<GlyphId>, FontError> {
        let glyph = |c| self.face.glyph_index(c).ok_or(FontError::MissingGlyph(c));
        let single: Vec<GlyphId> = text.chars().map(glyph).collect::<Result<_, _>>()?;
        let mut glyphs = Vec::with_capacity(single.len());
        let mut rest = single.as_slice();
        while let [first, after @ ..] = rest {
            let (glyph, more) = self.ligature(*first, after).unwrap_or((*first, 0));
            glyphs.push(glyph);
            rest = &after[more..];
        }
        Ok(glyphs)
    }

    /// The ligature that starts with `first`, and the number of glyphs of `after` that it replaces.
    ///
    /// The font lists longer ligatures first, so that "ffi" is found before "ff".
    fn ligature(&self, first: GlyphId, after: &[GlyphId]) -> Option<(GlyphId, usize)> {
        self.ligatures.iter().find_map(|table| {
            let set = table.ligature_sets.get(table.coverage.get(first)?)?;
            let ligature = set.into_iter().find(|ligature| {
                let count = usize::from(ligature.components.len());
                after
                    .get(..count)
                    .is_some_and(|next| ligature.components.into_iter().eq(next.iter().copied()))
            })?;
            Some((ligature.glyph, usize::from(ligature.components.len())))
        })
    }

    /// The correction of the distance between two glyphs, in font units; 0 for most pairs.
    fn kern(&self, left: GlyphId, right: GlyphId) -> i16 {
        let correction = |table: &PairAdjustment| {
            let place = table.coverage().get(left)?;
            let (first, _) = match table {
                PairAdjustment::Format1 { sets, .. } => sets.get(place)?.get(right)?,
                PairAdjustment::Format2 { classes, matrix, .. } => {
                    matrix.get((classes.0.get(left), classes.1.get(right)))?
                }
            };
            Some(first.x_advance)
        };
        self.kerning.iter().find_map(correction).unwrap_or(0)
    }
}

/// The subtables of a feature for Latin text in no special language. Other languages have ligatures such as the Dutch
/// ij.
fn subtables<T: LookupSubtable<'static>>(
    table: Option<LayoutTable<'static>>,
    feature: &[u8; 4],
) -> Vec<T> {
    let Some(table) = table else { return Vec::new() };
    let language =
        table.scripts.find(Tag::from_bytes(b"latn")).and_then(|script| script.default_language);
    language
        .into_iter()
        .flat_map(|language| language.feature_indices)
        .filter_map(|index| table.features.get(index))
        .filter(|found| found.tag == Tag::from_bytes(feature))
        .flat_map(|found| found.lookup_indices)
        .filter_map(|index| table.lookups.get(index))
        .flat_map(|lookup| lookup.subtables.into_iter())
        .collect()
}

/// Receives a glyph in font units, y upwards, and adds it to a path on the page, y downwards.
struct GlyphPen<'a> {
    path: &'a mut Path,
    scale: f64,
    origin: Point,
    /// The last point, in font units.
    at: Point,
}

impl GlyphPen<'_> {
    fn to(&mut self, x: f32, y: f32) -> Point {
        self.at = (f64::from(x), f64::from(y));
        self.place(self.at)
    }

    fn place(&self, (x, y): Point) -> Point {
        (self.origin.0 + self.scale * x, self.origin.1 - self.scale * y)
    }
}

impl OutlineBuilder for GlyphPen<'_> {
    fn move_to(&mut self, x: f32, y: f32) {
        let point = self.to(x, y);
        self.path.push(Segment::Move(point));
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let point = self.to(x, y);
        self.path.push(Segment::Line(point));
    }

    /// A parabola is a cubic piece. The control points of the cubic piece lie at two thirds of the way from its ends to
    /// the control point of the parabola.
    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let (x1, y1) = (f64::from(x1), f64::from(y1));
        let towards = |(x, y): Point| (x + (x1 - x) * 2.0 / 3.0, y + (y1 - y) * 2.0 / 3.0);
        let first = self.place(towards(self.at));
        let end = self.to(x, y);
        let second = self.place(towards(self.at));
        self.path.push(Segment::Cubic(first, second, end));
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let (first, second) = (self.to(x1, y1), self.to(x2, y2));
        let end = self.to(x, y);
        self.path.push(Segment::Cubic(first, second, end));
    }

    fn close(&mut self) {
        self.path.push(Segment::Close);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Size at which font units are points.
    const UNITS: f64 = 1000.0;

    fn set(text: &str) -> Result<(Path, f64), FontError> {
        let mut path = Path::default();
        let width = Font::shipped()?.set(text, UNITS, (0.0, 0.0), &mut path)?;
        Ok((path, width))
    }

    /// The widths are those of HarfBuzz with the same font: with the ligatures ff, ffi, fi and with kerning between
    /// T, y, A and V.
    #[test]
    fn widths_as_harfbuzz_sets_them() {
        for (text, width) in [
            ("lift-off speed", 5142.0),
            ("difference", 3990.0),
            ("first", 1550.0),
            ("ffi", 832.0),
            ("Type AVAT", 4812.0),
            ("A V", 1694.0),
            ("(dimensionless)", 6333.0),
            ("−0.25", 2435.0),
            ("𝛼", 524.0),
            ("𝑓", 555.0),
            ("", 0.0),
        ] {
            let found = set(text).unwrap().1;
            assert!((found - width).abs() < 1e-9, "{text}: {found} instead of {width}");
        }
    }

    /// The limits of M, − and the italic α in the font's CFF table, as fontTools reads them. The
    /// outlines of all three have points at their limits; y is upwards in the font, downwards here.
    #[test]
    fn outlines_have_the_limits_that_the_font_states() {
        for (text, limits) in [
            ("M", [12.0, 0.0, 864.0, 662.0]),
            ("−", [64.0, 220.0, 621.0, 286.0]),
            ("𝛼", [40.0, -10.0, 529.0, 441.0]),
        ] {
            let (path, _) = set(text).unwrap();
            let [left, top, right, bottom] = path.limits_of_ends();
            assert_eq!([left, -bottom, right, -top], limits, "{text}");
        }
    }

    #[test]
    fn a_character_that_the_font_lacks_is_an_error_that_names_it() {
        let error = set("speed 漢").unwrap_err();
        assert_eq!(error, FontError::MissingGlyph('漢'));
        assert_eq!(error.to_string(), "the font has no glyph for '漢' (U+6F22)");
    }
}
