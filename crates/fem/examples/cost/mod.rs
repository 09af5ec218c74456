//! What a program has cost so far, where Linux tells.

use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// What a program has cost.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Cost {
    /// Seconds from start to end.
    pub(crate) wall: f64,
    /// Seconds that all cores have worked.
    pub(crate) work: f64,
    /// The most memory, GB.
    pub(crate) memory: f64,
}

/// Seconds that all cores have worked for this program.
pub(crate) fn work() -> f64 {
    work_of("self")
}

/// The most memory that this program has had, GB.
pub(crate) fn memory() -> f64 {
    memory_of("self")
}

fn work_of(process: &str) -> f64 {
    // Fields 14 and 15 of proc(5) in ticks of 10 ms, counted after the name in parentheses.
    let stat = std::fs::read_to_string(format!("/proc/{process}/stat")).unwrap_or_default();
    let fields = stat.rsplit(')').next().unwrap_or_default().split_whitespace().skip(11).take(2);
    fields.filter_map(|ticks| ticks.parse::<f64>().ok()).sum::<f64>() / 100.0
}

fn memory_of(process: &str) -> f64 {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).unwrap_or_default();
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).unwrap_or_default();
    peak.split_whitespace().next().and_then(|kb| kb.parse::<f64>().ok()).unwrap_or_default() / 1e6
}

/// Runs a program to its end: what it wrote, and what it cost, read every few milliseconds.
pub(crate) fn watched(command: &mut Command) -> Result<(String, Cost), Box<dyn std::error::Error>> {
    let start = Instant::now();
    let mut child: Child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn()?;
    let process = child.id().to_string();
    let pipe = |stream: Box<dyn std::io::Read + Send>| {
        let mut stream = stream;
        std::thread::spawn(move || {
            let mut text = String::new();
            let _ = stream.read_to_string(&mut text);
            text
        })
    };
    let output = pipe(Box::new(child.stdout.take().ok_or("no output")?));
    let errors = pipe(Box::new(child.stderr.take().ok_or("no output")?));
    let mut cost = Cost::default();
    let status = loop {
        cost.work = cost.work.max(work_of(&process));
        cost.memory = cost.memory.max(memory_of(&process));
        if let Some(status) = child.try_wait()? {
            break status;
        }
        std::thread::sleep(Duration::from_millis(5));
    };
    cost.wall = start.elapsed().as_secs_f64();
    let text = output.join().unwrap_or_default();
    if !status.success() {
        let errors = errors.join().unwrap_or_default();
        return Err(format!("{} failed: {errors}{text}", command.get_program().display()).into());
    }
    Ok((text, cost))
}
