//! Where a step is sampled.

/// Nodes of the three-point Gauss–Legendre rule on `[0, 1]`.
pub const NODES: [f64; 3] = [0.112_701_665_379_258_31, 0.5, 0.887_298_334_620_741_7];
/// Its weights.
pub const WEIGHTS: [f64; 3] = [5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0];

/// Samples of a step: its start, the nodes, its end.
pub const SAMPLE_TIMES: [f64; 5] = [0.0, NODES[0], NODES[1], NODES[2], 1.0];
