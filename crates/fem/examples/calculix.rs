//! This program and CalculiX side by side: the pin on the block without friction, in one file that both read.
//!
//!     cargo run --release -p squealmap-fem --example calculix -- 4        # elements of 5 mm over 4
//!
//! CalculiX (`ccx`, Debian package calculix-ccx) ties the surfaces by a contact of its own, with a stiff penalty. Compared are the ten lowest
//! frequencies, mass, reactions to a pressure, time and memory. Without `ccx` a line says so and nothing is compared.

#![allow(clippy::doc_markdown, reason = "CalculiX and symbols of equations are no code")]

#[path = "../tests/suite/cases/mod.rs"]
#[expect(dead_code, reason = "one of the models is used here")]
mod cases;
#[expect(dead_code, reason = "of the costs those of other programs are used here")]
mod cost;

use std::fmt::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};

use squealmap_fem::assembly::{Loads, Model, internal_forces};
use squealmap_fem::contact::sliding;
use squealmap_fem::elements::{Kind, matrices};
use squealmap_fem::mesh::FaceRef;
use squealmap_fem::modes::{Factor, Ordering, lowest};
use squealmap_fem::output::inp;
use squealmap_fem::read::abaqus;
use squealmap_fem::statics::settle;

type Failure = Box<dyn std::error::Error>;

/// How far the pin's end is pressed down, m, and the pressure on one of its sides, Pa: small, as CalculiX stiffens its modes by the stress.
const DOWN: f64 = 1e-8;
const PRESSURE: f64 = 1000.0;
/// Pressure per overlap of CalculiX's contact, Pa/m.
const STIFFNESS: f64 = 1e18;
const MODES: usize = 10;
/// Sets of nodes and the axes along which their forces are summed up: none of the others is anything but zero.
const REACTIONS: [(&str, usize); 3] = [("BELOW", 2), ("ABOVE", 2), ("ABOVE", 0)];

