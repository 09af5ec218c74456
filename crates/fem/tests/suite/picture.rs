//! The pieces of a picture of a mesh.

use squealmap_fem::elements::Kind;
use squealmap_fem::mesh::{Block, Mesh};
use squealmap_fem::output::{Facet, facets, isometric};

fn cube(origin: [f64; 3], kind: Kind) -> Mesh {
    Block { origin, size: [2.0; 3], cells: [2, 2, 2].map(Into::into), kind }.mesh().expect("a block")
}

fn painted(mesh: &Mesh, size: f64) -> Vec<Facet> {
    let still = vec![[0.0; 3]; mesh.nodes.len()];
    let heights: Vec<f64> = mesh.nodes.iter().map(|x| x[2]).collect();
    facets(mesh, &still, &heights, &isometric(), size)
}

fn area(facet: &Facet) -> f64 {
    let o = &facet.outline;
    (1..o.len() - 1)
        .map(|i| {
            let (a, b) =
                ([o[i][0] - o[0][0], o[i][1] - o[0][1]], [o[i + 1][0] - o[0][0], o[i + 1][1] - o[0][1]]);
            0.5 * (a[0] * b[1] - a[1] * b[0])
        })
        .sum()
}

/// Of a cube of edge 2 three sides are seen, each of an area of 4/√3; values are those in the middles of the pieces.
#[test]
fn three_sides_of_a_cube_are_seen() {
    for (kind, size, count) in
        [(Kind::Hex20, 1.0, 12), (Kind::Hex8, 0.5, 48), (Kind::Tet10, 2.0, 24), (Kind::Tet10, 0.75, 96)]
    {
        let seen = painted(&cube([0.0; 3], kind), size);
        assert_eq!(seen.len(), count, "{}", kind.name());
        let sum: f64 = seen.iter().map(area).sum();
        assert!((sum - 3.0 * 4.0 / 3.0_f64.sqrt()).abs() < 1e-12, "{sum}");
        // The top has height 2 everywhere, the two sides 1 in the mean.
        let mean: f64 = seen.iter().map(|f| f.value * area(f)).sum::<f64>() / sum;
        assert!((mean - 4.0 / 3.0).abs() < 1e-12, "{mean}");
        assert!(seen.windows(2).all(|pair| pair[0].depth <= pair[1].depth));
        // Edges of elements, each side of each face: 4 of a brick, 3 of a tetrahedron, cut into n.
        let edges: usize = seen.iter().flat_map(|f| &f.edges).filter(|edge| **edge).count();
        assert_eq!(
            edges,
            if kind == Kind::Tet10 { 24 * 3 * (count / 24).isqrt() } else { 12 * 4 * (count / 12).isqrt() }
        );
    }
}

/// A cube behind another of the same size is not seen; one beside it is; one that stands out behind is seen where it stands out.
#[test]
fn what_is_hidden_is_left_out() {
    let along = isometric()[2];
    let both = |shift: [f64; 3]| {
        let mut mesh = cube([0.0; 3], Kind::Hex8);
        mesh.add(cube(shift, Kind::Hex8), "other.", 0);
        painted(&mesh, 1.0)
    };
    assert_eq!(both(along.map(|c| -10.0 * c)).len(), 12);
    assert_eq!(both([10.0, 0.0, 0.0]).len(), 24);
    // Raised by one element, the farther cube stands out by eight triangles of half a piece each: three whole pieces of its top, and
    // half of the outermost one of either side. The front cube has 24. Halves are cut into eight rows.
    let raised = both([-10.0 * along[0], -10.0 * along[1], 1.0 - 10.0 * along[2]]);
    let triangle = 3.0_f64.sqrt() / 6.0;
    let sum: f64 = raised.iter().map(area).sum();
    assert!((sum / triangle - 32.0).abs() < 2.0 * 2.0 / 8.0, "{}", sum / triangle);
    assert_eq!(raised.iter().filter(|facet| (area(facet) - 2.0 * triangle).abs() < 1e-12).count(), 12 + 3);
}

/// Whether a place lies in an outline, not on it.
fn inside(outline: &[[f64; 2]], at: [f64; 2]) -> bool {
    (0..outline.len()).all(|i| {
        let (a, b) = (outline[i], outline[(i + 1) % outline.len()]);
        (b[0] - a[0]) * (at[1] - a[1]) - (b[1] - a[1]) * (at[0] - a[0]) > 1e-9
    })
}

