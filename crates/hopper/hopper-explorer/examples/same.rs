//! What the page shows as "the same in Rust" for M = 0.2 and α = 7. The test of the page compares the lines of
//! `main` with it.

fn main() -> Result<(), Box<dyn std::error::Error>> {
    use hopper_basin::Fates;
    use passive_hopper::MassRatio;

    let fates = Fates::new(MassRatio::new(0.2)?)?;
    println!("{:?}", fates.fate(7.0)?);
    println!("{:?}", fates.map().hop(7.0)?);
    Ok(())
}
