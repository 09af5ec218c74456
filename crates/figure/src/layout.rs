//! How the blocks of a map are arranged on its page.

/// Panels become flatter when the rows of all blocks would not fit this height, points (230 mm) ...
const PAGE: f64 = 652.0;
/// ... but not flatter than this, as long as the page is no limit, ...
const FLAT: f64 = 0.6;
/// ... never flatter than this, ...
const FLATTEST: f64 = 0.25;
/// ... and never lower than what a reader needs, points: two labels on the axis beside it, and cells that can be seen. What
/// is lower does not fit its page.
const LOWEST: f64 = 22.0;
/// Between blocks, points, ...
const GAP: f64 = 16.0;
/// ... and where they would not fit the page otherwise.
const NEAR: f64 = 8.0;
/// How many more columns of panels than usual are tried.
const MORE_COLUMNS: usize = 4;

/// An arrangement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layout {
    /// How many blocks stand side by side.
    pub across: usize,
    /// Between blocks, points.
    pub gap: f64,
    /// How many more columns of panels a block has than usual.
    pub more_columns: usize,
    /// Whether a table of panels, a row for each value of an axis, may have other columns too.
    pub broken: bool,
    /// The least height of a panel, as a part of its width.
    pub flattest: f64,
    /// The height that the blocks should take together, points.
    pub page: f64,
}

impl Layout {
    /// The least height of a panel of this width, points; none is taller than wide.
    #[must_use]
    pub fn least_height(&self, width: f64) -> f64 {
        (self.flattest * width).max(LOWEST).min(width)
    }

    /// The usual one.
    #[must_use]
    pub fn usual(across: usize) -> Layout {
        Layout { across, gap: GAP, more_columns: 0, broken: false, flattest: FLAT, page: PAGE }
    }

    /// The first layout that is no taller than a page, points. Tried are more columns of panels, up to so many blocks side
    /// by side, flatter panels, blocks nearer to one another, and broken tables of panels. Where none fits, it is the last.
    /// `height` measures a figure.
    pub fn fitting(
        usual: Layout,
        most_across: usize,
        tallest: f64,
        height: impl Fn(Layout) -> f64,
    ) -> Layout {
        let usual = Layout { page: usual.page.min(tallest), ..usual };
        // Three and more blocks side by side are narrow: only where pairs do not do.
        let [pairs, more] = [2, usize::MAX].map(|most| most.min(most_across).max(usual.across));
        let stages = [
            (FLAT, GAP, pairs, false),
            (FLATTEST, GAP, pairs, false),
            (FLATTEST, NEAR, pairs, false),
            (FLAT, NEAR, more, false),
            (FLATTEST, NEAR, more, false),
            (FLATTEST, NEAR, pairs, true),
        ];
        let all = stages.into_iter().flat_map(|(flattest, gap, most, broken)| {
            (usual.across..=most).flat_map(move |across| {
                (0..=MORE_COLUMNS).map(move |more_columns| Layout {
                    across,
                    gap,
                    more_columns,
                    broken,
                    flattest,
                    ..usual
                })
            })
        });
        let mut last = usual;
        for layout in all {
            last = layout;
            // What stands around the panels is guessed at first, and known once it is measured.
            for _ in 0..2 {
                let beyond = height(last) - tallest;
                if beyond <= 0.0 {
                    return last;
                }
                last.page -= beyond + 0.1;
            }
            if height(last) <= tallest {
                return last;
            }
        }
        last
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whatever the page, panels stay readable: as low as two labels beside them let them be, and not flatter than a quarter.
    #[test]
    fn panels_stay_readable() {
        for flattest in [FLAT, FLATTEST] {
            let layout = Layout { flattest, ..Layout::usual(1) };
            for width in [10.0, 44.0, 64.0, 120.0, 400.0] {
                let least = layout.least_height(width);
                assert!(
                    least >= LOWEST.min(width) && least >= flattest * width && least <= width,
                    "{width}: {least}"
                );
            }
        }
    }

    /// Panels of a part of their width, in rows: what is tried first is what changes least.
    #[test]
    fn what_changes_least_comes_first() {
        let usual = Layout::usual(1);
        let of = |tallest: f64| {
            Layout::fitting(usual, 2, tallest, |layout| {
                let columns = (2 + layout.more_columns).min(4) as f64;
                let width = 200.0 / layout.across as f64 / columns;
                let blocks = (2 / layout.across) as f64;
                let rows = (4.0 / columns).ceil();
                let panel = (layout.page / blocks / rows).clamp(layout.least_height(width), width);
                blocks * rows * panel + 20.0
            })
        };
        assert_eq!(of(420.0), Layout { page: 420.0, ..usual });
        assert!(of(300.0).page < usual.page && of(300.0).more_columns == 0, "flatter first");
        assert_eq!((of(200.0).across, of(200.0).more_columns), (1, 1));
        assert_eq!((of(150.0).across, of(150.0).more_columns), (1, 2));
        assert_eq!((of(75.0).across, of(75.0).flattest.to_bits()), (2, FLAT.to_bits()));
        assert_eq!(of(30.0).flattest.to_bits(), FLATTEST.to_bits());
        assert!(!of(75.0).broken && of(75.0).gap > of(5.0).gap && of(5.0).broken);
    }
}
