//! The layers of a raster over (M, α): what its pixels can show.
//!
//! [`LAYERS`] is the one table. The program, the Python package and the page read keys, names, columns and colours from
//! it: a new entry is a new layer of all three.

use crate::error::Error;
use crate::fate_colors;
use crate::layer_columns::{LayerColumns, fates, hops, proofs, shares};
use crate::number_columns::{
    digits, flight_times, phases, relative_losses, slopes, sudden_lift_offs,
};
use crate::scales::Scale;
use basin_of_attraction::Label;
use journal_figures::palette::Color;

/// All layers.
pub static LAYERS: &[Layer] = &[
    Layer {
        key: "label",
        other_key: "fate",
        name: "fate",
        about: "The fate of every pixel's middle",
        legend: "",
        file: "basin",
        pieces: "tiles",
        cost: 1.0,
        beside_edges: BesideEdges::Fates,
        content: Content::Values(Values {
            bytes: 2,
            meaning: Meaning::Fates { flag: None },
            together: 16,
            columns: fates,
        }),
    },
    Layer {
        key: "hops",
        other_key: "hops",
        name: "number of hops",
        about: "The number of hops until this fate is known",
        legend: "hops until the fate is known",
        file: "hops",
        pieces: "tiles of hops",
        cost: 1.0,
        beside_edges: BesideEdges::Nothing,
        content: Content::Values(Values {
            bytes: 8,
            meaning: Meaning::Numbers { largest: 10_000 },
            together: 1,
            columns: hops,
        }),
    },
    Layer {
        key: "coverage",
        other_key: "coverage",
        name: "exact coverage",
        about: "The share of every basin in each pixel, mixed as light",
        legend: "mixed by shares",
        file: "coverage",
        pieces: "columns",
        cost: 170.0,
        beside_edges: BesideEdges::Fates,
        content: Content::Shares(shares),
    },
    Layer {
        key: "proof",
        other_key: "proof",
        name: "proved or computed",
        about: "The fate, and whether it is proved or only computed",
        legend: "computed, not proved",
        file: "proof",
        pieces: "tiles of proofs",
        cost: 25.0,
        beside_edges: BesideEdges::Nothing,
        content: Content::Values(Values {
            bytes: 4,
            meaning: Meaning::Fates { flag: Some("proved") },
            together: 1,
            columns: proofs,
        }),
    },
    Layer {
        key: "phase",
        other_key: "phase",
        name: "phase Ψ",
        about: "The fraction of the phase Ψ with which an orbit comes to its α*: it is the same all along the orbit",
        legend: "fraction of the phase Ψ",
        file: "phase",
        pieces: "tiles of phases",
        cost: 3.0,
        beside_edges: BesideEdges::Phases,
        content: Content::Values(Values {
            bytes: 4,
            meaning: Meaning::Reals(Scale::Turn),
            together: 1,
            columns: phases,
        }),
    },
    Layer {
        key: "loss",
        other_key: "energy",
        name: "energy lost",
        about: "The share of the energy of the hopping that the landings of the next hop take: (α² − α′²)/α²",
        legend: "energy lost in the next hop",
        file: "loss",
        pieces: "tiles of losses",
        cost: 1.0,
        beside_edges: BesideEdges::Sides,
        content: Content::Values(Values {
            bytes: 4,
            meaning: Meaning::Reals(Scale::Linear { from: 0.0, to: 1.0 }),
            together: 1,
            columns: relative_losses,
        }),
    },
    Layer {
        key: "sudden",
        other_key: "sudden",
        name: "sudden lift-offs",
        about: "The number of sudden lift-offs in the next hop",
        legend: "sudden lift-offs",
        file: "sudden",
        pieces: "tiles of sudden lift-offs",
        cost: 1.0,
        beside_edges: BesideEdges::Sides,
        content: Content::Values(Values {
            bytes: 4,
            meaning: Meaning::Numbers { largest: 4 },
            together: 1,
            columns: sudden_lift_offs,
        }),
    },
    Layer {
        key: "flight",
        other_key: "flight",
        name: "time of flight",
        about: "The time of flight of the next hop, in units of 1/ω",
        legend: "time of flight (1/ω)",
        file: "flight",
        pieces: "tiles of times",
        cost: 1.0,
        beside_edges: BesideEdges::Sides,
        content: Content::Values(Values {
            bytes: 4,
            meaning: Meaning::Reals(Scale::Linear { from: 0.0, to: 50.0 }),
            together: 1,
            columns: flight_times,
        }),
    },
    Layer {
        key: "slope",
        other_key: "sensitivity",
        name: "sensitivity |∂α′/∂α|",
        about: "How much the next lift-off speed changes with this one: |∂α′/∂α|",
        legend: "sensitivity |∂α′/∂α|",
        file: "slope",
        pieces: "tiles of slopes",
        cost: 2.0,
        beside_edges: BesideEdges::Sides,
        content: Content::Values(Values {
            bytes: 4,
            meaning: Meaning::Reals(Scale::Logarithmic { from: 0.1, to: 100.0 }),
            together: 1,
            columns: slopes,
        }),
    },
    Layer {
        key: "digits",
        other_key: "depth-of-proof",
        name: "depth of proof",
        about: "The digits that the enclosed orbit still has where its fate is proved, of 16",
        legend: "digits left where the fate is proved",
        file: "digits",
        pieces: "tiles of digits",
        cost: 25.0,
        beside_edges: BesideEdges::Nothing,
        content: Content::Values(Values {
            bytes: 4,
            meaning: Meaning::Reals(Scale::Linear { from: 0.0, to: 16.0 }),
            together: 1,
            columns: digits,
        }),
    },
];

