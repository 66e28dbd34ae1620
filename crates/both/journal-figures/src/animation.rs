//! Animations of frames of one size: animated PNG (APNG, PNG third edition) and GIF.
//!
//! Nearly all the work is done frame by frame ([`AnimationForm::frame`]), so that all cores can have a part in it.
//! Joining the frames copies bytes.

use crate::error::Error;
use std::io::Cursor;

/// The kind of file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AnimationForm {
    /// GIF (89a), which every program shows. In a frame with more than 256 colours they are rounded to fewer bits; times
    /// are rounded to hundredths of a second.
    Gif,
    /// Animated PNG, with all colours.
    Apng,
}

/// A frame as it is in the file.
#[derive(Debug, Clone)]
pub struct AnimationFrame {
    size: (u32, u32),
    content: Content,
}

#[derive(Debug, Clone)]
enum Content {
    Gif(gif::Frame<'static>),
    /// The compressed pixels.
    Png(Vec<u8>),
}

impl AnimationForm {
    /// The frame of a PNG with eight bits a channel.
    ///
    /// # Errors
    /// [`Error::Render`] for bytes that are no such PNG, and of a GIF for more than 65535 pixels each way.
    pub fn frame(self, name: &str, png: &[u8]) -> Result<AnimationFrame, Error> {
        let fail = |reason: String| Error::Render { what: name.to_owned(), reason };
        let (width, height, pixels) = pixels(png).map_err(fail)?;
        let content = match self {
            AnimationForm::Gif => {
                let (Ok(columns), Ok(rows)) = (u16::try_from(width), u16::try_from(height)) else {
                    let reason = format!("{width} × {height} pixels are more than a GIF can have");
                    return Err(fail(reason));
                };
                let (palette, places) = palette_of(&pixels);
                let mut frame =
                    gif::Frame::from_palette_pixels(columns, rows, places, palette, None);
                frame.make_lzw_pre_encoded();
                Content::Gif(frame)
            }
            AnimationForm::Apng => {
                Content::Png(compressed(width, height, &pixels).map_err(|e| fail(e.to_string()))?)
            }
        };
        Ok(AnimationFrame { size: (width, height), content })
    }

    /// The file of frames of this form, each shown for `seconds`, again and again.
    ///
    /// # Errors
    /// [`Error::Render`] for no frames, for frames of the other form, and for frames of different sizes.
    pub fn join(
        self,
        name: &str,
        frames: &[AnimationFrame],
        seconds: f64,
    ) -> Result<Vec<u8>, Error> {
        let fail = |reason: String| Error::Render { what: name.to_owned(), reason };
        let first = frames.first().ok_or_else(|| fail("there is no frame".into()))?;
        if let Some(at) = frames.iter().position(|frame| frame.size != first.size) {
            return Err(fail(other_size(at, frames[at].size, first.size)));
        }
        let joined = match self {
            AnimationForm::Gif => joined_gif(first.size, frames, seconds),
            AnimationForm::Apng => joined_png(first.size, frames, seconds),
        };
        joined.map_err(|error| fail(error.to_string()))
    }
}

/// The frames one after another, each shown for `seconds`, again and again. Frames are PNGs of one size with eight
/// bits a channel.
///
/// # Errors
/// As [`AnimationForm::frame`] and [`AnimationForm::join`].
pub fn animated_png(name: &str, frames: &[Vec<u8>], seconds: f64) -> Result<Vec<u8>, Error> {
    animated(AnimationForm::Apng, name, frames, seconds)
}

/// The same as a GIF.
///
/// # Errors
/// As [`animated_png`].
pub fn animated_gif(name: &str, frames: &[Vec<u8>], seconds: f64) -> Result<Vec<u8>, Error> {
    animated(AnimationForm::Gif, name, frames, seconds)
}

fn animated(
    form: AnimationForm,
    name: &str,
    frames: &[Vec<u8>],
    seconds: f64,
) -> Result<Vec<u8>, Error> {
    let frames = frames.iter().map(|png| form.frame(name, png)).collect::<Result<Vec<_>, _>>()?;
    form.join(name, &frames, seconds)
}

/// What cannot be joined, in words.
type Reason = Box<dyn std::error::Error>;

fn joined_gif(
    (width, height): (u32, u32),
    frames: &[AnimationFrame],
    seconds: f64,
) -> Result<Vec<u8>, Reason> {
    let mut bytes = Vec::new();
    let (columns, rows) = (u16::try_from(width)?, u16::try_from(height)?);
    let mut encoder = gif::Encoder::new(&mut bytes, columns, rows, &[])?;
    encoder.set_repeat(gif::Repeat::Infinite)?;
    for frame in frames {
        let Content::Gif(frame) = &frame.content else { return Err(OTHER_FORM.into()) };
        let mut frame = frame.clone();
        frame.delay = (100.0 * seconds).round() as u16;
        encoder.write_lzw_pre_encoded_frame(&frame)?;
    }
    drop(encoder);
    Ok(bytes)
}

const OTHER_FORM: &str = "a frame is of another form than the file";

/// The pixels of a frame, compressed: the contents of the chunks IDAT of a PNG, one after another.
fn compressed(width: u32, height: u32, pixels: &[u8]) -> Result<Vec<u8>, Reason> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Balanced);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels)?;
    writer.finish()?;
    // A chunk is its length, its type, its contents and a check sum.
    let (mut rest, mut data) = (bytes.get(SIGNATURE.len()..).unwrap_or_default(), Vec::new());
    while let Some((length, after)) = rest.split_first_chunk::<4>() {
        let length = u32::from_be_bytes(*length) as usize;
        let chunk = after.get(..4 + length).ok_or("a chunk is cut")?;
        if chunk.starts_with(b"IDAT") {
            data.extend(&chunk[4..]);
        }
        rest = after.get(4 + length + 4..).unwrap_or_default();
    }
    Ok(data)
}

