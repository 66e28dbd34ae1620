//! An animated PNG (APNG, PNG third edition) of frames of one size.

use crate::error::Error;
use std::io::Cursor;

/// The frames one after another, each shown for `seconds`, again and again. Frames are PNGs of one size with eight bits a channel.
///
/// # Errors
/// [`Error::Render`] for no frames, for a frame that is no such PNG, and for frames of different sizes.
pub fn animated_png(name: &str, frames: &[Vec<u8>], seconds: f64) -> Result<Vec<u8>, Error> {
    let fail = |reason: String| Error::Render { what: name.to_owned(), reason };
    let refused = |e: png::EncodingError| fail(e.to_string());
    let first = frames.first().ok_or_else(|| fail("there is no frame".into()))?;
    let (width, height, _) = pixels(first).map_err(fail)?;
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Balanced);
    // 0 plays: without end.
    encoder.set_animated(frames.len() as u32, 0).map_err(refused)?;
    encoder.set_frame_delay((1000.0 * seconds).round() as u16, 1000).map_err(refused)?;
    let mut writer = encoder.write_header().map_err(refused)?;
    for (at, frame) in frames.iter().enumerate() {
        let (own_width, own_height, pixels) = pixels(frame).map_err(fail)?;
        if (own_width, own_height) != (width, height) {
            let sizes = format!("{own_width} × {own_height} pixels, not {width} × {height}");
            return Err(fail(format!("frame {at} has {sizes}")));
        }
        writer.write_image_data(&pixels).map_err(refused)?;
    }
    writer.finish().map_err(refused)?;
    Ok(bytes)
}

/// Width, height, and red, green and blue of every pixel. Drawings are opaque: the fourth channel is left out.
fn pixels(png: &[u8]) -> Result<(u32, u32, Vec<u8>), String> {
    let mut reader = png::Decoder::new(Cursor::new(png)).read_info().map_err(|e| e.to_string())?;
    let size = reader.output_buffer_size().ok_or("it is too large")?;
    let mut bytes = vec![0; size];
    let info = reader.next_frame(&mut bytes).map_err(|e| e.to_string())?;
    bytes.truncate(info.buffer_size());
    let rgb = match (info.color_type, info.bit_depth) {
        (png::ColorType::Rgb, png::BitDepth::Eight) => bytes,
        (png::ColorType::Rgba, png::BitDepth::Eight) => {
            bytes.as_chunks::<4>().0.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect()
        }
        other => {
            return Err(format!(
                "a frame has {other:?}, not eight bits for each of three or four channels"
            ));
        }
    };
    Ok((info.width, info.height, rgb))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::rgb_png;

    /// A reader finds the number of frames, the pixels of each, and their time.
    #[test]
    fn an_animation_has_all_frames() {
        let colors = [[255, 0, 0], [0, 255, 0], [0, 0, 255]];
        let frames = colors.map(|color| rgb_png("frame", 2, 1, &[color, color].concat()).unwrap());
        let bytes = animated_png("zoom", &frames, 0.25).unwrap();
        let mut reader = png::Decoder::new(Cursor::new(&bytes)).read_info().unwrap();
        assert_eq!(reader.info().animation_control().unwrap().num_frames, 3);
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        for color in colors {
            reader.next_frame(&mut pixels).unwrap();
            let time = reader.info().frame_control().unwrap();
            assert_eq!(f64::from(time.delay_num) / f64::from(time.delay_den), 0.25);
            assert_eq!(pixels, [color, color].concat());
        }
    }

    #[test]
    fn frames_of_different_sizes_and_no_frames_are_errors() {
        let frame = |width: usize| rgb_png("frame", width, 1, &vec![0; 3 * width]).unwrap();
        let error = animated_png("zoom", &[frame(2), frame(3)], 0.1).unwrap_err().to_string();
        assert!(error.contains("frame 1 has 3 × 1 pixels, not 2 × 1"), "{error}");
        assert!(animated_png("zoom", &[], 0.1).is_err());
        assert!(animated_png("zoom", &[b"no picture".to_vec()], 0.1).is_err());
    }
}
