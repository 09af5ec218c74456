//! Eigenvalues of a real matrix, without its vectors: scaled, brought to Hessenberg form by Householder's reflections, then
//! Francis' double steps on the part that has not split off.
//!
//! After the procedure `hqr` of R. S. Martin, G. Peters and J. H. Wilkinson, Numer. Math. 14, 219 (1970). Crates at hand do more:
//! they keep the whole Schur form up to date (`docs/fem_maps.md` has the times).

use nalgebra::DMatrix;
use num_complex::Complex64;

/// Double steps for each row at most; it takes one or two.
const MOST_STEPS: usize = 60;

/// After so many steps without any an exceptional shift breaks a cycle.
const EXCEPTIONAL: usize = 10;

/// The eigenvalues of a square matrix of finite numbers, conjugate pairs next to each other; `None` where the steps do not
/// converge.
#[must_use]
pub fn eigenvalues(mut matrix: DMatrix<f64>) -> Option<Vec<Complex64>> {
    let size = matrix.nrows();
    if !matrix.iter().all(|entry| entry.is_finite()) {
        return None;
    }
    balance(&mut matrix);
    let form = if size > 2 { matrix.hessenberg().unpack_h() } else { matrix };
    // Rows one after the other: a step goes along them.
    let mut rows = Hessenberg { size, entries: form.transpose().as_slice().to_vec() };
    rows.eigenvalues()
}

/// Scales coordinates by powers of two, which round nothing, until rows and columns are about as long (B. N. Parlett and C.
/// Reinsch, Numer. Math. 13, 293, 1969). Of modes with frequencies far apart the steps do not converge without.
fn balance(matrix: &mut DMatrix<f64>) {
    /// A scaling that shortens row and column by less is not worth it.
    const GAIN: f64 = 0.95;
    let size = matrix.nrows();
    let mut goes_on = true;
    while goes_on {
        goes_on = false;
        for i in 0..size {
            let rest = matrix[(i, i)].abs();
            let column = matrix.column(i).iter().map(|entry| entry.abs()).sum::<f64>() - rest;
            let row = matrix.row(i).iter().map(|entry| entry.abs()).sum::<f64>() - rest;
            if !(column > 0.0 && row > 0.0) {
                continue;
            }
            let factor = (row / column).sqrt().log2().round().exp2();
            if column * factor + row / factor < GAIN * (column + row) {
                goes_on = true;
                matrix.column_mut(i).scale_mut(factor);
                matrix.row_mut(i).scale_mut(1.0 / factor);
            }
        }
    }
}

/// A matrix with nothing below its first subdiagonal.
struct Hessenberg {
    size: usize,
    entries: Vec<f64>,
}

impl Hessenberg {
    fn at(&self, row: usize, column: usize) -> f64 {
        self.entries[row * self.size + column]
    }

    fn set(&mut self, row: usize, column: usize, value: f64) {
        self.entries[row * self.size + column] = value;
    }

    fn eigenvalues(&mut self) -> Option<Vec<Complex64>> {
        let norm: f64 = self.entries.iter().map(|entry| entry.abs()).sum();
        let mut found = Vec::with_capacity(self.size);
        // The active part ends here; what lies behind has split off.
        let mut end = self.size;
        let (mut shifted, mut steps, mut all) = (0.0, 0_usize, 0);
        while end > 0 {
            let begin = self.split(end, norm);
            let last = end - 1;
            if begin == last {
                found.push(Complex64::new(self.at(last, last) + shifted, 0.0));
                (end, steps) = (end - 1, 0);
            } else if begin + 1 == last {
                found.extend(self.pair(last).map(|root| root + shifted));
                (end, steps) = (end - 2, 0);
            } else if all == MOST_STEPS * self.size {
                return None;
            } else {
                let mut shift = [
                    self.at(last, last),
                    self.at(last - 1, last - 1),
                    self.at(last, last - 1) * self.at(last - 1, last),
                ];
                if steps > 0 && steps.is_multiple_of(EXCEPTIONAL) {
                    shifted += shift[0];
                    for i in 0..end {
                        self.entries[i * self.size + i] -= shift[0];
                    }
                    let size = self.at(last, last - 1).abs() + self.at(last - 1, last - 2).abs();
                    shift = [0.75 * size, 0.75 * size, -0.4375 * size * size];
                }
                (steps, all) = (steps + 1, all + 1);
                self.step(begin, last, shift);
            }
        }
        Some(found)
    }

    /// Where the part that ends before `end` begins: behind the last subdiagonal entry that is rounding.
    fn split(&mut self, end: usize, norm: f64) -> usize {
        for row in (1..end).rev() {
            let around = self.local(row - 1, end) + self.local(row, end);
            let around = if around == 0.0 { norm } else { around };
            if self.at(row, row - 1).abs() <= f64::EPSILON * around {
                self.set(row, row - 1, 0.0);
                return row;
            }
        }
        0
    }

