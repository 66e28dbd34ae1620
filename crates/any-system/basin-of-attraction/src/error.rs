//! Input that the crate refuses.

use crate::space::label::Label;
use thiserror::Error;

/// Why a basin could not be computed.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Error {
    /// The ends of an interval are not finite numbers in increasing order.
    #[error(
        "[{left}, {right}] is not an interval: both ends must be finite, the left one not larger"
    )]
    BadInterval {
        /// Left end.
        left: f64,
        /// Right end.
        right: f64,
    },
    /// Two traps have a point in common.
    #[error(
        "the traps [{first_left}, {first_right}] and [{second_left}, {second_right}] have a point in common: give disjoint ones"
    )]
    OverlappingTraps {
        /// Left end of the first.
        first_left: f64,
        /// Right end of the first.
        first_right: f64,
        /// Left end of the second.
        second_left: f64,
        /// Right end of the second.
        second_right: f64,
    },
    /// An interval that orbits leave, given as a trap.
    #[error(
        "[{left}, {right}] is no trap: the map takes its point {at} to {image:?} (`None`: the orbit ends there, and \
         others do not). Give an interval whose image lies in it, or one on which the map has no value"
    )]
    NotATrap {
        /// Left end.
        left: f64,
        /// Right end.
        right: f64,
        /// The point.
        at: f64,
        /// Its image.
        image: Option<f64>,
    },
    /// A point that the branches do not know.
    #[error(
        "the map has the value {value} at {at}, and the branches do not take it there, or take it at another point as \
         well: a branch is missing. Search with more samples, or divide the window at the turning points"
    )]
    BranchMissed {
        /// The point.
        at: f64,
        /// The value of the map there.
        value: f64,
    },
    /// Limits of a refinement that are negative or NaN.
    #[error(
        "a refinement to an undecided length of {undecided} and intervals of {shortest}: both must be 0 or larger, \
         and the shortest interval finite"
    )]
    BadRefinement {
        /// The undecided length.
        undecided: f64,
        /// The shortest interval.
        shortest: f64,
    },
    /// A raster without pixels, or with more than the largest number of pixels.
    #[error(
        "a raster of {columns} × {rows} pixels: it must have between 1 and 2³⁴ pixels, and two across and up if the \
         ends of its ranges are to be pixels"
    )]
    BadRaster {
        /// Number of columns.
        columns: usize,
        /// Number of rows.
        rows: usize,
    },
    /// Pixels of a line that have no length in `f64`, or too many of them.
    #[error(
        "{pixels} pixels from {left} to {right}: there must be between 1 and 2²⁶, and different `f64` at their ends; \
         take fewer pixels, or a wider window"
    )]
    BadPixels {
        /// Number of pixels.
        pixels: usize,
        /// Left end of the window.
        left: f64,
        /// Right end of the window.
        right: f64,
    },
    /// Intervals that overlap, or are not in increasing order.
    #[error(
        "an interval ends at {first_right}, and the next one begins at {second_left}: give disjoint intervals from \
         left to right"
    )]
    UnsortedIntervals {
        /// Right end of the first.
        first_right: f64,
        /// Left end of the second.
        second_left: f64,
    },
    /// A strip whose labels are not one for each of its pixels.
    #[error(
        "a strip of {columns} columns and {rows} rows has {found} labels: it must have {rows} labels for every column"
    )]
    BadStrip {
        /// Its number of labels.
        found: usize,
        /// Number of columns.
        columns: usize,
        /// Number of rows.
        rows: usize,
    },
    /// The caller stopped the work. Its parts are the columns of an image, or the parameters of a curve.
    #[error("interrupted after {finished} of {parts} parts")]
    Interrupted {
        /// Parts finished.
        finished: usize,
        /// Parts in all; at most, for a curve.
        parts: usize,
    },
    /// A search for monotone branches with too few samples.
    #[error("monotone branches cannot be found with {samples} samples: at least 3 are needed")]
    TooFewSamples {
        /// Requested number of samples.
        samples: usize,
    },
    /// More samples than a computer can keep, or label in a usable time.
    #[error("{samples} samples are more than the {most} that are accepted; {remedy}")]
    TooManySamples {
        /// Requested number of samples; the largest `usize` if the product of two counts exceeds it.
        samples: usize,
        /// The largest number of samples.
        most: usize,
        /// What to do instead.
        remedy: &'static str,
    },
    /// A proportion without trials, or with more successes than trials.
    #[error(
        "{successes} successes in {trials} trials: there must be at least 1 trial, and no more successes than trials"
    )]
    BadTrials {
        /// Successes.
        successes: usize,
        /// Trials.
        trials: usize,
    },
    /// Too few replicates for a confidence interval.
    #[error(
        "a confidence interval cannot be found with {replicates} replicates: at least 2 are needed"
    )]
    TooFewReplicates {
        /// Replicates.
        replicates: usize,
    },
    /// A box size for which boxes cannot be counted.
    #[error(
        "boxes of size {size}: the size must be finite, larger than {above} and at most {largest}"
    )]
    BadBoxSize {
        /// The size given.
        size: f64,
        /// The size must be larger than this: neighbouring boxes of this size could not be distinguished.
        above: f64,
        /// The largest size accepted; infinite if every finite size is.
        largest: f64,
    },
    /// Points that lie in no box.
    #[error(
        "{bad} of {points} points, counted from {left}, lie in no box, because their distance is no finite number: \
         leave these points out, and count them apart"
    )]
    BadPoints {
        /// Points without a finite distance from `left`.
        bad: usize,
        /// Points in all.
        points: usize,
        /// The left end of the first box.
        left: f64,
    },
    /// A perturbation ε of a start that is not positive and finite.
    #[error("a perturbation ε of {epsilon}: it must be positive and finite")]
    BadPerturbation {
        /// The ε given.
        epsilon: f64,
    },
    /// A grid of state space that has no cells, or too many to number.
    #[error(
        "{cells} cells along each of {dimension} sides: there must be at least 1 cell, at most {most} sides, and \
         fewer than 2⁶⁴ cells in all"
    )]
    BadStateGrid {
        /// Cells along a side.
        cells: usize,
        /// Sides.
        dimension: usize,
        /// The largest number of sides.
        most: usize,
    },
    /// A point of another dimension than the region, or feature vectors of different lengths.
    #[error("a point of {dimension} coordinates where {expected} are expected: give as many")]
    WrongDimension {
        /// Coordinates of the point.
        dimension: usize,
        /// Coordinates of the others.
        expected: usize,
    },
    /// More attractors than labels.
    #[error(
        "more than {most} attractors: parts of one count apart where cells are finer than it; take fewer cells"
    )]
    TooManyAttractors {
        /// The largest number.
        most: usize,
    },
    /// A region, or a feature vector, without coordinates.
    #[error("a region has at least one side, a feature vector at least one number")]
    NoDimension,
    /// So many pairs have an undecided point that their number decides the exponent.
    #[error(
        "{open} pairs have an undecided point, and {uncertain} pairs are uncertain: an exponent needs ten times more \
         uncertain pairs than open ones. Raise the budget of the labelling"
    )]
    TooManyOpenPairs {
        /// Pairs with an undecided point.
        open: usize,
        /// Uncertain pairs.
        uncertain: usize,
    },
    /// So few uncertain pairs, or all of them at one distance, that they give no bound on the exponent.
    #[error(
        "{uncertain} uncertain pairs give no bound on the exponent: at least {fewest} are needed, at two distances or \
         more; take more pairs, or larger distances"
    )]
    TooFewUncertainPairs {
        /// Uncertain pairs.
        uncertain: usize,
        /// The smallest number accepted.
        fewest: usize,
    },
    /// Points to which no power law can be fitted.
    #[error(
        "a power law cannot be fitted to these {points} points: at least 3 are needed, with different positive \
         scales, and finite values that are not negative"
    )]
    BadFit {
        /// Points given.
        points: usize,
    },
    /// Replicates of a measurement with different scales.
    #[error(
        "replicate {replicate}, counted from 0, has other scales than replicate 0: measure all at the same scales"
    )]
    UnlikeReplicates {
        /// The first replicate with other scales.
        replicate: usize,
    },
    /// A scale at which every replicate has the value 0, which has no logarithm.
    #[error(
        "the value at scale {scale} is 0 in every replicate: leave this scale out, or take more points at it"
    )]
    NothingFound {
        /// The scale.
        scale: f64,
    },
    /// Fewer points than an interval needs to contain the true number as often as it says.
    #[error("{points} points: a 95 % interval needs at least {fewest}")]
    TooFewPoints {
        /// Points given.
        points: usize,
        /// The smallest number accepted.
        fewest: usize,
    },
    /// Random balls that do not fit into the region, or have too few points.
    #[error(
        "balls of radius {radius} with {points} points: the radius must be positive and below half of the shortest \
         side, {narrowest}; there must be at least 2 points"
    )]
    BadBalls {
        /// The radius given.
        radius: f64,
        /// The shortest side of the region.
        narrowest: f64,
        /// Points in a ball.
        points: usize,
    },
    /// Too few random balls on a boundary.
    #[error(
        "{mixed} of {balls} random balls have more than one basin: at least {fewest} are needed; take more or larger ones"
    )]
    TooFewMixedBalls {
        /// Balls with more than one basin.
        mixed: usize,
        /// Balls in all.
        balls: usize,
        /// The smallest number accepted.
        fewest: usize,
    },
    /// A Wada test of fewer than three basins.
    #[error("{labels} basins: the Wada test needs at least 3")]
    TooFewLabels {
        /// Basins found; undecided labels are none.
        labels: usize,
    },
    /// An image whose labels are not one for each pixel.
    #[error(
        "an image of {columns} × {rows} pixels has {labels} labels: it must have one label for each pixel, and a pixel"
    )]
    BadImage {
        /// Its number of labels.
        labels: usize,
        /// Number of columns.
        columns: usize,
        /// Number of rows.
        rows: usize,
    },
    /// An image, or a sample, without any point inside the region of interest.
    #[error("all {points} points are outside the region of interest: at least one must be inside")]
    NothingInside {
        /// Number of points.
        points: usize,
    },
    /// A coordinate of a point, or a parameter, that is not finite.
    #[error(
        "number {coordinate} of a point or a list, counted from 0, is {value}: it must be finite"
    )]
    BadPoint {
        /// Its place.
        coordinate: usize,
        /// Its value.
        value: f64,
    },
    /// Limits with which a curve of parameters cannot be divided.
    #[error(
        "{first_steps} first steps, halved until fractions differ by {difference} or by {relative} of their value, \
         down to steps of {shortest}, with {budget} parameters: there must be a first step, the differences and the \
         shortest step must be positive (the relative one may be 0), and the budget at least {fewest}"
    )]
    BadCurveLimits {
        /// First steps of every part.
        first_steps: usize,
        /// The difference.
        difference: f64,
        /// The relative difference.
        relative: f64,
        /// The shortest step.
        shortest: f64,
        /// The budget.
        budget: usize,
        /// Parameters at which every curve is computed.
        fewest: usize,
    },
    /// Basins in different windows, or in windows of length 0.
    #[error(
        "basins in [{left}, {right}] and in [{other_left}, {other_right}]: both must have the same window, of a \
         positive length; cut them with `within`"
    )]
    OtherWindow {
        /// Left end of the first window.
        left: f64,
        /// Right end of the first window.
        right: f64,
        /// Left end of the second window.
        other_left: f64,
        /// Right end of the second window.
        other_right: f64,
    },
    /// A boundary is searched between two points that are not in two basins.
    #[error(
        "the points have the labels '{first}' and '{second}': give two points of different basins"
    )]
    NotTwoBasins {
        /// Label of the first point.
        first: Label,
        /// Label of the second point.
        second: Label,
    },
    /// A state whose basin is not known, where it must be.
    #[error(
        "the state has the label '{label}': give a state of a basin, or raise the budget of the labelling"
    )]
    NoBasin {
        /// The label.
        label: Label,
    },
    /// A length or a number of a search that must be positive.
    #[error("{name} of {value}: it must be positive and finite{remedy}")]
    BadSearch {
        /// Its name, with its article.
        name: &'static str,
        /// Its value.
        value: f64,
        /// More about it.
        remedy: &'static str,
    },
}
