//! This program and CalculiX side by side, without friction: a pin on a block in one file that both read, or a study.
//!
//!     cargo run --release -p squealmap-fem --example calculix -- 4        # elements of 5 mm over 4
//!     cargo run --release -p squealmap-fem --example calculix -- sweeps/fem/paper.toml [--write]
//!
//! CalculiX (`ccx`, Debian package calculix-ccx) ties the surfaces by a contact of its own, with a stiff penalty. Compared are the ten lowest
//! frequencies, mass, reactions, time and memory; of a study it has to be at least as fast here. This program runs before and after
//! CalculiX, and the slower of both counts. CalculiX integrates the mass of some elements with few points, and so does this program for the
//! comparison; the largest difference with the exact mass is printed, too. `--write` puts the costs into benches/results/calculix.csv.
//! Without `ccx` a line says so and nothing is compared.

#![allow(clippy::doc_markdown, reason = "CalculiX and symbols of equations are no code")]

#[path = "../../tests/suite/cases/mod.rs"]
#[expect(dead_code, reason = "one of the models is used here")]
mod cases;
#[path = "../cost/mod.rs"]
#[expect(dead_code, reason = "of the costs those of other programs are used here")]
mod cost;
mod deck;
mod rows;

use std::path::Path;
use std::process::{Command, Stdio};

use cases::apart::{apart, worst};
use deck::{Case, MODES};
use squealmap_fem::assembly::{Loads, Model, internal_forces};
use squealmap_fem::contact::sliding;
use squealmap_fem::elements::{Inertia, Kind, matrices};
use squealmap_fem::modes::{Factor, Ordering, lowest};
use squealmap_fem::read::abaqus;
use squealmap_fem::statics::settle;
use squealmap_fem::study::{Study, document::Document};

pub(crate) type Failure = Box<dyn std::error::Error>;

/// How far the pin's end is pressed down, m, and the pressure on one of its sides, Pa: small, as CalculiX stiffens its modes by the stress.
const DOWN: f64 = 1e-8;
const PRESSURE: f64 = 1000.0;
/// The part of a study's loads that is taken, for the same reason.
const LESS: f64 = 1e-3;
/// How far numbers may be apart.
const SAME: f64 = 1e-4;
/// The word for frequencies with the exact mass.
const EXACT: &str = "exact";

fn main() -> Result<(), Failure> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let (words, write) = match words.as_slice() {
        [rest @ .., "--write"] => (rest, true),
        all => (all, false),
    };
    if let [what, rest @ ..] = words
        && rest.contains(&"solve")
    {
        let mut case = case(what, true)?;
        case.model.inertia = if rest.contains(&EXACT) { Inertia::Exact } else { Inertia::Calculix };
        return ours(&case);
    }
    if Command::new("ccx").arg("-v").stdout(Stdio::null()).status().is_err() {
        println!(
            "CalculiX is not installed: install calculix-ccx, or put ccx on the path. Nothing is compared."
        );
        return Ok(());
    }
    let what = words.first().copied().unwrap_or("1");
    let folder = std::env::temp_dir().join(format!("squealmap-calculix-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    let compared = side_by_side(&folder, what, write);
    std::fs::remove_dir_all(&folder)?;
    compared
}

/// A pin by its cut, a pin by the file that CalculiX reads, or a study.
fn case(what: &str, read: bool) -> Result<Case, Failure> {
    if Path::new(what).extension().is_some_and(|ending| ending == "toml") {
        return study(Path::new(what));
    }
    let mut model = cases::pin::model(Kind::Hex20, if read { 1 } else { what.parse()? })?;
    let (mut names, mut loaded) = (["pin.z0", "z1", "z0", "pin.z1"], "pin.x0");
    if read {
        let text = std::fs::read_to_string(what)?;
        let deck = abaqus(&text.replace(deck::CONTACT, ""))?;
        model = Model { mesh: deck.mesh, materials: deck.materials, ..Model::default() };
        for (node, axis, displacement) in deck.supports {
            model.supports.prescribe(&[node], axis, displacement);
        }
        (names, loaded) = (["SLAVE", "MASTER", "BELOW", "ABOVE"], "LOADED0");
        let mesh = &model.mesh;
        let touching = [mesh.node_set(names[0])?, mesh.node_set(names[1])?];
        model.contact = sliding(mesh, touching[0], touching[1], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0])?;
    }
    let mesh = &model.mesh;
    let [slaves, masters] = [mesh.face_set(names[0])?.to_vec(), mesh.face_set(names[1])?.to_vec()];
    let [below, above] = [mesh.node_set(names[2])?.to_vec(), mesh.node_set(names[3])?.to_vec()];
    let loads = Loads { pressure: vec![(mesh.face_set(loaded)?.to_vec(), PRESSURE)], ..Loads::default() };
    model.supports.prescribe(&above, 2, -DOWN);
    let reactions = vec![("BELOW", below, 2), ("ABOVE", above.clone(), 2), ("ABOVE", above, 0)];
    Ok(Case { model, slaves, masters, loads, reactions })
}

