//! The options of `hopper basins` and of the commands with jobs of other kinds, and the help of the first.

use crate::basins::coverage::CoverageOptions;
use crate::basins::job::Job;
use crate::basins::layer::{StoredLayer, stored_layers};
use crate::basins::shares::ScalesOptions;
use crate::basins::tables;
use crate::basins::zoom::ZoomOptions;
use crate::commands::page::{Example, Page};
use crate::options::form::OutputOptions;
use crate::options::output_file::{self, OutputFile};
use crate::options::values;
use clap::ValueHint;
use clap::builder::{PossibleValue, PossibleValuesParser};
use hopper_asymptotics::Offset;
use hopper_basin::HopperFate;
use resumable_job::Part;
use std::path::PathBuf;

/// What a job of `hopper basins` is.
#[derive(Debug, Clone, PartialEq, Default, clap::Args)]
pub(crate) struct RasterOptions {
    /// Mass ratios from and to [default: 0.1 1]
    #[arg(short = 'M', long, num_args = 2, value_names = ["FROM", "TO"], value_parser = mass_ratio, allow_negative_numbers = true)]
    pub(crate) mass_ratio: Option<Vec<f64>>,
    /// Lift-off speeds from and to, in m₂gω/k [default: the first and the sixth fixed point]
    #[arg(long, num_args = 2, value_names = ["FROM", "TO"], value_parser = values::finite, allow_negative_numbers = true)]
    pub(crate) speed: Option<Vec<f64>>,
    /// Pixels across and up [default: 1024 1024; of a preview 72 40]
    #[arg(long, num_args = 2, value_names = ["COLUMNS", "ROWS"], value_parser = values::count, allow_negative_numbers = true)]
    pub(crate) pixels: Option<Vec<usize>>,
    /// What to compute, one or several [default: label]
    #[arg(long, num_args = 1.., value_name = "LAYER", value_parser = layers(), conflicts_with_all = ["about", "zoom"])]
    pub(crate) layer: Vec<String>,
    #[command(flatten)]
    pub(crate) old: OldOptions,
}

/// Options that are commands of their own now. They work for scripts until version 0.4, with a note.
#[derive(Debug, Clone, PartialEq, Default, clap::Args)]
pub(crate) struct OldOptions {
    #[arg(long, hide = true, value_name = "TOLERANCE", num_args = 0..=1, default_missing_value = "0.05", conflicts_with_all = ["about", "zoom", "layer"], value_parser = values::finite, allow_negative_numbers = true)]
    coverage: Option<f64>,
    #[arg(long, hide = true, value_name = "N", conflicts_with = "speed", value_parser = scale())]
    about: Option<u64>,
    #[arg(long, hide = true, num_args = 2, value_names = ["FAR", "NEAR"], requires = "about", value_parser = offset, allow_negative_numbers = true)]
    offset: Option<Vec<Offset>>,
    #[arg(long, hide = true, num_args = 2, value_names = ["M", "SPEED"], requires = "about", conflicts_with = "turns", value_parser = values::finite, allow_negative_numbers = true)]
    preimage: Option<Vec<f64>>,
    #[arg(long, hide = true, value_name = "TURNS", requires = "about", conflicts_with = "offset", value_parser = values::finite, allow_negative_numbers = true)]
    turns: Option<f64>,
    #[arg(long, hide = true, num_args = 2, value_names = ["M", "SPEED"], conflicts_with_all = ["about", "speed", "mass_ratio"], value_parser = values::finite, allow_negative_numbers = true)]
    zoom: Option<Vec<f64>>,
    #[arg(long, hide = true, value_name = "COUNT", requires = "zoom", value_parser = values::count, allow_negative_numbers = true)]
    frames: Option<usize>,
    #[arg(long, hide = true, value_name = "DECADES", requires = "zoom", value_parser = values::finite, allow_negative_numbers = true)]
    step: Option<f64>,
}

/// What a call of a job has beside it.
#[derive(Debug, Clone, clap::Args)]
#[command(next_help_heading = "Long jobs")]
pub(crate) struct PlaceOptions {
    /// Compute part K of N only, beside other parts; then --join
    #[arg(long, value_name = "K/N", conflicts_with_all = ["join", "force"])]
    pub(crate) part: Option<Part>,
    /// Join the parts to the results, without computing a piece
    #[arg(long, conflicts_with = "force")]
    pub(crate) join: bool,
    /// Remove the results that are in the folder, of this job or of another one, and compute anew
    #[arg(long)]
    pub(crate) force: bool,
}

/// Options of `hopper basins`.
#[derive(Debug, Clone, clap::Args)]
#[command(
    args_conflicts_with_subcommands = true,
    subcommand_value_name = "ACTION",
    subcommand_help_heading = "Actions"
)]
pub(crate) struct Options {
    #[command(subcommand)]
    pub(crate) action: Option<Action>,
    /// Folder for the results, and for finished pieces until the results are complete. With no option beside it the
    /// job in this folder goes on. Without it a small picture is printed
    #[arg(short, long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub(crate) out: Option<PathBuf>,
    /// Write the picture of the first layer, FILE.png or FILE.svg, without a folder
    #[arg(long, value_name = "FILE", value_parser = output_file::figure, value_hint = ValueHint::FilePath, conflicts_with_all = ["out", "part", "join", "force", "coverage", "about", "zoom"])]
    pub(crate) picture: Option<OutputFile>,
    #[command(flatten)]
    pub(crate) job: RasterOptions,
    #[command(flatten)]
    pub(crate) place: PlaceOptions,
    #[command(flatten)]
    pub(crate) output: OutputOptions,
}

