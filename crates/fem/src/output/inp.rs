//! The model without friction as an `.inp` file for CalculiX: an independent judge of the real modes.

use std::fmt::Write as _;

use crate::assembly::Model;
use crate::elements::Kind;
use crate::material::inverse3;

/// CalculiX's name of a kind of element.
fn name(kind: Kind) -> &'static str {
    match kind {
        Kind::Hex8 => "C3D8",
        Kind::Hex20 => "C3D20",
        Kind::Hex20Reduced => "C3D20R",
        Kind::Tet4 => "C3D4",
        Kind::Tet10 => "C3D10",
        Kind::Wedge15 => "C3D15",
    }
}

/// The model as a file that asks for its lowest real modes. Bonds and tied normal displacements become equations; friction has no place
/// in it, and a contact stiffness is written as tied. Materials are written with nine elastic constants each.
///
/// Numbers have 13 digits: CalculiX reads no more than twenty characters of one.
#[must_use]
pub fn inp(model: &Model, modes: usize) -> String {
    let mut text = String::from("*NODE\n");
    for (i, [x, y, z]) in model.mesh.nodes.iter().enumerate() {
        let _ = writeln!(text, "{}, {x:.12e}, {y:.12e}, {z:.12e}", i + 1);
    }
    let mut first = 1;
    for (g, group) in model.mesh.groups.iter().enumerate() {
        let _ = writeln!(text, "*ELEMENT, TYPE={}, ELSET=GROUP{g}", name(group.kind));
        for (i, nodes) in group.elements.iter().enumerate() {
            let _ = write!(text, "{}", first + i);
            for (k, node) in nodes.iter().enumerate() {
                // CalculiX reads sixteen entries of a line.
                text.push_str(if (k + 1) % 16 == 0 { ",\n" } else { ", " });
                let _ = write!(text, "{}", node + 1);
            }
            text.push('\n');
        }
        first += group.elements.len();
    }
    for (i, material) in model.materials.iter().enumerate() {
        let d = &material.stiffness;
        let block = [0, 1, 2].map(|row| [d[row][0], d[row][1], d[row][2]]);
        let (c, _) = inverse3(&block);
        let _ = writeln!(text, "*MATERIAL, NAME=MATERIAL{i}\n*ELASTIC, TYPE=ENGINEERING CONSTANTS");
        // E1, E2, E3, ν12, ν13, ν23, G12, G13, G23.
        let ratios = [-c[0][1] / c[0][0], -c[0][2] / c[0][0], -c[1][2] / c[1][1]];
        let first =
            [1.0 / c[0][0], 1.0 / c[1][1], 1.0 / c[2][2], ratios[0], ratios[1], ratios[2], d[3][3], d[5][5]];
        let _ = writeln!(text, "{}\n{:.12e}", first.map(|c| format!("{c:.12e}")).join(", "), d[4][4]);
        let _ = writeln!(text, "*DENSITY\n{:.12e}", material.density);
    }
    for (g, group) in model.mesh.groups.iter().enumerate() {
        let _ = writeln!(text, "*SOLID SECTION, ELSET=GROUP{g}, MATERIAL=MATERIAL{}", group.material);
    }
    text.push_str("*BOUNDARY\n");
    for (node, axis) in model.supports.prescribed.keys() {
        let _ = writeln!(text, "{}, {}, {}", node + 1, axis + 1, axis + 1);
    }
    for (a, b) in &model.supports.same {
        (0..3).for_each(|axis| equation(&mut text, &[(*a, axis, 1.0), (*b, axis, -1.0)]));
    }
    for tie in &model.supports.tied {
        for axis in 0..3 {
            let masters = tie.masters.iter().map(|(node, w)| (*node, axis, -w));
            equation(&mut text, &std::iter::once((tie.slave, axis, 1.0)).chain(masters).collect::<Vec<_>>());
        }
    }
    for point in &model.contact {
        let mut terms: Vec<(usize, usize, f64)> = Vec::new();
        for i in 0..3 {
            terms.push((point.slave, i, point.normal[i]));
            terms.extend(point.masters.iter().map(|(node, w)| (*node, i, -w * point.normal[i])));
        }
        terms.retain(|(_, _, factor)| factor.abs() > 0.0);
        // The first one is eliminated: the slave along the normal.
        terms.sort_by(|a, b| {
            (b.0 == point.slave, b.2.abs())
                .partial_cmp(&(a.0 == point.slave, a.2.abs()))
                .unwrap_or(std::cmp::Ordering::Equal)
        });
        equation(&mut text, &terms);
    }
    let _ = writeln!(text, "*STEP\n*FREQUENCY\n{modes}\n*END STEP");
    text
}

/// Σ factor · displacement = 0.
fn equation(text: &mut String, terms: &[(usize, usize, f64)]) {
    let _ = writeln!(text, "*EQUATION\n{}", terms.len());
    for line in terms.chunks(4) {
        let words: Vec<String> =
            line.iter().map(|(node, axis, f)| format!("{}, {}, {f:.12e}", node + 1, axis + 1)).collect();
        let _ = writeln!(text, "{}", words.join(", "));
    }
}
