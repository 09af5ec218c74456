//! Modes that damp: where they turn to growth is where the eigenvalue crosses, whatever values of μ are taken, and rounding is no growth.

use squealmap_fem::study::Event;

use crate::cases::{block, outcome, slides, support};

/// Two blocks of tetrahedra; the upper one damps.
fn blocks(values: &str) -> String {
    let bodies = [
        block("u", "tet4", [[0.004, 0.0, 0.0], [0.009, 0.008, 0.012]], [2, 2, 3], "a"),
        block("l", "tet4", [[0.0, -0.002, -0.008], [0.02, 0.012, 0.008]], [4, 3, 2], "b"),
        support("u.z1", "xyz"),
        support("l.z0", "xyz"),
        slides("u.z0", "l.z1", [0.3, 1.0, 0.0]),
    ]
    .concat();
    format!(
        r"
        {bodies}
        [materials.a]
        young = 70e9
        poisson = 0.3
        density = 2700.0
        rayleigh = [20.0, 2e-8]
        [materials.b]
        young = 210e9
        poisson = 0.28
        density = 7800.0
        [friction]
        mu = {{ {values} }}
        [modes]
        count = 12
        "
    )
}

/// Between the coarse values two modes come near each other and exchange their shapes. At 31 and 121 values of μ, where each is followed without doubt, the
/// three cross where they are told to here; bisection between the wrong ones ended at a dyadic part of the step.
#[test]
fn modes_that_exchange_their_shapes_turn_where_they_cross() {
    let found = outcome(&blocks("values = [0.0, 0.5, 1.0, 1.5]"));
    assert_eq!(found.remarks, Vec::<String>::new());
    let told: Vec<(Event, f64, f64)> =
        found.transitions.iter().map(|t| (t.event, t.mu, t.frequency)).collect();
    let expected = [(0.234_441, 181_857.6), (1.176_830, 96_198.75), (1.482_952, 158_865.5)];
    assert_eq!(told.len(), expected.len(), "{told:?}");
    for ((event, mu, frequency), (at, hertz)) in told.iter().zip(expected) {
        let near = (mu - at).abs() < 2e-6 && (frequency / hertz - 1.0).abs() < 1e-5;
        assert!(*event == Event::Onset && near, "{told:?}");
    }
}

/// A square column has modes that nothing damps beside two that damping is given for, or a damping that is none: their growth is rounding.
#[test]
fn rounding_is_no_growth() {
    let body = [
        block("c", "hex8", [[0.0; 3], [0.01, 0.01, 0.03]], [2, 2, 3], "a"),
        support("c.z1", "xyz"),
        slides("c.z0", "rigid", [1.0, 0.0, 0.0]),
    ]
    .concat();
    let column = |[of_material, of_modes]: [&str; 2]| {
        format!(
            r"
            {body}
            [materials.a]
            young = 70e9
            poisson = 0.3
            density = 2700.0
            {of_material}
            [friction]
            mu = {{ values = [0.0, 0.001, 0.005, 0.01, 0.02, 0.1, 0.3] }}
            [modes]
            count = 6
            {of_modes}
            "
        )
    };
    for damping in [["", "damping_ratios = [0.01, 0.02]"], ["rayleigh = [0.0, 1e-30]", ""]] {
        let found = outcome(&column(damping));
        assert_eq!(found.transitions, Vec::new(), "{damping:?}");
    }
}
