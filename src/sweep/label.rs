//! The labels of an instance in two bytes, and how many instances have which.
//!
//! Figures, counts and summaries need nothing else of a record, so that none of them keeps the records of a sweep.

use std::collections::BTreeMap;

use crate::engine::record::Record;
use crate::engine::regime::Regime;
use crate::model::kind::InstabilityType;
use crate::model::status::Status;
use crate::sweep::checks::Checks;

/// Status, type, regime, whether it is settled and whether it is bistable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Label(u16);

/// Bits of a part of a label: four of them, two of `settled` and `bistable`.
const KIND: u32 = 4;
const REGIME: u32 = 8;
const SETTLED: u32 = 12;
const BISTABLE: u32 = 14;
const PART: u16 = 0xf;
const FLAG: u16 = 0x3;

impl Label {
    /// The label of an instance that a stopped run did not come to.
    pub const NOT_COMPUTED: Label = Label(Status::NotComputed as u16);

    /// How the instance ended.
    #[must_use]
    pub fn status(self) -> Status {
        let code = u32::from(self.0 & PART);
        Status::IN_MAP.into_iter().find(|status| *status as u32 == code).unwrap_or_default()
    }

    /// The type of instability, where there is one.
    #[must_use]
    pub fn kind(self) -> Option<InstabilityType> {
        self.kind_position().map(|position| InstabilityType::ALL[position])
    }

    /// The position of the type in [`InstabilityType::ALL`].
    #[must_use]
    pub fn kind_position(self) -> Option<usize> {
        self.part(KIND).checked_sub(1)
    }

    /// The regime, where there is one.
    #[must_use]
    pub fn regime(self) -> Option<Regime> {
        self.regime_position().map(|position| Regime::ALL[position])
    }

    /// The position of the regime in [`Regime::ALL`].
    #[must_use]
    pub fn regime_position(self) -> Option<usize> {
        self.part(REGIME).checked_sub(1)
    }

    /// Whether the regime is settled, where there is one.
    #[must_use]
    pub fn settled(self) -> Option<bool> {
        self.flag(SETTLED)
    }

    /// Whether several starts ended differently, where that is known.
    #[must_use]
    pub fn bistable(self) -> Option<bool> {
        self.flag(BISTABLE)
    }

    /// The label without whether it is settled: instances that differ in nothing else belong to one region of a map.
    #[must_use]
    pub fn class(self) -> Label {
        Label(self.0 & !(FLAG << SETTLED))
    }

    fn flag(self, shift: u32) -> Option<bool> {
        ((self.0 >> shift) & FLAG).checked_sub(1).map(|flag| flag == 1)
    }

    fn part(self, shift: u32) -> usize {
        usize::from((self.0 >> shift) & PART)
    }
}

impl From<&Record> for Label {
    #[expect(clippy::cast_possible_truncation, reason = "positions and codes below 16")]
    fn from(record: &Record) -> Label {
        let position = |found: Option<usize>| found.map_or(0, |position| position as u16 + 1);
        let kind = record.kind.map(|kind| kind as usize);
        let regime = record.regime.map(|regime| regime as usize);
        let [settled, bistable] = [record.settled, record.bistable].map(|flag| flag.map(usize::from));
        Label(
            record.status as u16
                | position(kind) << KIND
                | position(regime) << REGIME
                | position(settled) << SETTLED
                | position(bistable) << BISTABLE,
        )
    }
}

impl From<Label> for Record {
    /// A record with these labels and nothing else.
    fn from(label: Label) -> Record {
        Record {
            status: label.status(),
            kind: label.kind(),
            regime: label.regime(),
            settled: label.settled(),
            bistable: label.bistable(),
            ..Record::default()
        }
    }
}

/// How many instances have each label.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    counts: BTreeMap<Label, usize>,
    energy_gaining_impacts: Option<u64>,
    checks: Checks,
    /// Starts beside the small one that failed: large ones by their status, those of boxes together (`None`).
    failed: BTreeMap<Option<&'static str>, u64>,
}

impl Tally {
    /// Counts some records.
    pub fn add(&mut self, records: &[Record]) {
        // Neighbours mostly have the same label.
        for run in records.chunk_by(|a, b| Label::from(a) == Label::from(b)) {
            *self.counts.entry(Label::from(&run[0])).or_default() += run.len();
        }
        for record in records {
            if let Some(large) = record.large().filter(|large| large.status != Status::Ok) {
                *self.failed.entry(Some(large.status.name())).or_default() += 1;
            }
            if let Some(basin) = record.basin().filter(|basin| basin.failed > 0) {
                *self.failed.entry(None).or_default() += u64::from(basin.failed);
            }
            for start in std::iter::once(record).chain(record.large()) {
                self.checks.add(start);
                if let Some(impacts) =
                    start.outcome.as_ref().and_then(|outcome| outcome.energy_gaining_impacts)
                {
                    *self.energy_gaining_impacts.get_or_insert(0) += impacts;
                }
            }
        }
    }

    /// Counts one label.
    pub fn add_label(&mut self, label: Label) {
        *self.counts.entry(label).or_default() += 1;
    }

    /// Counts instances that were not computed.
    pub fn add_missing(&mut self, count: usize) {
        *self.counts.entry(Label::NOT_COMPUTED).or_default() += count;
    }

    /// The tally of all records of a sweep.
    #[must_use]
    pub fn of(records: &[Record]) -> Tally {
        let mut tally = Tally::default();
        tally.add(records);
        tally
    }

    /// How many instances have a label that is selected.
    #[must_use]
    pub fn count(&self, selects: impl Fn(Label) -> bool) -> usize {
        self.counts.iter().filter(|(label, _)| selects(**label)).map(|(_, count)| count).sum()
    }

    /// How many instances were counted.
    #[must_use]
    pub fn total(&self) -> usize {
        self.count(|_| true)
    }

    /// How many of them were computed.
    #[must_use]
    pub fn computed(&self) -> usize {
        self.count(|label| label.status() != Status::NotComputed)
    }

    /// How many large starts failed with each status.
    pub fn failed(&self) -> impl Iterator<Item = (&'static str, u64)> {
        self.failed.iter().filter_map(|(status, count)| Some(((*status)?, *count)))
    }

    /// How many starts of boxes failed.
    #[must_use]
    pub fn failed_in_boxes(&self) -> u64 {
        self.failed.get(&None).copied().unwrap_or_default()
    }

    /// What the checks found.
    #[must_use]
    pub fn checks(&self) -> &Checks {
        &self.checks
    }

    /// Impacts that gained energy, of all instances; only the reference counts them.
    #[must_use]
    pub fn energy_gaining_impacts(&self) -> Option<u64> {
        self.energy_gaining_impacts
    }
}
