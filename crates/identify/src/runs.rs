//! Windows as they come → episodes: only those of the run under way are kept, and two numbers of every other.

use crate::episode::Brief;
use crate::episode::{Episode, LASTING, LOUD, Recorded, SAME, beats, episode, grows, preceded};
use crate::settings::Settings;
use crate::window::Window;

/// Gathers windows in a row in which one oscillation grows.
pub(super) struct Runs<'a> {
    recorded: Recorded,
    settings: &'a Settings,
    /// The windows of the run under way.
    run: Vec<Window>,
    briefs: Vec<Brief>,
    /// Episodes and the number of windows of their runs.
    found: Vec<(Episode, usize)>,
}

impl<'a> Runs<'a> {
    pub(super) fn new(recorded: Recorded, settings: &'a Settings) -> Runs<'a> {
        Runs { recorded, settings, run: Vec::new(), briefs: Vec::new(), found: Vec::new() }
    }

    /// Takes the next window.
    #[expect(clippy::cast_possible_truncation, reason = "ratios of powers need no more digits than f32")]
    pub(super) fn take(&mut self, window: &Window) {
        let grows = grows(window, self.recorded);
        let alike = |last: &Window| (last.frequency - window.frequency).abs() <= SAME * last.frequency;
        if !(grows && self.run.last().is_none_or(alike)) {
            self.close();
        }
        if grows {
            self.run.push(*window);
        }
        let (power, distortion) = (window.sums.xx as f32, window.distortion as f32);
        self.briefs.push(Brief { power, distortion, loud: window.signal_to_noise >= LOUD });
    }

    /// Ends the run under way.
    fn close(&mut self) {
        let length = self.run.len();
        if length > 0 {
            let first = self.briefs.len() - length;
            if let Some(found) = episode(&self.run, first, self.recorded, self.settings) {
                let preceded = preceded(&self.briefs, first, &self.run[0], found.growth.value);
                self.found.push((Episode { preceded, ..found }, length));
            }
            self.run.clear();
        }
    }

    /// All episodes of the record.
    pub(super) fn finish(mut self) -> Vec<Episode> {
        self.close();
        let Runs { briefs, found, .. } = self;
        let lasts = |(episode, length): &(Episode, usize)| {
            episode.gain >= LASTING || !beats(&briefs, episode.windows[0], *length)
        };
        found.into_iter().filter(lasts).map(|(episode, _)| episode).collect()
    }
}