/// A small cube on a large piece: the piece is hidden in part, and no part of it is painted over the cube.
#[test]
fn a_piece_ends_where_something_stands_on_it() {
    let mut mesh = Block {
        origin: [0.0, 0.0, -1.0],
        size: [8.0, 8.0, 1.0],
        cells: [1, 1, 1].map(Into::into),
        kind: Kind::Hex8,
    }
    .mesh()
    .expect("a plate");
    mesh.add(cube([3.0, 3.0, 0.0], Kind::Hex8), "cube.", 0);
    let still = vec![[0.0; 3]; mesh.nodes.len()];
    // The plate is 0, the cube 1.
    let values: Vec<f64> = (0..mesh.nodes.len()).map(|node| if node < 8 { 0.0 } else { 1.0 }).collect();
    let seen = facets(&mesh, &still, &values, &isometric(), 8.0);
    let cubes = |facet: &&Facet| facet.value > 0.5;
    assert_eq!(seen.iter().filter(cubes).count(), 12);
    // No middle of a piece of the plate lies inside a piece of the cube.
    for part in seen.iter().filter(|facet| facet.value < 0.5) {
        let middle =
            [0, 1].map(|i| part.outline.iter().map(|c| c[i]).sum::<f64>() / part.outline.len() as f64);
        for facet in seen.iter().filter(cubes) {
            assert!(!inside(&facet.outline, middle), "{middle:?}");
        }
    }
    // The plate's sides, and its top without most of what the cube hides: its hexagon.
    let plate: f64 = seen.iter().filter(|facet| facet.value < 0.5).map(area).sum();
    let whole = (64.0 + 8.0 + 8.0) / 3.0_f64.sqrt();
    let hidden = 3.0 * 4.0 / 3.0_f64.sqrt();
    assert!((plate - (whole - hidden)).abs() < 0.25 * hidden, "{plate} {}", whole - hidden);
}

/// A block of wide, flat elements on a large piece: what of the piece reaches below it is painted before it, though its middle is nearer.
#[test]
fn what_stands_on_a_piece_is_painted_over_it() {
    let plate = Block {
        origin: [0.0, 0.0, -1.0],
        size: [8.0, 8.0, 1.0],
        cells: [1, 1, 1].map(Into::into),
        kind: Kind::Hex8,
    };
    let block =
        Block { origin: [3.3, 3.3, 0.0], size: [2.0; 3], cells: [1, 1, 4].map(Into::into), kind: Kind::Hex8 };
    let mut mesh = plate.mesh().expect("a plate");
    mesh.add(block.mesh().expect("a block"), "block.", 0);
    let still = vec![[0.0; 3]; mesh.nodes.len()];
    let values: Vec<f64> = (0..mesh.nodes.len()).map(|node| if node < 8 { 0.0 } else { 1.0 }).collect();
    let seen = facets(&mesh, &still, &values, &isometric(), 8.0);
    let first = seen.iter().position(|facet| facet.value > 0.5).expect("a block");
    for part in seen[first..].iter().filter(|facet| facet.value < 0.5) {
        let count = part.outline.len() as f64;
        let middle = [0, 1].map(|i| part.outline.iter().map(|c| c[i]).sum::<f64>() / count);
        for corner in &part.outline {
            let at = [0, 1].map(|i| corner[i] + 0.06 * (middle[i] - corner[i]));
            let below = seen.iter().filter(|facet| facet.value > 0.5);
            assert!(!below.clone().any(|facet| inside(&facet.outline, at)), "{at:?}");
        }
    }
}

/// A bent plate hides nothing of itself.
#[test]
fn a_bent_surface_has_no_holes() {
    let plate = Block {
        origin: [0.0; 3],
        size: [4.0, 4.0, 0.5],
        cells: [4, 4, 1].map(Into::into),
        kind: Kind::Hex20,
    };
    let mesh = plate.mesh().expect("a plate");
    // A saddle: no piece of its top is plane.
    let bent: Vec<[f64; 3]> =
        mesh.nodes.iter().map(|x| [0.0, 0.0, 0.05 * (x[0] - 2.0) * (x[1] - 2.0)]).collect();
    let values = vec![0.0; mesh.nodes.len()];
    // Bent sides are a little longer than 1.
    let seen = facets(&mesh, &bent, &values, &isometric(), 1.1);
    // The top and two sides.
    assert_eq!(seen.len(), 16 + 4 + 4);
}

/// A displacement moves the pieces.
#[test]
fn pieces_move_with_the_nodes() {
    let mesh = cube([0.0; 3], Kind::Hex20);
    let moved = vec![[0.0, 0.0, 3.0]; mesh.nodes.len()];
    let values = vec![0.0; mesh.nodes.len()];
    let up = 3.0 * (2.0 / 3.0_f64).sqrt();
    let after = facets(&mesh, &moved, &values, &isometric(), 1.0);
    for before in painted(&mesh, 1.0) {
        let same = |facet: &&Facet| {
            let apart = |(a, b): (&[f64; 2], &[f64; 2])| (b[0] - a[0]).abs() + (b[1] - a[1] - up).abs();
            before.outline.iter().zip(&facet.outline).map(apart).sum::<f64>() < 1e-12
        };
        assert_eq!(after.iter().filter(same).count(), 1);
    }
}
