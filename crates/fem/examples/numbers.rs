//! The tables of `docs/fem.md`: what this program computes against what is exact or published.
//!
//!     cargo run --release -p squealmap-fem --example numbers
//!
//! With numbers behind it, the refined pin only, with elements of 5 mm over each of them; with `stressed`, the pressed pin only.

#![allow(clippy::doc_markdown, reason = "symbols of equations, such as μ_c or K_n, are no code")]

#[path = "../tests/suite/cases/mod.rs"]
#[expect(dead_code, reason = "two of the models are used here")]
mod cases;
#[expect(dead_code, reason = "of the costs those of this program are used here")]
mod cost;

use cost::{memory, work};
use faer::c64;
use squealmap_fem::Error;
use squealmap_fem::assembly::{Loads, Model, Pencil, Rows, assemble};
use squealmap_fem::elements::Kind;
use squealmap_fem::modes::{
    Basis, Factor, Ordering, coalescence, first_unstable, lowest, near, pairs, refine,
};
use squealmap_fem::statics::settle;

fn main() -> Result<(), Error> {
    let sizes: Vec<usize> = std::env::args().skip(1).filter_map(|word| word.parse().ok()).collect();
    if std::env::args().nth(1).is_some_and(|word| word == "stressed") {
        return stressed();
    }
    if !sizes.is_empty() {
        return pin_refined(&sizes);
    }
    layer()?;
    pin()?;
    stressed()?;
    pin_refined(&[1, 2, 4])
}

fn hz(lambda: c64) -> f64 {
    lambda.im / std::f64::consts::TAU
}

fn factorised(model: &Model, shift: f64) -> Result<(Pencil, Ordering, Factor), Error> {
    let (numbering, pencil) = assemble(model)?;
    let ordering = Ordering::best(&pencil.stiffness.pattern, &numbering.places(&model.mesh))?;
    let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, shift)?;
    Ok((pencil, ordering, factor))
}

/// Errors of the layer's eigenvalues, and by which power of the size of the elements they fall.
fn layer() -> Result<(), Error> {
    println!(
        "| μ | exact | elements | n | frequency, Hz | growth, 1/s | error | order | error of growth | order |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|");
    for mu in [0.3, 0.55] {
        for exact in cases::plane_waves::exact(1, mu, 3.5e5) {
            for (kind, sizes) in
                [(Kind::Hex20, [4, 8, 16]), (Kind::Tet10, [4, 8, 16]), (Kind::Hex8, [8, 16, 32])]
            {
                let mut last: Option<[f64; 2]> = None;
                for n in sizes {
                    let (pencil, _, factor) =
                        factorised(&cases::layer::model(kind, n)?, -(exact * exact).re)?;
                    let found = near(&pencil, &factor, mu, 6, 1e-10)?;
                    let apart = |l: &c64| (l - exact).norm();
                    let closest =
                        found.iter().map(|mode| mode.lambda).min_by(|a, b| apart(a).total_cmp(&apart(b)));
                    let found = closest.unwrap_or_default();
                    let errors =
                        [(found.im - exact.im).abs() / exact.im, (found.re - exact.re).abs() / exact.re];
                    let order = |i: usize| {
                        last.map_or(String::new(), |l| format!("{:.2}", (l[i] / errors[i]).log2()))
                    };
                    println!(
                        "| {mu} | {:.3} Hz, {:.3} 1/s | {} | {n} | {:.3} | {:.3} | {:.1e} | {} | {:.1e} | {} |",
                        hz(exact),
                        exact.re,
                        kind.name(),
                        hz(found),
                        found.re,
                        errors[0],
                        order(0),
                        errors[1],
                        order(1)
                    );
                    last = Some(errors);
                }
            }
        }
    }
    Ok(())
}

/// The pin on the block: five frequencies, the unstable pair, the coalescence.
fn pin() -> Result<(), Error> {
    println!("\n| what | published | found |\n|---|---|---|");
    let (pencil, _, factor) = factorised(&cases::pin::model(Kind::Hex20, 1)?, 0.0)?;
    let modes = lowest(&pencil, &factor, 20)?;
    for (published, found) in
        [16_087.39, 16_690.00, 30_126.49, 55_767.81, 63_371.81].iter().zip(modes.frequencies())
    {
        println!("| frequency at μ = 0, Hz | {published:.2} | {found:.4} |");
    }
    let mut basis = Basis::new(&pencil, &modes.shapes);
    let none = Rows::default();
    let worst = refine(&pencil, &factor, &mut basis, &[0.2, 0.4], &none, 8, 1e-8, 20)?;
    let found = pairs(&basis.at(0.4, &none))?;
    if let Some(unstable) = found.iter().find(|p| p.growth() > 1.0) {
        println!("| frequency at μ = 0.4, Hz | 64170.82 | {:.4} |", unstable.frequency());
        println!("| growth at μ = 0.4, 1/s | 431.41 | {:.4} |", unstable.growth());
    }
    let mus: Vec<f64> = (0..=8).map(|i| 0.05 * f64::from(i)).collect();
    if let Some((i, start)) = first_unstable(&basis, &mus, &none, 7e4, 1.0)? {
        let critical = coalescence(&pencil, &factor, &mut basis, mus[i], &start)?;
        println!("| μ_c | 0.38838 | {:.8} |", critical.mu);
        println!("| frequency at μ_c, Hz | | {:.4} |", critical.frequency());
    }
    println!("\n{} vectors in the basis; largest residual {worst:.1e}.", basis.vectors.ncols());
    Ok(())
}

