//! Where a stretch of cells changes in kind: the cut into straight pieces that is most likely, by dynamic programming.
//!
//! Every quantity is a straight line over its abscissa within a piece; a cut has to lower the sum of the squared, scaled
//! residuals of all quantities by [`PRICE`].

/// What a cut has to gain. Noise alone gains the number of its parameters, some 10; slow modulation of a limit cycle more.
pub(super) const PRICE: f64 = 60.0;
/// The most pieces of a stretch.
const PIECES: usize = 5;

/// One quantity of the cells of a stretch.
pub(super) struct Course {
    /// Running sums of `1, x, y, xx, xy, yy`, from nothing on.
    sums: Vec<[f64; 5]>,
    scale: f64,
}

impl Course {
    /// From points and the least scatter that means anything. Their scatter is that of second differences, which no
    /// straight line has.
    pub(super) fn new(points: &[[f64; 2]], least: f64) -> Course {
        let mut second: Vec<f64> =
            points.windows(3).map(|three| (three[0][1] - 2.0 * three[1][1] + three[2][1]).abs()).collect();
        second.sort_by(f64::total_cmp);
        let scatter = 1.4826 * second.get(second.len() / 2).copied().unwrap_or_default() / 6_f64.sqrt();
        // Abscissas from the middle on: no digits are lost.
        let x0 = points.iter().map(|[x, _]| x).sum::<f64>() / points.len().max(1) as f64;
        let mut sums = vec![[0.0; 5]];
        let mut sum = [0.0; 5];
        for [x, y] in points {
            let x = x - x0;
            for (sum, term) in sum.iter_mut().zip([x, *y, x * x, x * y, y * y]) {
                *sum += term;
            }
            sums.push(sum);
        }
        Course { sums, scale: scatter.max(least) }
    }

    /// By what residuals are scaled.
    pub(super) fn scale(&self) -> f64 {
        self.scale
    }

    /// Scaled squared residuals of a line through the points `from..to`.
    fn cost(&self, from: usize, to: usize) -> f64 {
        let n = (to - from) as f64;
        let [x, y, xx, xy, yy] = std::array::from_fn(|k| self.sums[to][k] - self.sums[from][k]);
        let (sxx, sxy, syy) = (xx - x * x / n, xy - x * y / n, yy - y * y / n);
        let explained = if sxx > 1e-12 * xx.abs() { sxy * sxy / sxx } else { 0.0 };
        (syy - explained).max(0.0) / (self.scale * self.scale)
    }
}

/// The ends of the pieces of `count` cells, the last one `count` itself; no piece has fewer than `least` cells.
pub(super) fn cut(count: usize, courses: &[Course], least: usize) -> Vec<usize> {
    priced(count, courses, least).0
}

/// The same, and what is left of all residuals with the price of the cuts.
pub(super) fn priced(count: usize, courses: &[Course], least: usize) -> (Vec<usize>, f64) {
    let least = least.max(3);
    let cost = |from: usize, to: usize| courses.iter().map(|course| course.cost(from, to)).sum::<f64>();
    if courses.is_empty() || count < 2 * least {
        return (vec![count], cost(0, count));
    }
    // best[k][to]: the least cost of the first `to` cells in k + 1 pieces, and where the last of them begins.
    let mut best: Vec<Vec<(f64, usize)>> =
        vec![(0..=count).map(|to| (if to >= least { cost(0, to) } else { f64::INFINITY }, 0)).collect()];
    for k in 1..PIECES {
        let before = &best[k - 1];
        let row = (0..=count).map(|to| {
            let last = (k * least..(to + 1).saturating_sub(least))
                .map(|from| (before[from].0 + cost(from, to), from));
            last.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((f64::INFINITY, 0))
        });
        let row = row.collect();
        best.push(row);
    }
    let priced = (0..PIECES).map(|k| best[k][count].0 + PRICE * k as f64);
    let (pieces, price) = priced.enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default();
    let mut ends = vec![count];
    for k in (1..=pieces).rev() {
        let end = ends[ends.len() - 1];
        ends.push(best[k][end].1);
    }
    ends.reverse();
    (ends, price)
}
