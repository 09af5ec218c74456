//! Gmsh's text formats 2 and 4.1 (reference manual, chapter "Gmsh file formats").

use std::collections::{BTreeMap, BTreeSet, HashMap};

use super::raw::{Raw, RawElement, faces_by_corners, number, sorted};
use crate::Error;
use crate::elements::Kind;
use crate::mesh::Mesh;

/// The solid kinds by Gmsh's type: our node i is Gmsh's node `order[i]`.
fn solid(kind: u64) -> Option<(Kind, &'static [usize])> {
    match kind {
        4 => Some((Kind::Tet4, &[0, 1, 2, 3])),
        5 => Some((Kind::Hex8, &[0, 1, 2, 3, 4, 5, 6, 7])),
        11 => Some((Kind::Tet10, &[0, 1, 2, 3, 4, 5, 6, 7, 9, 8])),
        17 => Some((Kind::Hex20, &[0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15])),
        18 => Some((Kind::Wedge15, &[0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11])),
        _ => None,
    }
}

/// Number of nodes, and of corners, of the kinds that only name sets: points, lines, triangles, quadrilaterals.
fn flat(kind: u64) -> Option<(usize, usize)> {
    match kind {
        15 => Some((1, 1)),
        1 => Some((2, 2)),
        8 => Some((3, 2)),
        2 => Some((3, 3)),
        9 => Some((6, 3)),
        3 => Some((4, 4)),
        16 => Some((8, 4)),
        _ => None,
    }
}

/// A line, triangle, … that belongs to named groups: nodes, number of corners, names.
type Marked = (Vec<u64>, usize, Vec<String>);

/// What has been read so far.
#[derive(Default)]
struct Found {
    /// Names of physical groups by dimension and tag.
    names: HashMap<(usize, u64), String>,
    /// Physical groups of each entity of a format 4 file.
    entities: HashMap<(usize, u64), Vec<u64>>,
    raw: Raw,
    /// The physical groups of each solid element.
    groups: Vec<Vec<u64>>,
    /// Places of the solid elements in the list, by their nodes: format 2 writes one again for each of its groups.
    known: HashMap<Vec<u64>, usize>,
    marked: Vec<Marked>,
}

/// Lines of a file with their numbers.
struct Lines<'a> {
    rest: Box<dyn Iterator<Item = (usize, &'a str)> + 'a>,
    line: usize,
}

impl<'a> Lines<'a> {
    fn next(&mut self, what: &str) -> Result<Vec<&'a str>, Error> {
        let (line, text) = self.rest.next().ok_or_else(|| Error::File {
            line: self.line,
            what: format!("the file ends where {what} should follow"),
        })?;
        self.line = line;
        Ok(text.split_whitespace().collect())
    }

    fn word<T: std::str::FromStr>(&self, words: &[&str], index: usize, what: &str) -> Result<T, Error> {
        let word = words
            .get(index)
            .ok_or_else(|| self.wrong(format!("the line ends where {what} should follow")))?;
        number(word, self.line, what)
    }

    /// Takes the end of a section: more or fewer lines than its count says are no mesh.
    fn end(&mut self, section: &str) -> Result<(), Error> {
        let end = section.replacen('$', "$End", 1);
        let words = self.next(&end)?;
        if words == [end.as_str()] {
            return Ok(());
        }
        let what = format!(
            "{end} should follow, but there is \"{}\": the section has more lines than its count says, write the mesh again",
            words.join(" ")
        );
        Err(self.wrong(what))
    }

    /// Checks that the blocks of a section of format 4 have as many members as its first line says.
    fn counted(&self, said: usize, found: usize, what: &str) -> Result<(), Error> {
        if said == found {
            return Ok(());
        }
        let what = format!(
            "the blocks have {found} {what} in all, where the section says {said}: write the mesh again"
        );
        Err(self.wrong(what))
    }

    fn wrong(&self, what: String) -> Error {
        Error::File { line: self.line, what }
    }
}

