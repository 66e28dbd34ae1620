use hopper_basin::*;
use passive_hopper::*;
use std::time::Instant;
fn long(f: &Fates, alpha: f64, a: Arithmetic, budget: usize) -> (Option<HopperFate>, usize) {
    let mut o = ExtendedOrbit::new(f.map(), alpha, a).unwrap();
    for h in 0..budget {
        let mut n = index_below(o.speed()).unwrap();
        let (mut d, mut e) = o.offset_from(n);
        if d < 0.0 && n > 0 {
            n -= 1;
            (d, e) = o.offset_from(n);
        }
        if f.trap(n).unwrap().side_of_offset(d, e) == TrapSide::Inside {
            return (
                Some(if n == 0 { HopperFate::Decaying } else { HopperFate::Incessant { n } }),
                h,
            );
        }
        match o.hop().unwrap() {
            ExtendedStep::LiftsOff => {}
            ExtendedStep::Grounded => return (Some(HopperFate::Grounded), h + 1),
            _ => return (None, h),
        }
    }
    (None, budget)
}
fn plain(f: &Fates, alpha: f64) -> Option<HopperFate> {
    let mut x = alpha;
    for _ in 0..1000000 {
        let n = index_below(x).unwrap();
        let t = f.trap(n).unwrap();
        let be = if t.edge == TrapEdge::NextFixedPoint { true } else { x <= t.right() };
        if be {
            return Some(if n == 0 { HopperFate::Decaying } else { HopperFate::Incessant { n } });
        }
        match f.map().image(x) {
            Ok(Some(y)) if y == x => return None,
            Ok(Some(y)) => x = y,
            Ok(None) => return Some(HopperFate::Grounded),
            Err(_) => return None,
        }
    }
    None
}
fn main() {
    let f = Fates::new(MassRatio::new(0.12).unwrap()).unwrap();
    println!(
        "{:?} {:?}",
        f.fate_within(11.920553918272727, 1000000),
        long(&f, 11.920553918272727, Arithmetic::Bits256, 100000)
    );
    let c = 11.920553918335777;
    for d in [3e-11, 1e-11, 3e-12] {
        let (mut w0, mut w1, mut u0, mut u1, mut uu) = (0, 0, 0, 0, 0);
        let mut mh = 0;
        let mut t1 = 0.0;
        for k in 0..300 {
            let a = c - d * (0.3 + 0.7 * k as f64 / 299.0);
            let t = Instant::now();
            let (q, h) = f.fate_within(a, 1000000).unwrap();
            t1 += t.elapsed().as_secs_f64();
            mh = mh.max(h);
            match q {
                HopperFate::Undecided(_) => u1 += 1,
                p => {
                    match plain(&f, a) {
                        None => u0 += 1,
                        Some(x) if x != p => w0 += 1,
                        _ => {}
                    }
                    if k % 30 == 0 {
                        let (r, _) = long(&f, a, Arithmetic::Bits256, 100000);
                        uu += 1;
                        if r != Some(p) {
                            w1 += 1
                        }
                    }
                }
            }
        }
        println!(
            "{d:e}: before wrong {w0} undecided {u0}; now wrong {w1} of {uu}, undecided {u1}; max hops {mh} time ours {t1:.3}"
        );
    }
    for (m, a) in [
        (0.7451315418933749, 1.4484803730457718),
        (0.3592217019143822, 11.668485594655293),
        (0.37736327112335555, 9.905886873248653),
        (0.44339619003174835, 7.782241751619274),
        (1.5642380704630494, 8.463663833675143e11),
    ] {
        let f = Fates::new(MassRatio::new(m).unwrap()).unwrap();
        let t = Instant::now();
        let q = f.fate_within(a, 1000000);
        let e = t.elapsed();
        println!(
            "{m} {a}: {q:?} {e:?} plain {:?} ref {:?}",
            plain(&f, a),
            long(&f, a, Arithmetic::Bits512, 200)
        );
    }
    let f = Fates::new(MassRatio::new(1.0).unwrap()).unwrap();
    for n in [3883u64, 10000, 29000] {
        let s = FixedPointSpeed::new(n);
        let mut a = s.smallest_not_below();
        for _ in 0..2 {
            let t = Instant::now();
            let q = f.fate_within(a, 1000000);
            let e = t.elapsed();
            println!("{n} {a}: {q:?} {e:?} plain {:?}", plain(&f, a));
            a = a.next_up();
        }
    }
    // time of hops
    let f = Fates::new(MassRatio::new(0.12).unwrap()).unwrap();
    for ar in Arithmetic::ALL {
        let t = Instant::now();
        let mut n = 0;
        for k in 0..20 {
            let mut o = ExtendedOrbit::new(f.map(), 11.92 - 0.05 * k as f64, ar).unwrap();
            for _ in 0..5 {
                if o.hop().unwrap() == ExtendedStep::LiftsOff { n += 1 } else { break }
            }
        }
        println!("{ar:?} {} us a hop", t.elapsed().as_secs_f64() * 1e6 / n as f64);
    }
}