/// The pin pressed down by its clamped end: what the stress does to the modes.
fn stressed() -> Result<(), Error> {
    println!(
        "\n| pressed by | mean pressure, MPa | stress stiffens | 5 lowest frequencies, Hz | μ_c | Hz |\n|---|---|---|---|---|---|"
    );
    for down in [1e-6, 1e-5] {
        let mut model = cases::pin::model(Kind::Hex20, 1)?;
        let top = model.mesh.node_set("pin.z1")?.to_vec();
        model.supports.prescribe(&top, 2, -down);
        let faces = model.mesh.face_set("pin.z0")?.to_vec();
        let settled = settle(&model, &faces, &Loads::default(), 0.0)?;
        let pressure = settled.forces.iter().sum::<f64>() / 1e-4;
        for (name, pencil) in [("no", &settled.pencil), ("yes", &settled.stiffened()?)] {
            let ordering = Ordering::new(&pencil.stiffness.pattern)?;
            let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0)?;
            let modes = lowest(pencil, &factor, 20)?;
            let five: Vec<String> = modes.frequencies()[..5].iter().map(|f| format!("{f:.2}")).collect();
            let mut basis = Basis::new(pencil, &modes.shapes);
            let mus: Vec<f64> = (0..=12).map(|i| 0.05 * f64::from(i)).collect();
            refine(pencil, &factor, &mut basis, &[0.2, 0.4], &Rows::default(), 8, 1e-8, 20)?;
            let critical = match first_unstable(&basis, &mus, &Rows::default(), 7e4, 1.0)? {
                Some((i, pair)) => {
                    let found = coalescence(pencil, &factor, &mut basis, mus[i], &pair)?;
                    format!("{:.6} | {:.2}", found.mu, found.frequency())
                }
                None => "none up to 0.6 | ".to_owned(),
            };
            println!(
                "| {:.0} μm | {:.1} | {name} | {} | {critical} |",
                1e6 * down,
                pressure / 1e6,
                five.join(", ")
            );
        }
    }
    Ok(())
}

/// The same with smaller elements: what it costs, and where μ_c goes.
fn pin_refined(sizes: &[usize]) -> Result<(), Error> {
    println!(
        "\n| elements of | unknowns | contact points | entries of L | matrices and factor, s | 20 modes, s | space, s | μ_c, s | memory, GB | \
         μ_c | Hz |\n|---|---|---|---|---|---|---|---|---|---|---|"
    );
    for n in sizes {
        let mut clock = vec![work()];
        let (pencil, ordering, factor) = factorised(&cases::pin::model(Kind::Hex20, *n)?, 0.0)?;
        clock.push(work());
        let modes = lowest(&pencil, &factor, 20)?;
        clock.push(work());
        let mut basis = Basis::new(&pencil, &modes.shapes);
        let none = Rows::default();
        let mus: Vec<f64> = (0..=24).map(|i| 0.025 * f64::from(i)).collect();
        refine(&pencil, &factor, &mut basis, &[0.15, 0.3, 0.45], &none, 8, 1e-4, 10)?;
        clock.push(work());
        let critical = match first_unstable(&basis, &mus, &none, 7e4, 10.0)? {
            Some((i, pair)) => {
                let found = coalescence(&pencil, &factor, &mut basis, mus[i], &pair)?;
                format!("{:.6} | {:.2}", found.mu, found.frequency())
            }
            None => "none up to 0.6 | ".to_owned(),
        };
        clock.push(work());
        let seconds: Vec<String> = clock.windows(2).map(|w| format!("{:.2}", w[1] - w[0])).collect();
        println!(
            "| {:.3} mm | {} | {} | {:.1e} | {} | {:.2} | {critical} |",
            5.0 / *n as f64,
            pencil.size(),
            pencil.slip.rows.len(),
            ordering.entries() as f64,
            seconds.join(" | "),
            memory()
        );
    }
    Ok(())
}