/// What is done with a folder that has a job.
#[derive(Debug, Clone, clap::Subcommand)]
pub(crate) enum Action {
    /// Say how far the job in a folder is, without disturbing it
    Status(FolderOptions),
    /// Compare all results and finished pieces in a folder with their digests; exit status 1 if one is damaged
    Verify(FolderOptions),
}

/// A folder, and the form of the output.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct FolderOptions {
    /// The folder of the job
    #[arg(value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub(crate) folder: PathBuf,
    #[command(flatten)]
    pub(crate) output: OutputOptions,
}

/// Options of a command with one kind of job.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct JobOptions<T: clap::Args> {
    #[command(flatten)]
    pub(crate) job: T,
    /// Folder for the results, and for finished pieces until the results are complete
    #[arg(short, long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub(crate) out: PathBuf,
    #[command(flatten)]
    pub(crate) place: PlaceOptions,
    #[command(flatten)]
    pub(crate) output: OutputOptions,
}

impl RasterOptions {
    /// The job of the options that are commands of their own now, with what to write instead.
    pub(crate) fn old_job(&self) -> Option<(Box<dyn Job>, &'static str)> {
        let RasterOptions { mass_ratio, speed, pixels, old, .. } = self.clone();
        if let Some(fixed_point) = old.about {
            let OldOptions { offset, preimage, turns, .. } = old;
            let job = ScalesOptions { fixed_point, mass_ratio, offset, preimage, turns, pixels };
            return Some((Box::new(job), "--about N is the command `hopper scales N`"));
        }
        if let Some(&[mass_ratio, speed]) = old.zoom.as_deref() {
            let (frames, step) = (old.frames, old.step);
            let job = ZoomOptions { mass_ratio, speed, frames, step, pixels };
            return Some((Box::new(job), "--zoom M SPEED is the command `hopper zoom M SPEED`"));
        }
        let tolerance = Some(old.coverage?);
        let job = CoverageOptions { tolerance, mass_ratio, speed, pixels };
        Some((Box::new(job), "--coverage is the command `hopper coverage`"))
    }
}

/// The numbers of fixed points.
pub(crate) fn scale() -> impl Fn(&str) -> Result<u64, String> + Clone {
    values::whole(1..=HopperFate::LARGEST_LABEL)
}

/// The words of `--layer`.
fn layers() -> PossibleValuesParser {
    let word = |own: StoredLayer| {
        PossibleValue::new(own.layer.key).alias(own.layer.other_key).help(own.layer.about)
    };
    PossibleValuesParser::new(stored_layers().map(word))
}

/// A distance, which may be smaller than any `f64`.
pub(crate) fn offset(text: &str) -> Result<Offset, String> {
    text.parse().map_err(|_| {
        "it is not a distance with an exponent of ten from −10000 to 10000; give one such as 1e-300".to_owned()
    })
}

/// A mass ratio as a number.
pub(crate) fn mass_ratio(text: &str) -> Result<f64, String> {
    values::mass_ratio(text).map(|ratio| ratio.value())
}

/// The help beside the options.
pub(crate) const PAGE: Page = Page {
    units: "Speeds and distances in m₂gω/k.",
    limits: "1 to 1048576 columns and rows, at most 2³⁴ pixels in all; of --picture and previews 2²².\n\
             Speeds from 0 to α*₆₅₀₀₀; mass ratios from 2⁻¹⁰²² to 2¹⁰²². 1000000 parts at most.\n\
             A call that is interrupted or killed keeps its finished pieces: `hopper basins --out DIR` goes on, of \
             whichever kind the job in the folder is.\n\
             A folder has the results of one job, which job.txt in it names; call.txt has the call.\n\
             A preview has colours on a terminal, unless NO_COLOR is set, and two rows of pixels in a line. Elsewhere it \
             shows every second row in signs: a digit is the fixed point to which the orbits converge, a point is \
             decaying, # grounded, ? undecided, + a fixed point beyond the ninth. Of layers of numbers the digits are \
             shades, from 0, dark, to 9, light; --picture has the scale.\n\
             The number of threads does not change the results.",
    is_filter: false,
    tables: &tables::ALL,
    examples: &[
        Example {
            about: "The basins over the paper's window, coarsely.",
            line: "hopper basins --mass-ratio 0.1 1 --pixels 64 64 --out basins",
        },
        Example {
            about: "The number of hops as well, in two parts, which could be on two computers.",
            line: "hopper basins --pixels 48 32 --layer label hops --out parts --part 1/2 &&\n\
                   hopper basins --pixels 48 32 --layer label hops --out parts --part 2/2 &&\n\
                   hopper basins --out parts --join",
        },
        Example {
            about: "A small picture at once.",
            line: "hopper basins --mass-ratio 0.17 0.18 --speed 17 17.8",
        },
        Example {
            about: "How far a job is, and whether all its files are whole.",
            line: "hopper basins --pixels 48 32 --out job && hopper basins status job &&\n\
                   hopper basins verify job",
        },
    ],
};
