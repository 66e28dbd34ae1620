//! A buck converter: a switch that a clock opens and a voltage closes.
//!
//! The voltage of the load, amplified, is compared with a ramp that begins anew at each tick of a clock. The source is connected
//! as long as the ramp is above. Up to a source of 24.516 V one period of the clock is a period of the converter; there the
//! period doubles, and at 33 V the motion is chaotic.
//!
//! E. Fossas, G. Olivar, *Study of chaos in the buck converter*, IEEE Trans. Circuits Syst. I 43 (1996); M. di Bernardo,
//! F. Garofalo, L. Glielmo, F. Vasca, *Switchings, bifurcations, and chaos in DC/DC converters*, the same 45 (1998).

use hybrid_system::Equations;

/// The period of the clock, in seconds.
pub const PERIOD: f64 = 4e-4;

/// A load of 22 Ω, 47 µF, 20 mH, the gain 8.4 about 11.3 V, a ramp from 3.8 to 8.2 V in 400 µs, and this source, in volts, as
/// a decimal. The state has the voltage, the current and the ramp. All events are certain.
pub fn buck_converter(source: &str) -> Equations {
    let numbers = [
        ("source", source),
        ("resistance", "22"),
        ("capacitance", "47e-6"),
        ("inductance", "20e-3"),
        ("period", "400e-6"),
    ];
    let charge = "(current - voltage/resistance)/capacitance";
    let above = "8.4*(voltage - 11.3) - ramp";
    Equations::new(&["voltage", "current", "ramp"], &numbers)
        .clock_text("tick", "period", "period")
        .resets_text(&["voltage", "current", "3.8"])
        .mode_text("on", &[charge, "(source - voltage)/inductance", "4.4/period"])
        .rising_text("opens", above)
        .contact()
        .to("off")
        .mode_text("off", &[charge, "-voltage/inductance", "4.4/period"])
        .falling_text("closes", above)
        .contact()
        .to("on")
}
