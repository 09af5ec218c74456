//! A region computed by the reader's own GPU, in turns: the page sends what it is given to the device, and brings back what has come
//! of it, until there is an answer.
//!
//! The eigenvalues of all cells in one turn; or, where they are asked for, the transients, some steps a turn, in as many lanes as
//! the device holds, and the eigenvalues beside them by WebAssembly. Words, kernels and records are those of the GPU engine of [`squealmap`], in f32; what that does not
//! bring to its end is computed again in f64 by WebAssembly.

use std::sync::atomic::AtomicBool;

use serde_json::{Map, Value as Json, json};
use squealmap::engine::fields::words;
use squealmap::engine::instances::Instances;
use squealmap::engine::kernel::batch::{self, Known};
use squealmap::engine::kernel::linear::KERNEL;
use squealmap::engine::kernel::places::room;
use squealmap::engine::kernel::source::{Constant, Kernel, SETTING_WORDS, Settings};
use squealmap::engine::lanes::again::records_again;
use squealmap::engine::march::asked::{Asked, Tally};
use squealmap::engine::march::flow::Flow;
use squealmap::engine::march::kernel::kernel_for;
use squealmap::engine::march::lane::Lane;
use squealmap::engine::march::marching::PARTS;
use squealmap::engine::march::round::{ALIGNED, Round};
use squealmap::engine::precision::Precision;
use squealmap::engine::record::Record;
use squealmap::study::explore::Explorer;
use squealmap::study::explore::answer::Answer;
use squealmap::study::explore::region::{Region, answered};
use squealmap::sweep::columns::Column;
use squealmap::sweep::spec::Spec;

/// Most lanes of a turn: some hundred megabytes in the memory of the page.
const MOST_LANES: usize = 16_384;

/// Most loop iterations of an invocation in one turn: software in the place of a GPU may stop silently beyond 65 535.
const MOST_LOOPS: u32 = 60_000;

/// A region on its way.
#[derive(Debug)]
pub struct OnDevice {
    spec: Spec,
    wanted: Vec<Column>,
    names: Vec<String>,
    records: Vec<Record>,
    stage: Stage,
    /// Kernels whose text was told.
    told: Vec<String>,
}

/// What the device is at.
#[derive(Debug)]
enum Stage {
    Eigenvalues(Vec<Known>),
    Transients(Box<Transients>),
}

#[derive(Debug)]
struct Transients {
    flow: Flow<f32>,
    tally: Tally,
    lanes: Vec<Lane<f32>>,
    round: Round<f32>,
}

/// A dispatch: its kernel, where its words of inputs, state and flags begin and how many there are, and how many invocations.
struct Dispatch<'a> {
    kernel: &'a Kernel,
    choices: Vec<(&'static str, Constant)>,
    first: [usize; 3],
    words: [usize; 3],
    count: usize,
}

impl OnDevice {
    /// A region of a sweep before the first turn, from the question for it.
    ///
    /// # Errors
    /// A sentence that says why no GPU can compute the region, or what is wrong with it.
    pub fn new(question: &str, explorer: &Explorer) -> Result<OnDevice, String> {
        let region: Region =
            serde_json::from_str(question).map_err(|why| format!("this is no region: {why}"))?;
        let opened = explorer.opened();
        let spec = region.spec(opened)?;
        if spec.modal.is_some() {
            return Err("models of modes are computed without a GPU".to_owned());
        }
        if spec.response() && spec.plan().hunts {
            return Err("cycles are found without a GPU".to_owned());
        }
        if kernel_for(spec.pieces()).is_none() {
            return Err("no kernel holds a friction law of so many pieces".to_owned());
        }
        let wanted = region.wanted(&spec)?;
        let (count, mut records) = (spec.grid.len(), Vec::new());
        let stage = if spec.response() {
            records.resize(count, Record::default());
            let (flow, round) = (Flow::new(&spec, Vec::new()), Round::new(true));
            Stage::Transients(Box::new(Transients {
                flow,
                tally: Tally::default(),
                lanes: Vec::new(),
                round,
            }))
        } else {
            Stage::Eigenvalues((0..count).map(|index| batch::known(&spec, index)).collect())
        };
        Ok(OnDevice { spec, wanted, names: region.columns, records, stage, told: Vec::new() })
    }

    /// A turn of at most so many steps: takes the words of state and flags that have come `back`, none in the first turn, and says
    /// what is next: the answer, or what to send and to do, with `turn` in the head.
    ///
    /// # Errors
    /// A sentence, when the device cannot have made those words.
    pub fn turn(&mut self, back: &[u8], steps: u32) -> Result<Answer, String> {
        let is_first = back.is_empty();
        let back: Vec<u32> = back
            .chunks_exact(4)
            .map(|four| u32::from_le_bytes([four[0], four[1], four[2], four[3]]))
            .collect();
        match &mut self.stage {
            Stage::Eigenvalues(known) => {
                let count = known.iter().filter(|(_, words)| words.is_some()).count();
                if is_first && count > 0 {
                    return Ok(eigenvalues(&mut self.told, batch::inputs(known)));
                }
                let room = room(count);
                let (state, flags) =
                    split(&back, [KERNEL.state, KERNEL.flags].map(|fields| words(fields) * room))?;
                let known = std::mem::take(known);
                batch::take(&mut self.records, known, (&state, flags), false)
                    .map_err(|why| why.to_string())?;
                return Ok(self.done());
            }
            Stage::Transients(_) if is_first => {}
            Stage::Transients(going) => {
                let Transients { flow, tally, lanes, round } = &mut **going;
                let [_, of_state, of_flags] = round.words();
                let (state, flags) = split(&back, [of_state, of_flags])?;
                let asked = asked(&self.spec, &mut self.records, tally);
                let back = (&state[..], flags);
                let (_, ended) = round.collect(lanes, back, flow, &asked);
                ended.map_err(|why| why.to_string())?;
            }
        }
        Ok(self.next_round(steps))
    }

