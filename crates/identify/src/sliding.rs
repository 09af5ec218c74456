//! Windows of one length over a signal that streams.

/// The last samples of a signal, as many as windows of it still need.
pub(super) struct Sliding {
    values: Vec<f64>,
    /// Where the window starts.
    from: usize,
    length: usize,
    hop: usize,
}

impl Sliding {
    /// Windows of `length` samples (one or more), each `hop` samples (one to a whole window) after the one before.
    pub(super) fn new(length: usize, hop: usize) -> Sliding {
        Sliding { values: Vec::with_capacity(2 * length), from: 0, length, hop: hop.clamp(1, length) }
    }

    /// Takes the next samples. Windows that they fill have to be left before more come.
    pub(super) fn take(&mut self, values: &[f64]) {
        if self.from >= self.length {
            self.values.drain(..self.from);
            self.from = 0;
        }
        self.values.extend_from_slice(values);
    }

    /// The window, where it is full.
    pub(super) fn window(&self) -> Option<&[f64]> {
        self.values.get(self.from..self.from + self.length)
    }

    /// What is not left yet.
    pub(super) fn rest(&self) -> &[f64] {
        &self.values[self.from..]
    }

    /// Leaves the window for the next one.
    pub(super) fn leave(&mut self) {
        self.from += self.hop;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn windows_follow_each_other_by_a_hop() {
        for (length, hop) in [(1, 1), (4, 1), (4, 3), (5, 5), (7, 2)] {
            for at_once in [1, 3, 50] {
                let mut sliding = Sliding::new(length, hop);
                let mut starts = Vec::new();
                let samples: Vec<f64> = (0..100).map(f64::from).collect();
                for some in samples.chunks(at_once) {
                    sliding.take(some);
                    while let Some(window) = sliding.window() {
                        let expected: Vec<f64> = (0..length).map(|k| window[0] + k as f64).collect();
                        assert_eq!(window, expected);
                        starts.push(window[0]);
                        sliding.leave();
                    }
                }
                assert_eq!(starts.len() * hop, 100 - sliding.rest().len());
                let expected: Vec<f64> = (0..=100 - length).step_by(hop).map(|k| k as f64).collect();
                assert_eq!(starts, expected, "{length} {hop} {at_once}");
            }
        }
    }
}
