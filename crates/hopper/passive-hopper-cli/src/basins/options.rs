//! The options of `hopper basins`, and its help.

use crate::basins::layer::{StoredLayer, stored_layers};
use crate::basins::tables;
use crate::commands::page::{Example, Page};
use crate::options::form::OutputOptions;
use crate::options::values;
use clap::builder::{PossibleValue, PossibleValuesParser};
use hopper_asymptotics::Offset;
use hopper_basin::HopperFate;
use resumable_job::Part;
use std::path::PathBuf;

/// Options.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Options {
    /// Folder for the results, and for finished pieces until the results are complete
    #[arg(short, long, value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// Mass ratios from and to
    #[arg(short = 'M', long, num_args = 2, value_names = ["FROM", "TO"], default_values_t = [0.1, 1.0], value_parser = mass_ratio, allow_negative_numbers = true)]
    pub(crate) mass_ratio: Vec<f64>,
    /// Lift-off speeds from and to, in m₂gω/k [default: the first and the sixth fixed point]
    #[arg(long, num_args = 2, value_names = ["FROM", "TO"], value_parser = values::finite, allow_negative_numbers = true)]
    pub(crate) speed: Option<Vec<f64>>,
    /// Pixels across and up [default: 1024 1024; with --zoom 320 320]
    #[arg(long, num_args = 2, value_names = ["COLUMNS", "ROWS"], value_parser = values::count, allow_negative_numbers = true)]
    pub(crate) pixels: Option<Vec<usize>>,
    /// What to compute, one or several
    #[arg(long, num_args = 1.., value_name = "LAYER", default_values = ["label"], value_parser = layers(), conflicts_with_all = ["about", "zoom"])]
    pub(crate) layer: Vec<String>,

    /// Give each pixel the shares of the basins in it at the mass ratio of its column: a needle thinner than a
    /// pixel is a faint line. At most this part of a pixel stays undecided, unless too many basins meet there
    #[arg(long, value_name = "TOLERANCE", num_args = 0..=1, default_missing_value = "0.05", conflicts_with_all = ["about", "zoom", "layer"], value_parser = values::finite, allow_negative_numbers = true)]
    pub(crate) coverage: Option<f64>,

    /// Compute part K of N only, beside other parts; then --join
    #[arg(long, value_name = "K/N", help_heading = "Long jobs", conflicts_with_all = ["join", "force"])]
    pub(crate) part: Option<Part>,
    /// Join the parts to the results, without computing a piece
    #[arg(long, help_heading = "Long jobs", conflicts_with = "force")]
    pub(crate) join: bool,
    /// Remove the results that are in the folder, of this job or of another one, and compute anew
    #[arg(long, help_heading = "Long jobs")]
    pub(crate) force: bool,

    /// Show the speeds below this fixed point at all scales: each pixel has the shares of the basins that it covers
    #[arg(long, value_name = "N", help_heading = "All scales", conflicts_with = "speed", value_parser = values::whole(1..=HopperFate::LARGEST_LABEL), allow_negative_numbers = true)]
    pub(crate) about: Option<u64>,
    /// With --about: distances below the fixed point, on a logarithmic scale [default: 1e-2 1e-300]
    #[arg(long, num_args = 2, value_names = ["FAR", "NEAR"], help_heading = "All scales", requires = "about", value_parser = offset, allow_negative_numbers = true)]
    pub(crate) offset: Option<Vec<Offset>>,
    /// With --about: distances from a preimage of the fixed point instead, on both sides. It is the one next to
    /// this speed at this mass ratio, followed over the mass ratios of the raster
    #[arg(long, num_args = 2, value_names = ["M", "SPEED"], help_heading = "All scales", requires = "about", conflicts_with = "turns", value_parser = values::finite, allow_negative_numbers = true)]
    pub(crate) preimage: Option<Vec<f64>>,
    /// With --about: the phase instead of the distance, so many turns of the circle of fates
    #[arg(long, value_name = "TURNS", help_heading = "All scales", requires = "about", conflicts_with = "offset", value_parser = values::finite, allow_negative_numbers = true)]
    pub(crate) turns: Option<f64>,
    /// Make a sequence of frames into the edge of a basin next to this speed, at this mass ratio
    #[arg(long, num_args = 2, value_names = ["M", "SPEED"], help_heading = "All scales", conflicts_with_all = ["about", "speed", "mass_ratio"], value_parser = values::finite, allow_negative_numbers = true)]
    pub(crate) zoom: Option<Vec<f64>>,
    /// With --zoom: the number of frames; the first has the half height 1
    #[arg(
        long,
        value_name = "COUNT",
        help_heading = "All scales",
        requires = "zoom",
        default_value_t = 101,
        value_parser = values::count,
        allow_negative_numbers = true
    )]
    pub(crate) frames: usize,
    /// With --zoom: decades from one frame to the next
    #[arg(long, value_name = "DECADES", help_heading = "All scales", requires = "zoom", default_value_t = 1.0, value_parser = values::finite, allow_negative_numbers = true)]
    pub(crate) step: f64,
    #[command(flatten)]
    pub(crate) output: OutputOptions,
}

/// The words of `--layer`.
fn layers() -> PossibleValuesParser {
    let word = |own: StoredLayer| {
        PossibleValue::new(own.layer.key).alias(own.layer.other_key).help(own.layer.about)
    };
    PossibleValuesParser::new(stored_layers().map(word))
}

/// A distance, which may be smaller than any `f64`.
fn offset(text: &str) -> Result<Offset, String> {
    text.parse().map_err(|_| {
        "it is not a distance with an exponent of ten from −10000 to 10000; give one such as 1e-300".to_owned()
    })
}

/// A mass ratio as a number.
fn mass_ratio(text: &str) -> Result<f64, String> {
    values::mass_ratio(text).map(|ratio| ratio.value())
}

/// The help beside the options.
pub(crate) const PAGE: Page = Page {
    units: "Speeds and distances in m₂gω/k.",
    limits: "1 to 1048576 columns and rows, at most 2³⁴ pixels in all; with --about and --coverage 2²⁴ pixels, with \
             --zoom 2 to 2048 a side.\n\
             Speeds from 0 to α*₆₅₀₀₀; mass ratios from 2⁻¹⁰²² to 2¹⁰²². 1000000 parts at most.\n\
             A call that is interrupted or killed keeps its finished pieces: the same call, given again, goes on.\n\
             A folder has the results of one job, which job.txt in it names.\n\
             The number of threads is that of the processors, or RAYON_NUM_THREADS. It does not change the results.",
    tables: tables::ALL,
    examples: &[
        Example {
            about: "The basins over the paper's window, coarsely.",
            line: "hopper basins --mass-ratio 0.1 1 --pixels 64 64 --out basins",
        },
        Example {
            about: "The number of hops as well, in two parts, which could be on two computers.",
            line: "hopper basins --pixels 48 32 --layer label hops --out parts --part 1/2 && \
                   hopper basins --pixels 48 32 --layer label hops --out parts --part 2/2 && \
                   hopper basins --pixels 48 32 --layer label hops --out parts --join",
        },
        Example {
            about: "The share of every basin in each pixel: needles thinner than a pixel are not missed.",
            line: "hopper basins --coverage --mass-ratio 0.17 0.18 --speed 17 17.8 --pixels 8 32 --out coverage",
        },
        Example {
            about: "All scales below the second fixed point at once: two turns of the circle of fates.",
            line: "hopper basins --about 2 --turns 2 --mass-ratio 0.08 0.4 --pixels 8 40 --out scales",
        },
    ],
};
