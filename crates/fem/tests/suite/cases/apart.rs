//! How far numbers of two programs are apart.

/// Relative difference of two numbers.
pub(crate) fn apart(a: f64, b: f64) -> f64 {
    (a / b - 1.0).abs()
}

/// The largest difference of two lists, above any bound where one of them is no number; nothing for lists of different lengths, or empty
/// ones.
pub(crate) fn worst(ours: &[f64], theirs: &[f64]) -> Option<f64> {
    if ours.len() != theirs.len() || ours.is_empty() {
        return None;
    }
    let apart = ours.iter().zip(theirs).map(|(a, b)| apart(*a, *b));
    Some(apart.map(|x| if x.is_finite() { x } else { f64::INFINITY }).fold(0.0, f64::max))
}

#[test]
fn a_planted_fault_is_seen() {
    let right = [1.0, -2.0, 3.0];
    let seen = |theirs: &[f64]| worst(&right, theirs).expect("as many numbers");
    assert!(seen(&right) < 1e-15);
    assert!(seen(&[1.0, -2.0, 3.0003]) > 0.9e-4);
    assert!(seen(&[1.0, 2.0, 3.0]) > 1.0);
    assert!(seen(&[1.0, f64::NAN, 3.0]).is_infinite());
    assert!(seen(&[1.0, 0.0, 3.0]).is_infinite());
    assert_eq!(worst(&right, &right[..2]), None);
    assert_eq!(worst(&[], &[]), None);
}