/// Reads a mesh. Physical volumes, in the order of their tags, are materials 0, 1, …, where the first group of a volume counts and what has none
/// comes first; physical surfaces are sets of faces and of nodes,
/// physical curves and points sets of nodes, by their names, or `surface 3` where they have none.
///
/// # Errors
/// What is no such file, binary files, other versions, kinds of elements that are not here, missing nodes.
pub fn gmsh(text: &str) -> Result<Mesh, Error> {
    let lines =
        text.lines().enumerate().map(|(i, line)| (i + 1, line.trim())).filter(|(_, line)| !line.is_empty());
    let mut lines = Lines { rest: Box::new(lines), line: 1 };
    let mut found = Found::default();
    let mut version = 0.0;
    while let Some((line, section)) = lines.rest.next() {
        lines.line = line;
        match section {
            "$MeshFormat" => {
                let words = lines.next("the version")?;
                version = lines.word(&words, 0, "version")?;
                if !((2.0..3.0).contains(&version) || (4.1..4.2).contains(&version)) {
                    return Err(lines.wrong(format!(
                        "the format is {version}, it must be 2 or 4.1: save the mesh as one of them"
                    )));
                }
                if lines.word::<u8>(&words, 1, "kind of file")? != 0 {
                    return Err(
                        lines.wrong("the file is binary: save the mesh as text (Mesh.Binary = 0)".to_owned())
                    );
                }
            }
            "$PhysicalNames" => {
                let words = lines.next("a count")?;
                for _ in 0..lines.word::<usize>(&words, 0, "count")? {
                    let words = lines.next("a name")?;
                    let (dim, tag) = (lines.word(&words, 0, "dimension")?, lines.word(&words, 1, "tag")?);
                    found.names.insert((dim, tag), words[2..].join(" ").trim_matches('"').to_owned());
                }
            }
            "$Entities" => read_entities(&mut lines, &mut found.entities)?,
            "$Nodes" if version >= 4.0 => read_nodes4(&mut lines, &mut found.raw)?,
            "$Nodes" => {
                let words = lines.next("a count")?;
                for _ in 0..lines.word::<usize>(&words, 0, "count")? {
                    let words = lines.next("a node")?;
                    found.raw.nodes.push((lines.word(&words, 0, "number")?, place(&lines, &words, 1)?));
                }
            }
            "$Elements" => read_elements(&mut lines, version, &mut found)?,
            _ => continue,
        }
        if section != "$MeshFormat" {
            lines.end(section)?;
        }
    }
    if version == 0.0 {
        return Err(Error::File {
            line: 1,
            what: "this is no mesh of Gmsh: it has no $MeshFormat".to_owned(),
        });
    }
    // Volumes without a group are one, before all others.
    let first = |own: &Vec<u64>| own.first().copied().unwrap_or_default();
    let tags: BTreeSet<u64> = found.groups.iter().map(first).collect();
    for (element, own) in found.raw.elements.iter_mut().zip(&found.groups) {
        element.material = tags.iter().position(|tag| *tag == first(own)).unwrap_or_default();
    }
    finish(found.raw, &found.marked)
}

fn place(lines: &Lines<'_>, words: &[&str], from: usize) -> Result<[f64; 3], Error> {
    let at = |i: usize| lines.word(words, from + i, "coordinate");
    Ok([at(0)?, at(1)?, at(2)?])
}

fn read_entities(lines: &mut Lines<'_>, entities: &mut HashMap<(usize, u64), Vec<u64>>) -> Result<(), Error> {
    let counts = lines.next("counts")?;
    for dim in 0..4 {
        for _ in 0..lines.word::<usize>(&counts, dim, "count")? {
            let words = lines.next("an entity")?;
            // A point has a place, the others have a box.
            let from = if dim == 0 { 4 } else { 7 };
            // A sign says which way round an entity is taken.
            let physical: Result<Vec<u64>, Error> = (0..lines.word::<usize>(&words, from, "count")?)
                .map(|i| lines.word::<i64>(&words, from + 1 + i, "tag").map(i64::unsigned_abs))
                .collect();
            entities.insert((dim, lines.word(&words, 0, "tag")?), physical?);
        }
    }
    Ok(())
}

fn read_nodes4(lines: &mut Lines<'_>, raw: &mut Raw) -> Result<(), Error> {
    let words = lines.next("counts")?;
    let (blocks, all) = (lines.word::<usize>(&words, 0, "count")?, lines.word(&words, 1, "count")?);
    let before = raw.nodes.len();
    for _ in 0..blocks {
        let words = lines.next("a block of nodes")?;
        let count: usize = lines.word(&words, 3, "count")?;
        let mut numbers = Vec::new();
        for _ in 0..count {
            let words = lines.next("a node")?;
            numbers.push(lines.word::<u64>(&words, 0, "number")?);
        }
        for number in numbers {
            let words = lines.next("a node's place")?;
            raw.nodes.push((number, place(lines, &words, 0)?));
        }
    }
    lines.counted(all, raw.nodes.len() - before, "nodes")
}

