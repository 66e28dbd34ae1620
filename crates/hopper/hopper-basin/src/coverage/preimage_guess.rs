//! Guesses of preimages.

/// Guesses which speed has a given image, by a line or a parabola through known ones.
pub(crate) struct PreimageGuess {
    first: (f64, f64),
    /// The slope of the line, and the factor of (y − y₁)(y − y₂).
    slope: f64,
    last: (f64, f64),
    bend: f64,
}

impl PreimageGuess {
    /// The line through two points (image, speed).
    pub(crate) fn line(first: (f64, f64), last: (f64, f64)) -> Self {
        PreimageGuess { first, last, slope: (last.1 - first.1) / (last.0 - first.0), bend: 0.0 }
    }

    /// The parabola through a third point, if it increases or decreases all the way; else the line.
    pub(crate) fn with(mut self, (y, x): (f64, f64)) -> Self {
        let bend = (x - self.at(y)) / ((y - self.first.0) * (y - self.last.0));
        // At the ends the slope is slope ± bend (last − first).
        if (bend * (self.last.0 - self.first.0)).abs() < self.slope.abs() {
            self.bend = bend;
        }
        self
    }

    pub(crate) fn at(&self, y: f64) -> f64 {
        let PreimageGuess { first, last, slope, bend } = self;
        first.1 + slope * (y - first.0) + bend * (y - first.0) * (y - last.0)
    }
}
