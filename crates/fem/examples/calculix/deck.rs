//! A model as a file for CalculiX with its own contact, and what CalculiX finds.

use std::fmt::Write as _;

use squealmap_fem::assembly::{Loads, Model};
use squealmap_fem::mesh::FaceRef;
use squealmap_fem::output::inp;

use crate::Failure;

/// How many frequencies are asked for.
pub(crate) const MODES: usize = 10;
/// The card of CalculiX's contact, which is not read here: the surfaces are tied by their nodes instead.
pub(crate) const CONTACT: &str = "*CONTACT PAIR, INTERACTION=TIED, TYPE=SURFACE TO SURFACE\nSLAVE, MASTER\n";
/// Pressure per overlap of CalculiX's contact, Pa/m.
const STIFFNESS: f64 = 1e18;

/// A model without friction and what is asked about it.
pub(crate) struct Case {
    /// Bodies; the contact is in `slaves` and `masters`.
    pub(crate) model: Model,
    /// Faces that keep touching.
    pub(crate) slaves: Vec<FaceRef>,
    pub(crate) masters: Vec<FaceRef>,
    /// Pressures; displacements that are not zero stand in the model.
    pub(crate) loads: Loads,
    /// Names of sets of nodes, and the axis along which their forces are summed up.
    pub(crate) reactions: Vec<(&'static str, Vec<usize>, usize)>,
}

impl Case {
    /// The file: a step with the loads, and one for the modes.
    pub(crate) fn deck(&self) -> String {
        let free = Model { contact: Vec::new(), ..self.model.clone() };
        let mut text = inp(&free, MODES).split("*STEP").next().unwrap_or_default().to_owned();
        let pressed = (0..).zip(&self.loads.pressure).map(|(i, (faces, _))| (format!("LOADED{i}"), faces));
        let contact = [("SLAVE".to_owned(), &self.slaves), ("MASTER".to_owned(), &self.masters)];
        for (name, faces) in contact.into_iter().chain(pressed) {
            let _ = writeln!(text, "*SURFACE, NAME={name}");
            for FaceRef { element, face } in faces {
                let _ = writeln!(text, "{}, S{}", element + 1, face + 1);
            }
        }
        let mut sets: Vec<&str> = Vec::new();
        for (name, nodes, _) in &self.reactions {
            if !sets.contains(name) {
                sets.push(name);
                let _ = writeln!(text, "*NSET, NSET={name}");
                for node in nodes {
                    let _ = writeln!(text, "{},", node + 1);
                }
            }
        }
        let groups: Vec<String> = (0..free.mesh.groups.len()).map(|g| format!("GROUP{g}")).collect();
        let _ = write!(
            text,
            "*ELSET, ELSET=ALL\n{}\n\
             *SURFACE INTERACTION, NAME=TIED\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TIED\n{STIFFNESS:e}\n\
             {CONTACT}*STEP\n*STATIC\n",
            groups.join("\n"),
        );
        for ((node, axis), by) in free.supports.prescribed.iter().filter(|(_, by)| **by != 0.0) {
            let _ = writeln!(text, "*BOUNDARY\n{}, {}, {}, {by:e}", node + 1, axis + 1, axis + 1);
        }
        for (i, (_, pressure)) in self.loads.pressure.iter().enumerate() {
            let _ = writeln!(text, "*DSLOAD\nLOADED{i}, P, {pressure:.12e}");
        }
        for set in sets {
            let _ = writeln!(text, "*NODE PRINT, NSET={set}, TOTALS=ONLY\nRF");
        }
        let _ = write!(
            text,
            "*EL PRINT, ELSET=ALL, TOTALS=ONLY\nEMAS\n*END STEP\n\
             *STEP, PERTURBATION\n*FREQUENCY\n{MODES}\n*END STEP\n",
        );
        text
    }

    /// What is compared, in the order of the numbers.
    pub(crate) fn names(&self) -> Vec<String> {
        let forces = self
            .reactions
            .iter()
            .map(|(set, _, axis)| format!("force {}, {}, N", set.to_lowercase(), ["x", "y", "z"][*axis]));
        let modes = (1..=MODES).map(|i| format!("frequency {i}, Hz"));
        std::iter::once("mass, kg".to_owned()).chain(forces).chain(modes).collect()
    }

    /// The same numbers from CalculiX's results.
    pub(crate) fn found(&self, text: &str) -> Result<Vec<f64>, Failure> {
        let lines: Vec<&str> = text.lines().collect();
        let after = |words: &[&str]| -> Result<Vec<f64>, Failure> {
            let title = lines.iter().position(|line| words.iter().all(|word| line.contains(word)));
            let rows = &lines[title.ok_or_else(|| format!("CalculiX wrote no line with {words:?}"))? + 1..];
            let row =
                rows.iter().find(|line| !line.trim().is_empty()).ok_or("CalculiX's results end early")?;
            Ok(row.split_whitespace().filter_map(|word| word.parse().ok()).collect())
        };
        let mut found = vec![*after(&["mass"])?.first().ok_or("no mass")?];
        for (set, _, axis) in &self.reactions {
            found.push(*after(&["total force", set])?.get(*axis).ok_or("a force has three parts")?);
        }
        let table = lines.iter().position(|line| line.contains("E I G E N V A L U E   O U T P U T"));
        let rows = lines[table.ok_or("CalculiX wrote no eigenvalues")? + 1..].iter();
        let numbers =
            rows.map(|line| line.split_whitespace().map(str::parse::<f64>).collect::<Result<Vec<_>, _>>());
        // Number, eigenvalue, frequency in rad/s and in Hz, imaginary part.
        found.extend(numbers.flatten().filter(|row| row.len() == 5).map(|row| row[3]).take(MODES));
        Ok(found)
    }
}
