//! What is wrong with a model is said in a sentence.

use squealmap_fem::assembly::{Model, assemble};
use squealmap_fem::contact::{mortar, sliding, sliding_on_rigid};
use squealmap_fem::elements::Kind;
use squealmap_fem::material::{Material, Orthotropic};
use squealmap_fem::mesh::{Block, Mesh};
use squealmap_fem::modes::{Factor, Ordering, lowest};

use crate::cases::{pin, steel};

fn block(kind: Kind) -> Mesh {
    let cells = [2.into(), 2.into(), 2.into()];
    Block { origin: [0.0; 3], size: [1.0; 3], cells, kind }.mesh().expect("a block")
}

fn sentence(mesh: Mesh) -> String {
    let model = Model { mesh, materials: vec![steel()], ..Model::default() };
    assemble(&model).map(drop).expect_err("a bad mesh").to_string()
}

#[test]
fn bad_elements_are_named() {
    let mut inverted = block(Kind::Hex20);
    inverted.groups[0].elements[3].swap(0, 1);
    assert!(sentence(inverted).starts_with("element 3 (Hex20) has a Jacobian determinant of -"));
    let mut flat = block(Kind::Tet4);
    for x in &mut flat.nodes {
        x[2] = 0.0;
    }
    assert!(sentence(flat).starts_with("element 0 (Tet4) has a Jacobian determinant of 0.000e0 at"));
    let mut missing = block(Kind::Hex8);
    missing.groups[0].elements[1][2] = 99;
    assert_eq!(sentence(missing), "element 1 (Hex8) names node 99, but there are only 27");
    let mut twice = block(Kind::Tet10);
    twice.groups[0].elements[0][2] = twice.groups[0].elements[0][1];
    assert!(sentence(twice).starts_with("element 0 (Tet10) names node"));
    let mut short = block(Kind::Hex8);
    short.groups[0].elements[0].pop();
    assert_eq!(sentence(short), "element 0 (Hex8) has 7 nodes, it needs 8");
    let mut nowhere = block(Kind::Hex8);
    nowhere.nodes[4][1] = f64::NAN;
    assert_eq!(sentence(nowhere), "a coordinate of node 4 is not a finite number");
    let mut unknown = block(Kind::Hex8);
    unknown.groups[0].material = 2;
    assert_eq!(sentence(unknown), "element 0 is of material 2, but there are only 1");
    assert_eq!(sentence(Mesh::default()), "the mesh has no solid element: give it at least one");
}

#[test]
fn parts_that_hang_on_nothing_are_counted() {
    let mut mesh = block(Kind::Hex8);
    let mut other = block(Kind::Tet4);
    for x in &mut other.nodes {
        x[0] += 5.0;
    }
    mesh.add(other, "other.", 0);
    let mut model = Model { mesh, materials: vec![steel()], ..Model::default() };
    let side = model.mesh.node_set("x0").expect("a side").to_vec();
    model.supports.clamp(&side);
    let error = assemble(&model).map(drop).expect_err("a part on its own").to_string();
    assert!(
        error.starts_with("parts of the mesh hang on nothing, 1 in all, the smallest of 48 elements"),
        "{error}"
    );
    let side = model.mesh.node_set("other.x1").expect("a side").to_vec();
    model.supports.clamp(&side);
    assemble(&model).expect("both parts are held");
}

/// A free body has six motions without frequency; with a shift of 0 that is an error, below 0 they are found.
#[test]
fn rigid_motions_are_found() {
    for kind in [Kind::Hex20, Kind::Tet10] {
        let model = Model { mesh: block(kind), materials: vec![steel()], ..Model::default() };
        let (_, pencil) = assemble(&model).expect("matrices");
        let ordering = Ordering::new(&pencil.stiffness.pattern).expect("an order");
        let error = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0)
            .map(drop)
            .expect_err("a free body")
            .to_string();
        assert!(
            error.starts_with("the stiffness matrix is singular: a body can move without a force"),
            "{error}"
        );
        let shifted = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, -1e6).expect("a factor");
        let modes = lowest(&pencil, &shifted, 8).expect("modes");
        assert!(modes.omega2[..6].iter().all(|w| w.abs() < 1e-6 * modes.omega2[6]), "{:?}", modes.omega2);
        assert!(modes.omega2[6] > 1e6);
    }
}

