//! The answers of the core on this machine, as a file of JSON: the page in a browser must give the same.
//!
//! `cargo run --example native_answers -- FILE`

use hopper_explorer::{Depth, Tile, motion, numbered, point, strip};
use hopper_figures::{LAYERS, Layer};
use std::time::Instant;

/// Ten points with fates of every kind.
const POINTS: [(f64, f64); 10] = [
    (0.2, 7.0),
    (0.2, 4.55),
    (1.0, 2.0),
    (0.05, 10.0),
    (0.08, 13.3),
    (0.1, 18.0),
    (0.5, 9.2),
    (3.0, 5.5),
    (0.12, 11.92),
    (0.175, 17.4),
];

/// Layer, logarithmic, M or log₂ M, α, pixels.
type Scene = (u32, bool, [f64; 2], [f64; 2], usize);

/// Windows of layers whose bits depend on more than the layer. All others have one.
const WINDOWS: [Scene; 8] = [
    (0, false, [0.0, 1.0], [4.0, 20.0], 256),
    (0, false, [0.17, 0.18], [17.0, 17.8], 256),
    (0, true, [-4.0, 4.0], [4.0, 12.0], 128),
    (1, false, [0.0, 0.5], [4.0, 12.0], 64),
    (2, false, [0.1, 0.3], [8.0, 10.0], 32),
    (3, false, [0.1, 0.3], [8.0, 10.0], 32),
    (3, true, [-6.0, 0.0], [100.0, 120.0], 32),
    (7, true, [-4.0, 0.0], [4.4, 10.0], 32),
];

/// The window of the other layers.
const OTHER: Scene = (0, false, [0.02, 1.0], [4.4, 10.0], 32);

/// The scenes of all layers.
fn scenes() -> Vec<Scene> {
    let layers = 0..LAYERS.len() as u32;
    let others = layers.filter(|layer| WINDOWS.iter().all(|(own, ..)| own != layer));
    WINDOWS
        .into_iter()
        .chain(others.map(|layer| (layer, OTHER.1, OTHER.2, OTHER.3, OTHER.4)))
        .collect()
}

/// FNV-1a, which the browser's tests compute alike.
fn digest(bytes: impl IntoIterator<Item = u8>) -> String {
    let step = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    format!("{:016x}", bytes.into_iter().fold(0xcbf2_9ce4_8422_2325, step))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args_os().nth(1).ok_or("name the file: native_answers FILE")?;
    let mut tiles = Vec::new();
    for (layer, logarithmic, x, alpha, pixels) in scenes() {
        let window =
            Tile { x: x.into(), logarithmic, alpha: alpha.into(), columns: pixels, rows: pixels };
        let whole = || strip(numbered(layer)?, &window, 0..pixels);
        let found = whole()?;
        // The best of some runs; a loaded machine is not measured.
        let seconds = |_| {
            let begin = Instant::now();
            whole().map(|_| begin.elapsed().as_secs_f64())
        };
        let runs: Vec<f64> = (0..5).map(seconds).collect::<Result<_, _>>()?;
        let best = runs.into_iter().fold(f64::INFINITY, f64::min);
        tiles.push(format!(
            r#"{{"layer":{layer},"logarithmic":{logarithmic},"x":{x:?},"alpha":{alpha:?},"pixels":{pixels},"values":"{}","colors":"{}","milliseconds":{}}}"#,
            digest(found.values.iter().flat_map(|value| value.to_le_bytes())),
            digest(found.pixels),
            1e3 * best
        ));
    }
    let points =
        POINTS.iter().map(|&(m, alpha)| point(m, alpha, 60)).collect::<Result<Vec<_>, _>>()?;
    let heights = motion(0.2, 7.0, 6)?;
    let depth = Depth::near(0.12, 11.920553918335775)?;
    let shares = Layer::of("coverage").ok_or("no layer of shares")?;
    let frame = digest(depth.frame(shares, 100.0, (64, 64))?);
    let motion = digest(heights.iter().flat_map(|number| number.to_le_bytes()));
    let samples: Vec<String> = heights.iter().map(|number| format!("{number:?}")).collect();
    let names: Vec<String> = LAYERS.iter().map(|layer| format!("{:?}", layer.name)).collect();
    let text = format!(
        r#"{{"layers":[{}],"tiles":[{}],"points":[{}],"motion":"{motion}","samples":[{}],"depth":{},"frame":"{frame}"}}"#,
        names.join(","),
        tiles.join(","),
        points.join(","),
        samples.join(","),
        depth.text()
    );
    std::fs::write(path, text)?;
    Ok(())
}