fn read_elements(lines: &mut Lines<'_>, version: f64, found: &mut Found) -> Result<(), Error> {
    let first = lines.next("a count")?;
    let mut all = 0;
    for _ in 0..lines.word::<usize>(&first, 0, "count")? {
        let words = lines.next("an element")?;
        if version >= 4.0 {
            let (dim, tag) = (lines.word(&words, 0, "dimension")?, lines.word(&words, 1, "tag")?);
            let (kind, count) = (lines.word(&words, 2, "type")?, lines.word::<usize>(&words, 3, "count")?);
            let physical = found.entities.get(&(dim, tag)).cloned().unwrap_or_default();
            all += count;
            for _ in 0..count {
                let words = lines.next("an element")?;
                element(lines, &words, 1, kind, &physical, found)?;
            }
        } else {
            let (kind, tags) = (lines.word(&words, 1, "type")?, lines.word::<usize>(&words, 2, "count")?);
            let physical: Vec<u64> =
                if tags > 0 { vec![lines.word::<i64>(&words, 3, "tag")?.unsigned_abs()] } else { Vec::new() };
            element(lines, &words, tags.saturating_add(3), kind, &physical, found)?;
        }
    }
    if version >= 4.0 { lines.counted(lines.word(&first, 1, "count")?, all, "elements") } else { Ok(()) }
}

/// Takes in an element whose nodes begin at a word of its line.
fn element(
    lines: &Lines<'_>,
    words: &[&str],
    from: usize,
    kind: u64,
    physical: &[u64],
    found: &mut Found,
) -> Result<(), Error> {
    let nodes = |count: usize| -> Result<Vec<u64>, Error> {
        (0..count).map(|i| lines.word(words, from.saturating_add(i), "node")).collect()
    };
    if let Some((kind, order)) = solid(kind) {
        let nodes = nodes(order.len())?;
        let nodes: Vec<u64> = order.iter().map(|i| nodes[*i]).collect();
        let named: Vec<String> =
            physical.iter().filter_map(|tag| found.names.get(&(3, *tag)).cloned()).collect();
        // No corners: a set of nodes only.
        found.marked.push((nodes.clone(), 0, named));
        let place = *found.known.entry(sorted(&nodes)).or_insert(found.groups.len());
        if let Some(groups) = found.groups.get_mut(place) {
            groups.extend(physical);
            return Ok(());
        }
        found.groups.push(physical.to_vec());
        let number = lines.word(words, 0, "number")?;
        found.raw.elements.push(RawElement { number, kind, nodes, material: 0, line: lines.line });
        return Ok(());
    }
    let Some((count, corners)) = flat(kind) else {
        return Err(lines.wrong(format!(
            "elements of type {kind} are not known here: mesh with tetrahedra (types 4, 11), bricks (5, 17) or wedges of \
             15 nodes (18); Mesh.SecondOrderIncomplete = 1 makes bricks of 20 nodes"
        )));
    };
    let dim = match corners {
        1 => 0,
        2 => 1,
        _ => 2,
    };
    let name = |tag: &u64| {
        let kinds = ["point", "curve", "surface"];
        found.names.get(&(dim, *tag)).cloned().unwrap_or_else(|| format!("{} {tag}", kinds[dim]))
    };
    let named = physical.iter().filter(|tag| **tag != 0).map(name).collect();
    found.marked.push((nodes(count)?, corners, named));
    Ok(())
}

/// Names the sets.
fn finish(raw: Raw, marked: &[Marked]) -> Result<Mesh, Error> {
    let built = raw.build()?;
    let mut mesh = built.mesh;
    let faces = faces_by_corners(&mesh);
    let mut node_sets: BTreeMap<String, Vec<usize>> = BTreeMap::new();
    for (nodes, corners, names) in marked {
        let nodes: Vec<usize> = nodes.iter().filter_map(|n| built.node.get(n).copied()).collect();
        let mut key = nodes[..(*corners).min(nodes.len())].to_vec();
        key.sort_unstable();
        for name in names {
            node_sets.entry(name.clone()).or_default().extend(&nodes);
            if let Some(face) = faces.get(&key).filter(|_| *corners > 2) {
                mesh.face_sets.entry(name.clone()).or_default().push(*face);
            }
        }
    }
    for nodes in node_sets.values_mut() {
        nodes.sort_unstable();
        nodes.dedup();
    }
    mesh.node_sets = node_sets;
    Ok(mesh)
}
