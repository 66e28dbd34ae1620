//! Animations of frames of one size: animated PNG (APNG, PNG third edition) and GIF.

use crate::error::Error;
use std::io::Cursor;

/// The frames one after another, each shown for `seconds`, again and again. Frames are PNGs of one size with eight
/// bits a channel.
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
            return Err(fail(other_size(at, (own_width, own_height), (width, height))));
        }
        writer.write_image_data(&pixels).map_err(refused)?;
    }
    writer.finish().map_err(refused)?;
    Ok(bytes)
}

/// The same as a GIF (89a), for programs that show no animated PNG. In a frame with more than 256 colours they
/// are rounded to fewer bits; times are rounded to hundredths of a second.
///
/// # Errors
/// As [`animated_png`]; [`Error::Render`] also for frames of more than 65535 pixels each way.
pub fn animated_gif(name: &str, frames: &[Vec<u8>], seconds: f64) -> Result<Vec<u8>, Error> {
    let fail = |reason: String| Error::Render { what: name.to_owned(), reason };
    let refused = |e: gif::EncodingError| fail(e.to_string());
    let first = frames.first().ok_or_else(|| fail("there is no frame".into()))?;
    let (width, height, _) = pixels(first).map_err(fail)?;
    let (Ok(columns), Ok(rows)) = (u16::try_from(width), u16::try_from(height)) else {
        return Err(fail(format!("{width} × {height} pixels are more than a GIF can have")));
    };
    let mut bytes = Vec::new();
    let mut encoder = gif::Encoder::new(&mut bytes, columns, rows, &[]).map_err(refused)?;
    encoder.set_repeat(gif::Repeat::Infinite).map_err(refused)?;
    for (at, frame) in frames.iter().enumerate() {
        let (own_width, own_height, pixels) = pixels(frame).map_err(fail)?;
        if (own_width, own_height) != (width, height) {
            return Err(fail(other_size(at, (own_width, own_height), (width, height))));
        }
        let (palette, places) = palette_of(&pixels);
        let mut frame = gif::Frame::from_palette_pixels(columns, rows, places, palette, None);
        frame.delay = (100.0 * seconds).round() as u16;
        encoder.write_frame(&frame).map_err(refused)?;
    }
    drop(encoder);
    Ok(bytes)
}

/// At most 256 colours of an image, and the place of each pixel among them. Of an image with more, each colour
/// keeps as many bits as leave 256: drawings have flat areas and some hundred shades at the edges of lines, which
/// six or seven bits keep.
fn palette_of(pixels: &[u8]) -> (Vec<u8>, Vec<u8>) {
    let exact = (2..=8).rev().find_map(|bits| palette_with_bits(pixels, bits));
    // Two bits of three channels are 64 colours: there always is a palette.
    exact.unwrap_or_default()
}

/// The palette if each channel keeps this number of bits; `None` for more than 256 colours.
fn palette_with_bits(pixels: &[u8], bits: u32) -> Option<(Vec<u8>, Vec<u8>)> {
    // The nearest of 2^bits levels from 0 to 255: black and white stay.
    let steps = (1u32 << bits) - 1;
    let level = |byte: u8| {
        let nearest = (u32::from(byte) * steps + 127) / 255;
        (nearest * 255 / steps) as u8
    };
    let levels: [u8; 256] = std::array::from_fn(|byte| level(byte as u8));
    let mut known = std::collections::HashMap::new();
    let mut palette = Vec::new();
    let mut places = Vec::with_capacity(pixels.len() / 3);
    let mut last = ([0; 3], None);
    for &color in pixels.as_chunks::<3>().0 {
        // Most pixels have the colour of the one before.
        let place = match last {
            (own, Some(place)) if own == color => place,
            _ => {
                let rounded = color.map(|byte| levels[usize::from(byte)]);
                let next = known.len();
                let place = *known.entry(rounded).or_insert(next);
                if place == next {
                    palette.extend(rounded);
                }
                u8::try_from(place).ok()?
            }
        };
        last = (color, Some(place));
        places.push(place);
    }
    Some((palette, places))
}

fn other_size(at: usize, own: (u32, u32), first: (u32, u32)) -> String {
    format!("frame {at} has {} × {} pixels, not {} × {}", own.0, own.1, first.0, first.1)
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
    fn a_gif_has_all_frames_with_their_colours() {
        let colors = [[255, 0, 0], [0, 255, 0], [0, 0, 255]];
        let frames = colors.map(|color| rgb_png("frame", 2, 1, &[color, [9; 3]].concat()).unwrap());
        let bytes = animated_gif("motion", &frames, 0.25).unwrap();
        let mut options = gif::DecodeOptions::new();
        options.set_color_output(gif::ColorOutput::RGBA);
        let mut reader = options.read_info(&bytes[..]).unwrap();
        assert_eq!(reader.repeat(), gif::Repeat::Infinite);
        for [r, g, b] in colors {
            let frame = reader.read_next_frame().unwrap().unwrap();
            assert_eq!(frame.delay, 25);
            assert_eq!(frame.buffer[..], [r, g, b, 255, 9, 9, 9, 255]);
        }
        assert!(reader.read_next_frame().unwrap().is_none());
    }

    #[test]
    fn a_gif_of_many_colours_keeps_256_of_them() {
        let pixels: Vec<u8> = (0..900u32).flat_map(|k| [k as u8, (k / 3) as u8, 77]).collect();
        let (palette, places) = palette_of(&pixels);
        assert!(palette.len() <= 3 * 256 && palette_with_bits(&pixels, 8).is_none());
        let off = pixels.iter().zip(places.iter().flat_map(|&place| {
            let at = 3 * usize::from(place);
            palette[at..at + 3].to_vec()
        }));
        // Five bits are kept: a level is at most half of 255/31 away.
        assert!(off.clone().all(|(&own, shown)| own.abs_diff(shown) <= 5));
        assert_eq!(palette_of(&[255, 255, 255, 0, 0, 0]).0, [255, 255, 255, 0, 0, 0]);
        let frame = rgb_png("frame", 30, 30, &pixels).unwrap();
        let bytes = animated_gif("motion", &[frame], 0.1).unwrap();
        let mut reader = gif::DecodeOptions::new().read_info(&bytes[..]).unwrap();
        let frame = reader.read_next_frame().unwrap().unwrap();
        assert_eq!((frame.width, frame.height), (30, 30));
    }

    #[test]
    fn frames_of_different_sizes_and_no_frames_are_errors() {
        let frame = |width: usize| rgb_png("frame", width, 1, &vec![0; 3 * width]).unwrap();
        let error = animated_png("zoom", &[frame(2), frame(3)], 0.1).unwrap_err().to_string();
        assert!(error.contains("frame 1 has 3 × 1 pixels, not 2 × 1"), "{error}");
        assert!(animated_png("zoom", &[], 0.1).is_err() && animated_gif("zoom", &[], 0.1).is_err());
        assert!(animated_gif("zoom", &[frame(2), frame(3)], 0.1).is_err());
        assert!(animated_png("zoom", &[b"no picture".to_vec()], 0.1).is_err());
    }
}
