//! Maps of the line.

/// The image of a point under a map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Image {
    /// The image is this point.
    Point(f64),
    /// The map has no value: the orbit ends here.
    Stops,
    /// The map could not be evaluated. The map's own error has the reason.
    Undecided,
}

/// `None` is [`Image::Stops`].
impl From<Option<f64>> for Image {
    fn from(image: Option<f64>) -> Self {
        image.map_or(Image::Stops, Image::Point)
    }
}

/// A map of the line into itself. All closures `Fn(f64) -> Option<f64>` are maps.
pub trait ScalarMap {
    /// f(x).
    fn image(&self, x: f64) -> Image;
}

impl<F: Fn(f64) -> Option<f64>> ScalarMap for F {
    fn image(&self, x: f64) -> Image {
        self(x).into()
    }
}