/// The first bytes of every PNG.
const SIGNATURE: [u8; 8] = *b"\x89PNG\r\n\x1a\n";

/// The chunks of an animated PNG: the header, the number of frames, and for each frame its size and time, and its
/// pixels. The first frame is the picture for programs that show no animations.
fn joined_png(
    (width, height): (u32, u32),
    frames: &[AnimationFrame],
    seconds: f64,
) -> Result<Vec<u8>, Reason> {
    let mut bytes = SIGNATURE.to_vec();
    let size = [width.to_be_bytes(), height.to_be_bytes()].concat();
    // Eight bits a channel, three channels; the only methods of compression and filters; no interlace.
    append_chunk(*b"IHDR", &[&size, &[8, 2, 0, 0, 0]], &mut bytes);
    // 0 plays: without end.
    let count = u32::try_from(frames.len())?.to_be_bytes();
    append_chunk(*b"acTL", &[&count, &[0; 4]], &mut bytes);
    let time = [((1000.0 * seconds).round() as u16).to_be_bytes(), 1000u16.to_be_bytes()].concat();
    let mut number = 0u32..;
    let mut next = || number.next().unwrap_or(u32::MAX).to_be_bytes();
    for (at, frame) in frames.iter().enumerate() {
        let Content::Png(data) = &frame.content else { return Err(OTHER_FORM.into()) };
        // At the place 0, 0; the frame stays, and the next one replaces it.
        append_chunk(*b"fcTL", &[&next(), &size, &[0; 8], &time, &[0, 0]], &mut bytes);
        match at {
            0 => append_chunk(*b"IDAT", &[data], &mut bytes),
            _ => append_chunk(*b"fdAT", &[&next(), data], &mut bytes),
        }
    }
    append_chunk(*b"IEND", &[], &mut bytes);
    Ok(bytes)
}

fn append_chunk(kind: [u8; 4], parts: &[&[u8]], bytes: &mut Vec<u8>) {
    let length: usize = parts.iter().map(|part| part.len()).sum();
    bytes.extend((length as u32).to_be_bytes());
    let begin = bytes.len();
    bytes.extend(kind);
    parts.iter().for_each(|part| bytes.extend(*part));
    let sum = crc32fast::hash(&bytes[begin..]);
    bytes.extend(sum.to_be_bytes());
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
        let gif = AnimationForm::Gif.frame("zoom", &frame(2)).unwrap();
        let error = AnimationForm::Apng.join("zoom", &[gif], 0.1).unwrap_err().to_string();
        assert!(error.contains("another form"), "{error}");
        let error = animated_png("zoom", &[frame(2), frame(3)], 0.1).unwrap_err().to_string();
        assert!(error.contains("frame 1 has 3 × 1 pixels, not 2 × 1"), "{error}");
        assert!(animated_png("zoom", &[], 0.1).is_err() && animated_gif("zoom", &[], 0.1).is_err());
        assert!(animated_gif("zoom", &[frame(2), frame(3)], 0.1).is_err());
        assert!(animated_png("zoom", &[b"no picture".to_vec()], 0.1).is_err());
    }
}
