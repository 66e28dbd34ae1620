//! The fields of the motions as plain functions, for methods that take these: ours, and those of the program with diffsol,
//! which includes this file.

/// Van der Pol's oscillator.
pub(super) fn van_der_pol(mu: f64) -> impl Fn(&[f64; 2]) -> [f64; 2] + Clone {
    move |x| [x[1], mu * (1.0 - x[0] * x[0]) * x[1] - x[0]]
}

pub(super) fn lorenz(&[x, y, z]: &[f64; 3]) -> [f64; 3] {
    [10.0 * (y - x), x * (28.0 - z) - y, x * y - 2.666_666_666_666_666_5 * z]
}

pub(super) fn kepler(&[x, y, u, v]: &[f64; 4]) -> [f64; 4] {
    let square = x * x + y * y;
    let force = 1.0 / (square * square.sqrt());
    [u, v, -force * x, -force * y]
}

/// Mass of the moon, in that of earth and moon.
const MOON: f64 = 0.012_277_471;

pub(super) fn arenstorf(&[x, y, u, v]: &[f64; 4]) -> [f64; 4] {
    let pull = |mass: f64, place: f64| {
        let square = (x - place) * (x - place) + y * y;
        mass / (square * square.sqrt())
    };
    let (earth, moon) = (pull(1.0 - MOON, -MOON), pull(MOON, 1.0 - MOON));
    [
        u,
        v,
        x + 2.0 * v - earth * (x + MOON) - moon * (x - (1.0 - MOON)),
        y - 2.0 * u - (earth + moon) * y,
    ]
}

/// The masses of the sun and the outer planets, in that of the sun.
const MASSES: [f64; 6] = [
    1.000_005_976_82,
    0.000_954_786_104_043,
    0.000_285_583_733_151,
    0.000_043_727_316_454_6,
    0.000_051_775_913_844_9,
    0.000_000_007_692_307_692_3,
];

/// The constant of gravity, in astronomical units, days and masses of the sun.
const GRAVITY: f64 = 2.959_122_082_86e-4;

pub(super) fn planets(x: &[f64; 36]) -> [f64; 36] {
    let mut rates = [0.0; 36];
    rates[..18].copy_from_slice(&x[18..]);
    for i in 0..6 {
        for j in 0..i {
            let away: [f64; 3] = std::array::from_fn(|axis| x[3 * i + axis] - x[3 * j + axis]);
            let square = away.iter().map(|part| part * part).sum::<f64>();
            let force = GRAVITY / (square * square.sqrt());
            for (axis, part) in away.iter().enumerate() {
                rates[18 + 3 * i + axis] -= MASSES[j] * force * part;
                rates[18 + 3 * j + axis] += MASSES[i] * force * part;
            }
        }
    }
    rates
}
