//! From processor times to the cost of tiles.

/// What filling costs beside computing, a share of it, and its standard error from one group to the next.
pub(crate) fn overhead(costs: &[[f64; 2]]) -> [f64; 2] {
    let count = costs.len() as f64;
    let mean = |k: usize| costs.iter().map(|cost| cost[k]).sum::<f64>() / count;
    let ratio = mean(1) / mean(0);
    let square = costs.iter().map(|cost| (cost[1] - ratio * cost[0]).powi(2)).sum::<f64>();
    [ratio - 1.0, (square / (count * (count - 1.0))).sqrt() / mean(0)]
}
