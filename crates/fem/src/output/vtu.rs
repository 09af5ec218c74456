//! Unstructured grids of VTK (`.vtu`, XML with text), which ParaView reads.

use std::fmt::Write as _;

use faer::c64;

use crate::elements::Kind;
use crate::mesh::Mesh;

/// A quantity of every node.
#[derive(Debug, Clone)]
pub enum Field {
    /// A vector, such as the displacements of a static step (m).
    Real(Vec<[f64; 3]>),
    /// A complex vector, such as a mode: written as real part, imaginary part and phase (rad) of each component.
    Complex(Vec<[c64; 3]>),
}

/// VTK's number of a kind of cell.
fn cell_type(kind: Kind) -> u8 {
    match kind {
        Kind::Tet4 => 10,
        Kind::Hex8 => 12,
        Kind::Tet10 => 24,
        Kind::Hex20 | Kind::Hex20Reduced => 25,
        Kind::Wedge15 => 26,
    }
}

/// A mesh with named fields as the text of a file.
#[must_use]
pub fn vtu(mesh: &Mesh, fields: &[(&str, Field)]) -> String {
    let cells: Vec<(Kind, usize, &[usize])> = mesh.elements().map(|(_, k, m, nodes)| (k, m, nodes)).collect();
    let mut text = format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n\
         <UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<Points>\n",
        mesh.nodes.len(),
        cells.len()
    );
    vectors(&mut text, "places", &mesh.nodes);
    text.push_str("</Points>\n<Cells>\n");
    array(&mut text, "Int64", "connectivity", cells.iter().map(|(_, _, nodes)| words(nodes.iter())));
    let mut end = 0;
    let ends = cells.iter().map(|(_, _, nodes)| {
        end += nodes.len();
        end.to_string()
    });
    array(&mut text, "Int64", "offsets", ends);
    array(&mut text, "UInt8", "types", cells.iter().map(|(kind, ..)| cell_type(*kind).to_string()));
    text.push_str("</Cells>\n<CellData>\n");
    array(&mut text, "Int64", "material", cells.iter().map(|(_, material, _)| material.to_string()));
    text.push_str("</CellData>\n<PointData>\n");
    for (name, field) in fields {
        match field {
            Field::Real(values) => vectors(&mut text, name, values),
            Field::Complex(values) => {
                let part = |of: fn(&c64) -> f64| {
                    values.iter().map(|v| [of(&v[0]), of(&v[1]), of(&v[2])]).collect::<Vec<_>>()
                };
                vectors(&mut text, &format!("{name} real"), &part(|z| z.re));
                vectors(&mut text, &format!("{name} imaginary"), &part(|z| z.im));
                vectors(&mut text, &format!("{name} phase"), &part(|z| z.arg()));
            }
        }
    }
    text.push_str("</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
    text
}

fn words<T: ToString>(values: impl Iterator<Item = T>) -> String {
    values.map(|v| v.to_string()).collect::<Vec<_>>().join(" ")
}

fn array(text: &mut String, kind: &str, name: &str, lines: impl Iterator<Item = String>) {
    let _ = writeln!(text, "<DataArray type=\"{kind}\" Name=\"{}\" format=\"ascii\">", escaped(name));
    lines.for_each(|line| {
        text.push_str(&line);
        text.push('\n');
    });
    text.push_str("</DataArray>\n");
}

fn vectors(text: &mut String, name: &str, values: &[[f64; 3]]) {
    let name = escaped(name);
    let _ = writeln!(
        text,
        "<DataArray type=\"Float64\" Name=\"{name}\" NumberOfComponents=\"3\" format=\"ascii\">"
    );
    for [x, y, z] in values {
        let _ = writeln!(text, "{x:e} {y:e} {z:e}");
    }
    text.push_str("</DataArray>\n");
}

/// A name in an attribute of XML.
fn escaped(name: &str) -> String {
    name.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
