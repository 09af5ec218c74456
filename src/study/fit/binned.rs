//! Measured friction → tables for a material that no law describes: means of friction in bins of velocity at each temperature.
//!
//! The points of a temperature, in the order of their speed, are cut into bins of equal counts, and a table is straight between the
//! means of its bins. It has as many bins as give the least `AICc` of its points: more follow the friction closer, and take more
//! of its noise for slopes.

use std::sync::Arc;

use crate::model::friction::{FrictionLaw, LawKind, MuTable};
use crate::model::material::{Material, Outside};
use crate::study::fit::course::Course;
use crate::study::fit::criteria::Candidate;
use crate::study::fit::fault::FitFault;
use crate::study::fit::information::information;
use crate::study::fit::problem::sum_of_squares;
use crate::study::fit::range;
use crate::study::fit::rows::rows;
use crate::study::fit::squares::{Fit, Point};
use squealmap_input::quote::rounded;

/// Most bins of a table: between two temperatures a law has the velocities of both tables, which with the one at rest are 63 at
/// most, and a kernel holds 64.
pub const MOST_BINS: usize = 31;

/// Least points of a bin, whose scatter is the error of its mean.
pub const LEAST_POINTS: usize = 6;

/// Bins are one where their mean velocities differ by less than this part: noise over so little would be a steep slope.
const NEAR: f64 = 0.02;

/// The points of a bin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bin {
    /// Their mean speed, m/s.
    pub velocity: f64,
    /// Their mean friction coefficient.
    pub friction: f64,
    /// Its standard error, by their scatter about the table.
    pub error: f64,
    /// How many they are.
    pub points: usize,
}

/// The points of a temperature.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// That of the table, °C.
    pub temperature: f64,
    /// The mean of the points, °C.
    pub measured: f64,
    /// Rising speeds.
    pub bins: Vec<Bin>,
}

/// A material of tables.
#[derive(Clone, Debug, PartialEq)]
pub struct Binned {
    /// Rising temperatures.
    pub rows: Vec<Row>,
    /// What it leaves of the points.
    pub fit: Fit,
}

/// Tables at `temperatures` (°C, rising), to the nearest of which every point counts. Where none are given, points are gathered about
/// those of [`rows`], and a table is at the mean temperature of its points.
///
/// # Errors
/// When the points do not make two bins at some temperature, or the mean of a bin is negative.
pub fn binned(points: &[Point], temperatures: &[f64]) -> Result<Binned, FitFault> {
    if let Some(pair) = temperatures.windows(2).find(|pair| pair[0] >= pair[1]) {
        return Err(FitFault::NotRising { first: pair[0], second: pair[1] });
    }
    if points.is_empty() {
        return Err(FitFault::NoPoints);
    }
    let given = !temperatures.is_empty();
    let centres = if given { temperatures.to_vec() } else { rows(points) };
    let mut groups = vec![Vec::new(); centres.len()];
    for point in points {
        let above = centres.windows(2).take_while(|pair| 0.5 * (pair[0] + pair[1]) < point.temperature);
        let nearest = above.count();
        if let Some(group) = groups.get_mut(nearest) {
            group.push(*point);
        }
    }
    let kept = centres.into_iter().zip(groups).filter(|(_, group)| given || !group.is_empty());
    let made = kept.map(|(centre, group)| row(centre, given, group));
    let rows = made.collect::<Result<Vec<Row>, FitFault>>()?;
    let fit = fitted(&rows, points);
    Ok(Binned { rows, fit })
}

/// The table of the points nearest to `centre` (°C).
fn row(centre: f64, given: bool, mut points: Vec<Point>) -> Result<Row, FitFault> {
    points.sort_by(|a, b| a.velocity.abs().total_cmp(&b.velocity.abs()));
    let measured = mean(&points, |point| point.temperature);
    let temperature = if given { centre } else { measured };
    let most = (points.len() / LEAST_POINTS).min(MOST_BINS);
    let made = (2..=most).map(|count| bins(&points, count)).filter(|bins| bins.len() > 1);
    let judged = made.filter_map(|bins| {
        let squares = sum_of_squares(&residuals(&points, &bins));
        let [aicc, _] = information(points.len(), bins.len(), squares)?;
        Some((aicc, bins))
    });
    let best = judged.min_by(|a, b| a.0.total_cmp(&b.0));
    let Some((_, mut bins)) = best else {
        let [low, high] = range(&points, |point| point.velocity.abs());
        let (low, high) = if points.is_empty() { (0.0, 0.0) } else { (low, high) };
        return Err(FitFault::FewBins { temperature: centre, points: points.len(), low, high });
    };
    if let Some(bin) = bins.iter().find(|bin| bin.friction < 0.0) {
        return Err(FitFault::Negative { param: "mu", value: bin.friction, temperature });
    }
    let residuals = residuals(&points, &bins);
    let mut left = residuals.as_slice();
    for bin in &mut bins {
        let (own, others) = left.split_at(bin.points);
        bin.error = (sum_of_squares(own) / ((bin.points - 1) * bin.points) as f64).sqrt();
        left = others;
    }
    Ok(Row { temperature, measured, bins })
}