    /// How large the matrix is around a diagonal entry. Diagonals alone, as in the procedure, say nothing of modes that hardly
    /// grow or decay: a part that has split off then goes unseen, and the steps lose their shifts on the way through it.
    fn local(&self, row: usize, end: usize) -> f64 {
        let product = |upper: usize| (self.at(upper + 1, upper) * self.at(upper, upper + 1)).abs();
        let before = if row > 0 { product(row - 1) } else { 0.0 };
        let behind = if row + 1 < end { product(row) } else { 0.0 };
        self.at(row, row).abs() + before.max(behind).sqrt()
    }

    /// The eigenvalues of the two by two part that ends with row `last`.
    fn pair(&self, last: usize) -> [Complex64; 2] {
        let (x, y) = (self.at(last, last), self.at(last - 1, last - 1));
        let product = self.at(last, last - 1) * self.at(last - 1, last);
        let half = 0.5 * (y - x);
        let square = half * half + product;
        let root = square.abs().sqrt();
        if square >= 0.0 {
            let far = half + root.copysign(half);
            let near = if far == 0.0 { x } else { x - product / far };
            [Complex64::new(x + far, 0.0), Complex64::new(near, 0.0)]
        } else {
            [Complex64::new(x + half, root), Complex64::new(x + half, -root)]
        }
    }

    /// A double step on rows and columns `begin` to `last`, three or more.
    fn step(&mut self, begin: usize, last: usize, [x, y, product]: [f64; 3]) {
        // Two small entries in a row let it begin further down.
        let mut from = last - 2;
        let mut bulge;
        loop {
            let here = self.at(from, from);
            let (r, s) = (x - here, y - here);
            bulge = [
                (r * s - product) / self.at(from + 1, from) + self.at(from, from + 1),
                self.at(from + 1, from + 1) - here - r - s,
                self.at(from + 2, from + 1),
            ];
            let size: f64 = bulge.iter().map(|part| part.abs()).sum();
            bulge = bulge.map(|part| part / size);
            if from == begin {
                break;
            }
            let left = self.at(from, from - 1).abs() * (bulge[1].abs() + bulge[2].abs());
            let around: f64 = (from - 1..from + 2).map(|row| self.local(row, last + 1)).sum();
            if left <= f64::EPSILON * bulge[0].abs() * around {
                break;
            }
            from -= 1;
        }
        for row in from + 2..=last {
            self.set(row, row - 2, 0.0);
            if row > from + 2 {
                self.set(row, row - 3, 0.0);
            }
        }
        for k in from..last {
            let three = k + 1 < last;
            let mut size = 0.0;
            if k > from {
                bulge = [
                    self.at(k, k - 1),
                    self.at(k + 1, k - 1),
                    if three { self.at(k + 2, k - 1) } else { 0.0 },
                ];
                size = bulge.iter().map(|part| part.abs()).sum();
                if size > 0.0 {
                    bulge = bulge.map(|part| part / size);
                }
            }
            let [p, q, r] = bulge;
            let length = (p * p + q * q + r * r).sqrt().copysign(p);
            if length == 0.0 {
                continue;
            }
            if k > from {
                self.set(k, k - 1, -length * size);
            } else if begin < from {
                let before = self.at(k, k - 1);
                self.set(k, k - 1, -before);
            }
            let p = p + length;
            let (along, across) = ([p / length, q / length, r / length], [q / p, r / p]);
            if three {
                self.reflect_rows(k, last, along, across);
                self.reflect_columns([begin, last.min(k + 3)], k, along, across);
            } else {
                self.reflect_last(begin, k, last, along, across[0]);
            }
        }
    }

    /// Rows `k` to `k + 2`, from column `k` on.
    fn reflect_rows(&mut self, k: usize, last: usize, [x, y, z]: [f64; 3], [q, r]: [f64; 2]) {
        let n = self.size;
        let (first, rest) = self.entries[k * n..(k + 3) * n].split_at_mut(n);
        let (second, third) = rest.split_at_mut(n);
        let columns = k..=last;
        for ((a, b), c) in
            first[columns.clone()].iter_mut().zip(&mut second[columns.clone()]).zip(&mut third[columns])
        {
            let p = *a + q * *b + r * *c;
            *a -= p * x;
            *b -= p * y;
            *c -= p * z;
        }
    }

    /// Columns `k` to `k + 2` of some rows.
    fn reflect_columns(
        &mut self,
        [top, bottom]: [usize; 2],
        k: usize,
        [x, y, z]: [f64; 3],
        [q, r]: [f64; 2],
    ) {
        for row in self.entries.chunks_exact_mut(self.size).take(bottom + 1).skip(top) {
            let [a, b, c] = &mut row[k..k + 3] else { continue };
            let p = x * *a + y * *b + z * *c;
            *a -= p;
            *b -= p * q;
            *c -= p * r;
        }
    }

    /// The last rows and columns, of which there are two.
    fn reflect_last(&mut self, begin: usize, k: usize, last: usize, [x, y, _]: [f64; 3], q: f64) {
        for column in k..=last {
            let p = self.at(k, column) + q * self.at(k + 1, column);
            self.entries[k * self.size + column] -= p * x;
            self.entries[(k + 1) * self.size + column] -= p * y;
        }
        for row in begin..=last {
            let p = x * self.at(row, k) + y * self.at(row, k + 1);
            self.entries[row * self.size + k] -= p;
            self.entries[row * self.size + k + 1] -= p * q;
        }
    }
}