fn main() -> Result<(), Failure> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    if let [file, solve] = words.as_slice()
        && solve == "solve"
    {
        return ours(Path::new(file));
    }
    if Command::new("ccx").arg("-v").stdout(Stdio::null()).status().is_err() {
        println!(
            "CalculiX is not installed: install calculix-ccx, or put ccx on the path. Nothing is compared."
        );
        return Ok(());
    }
    let cut = words.first().map_or(Ok(1), |word| word.parse())?;
    let folder = std::env::temp_dir().join(format!("squealmap-calculix-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    let compared = side_by_side(&folder, cut);
    std::fs::remove_dir_all(&folder)?;
    compared
}

fn side_by_side(folder: &Path, cut: usize) -> Result<(), Failure> {
    std::fs::write(folder.join("pin.inp"), deck(&cases::pin::model(Kind::Hex20, cut)?)?)?;
    let mut own = Command::new(std::env::current_exe()?);
    let (text, own_cost) = cost::watched(own.arg("pin.inp").arg("solve").current_dir(folder))?;
    let ours: Vec<f64> = text.split_whitespace().map(str::parse).collect::<Result<_, _>>()?;
    let mut ccx = Command::new("ccx");
    let (_, their_cost) =
        cost::watched(ccx.args(["-i", "pin"]).env("OMP_NUM_THREADS", "2").current_dir(folder))?;
    let theirs = theirs(&std::fs::read_to_string(folder.join("pin.dat"))?)?;
    if ours.len() != theirs.len() {
        return Err(format!("{} numbers here, {} of CalculiX", ours.len(), theirs.len()).into());
    }
    println!("| what | squealmap-fem | CalculiX | difference |\n|---|---|---|---|");
    let names =
        ["mass, kg", "force below, z, N", "force above, z, N", "force above, x, N"].map(str::to_owned);
    let modes = (1..=MODES).map(|i| format!("frequency {i}, Hz"));
    let mut worst = 0.0_f64;
    for (name, (a, b)) in names.into_iter().chain(modes).zip(ours.iter().zip(&theirs)) {
        let apart = (a / b - 1.0).abs();
        worst = worst.max(apart);
        println!("| {name} | {a:.7} | {b:.7} | {apart:.1e} |");
    }
    println!("| wall, s | {:.1} | {:.1} | |", own_cost.wall, their_cost.wall);
    println!("| work of all cores, s | {:.1} | {:.1} | |", own_cost.work, their_cost.work);
    println!("| memory, GB | {:.2} | {:.2} | |", own_cost.memory, their_cost.memory);
    if worst > 1e-4 {
        return Err(format!("the largest difference is {worst:e}, it must be below 1e-4").into());
    }
    Ok(())
}

/// The pin as a file: a step with a pressure, and one for the modes.
fn deck(model: &Model) -> Result<String, Failure> {
    let free = Model { contact: Vec::new(), ..model.clone() };
    let text = inp(&free, MODES);
    let mut text = text.split("*STEP").next().unwrap_or_default().to_owned();
    for (name, side) in [("SLAVE", "pin.z0"), ("MASTER", "z1"), ("LOADED", "pin.x0")] {
        let _ = writeln!(text, "*SURFACE, NAME={name}");
        for FaceRef { element, face } in model.mesh.face_set(side)? {
            let _ = writeln!(text, "{}, S{}", element + 1, face + 1);
        }
    }
    for (name, side) in [("BELOW", "z0"), ("ABOVE", "pin.z1")] {
        let _ = writeln!(text, "*NSET, NSET={name}");
        for node in model.mesh.node_set(side)? {
            let _ = writeln!(text, "{},", node + 1);
        }
    }
    let _ = write!(
        text,
        "*ELSET, ELSET=ALL\n{}\n\
         *SURFACE INTERACTION, NAME=TIED\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TIED\n{STIFFNESS:e}\n\
         *CONTACT PAIR, INTERACTION=TIED, TYPE=SURFACE TO SURFACE\nSLAVE, MASTER\n\
         *STEP\n*STATIC\n*BOUNDARY\nABOVE, 3, 3, {:e}\n*DSLOAD\nLOADED, P, {PRESSURE}\n\
         *NODE PRINT, NSET=BELOW, TOTALS=ONLY\nRF\n*NODE PRINT, NSET=ABOVE, TOTALS=ONLY\nRF\n\
         *EL PRINT, ELSET=ALL, TOTALS=ONLY\nEMAS\n*END STEP\n\
         *STEP, PERTURBATION\n*FREQUENCY\n{MODES}\n*END STEP\n",
        (0..model.mesh.groups.len()).map(|g| format!("GROUP{g}")).collect::<Vec<_>>().join("\n"),
        -DOWN
    );
    Ok(text)
}

/// What this program finds for a file: mass, reactions, frequencies.
fn ours(file: &Path) -> Result<(), Failure> {
    let deck = abaqus(&std::fs::read_to_string(file)?)?;
    let mut model = Model { mesh: deck.mesh, materials: deck.materials, ..Model::default() };
    for (node, axis, displacement) in deck.supports {
        model.supports.prescribe(&[node], axis, displacement);
    }
    let mesh = &model.mesh;
    let (slaves, masters) = (mesh.node_set("SLAVE")?, mesh.node_set("MASTER")?);
    model.contact = sliding(mesh, slaves, masters, [0.0, 0.0, 1.0], [1.0, 0.0, 0.0])?;
    println!("{}", mass(&model)?);
    let loads = Loads { pressure: vec![(mesh.face_set("LOADED")?.to_vec(), PRESSURE)], ..Loads::default() };
    let settled = settle(&model, mesh.face_set("SLAVE")?, &loads, 0.0)?;
    if !settled.open.is_empty() {
        return Err(
            format!("{} points of the contact gape, CalculiX ties them all", settled.open.len()).into()
        );
    }
    // CalculiX prints the forces that elements exert on their nodes.
    let forces = internal_forces(&model, &settled.displacement)?;
    for (set, axis) in REACTIONS {
        println!("{}", mesh.node_set(set)?.iter().map(|node| forces[*node][axis]).sum::<f64>());
    }
    let (numbering, pencil) = (&settled.numbering, &settled.pencil);
    let ordering = Ordering::best(&pencil.stiffness.pattern, &numbering.places(mesh))?;
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
        let found = matrices(kind, &places, &model.materials[material])
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

/// The same numbers from CalculiX's results.
fn theirs(text: &str) -> Result<Vec<f64>, Failure> {
    let lines: Vec<&str> = text.lines().collect();
    let after = |words: &[&str]| -> Result<Vec<f64>, Failure> {
        let title = lines.iter().position(|line| words.iter().all(|word| line.contains(word)));
        let rows = &lines[title.ok_or_else(|| format!("pin.dat has no line with {words:?}"))? + 1..];
        let row = rows.iter().find(|line| !line.trim().is_empty()).ok_or("pin.dat ends early")?;
        Ok(row.split_whitespace().filter_map(|word| word.parse().ok()).collect())
    };
    let mut found = vec![*after(&["mass"])?.first().ok_or("no mass")?];
    for (set, axis) in REACTIONS {
        found.push(*after(&["total force", set])?.get(axis).ok_or("a force has three parts")?);
    }
    let table = lines.iter().position(|line| line.contains("E I G E N V A L U E   O U T P U T"));
    let rows = lines[table.ok_or("pin.dat has no eigenvalues")? + 1..].iter();
    let numbers =
        rows.map(|line| line.split_whitespace().map(str::parse::<f64>).collect::<Result<Vec<_>, _>>());
    // Number, eigenvalue, frequency in rad/s and in Hz, imaginary part.
    found.extend(numbers.flatten().filter(|row| row.len() == 5).map(|row| row[3]).take(MODES));
    Ok(found)
}