/// About `count` bins of the same number of points, which are in the order of their speed. Points of one speed are in one bin.
fn bins(points: &[Point], count: usize) -> Vec<Bin> {
    let target = points.len().div_ceil(count).max(LEAST_POINTS);
    let mut bins: Vec<Bin> = Vec::new();
    let (mut start, mut end, mut sum) = (0, 0, 0.0);
    for same in points.chunk_by(|a, b| a.velocity.abs().total_cmp(&b.velocity.abs()).is_eq()) {
        end += same.len();
        sum += same[0].velocity.abs() * same.len() as f64;
        let velocity = sum / (end - start) as f64;
        let is_apart = bins.last().is_none_or(|last| velocity - last.velocity > NEAR * velocity);
        let rest = points.len() - end;
        // What is left after the last bin has to make one, or belongs to it.
        if end - start >= target && is_apart && (rest == 0 || rest >= LEAST_POINTS) {
            bins.push(bin(&points[start..end]));
            (start, sum) = (end, 0.0);
        }
    }
    if start < points.len() {
        let rest = bin(&points[start..]);
        match bins.pop() {
            Some(last)
                if rest.points < LEAST_POINTS || rest.velocity - last.velocity <= NEAR * rest.velocity =>
            {
                bins.push(bin(&points[start - last.points..]));
            }
            last => bins.extend(last.into_iter().chain([rest])),
        }
    }
    bins
}

fn bin(points: &[Point]) -> Bin {
    Bin {
        velocity: mean(points, |point| point.velocity.abs()),
        friction: mean(points, |point| point.friction),
        error: 0.0,
        points: points.len(),
    }
}

/// The mean, which of equal numbers is that number.
fn mean(points: &[Point], of: impl Fn(&Point) -> f64) -> f64 {
    let Some(first) = points.first().map(&of) else { return 0.0 };
    first + points.iter().map(|point| of(point) - first).sum::<f64>() / points.len() as f64
}

/// Friction at rest: the line through the two slowest bins goes on, as slower points are part of them. `None` where a bin is at rest.
pub(super) fn at_rest(bins: &[Bin]) -> Option<f64> {
    let [slowest, next, ..] = bins else { return None };
    let slope = (next.friction - slowest.friction) / (next.velocity - slowest.velocity);
    (slowest.velocity > 0.0).then(|| (slowest.friction - slope * slowest.velocity).max(0.0))
}

/// The table of some bins, from rest on.
fn table(bins: &[Bin]) -> MuTable {
    let rest = at_rest(bins).map(|friction| (0.0, friction));
    let rows = rest.into_iter().chain(bins.iter().map(|bin| (bin.velocity, bin.friction)));
    let (velocity, mu) = rows.unzip();
    MuTable { velocity, mu }
}

/// Measured friction less that of the table of `bins`.
fn residuals(points: &[Point], bins: &[Bin]) -> Vec<f64> {
    if bins.is_empty() {
        return Vec::new();
    }
    let law = FrictionLaw::Table(Arc::new(table(bins)));
    points.iter().map(|point| point.friction - law.mu(point.velocity)).collect()
}

/// What the material leaves of the points, as a sweep reads it.
fn fitted(rows: &[Row], points: &[Point]) -> Fit {
    let material = Material {
        name: String::new(),
        temperature: rows.iter().map(|row| row.temperature).collect(),
        columns: Vec::new(),
        tables: rows.iter().map(|row| Arc::new(table(&row.bins))).collect(),
        outside: Outside::Clamp,
    };
    let left = |point: &Point| {
        let table = material.table_at(point.temperature);
        table.map_or(f64::NAN, |table| point.friction - FrictionLaw::Table(table).mu(point.velocity))
    };
    let residuals: Vec<f64> = points.iter().map(left).collect();
    let squares = sum_of_squares(&residuals);
    let bins = rows.iter().map(|row| row.bins.len()).sum();
    let free = points.len().checked_sub(bins).filter(|free| *free > 0);
    Fit {
        law: LawKind::Table,
        temperature: material.temperature,
        columns: Vec::new(),
        errors: Vec::new(),
        residual: (squares / points.len() as f64).sqrt(),
        deviation: free.map(|free| (squares / free as f64).sqrt()),
        residuals,
        open: false,
        points: points.len(),
    }
}

impl Binned {
    /// Warnings about tables at another temperature than that of their points.
    #[must_use]
    pub fn elsewhere(&self) -> Vec<String> {
        /// Friction coefficients hardly change over this, °C.
        const NEAR: f64 = 5.0;
        let away = self.rows.iter().filter(|row| (row.measured - row.temperature).abs() > NEAR);
        away.map(|row| {
            format!(
                "the points of the table at {} °C were measured at {} °C in the mean; ask for rows where you measured, or leave \
                 --temperatures out",
                row.temperature,
                rounded(row.measured)
            )
        })
        .collect()
    }

    /// The table of each temperature from rest to the fastest point.
    #[must_use]
    pub fn courses(&self, points: &[Point]) -> Vec<Course> {
        let [_, fastest] = range(points, |point| point.velocity.abs());
        let of_row = |row: &Row| {
            let MuTable { velocity, mu } = table(&row.bins);
            let beyond = mu.last().map(|mu| [fastest, *mu]);
            let points = velocity.into_iter().zip(mu).map(|(v, mu)| [v, mu]).chain(beyond).collect();
            Course { temperature: row.temperature, parameters: Vec::new(), points }
        };
        self.rows.iter().map(of_row).collect()
    }

    /// It beside the laws: every bin is a value.
    #[must_use]
    pub fn candidate(&self) -> Candidate {
        let bins = self.rows.iter().map(|row| row.bins.len()).sum();
        let criteria = information(self.fit.points, bins, sum_of_squares(&self.fit.residuals));
        Candidate { law: LawKind::Table, fit: Ok(self.fit.clone()), criteria }
    }
}