    /// The next round of the transients.
    fn next_round(&mut self, steps: u32) -> Answer {
        let Stage::Transients(going) = &mut self.stage else { return self.done() };
        let Transients { flow, tally, lanes, round } = &mut **going;
        let asked = asked(&self.spec, &mut self.records, tally);
        loop {
            flow.finish(&asked, lanes);
            flow.turn_over(&asked, lanes, MOST_LANES);
            if !lanes.is_empty() {
                break;
            }
            if !asked.has_more() {
                records_again(&self.spec, 0, &mut self.records, &AtomicBool::new(false));
                return self.done();
            }
        }
        round.place(lanes);
        let [inputs, state, flags, end] = round.begins_sent();
        let sizes = [state - inputs, flags - state, end - flags];
        let mut bytes = vec![0; end];
        round.send(lanes, |at, part| bytes[at..at + part.len()].copy_from_slice(part));
        let mut heads = Vec::new();
        let mut dispatches = Vec::new();
        for group in &round.groups {
            let Some((kernel, _)) = kernel_for(group.form.pieces) else { continue };
            let most = (MOST_LOOPS / kernel.loops_per_step.max(1)).max(1);
            let head = group.head(steps.clamp(1, most), flow.settings());
            for (kernel, choices) in PARTS.into_iter().filter_map(|part| group.form.kernel(part)) {
                heads.extend(&head);
                dispatches.push(Dispatch {
                    kernel,
                    choices,
                    first: group.first,
                    words: group.words(),
                    count: group.lanes,
                });
            }
        }
        sent(&mut self.told, (sizes, bytes), &heads, dispatches)
    }

    fn done(&self) -> Answer {
        answered(&self.spec, &self.wanted, &self.names, &self.records)
    }
}

/// All instances of a region.
fn asked<'a>(spec: &'a Spec, records: &'a mut [Record], tally: &'a Tally) -> Asked<'a> {
    let wanted = records.len();
    Asked::new(spec, [0, wanted], records, tally)
}

/// What computes the eigenvalues.
fn eigenvalues(told: &mut Vec<String>, (inputs, count): (Vec<f32>, usize)) -> Answer {
    let of_each = words(KERNEL.state);
    let words = [KERNEL.inputs, KERNEL.state, KERNEL.flags].map(|fields| words(fields) * room(count));
    let head = Settings::new([count, of_each], 1, 0, [0; SETTING_WORDS]);
    let dispatch = Dispatch { kernel: &KERNEL, choices: Vec::new(), first: [0; 3], words, count };
    let sizes = words.map(|count| 4 * count);
    let mut bytes: Vec<u8> = bytemuck::cast_slice(&inputs).to_vec();
    bytes.resize(sizes.iter().sum(), 0);
    sent(told, (sizes, bytes), bytemuck::bytes_of(&head), vec![dispatch])
}

/// What is to be sent, and to be done with it; `told` are the kernels whose text the page has. Bytes stand one after the other: inputs, state, flags,
/// and behind these the settings.
fn sent(
    told: &mut Vec<String>,
    ([inputs, state, flags], mut bytes): ([usize; 3], Vec<u8>),
    heads: &[u8],
    dispatches: Vec<Dispatch>,
) -> Answer {
    let mut sources = Map::new();
    let dispatches: Vec<Json> = dispatches
        .into_iter()
        .map(|Dispatch { kernel, choices, first, words, count }| {
            // Kernels of one name differ in the room for pieces of a law.
            let name = format!("{} {} {choices:?}", kernel.name, self::words(kernel.inputs));
            if !told.contains(&name) {
                sources.insert(name.clone(), Json::String(kernel.source(Precision::F32, &choices)));
                told.push(name.clone());
            }
            json!({ "kernel": name, "first": first.map(|word| 4 * word), "bytes": words.map(|count| 4 * count), "count": count })
        })
        .collect();
    let sizes = [inputs, state, flags, heads.len()];
    bytes.extend_from_slice(heads);
    let head = json!({
        "turn": { "dispatches": dispatches, "sizes": sizes, "settings": size_of::<Settings>(), "aligned": ALIGNED },
        "sources": sources,
    });
    Answer { head, numbers: Vec::new(), bytes }
}

/// Words of state and flags that have come back.
fn split(back: &[u32], [state, flags]: [usize; 2]) -> Result<(Vec<f32>, &[u32]), String> {
    if back.len() != state + flags {
        return Err(format!(
            "the device gave {} words back, and should have given {}",
            back.len(),
            state + flags
        ));
    }
    let (of_state, of_flags) = back.split_at(state);
    Ok((of_state.iter().map(|word| f32::from_bits(*word)).collect(), of_flags))
}