/// What a value of a layer of fates has beside the code of its label if it has the flag of the layer.
pub const FLAG: u64 = 1 << 16;

/// The colour of a fate without the flag of its layer: a light blue. The colours of fates are black, grey, yellow
/// and dark ones.
pub const WITHOUT_FLAG: Color = Color { css: "#38c0ff", rgb: [0x38, 0xc0, 0xff] };

/// What the pixels of a raster show.
#[derive(Debug, Clone, Copy)]
pub struct Layer {
    /// Its word in options, links and datasets.
    pub key: &'static str,
    /// Another word that is read, too.
    pub other_key: &'static str,
    /// Its name in sentences.
    pub name: &'static str,
    /// What a pixel has, in one line.
    pub about: &'static str,
    /// What its legend says beside the fates.
    pub legend: &'static str,
    /// The name of its files, without the ending.
    pub file: &'static str,
    /// What messages call the pieces of a long computation.
    pub pieces: &'static str,
    /// The time that a pixel takes, in that of a fate: measured for 64 × 64 pixels of the window of Fig. 6.
    pub cost: f64,
    /// What it is in a window about an edge that doubles do not resolve.
    pub beside_edges: BesideEdges,
    /// What a pixel is.
    pub content: Content,
}

/// What a layer is in a window about an edge of a basin, of a height down to 10⁻¹⁰⁰ and beyond.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BesideEdges {
    /// The shares of the fates.
    Fates,
    /// The phases with which the orbits come to their fixed points.
    Phases,
    /// One number on each side of the edge: one hop changes no more.
    Sides,
    /// Nothing: it is about doubles, or has no largest number there.
    Nothing,
}

/// What the pixels of a layer are.
#[derive(Debug, Clone, Copy)]
pub enum Content {
    /// A number for each pixel.
    Values(Values),
    /// The colours of some columns, mixed by the shares of the fates: red, green and blue, the highest row first.
    Shares(fn(&LayerColumns) -> Result<Vec<u8>, Error>),
}

/// The numbers of a layer.
#[derive(Debug, Clone, Copy)]
pub struct Values {
    /// Bytes of a number in arrays: 2, 4 or 8.
    pub bytes: usize,
    /// What the numbers mean.
    pub meaning: Meaning,
    /// Columns that are computed together, because they share work. Between them a long computation can end.
    pub together: usize,
    /// The numbers of some columns, each from below.
    pub columns: fn(&LayerColumns) -> Result<Vec<Vec<u64>>, Error>,
}

/// What the numbers of a layer mean.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Meaning {
    /// The code of a label in the lowest 16 bits; and [`FLAG`], if the layer has a flag of this name, and the pixel
    /// has it.
    Fates {
        /// The name of the flag.
        flag: Option<&'static str>,
    },
    /// A number, from 0 on.
    Numbers {
        /// The one with the darkest colour where one scale serves many pictures. Few pixels have more.
        largest: u64,
    },
    /// A real number: the bits of an `f32`, of NaN where there is none, as that of a hopper that is grounded.
    Reals(Scale),
}

