//! Maps of the line.

/// What a map makes of a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Image {
    /// Another point.
    Point(f64),
    /// Nothing: the orbit ends here.
    Stops,
    /// The map could not be evaluated; its own error tells why.
    Undecided,
}

impl From<Option<f64>> for Image {
    fn from(image: Option<f64>) -> Self {
        image.map_or(Image::Stops, Image::Point)
    }
}

/// A map of the line into itself. Closures `Fn(f64) -> Option<f64>` are maps.
pub trait ScalarMap {
    /// f(x).
    fn image(&self, x: f64) -> Image;
}

impl<F: Fn(f64) -> Option<f64>> ScalarMap for F {
    fn image(&self, x: f64) -> Image {
        self(x).into()
    }
}