#[test]
fn sets_supports_and_contacts_are_checked() {
    let model = pin::model(Kind::Hex8, 1).expect("the pin");
    let error = model.mesh.node_set("pin.top").map(drop).expect_err("no such set").to_string();
    assert_eq!(
        error,
        "the mesh has no set \"pin.top\"; it has pin.x0, pin.x1, pin.y0, pin.y1, pin.z0, pin.z1, x0, x1, y0, y1, z0, z1"
    );
    let set = |name| model.mesh.node_set(name).expect("a side");
    let (up, along) = ([0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
    let error = sliding(&model.mesh, set("pin.z1"), set("z1"), up, along)
        .map(drop)
        .expect_err("no partner")
        .to_string();
    assert!(error.contains("has no partner on the other surface within"), "{error}");
    let error =
        sliding_on_rigid(set("z0"), up, [1.0, 0.0, 0.5]).map(drop).expect_err("not across").to_string();
    assert!(error.starts_with("the direction of sliding leaves the surface"), "{error}");
    let error = sliding_on_rigid(set("z0"), [0.0; 3], along).map(drop).expect_err("no normal").to_string();
    assert!(error.starts_with("the normal of a contact or its direction of sliding is zero"), "{error}");
    let faces = |name| model.mesh.face_set(name).expect("a side");
    let error = mortar(&model.mesh, faces("pin.z1"), faces("z1"), up, along)
        .map(drop)
        .expect_err("apart")
        .to_string();
    assert!(error.starts_with("the surfaces of a contact lie up to 2.50e-2 m apart"), "{error}");
    let beside = model.mesh.faces_where(|x| (x[2] - 0.01).abs() < 1e-9 && x[0] < 0.01 + 1e-9);
    let error =
        mortar(&model.mesh, faces("pin.z0"), &beside, up, along).map(drop).expect_err("beside").to_string();
    assert!(error.starts_with("the two surfaces of a contact share no area"), "{error}");

    let mut clamped = model.clone();
    clamped.supports.clamp(set("pin.z0"));
    let error = assemble(&clamped).map(drop).expect_err("clamped and sliding").to_string();
    assert!(error.contains("is in sliding contact, but its motion along z is already given"), "{error}");
    let mut nowhere = model.clone();
    nowhere.supports.bond([(0, 5000)]);
    let error = assemble(&nowhere).map(drop).expect_err("no such node").to_string();
    assert!(error.starts_with("a support, bond or contact names node 5000, but there are only"), "{error}");
    let mut axis = model.clone();
    axis.supports.prescribe(&[3], 3, 0.0);
    let error = assemble(&axis).map(drop).expect_err("no such axis").to_string();
    assert_eq!(error, "node 3 is supported along axis 3, but axes are 0, 1 and 2");
    let mut bonded = model.clone();
    bonded.supports.bond([(set("z0")[0], set("x1")[0])]);
    bonded.supports.prescribe(&[set("x1")[0]], 2, 1e-3);
    let error = assemble(&bonded).map(drop).expect_err("two displacements").to_string();
    assert!(error.contains("prescribe one of both"), "{error}");
}

#[test]
fn constants_of_no_material_are_named() {
    let error =
        Material::isotropic("steel", 210e9, 0.5, 7800.0).map(drop).expect_err("incompressible").to_string();
    assert_eq!(error, "material steel: Poisson's ratio is 0.5, it must lie between -1 and 0.5");
    let error = Material::isotropic("steel", -1.0, 0.3, 7800.0).map(drop).expect_err("negative").to_string();
    assert_eq!(error, "material steel: Young's modulus is -1 Pa, it must be above 0");
    let error = Material::isotropic("steel", 210e9, 0.3, 0.0).map(drop).expect_err("no mass").to_string();
    assert_eq!(
        error,
        "material steel: the density is 0 kg/m3, it must be 0.001 or more: constants are in SI units (Pa, kg/m3), whatever the unit of lengths"
    );
    let constants = Orthotropic { young: [1e9, 1e9, 1e9], poisson: [0.9, 0.1, 0.9], shear: [1e9; 3] };
    let error =
        Material::orthotropic("pad", constants, 2000.0).map(drop).expect_err("gives energy").to_string();
    assert!(
        error.starts_with("material pad: with Poisson's ratios 0.9, 0.1, 0.9 some strain would give energy"),
        "{error}"
    );
    let bad = Block {
        origin: [0.0; 3],
        size: [1.0, 0.0, 1.0],
        cells: [1.into(), 1.into(), 1.into()],
        kind: Kind::Hex8,
    };
    assert_eq!(
        bad.mesh().map(drop).expect_err("flat").to_string(),
        "the block is 0 m long along y, it must be longer than 0"
    );
}