impl Layer {
    /// The layer of a key; `None` for other words.
    pub fn of(key: &str) -> Option<&'static Self> {
        LAYERS.iter().find(|layer| layer.key == key || layer.other_key == key)
    }

    /// Its numbers; `None` for a layer of shares.
    pub fn values(&self) -> Option<&Values> {
        match &self.content {
            Content::Values(values) => Some(values),
            Content::Shares(_) => None,
        }
    }
}

impl Values {
    /// The names of the columns of a table of these numbers.
    pub fn table_columns(&self, key: &'static str) -> Vec<&'static str> {
        match self.meaning {
            Meaning::Fates { flag } => ["label"].into_iter().chain(flag).collect(),
            Meaning::Numbers { .. } | Meaning::Reals(_) => vec![key],
        }
    }

    /// The scale of numbers where one serves many pictures; `None` for fates.
    pub fn scale(&self) -> Option<Scale> {
        match self.meaning {
            Meaning::Fates { .. } => None,
            Meaning::Numbers { largest } => Some(Scale::Counts { largest }),
            Meaning::Reals(scale) => Some(scale),
        }
    }

    /// What a value of a layer of numbers is.
    pub fn number(&self, value: u64) -> f64 {
        match self.meaning {
            Meaning::Reals(_) => f64::from(f32::from_bits(value as u32)),
            Meaning::Numbers { .. } | Meaning::Fates { .. } => value as f64,
        }
    }

    /// The colour of a value.
    pub fn color(&self, value: u64) -> [u8; 3] {
        match (self.meaning, self.scale()) {
            (_, Some(scale)) => scale.color(self.number(value)),
            (meaning, None) => {
                let label = label_of(value);
                let flagged = matches!(meaning, Meaning::Fates { flag: Some(_) });
                let bare = flagged && value & FLAG == 0 && !label.is_undecided();
                if bare { WITHOUT_FLAG.rgb } else { fate_colors::rgb(label) }
            }
        }
    }
}

/// The label of a number of a layer of fates.
pub fn label_of(value: u64) -> Label {
    Label::from_code((value % FLAG) as u16)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::basins::BasinWindow;
    use crate::layer_drawing::draw_layer;
    use basin_of_attraction::{Grid, Interval};

    /// An entry without one of its parts would be a layer that a front cannot show.
    #[test]
    fn every_layer_has_all_its_parts() {
        for (at, layer) in LAYERS.iter().enumerate() {
            let words =
                [layer.key, layer.other_key, layer.name, layer.about, layer.file, layer.pieces];
            assert!(words.iter().all(|word| !word.is_empty()), "{layer:?}");
            assert!(at == 0 || !layer.legend.is_empty(), "{layer:?}");
            assert!(layer.cost.is_finite() && layer.cost >= 1.0, "{layer:?}");
            let other = |word: &str| Layer::of(word).map(|found| found.name) == Some(layer.name);
            assert!(
                other(layer.key) && other(layer.other_key),
                "a key of {layer:?} is another one's"
            );
            let interval = |low: f64, high: f64| Interval::new(low, high).unwrap();
            let grid = Grid { x: interval(0.1, 0.3), y: interval(8.0, 9.0), columns: 4, rows: 3 };
            let columns = LayerColumns { grid, logarithmic: false, columns: 1..3 };
            match &layer.content {
                Content::Shares(pixels) => assert_eq!(pixels(&columns).unwrap().len(), 3 * 2 * 3),
                Content::Values(values) => {
                    let found = (values.columns)(&columns).unwrap();
                    assert_eq!(found.iter().map(Vec::len).collect::<Vec<_>>(), [3, 3]);
                    assert!([2, 4, 8].contains(&values.bytes) && values.together > 0);
                    let most = u64::MAX >> (64 - 8 * values.bytes);
                    assert!(found.iter().flatten().all(|&value| value <= most), "{layer:?}");
                    let window = BasinWindow {
                        name: layer.file,
                        mass_ratio: (0.1, 0.3),
                        alpha: (8.0, 9.0),
                        inset: None,
                        tick_counts: (4, 4),
                    };
                    let part = Grid { columns: 2, ..grid };
                    assert!(draw_layer((layer, values), &window, &part, &found.concat()).is_ok());
                    assert!(!values.table_columns(layer.key).is_empty());
                }
            }
        }
    }
}