/// The bodies of a study with one sliding surface.
fn study(path: &Path) -> Result<Case, Failure> {
    let beside = path.parent().unwrap_or(Path::new("")).to_owned();
    let document = Document::read(&std::fs::read_to_string(path)?)?;
    let read = |file: &str| std::fs::read_to_string(beside.join(file)).map_err(|why| why.to_string());
    let study = Study::new(document, &read)?;
    let [pair] = study.document.sliding.as_slice() else {
        return Err("CalculiX is asked about one sliding surface".into());
    };
    let Study { model, faces: slaves, mut loads, .. } = study.clone();
    for (_, pressure) in &mut loads.pressure {
        *pressure *= LESS;
    }
    let held = model.supports.prescribed.keys().filter(|(_, axis)| *axis == 2);
    let reactions = vec![("HELD", held.map(|(node, _)| *node).collect(), 2)];
    let masters = model.mesh.face_set(&pair.masters)?.to_vec();
    Ok(Case { model, slaves, masters, loads, reactions })
}

fn side_by_side(folder: &Path, what: &str, write: bool) -> Result<(), Failure> {
    let case = case(what, false)?;
    let file = folder.join("model.inp");
    std::fs::write(&file, case.deck())?;
    let is_study = what.parse::<usize>().is_err();
    let what_is_read = if is_study { Path::new(what) } else { &file };
    let mine = |inertia: Option<&str>| -> Result<(Vec<f64>, cost::Cost), Failure> {
        let mut own = Command::new(std::env::current_exe()?);
        let (text, cost) = cost::watched(own.arg(what_is_read).arg("solve").args(inertia))?;
        Ok((text.split_whitespace().map(str::parse).collect::<Result<_, _>>()?, cost))
    };
    let load = rows::load();
    let (ours, before) = mine(None)?;
    let mut ccx = Command::new("ccx");
    let (_, their_cost) =
        cost::watched(ccx.args(["-i", "model"]).env("OMP_NUM_THREADS", "2").current_dir(folder))?;
    let theirs = case.found(&std::fs::read_to_string(folder.join("model.dat"))?)?;
    let (_, after) = mine(None)?;
    let (with_exact_mass, _) = mine(Some(EXACT))?;
    let own_cost = if before.work > after.work { before } else { after };
    println!("| what | squealmap-fem | CalculiX | difference |\n|---|---|---|---|");
    for (name, (a, b)) in case.names().iter().zip(ours.iter().zip(&theirs)) {
        println!("| {name} | {a:.7} | {b:.7} | {:.1e} |", apart(*a, *b));
    }
    println!("| wall, s | {:.1} | {:.1} | |", own_cost.wall, their_cost.wall);
    println!("| work of all cores, s | {:.1} | {:.1} | |", own_cost.work, their_cost.work);
    println!("| memory, GB | {:.2} | {:.2} | |", own_cost.memory, their_cost.memory);
    println!(
        "\nPrograms that ran beside, at the beginning and at the end: {load}, {} of 2 cores",
        rows::load()
    );
    let far = |ours: &[f64]| {
        let counts = || format!("{} numbers here, {} of CalculiX", ours.len(), theirs.len());
        worst(ours, &theirs).ok_or_else(counts)
    };
    let (worst, exact) = (far(&ours)?, far(&with_exact_mass)?);
    println!("The largest difference is {worst:.1e}, with the exact mass {exact:.1e}");
    if write {
        rows::write(what, [own_cost, their_cost], [worst, exact], &load)?;
    }
    if worst > SAME {
        return Err(format!("the largest difference is {worst:e}, it must be below {SAME:e}").into());
    }
    if is_study && own_cost.work > their_cost.work {
        return Err("CalculiX was faster".into());
    }
    Ok(())
}

/// What this program finds: mass, reactions, frequencies.
fn ours(case: &Case) -> Result<(), Failure> {
    println!("{}", mass(&case.model)?);
    let settled = settle(&case.model, &case.slaves, &case.loads, 0.0)?;
    if !settled.open.is_empty() {
        return Err(
            format!("{} points of the contact gape, CalculiX ties them all", settled.open.len()).into()
        );
    }
    // CalculiX prints the forces that elements exert on their nodes.
    let forces = internal_forces(&case.model, &settled.displacement)?;
    for (_, nodes, axis) in &case.reactions {
        println!("{}", nodes.iter().map(|node| forces[*node][*axis]).sum::<f64>());
    }
    let (numbering, pencil) = (&settled.numbering, &settled.pencil);
    let ordering = Ordering::best(&pencil.stiffness.pattern, &numbering.places(&case.model.mesh))?;
    let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0)?;
    for frequency in lowest(pencil, &factor, MODES)?.frequencies() {
        println!("{frequency}");
    }
    Ok(())
}

fn mass(model: &Model) -> Result<f64, Failure> {
    let mut sum = 0.0;
    for (element, kind, material, nodes) in model.mesh.elements() {
        let places: Vec<[f64; 3]> = nodes.iter().map(|node| model.mesh.nodes[*node]).collect();
        let found = matrices(kind, &places, &model.materials[material], model.inertia)
            .map_err(|determinant| format!("element {element} has a determinant of {determinant}"))?;
        // Of all entries along one direction.
        let size = 3 * nodes.len();
        sum += (0..size)
            .step_by(3)
            .flat_map(|i| (0..size).step_by(3).map(move |j| i * size + j))
            .map(|at| found.mass[at])
            .sum::<f64>();
    }
    Ok(sum)
}
