//! `squealmap plot` of a map: classes, quantities with lines of equal value, and cuts.

use crate::cli::error::{Error, Result};
use crate::cli::numbers::finite;
use crate::cli::talk::note;
use clap::Args;
use squealmap::cluster::slurm::quote;
use squealmap::results::boundary_lines::boundary_lines;
use squealmap::results::cut::{Cut, cut_csv, cut_svg, left_out};
use squealmap::results::figure::isolines::{isoline_table, round_levels};
use squealmap::results::figure::look::{Content, Look};
use squealmap::results::figure::map;
use squealmap::results::figure::palette::Colouring;
use squealmap::results::figure::tikz::map_tikz;
use squealmap::results::number::NumberColumn;
use squealmap::results::read::{Archive, Taken};
use squealmap::sweep::columns::Cell;
use squealmap::sweep::grid::{Grid, Value};
use squealmap::sweep::spec::Starts;
use squealmap::sweep::spec::names::advice;

/// The lines between classes.
const BOUNDARIES: &str = "boundaries.csv";
/// The lines of equal value.
const ISOLINES: &str = "isolines.csv";
/// The source for LaTeX.
const TIKZ: &str = "plot.tex";
/// The curves of a cut.
const CUT: &str = "cut.csv";

/// The regime from the large start of two.
const LARGE_REGIME: &str = "regime_large";

/// All tables that stand beside maps.
pub(crate) const TABLES: [&str; 4] = [BOUNDARIES, ISOLINES, TIKZ, CUT];

/// Short names of quantities and their columns.
const ALIASES: [(&str, &str); 4] = [
    ("growth", "growth_rate"),
    ("amplitude", "x2_std"),
    ("stick_fraction", "stick"),
    ("cycle_frequency", "response_frequency"),
];

/// The quantities of a cut where none is asked for, as far as they were computed.
const OF_A_CUT: [&str; 2] = ["growth_rate", "x2_std"];

/// Names and bytes of the tables beside a figure.
pub(crate) type Tables = Vec<(&'static str, Vec<u8>)>;

/// Options of maps.
#[derive(Debug, Args)]
pub(crate) struct OfMaps {
    /// Of a map, what to show, separated by commas, one block each: type, regime, growth, amplitude, frequency, phase,
    /// `stick_fraction` or any column of numbers in map.csv [default: type and regime, as far as computed]
    #[arg(long, value_name = "NAME,...", value_delimiter = ',')]
    quantity: Vec<String>,
    /// Of a map, only the instances that have these values of its axes (or the nearest): numbers, laws, materials
    #[arg(long, value_name = "NAME=VALUE,...")]
    select: Option<String>,
    /// Of a map, types by hatching too, not by colour alone
    #[arg(long)]
    hatch: bool,
    /// Of a map, lines at these values of its quantities, separated by commas; isolines.csv has them too
    #[arg(long, value_name = "VALUE,...", value_delimiter = ',', allow_hyphen_values = true, value_parser = finite)]
    isolines: Vec<f64>,
    /// Of a map, lines at about so many round values of each quantity, 1 to 30
    #[arg(long, value_name = "N", conflicts_with = "isolines", value_parser = clap::value_parser!(u8).range(1..=30))]
    levels: Option<u8>,
    /// Of a map, curves instead, where axes have these values, or the nearest: along the longest of the others, one for each value of the
    /// shortest (or of an axis that is named several times), a panel for each of what is left; cut.csv has them too
    #[arg(long, value_name = "NAME=VALUE,...", conflicts_with_all = ["hatch", "isolines", "levels", "tikz"])]
    cut: Option<String>,
    /// Of a map, its classes as plot.tex too, a source for LaTeX with pgfplots
    #[arg(long)]
    tikz: bool,
}

impl OfMaps {
    /// The first of these options that is there.
    pub(crate) fn given(&self) -> Option<&'static str> {
        let all = [
            ("--quantity", !self.quantity.is_empty()),
            ("--select", self.select.is_some()),
            ("--hatch", self.hatch),
            ("--isolines", !self.isolines.is_empty()),
            ("--levels", self.levels.is_some()),
            ("--cut", self.cut.is_some()),
            ("--tikz", self.tikz),
        ];
        all.into_iter().find(|(_, given)| *given).map(|(option, _)| option)
    }

    /// These options, for the command that makes the same again.
    pub(crate) fn command(&self) -> String {
        let mut command = String::new();
        let mut add = |option: &str, value: &str| command.extend([" ", option, " ", value]);
        if !self.quantity.is_empty() {
            add("--quantity", &self.quantity.join(","));
        }
        if let Some(select) = &self.select {
            add("--select", &quote(select));
        }
        if !self.isolines.is_empty() {
            add("--isolines", &self.isolines.iter().map(f64::to_string).collect::<Vec<_>>().join(","));
        }
        if let Some(levels) = self.levels {
            add("--levels", &levels.to_string());
        }
        if let Some(cut) = &self.cut {
            add("--cut", &quote(cut));
        }
        for (option, given) in [(" --hatch", self.hatch), (" --tikz", self.tikz)] {
            command += if given { option } else { "" };
        }
        command
    }

    /// The tables beside the figure.
    pub(crate) fn tables(&self) -> Vec<&'static str> {
        if self.cut.is_some() {
            return vec![CUT];
        }
        let more = [(ISOLINES, self.lines().is_some()), (TIKZ, self.tikz)];
        let more = more.into_iter().filter(|(_, given)| *given).map(|(name, _)| name);
        std::iter::once(BOUNDARIES).chain(more).collect()
    }

    /// The option that asks for lines of equal value.
    fn lines(&self) -> Option<&'static str> {
        match (self.isolines.is_empty(), self.levels) {
            (false, _) => Some("--isolines"),
            (true, Some(_)) => Some("--levels"),
            (true, None) => None,
        }
    }

    /// The option that points have nothing for.
    fn of_areas(&self) -> Option<&'static str> {
        if self.hatch { Some("--hatch") } else { self.lines() }
    }

    /// The figure and the tables.
    pub(crate) fn draw(&self, archive: &Archive, look: Look<'_>) -> Result<(String, Tables)> {
        let Some(select) = &self.select else { return self.draw_all(archive, look) };
        let (part, taken) = archive.slice(select)?;
        tell_taken("--select", &taken);
        self.draw_all(&part, look)
    }

    /// The figure and the tables of all instances of `archive`, which holds only those that were selected.
    fn draw_all(&self, archive: &Archive, look: Look<'_>) -> Result<(String, Tables)> {
        if let Some(cut) = &self.cut {
            return self.draw_cut(archive, cut, &look);
        }
        if let (Grid::Tuples { .. }, Some(option)) = (&archive.map.spec.grid, self.of_areas()) {
            return Err(Error::NoAreas { option });
        }
        let mut contents = Vec::new();
        for name in &self.quantity {
            contents.push(content(archive, name, self.hatch)?);
        }
        if contents.is_empty() {
            contents = map::computed(archive.map.spec.analysis, self.hatch);
        }
        let mut tables = vec![(BOUNDARIES, boundary_lines(&archive.map)?)];
        let levels = self.levels_of(&contents)?;
        let mut quantities = Vec::new();
        for (content, of) in contents.iter_mut().zip(&levels) {
            if let Content::Quantity { column, levels } = content {
                *levels = of;
                quantities.push((*column, *levels));
            }
        }
        if self.lines().is_some() {
            let table = isoline_table(&archive.map, &quantities)?;
            // A sweep of one axis has levels across its curves.
            if has_planes(archive) {
                tell_without_lines(&table, &quantities);
            }
            tables.push((ISOLINES, table));
        }
        let look = Look { contents, ..look };
        if self.tikz {
            tables.push((TIKZ, map_tikz(&archive.map, &look)?.into_bytes()));
        }
        Ok((map::look_svg(&archive.map, &look)?, tables))
    }

    /// The values at which each content has lines. Only contents of numbers have any, and there has to be one such content.
    fn levels_of(&self, contents: &[Content<'_>]) -> Result<Vec<Vec<f64>>> {
        let Some(option) = self.lines() else { return Ok(vec![Vec::new(); contents.len()]) };
        if !contents.iter().any(|content| matches!(content, Content::Quantity { .. })) {
            let name = contents.first().map_or("", |content| match content {
                Content::Classes { colouring, .. } => colouring.name(),
                Content::LargeRegime => LARGE_REGIME,
                _ => "",
            });
            return Err(Error::NoIsolines { option, name: name.to_owned() });
        }
        let of = |content: &Content<'_>| match (content, self.levels) {
            (Content::Quantity { column, .. }, Some(most)) => round_levels(column, usize::from(most)),
            (Content::Quantity { .. }, None) => self.isolines.clone(),
            _ => Vec::new(),
        };
        Ok(contents.iter().map(of).collect())
    }

    fn draw_cut(&self, archive: &Archive, at: &str, look: &Look<'_>) -> Result<(String, Tables)> {
        let spec = &archive.map.spec;
        let cut = Cut::new(&spec.grid, at)?;
        tell_taken("--cut", &cut.taken);
        let mut quantities: Vec<&NumberColumn> = Vec::new();
        for name in &self.quantity {
            if is_class(archive, name) {
                let why = format!("curves are of numbers, which `{name}` is not; leave it out, or --cut");
                return Err(squealmap::results::error::Error::Cut { cut: at.to_owned(), why }.into());
            }
            quantities.push(column(archive, name).ok_or_else(|| unknown(archive, name, false))?);
        }
        if quantities.is_empty() {
            quantities = OF_A_CUT.iter().filter_map(|name| column(archive, name)).collect();
        }
        if quantities.is_empty() {
            return Err(unknown(archive, OF_A_CUT[0], false));
        }
        for (some, all, what) in left_out(&cut, look) {
            note(&format!(
                "the figure shows {some} of {all} {what}, {CUT} has all; name more axes or values in --cut to choose them, such as \
                 {}",
                example(&cut)
            ));
        }
        let table = cut_csv(&archive.map, &cut, &quantities)?;
        Ok((cut_svg(&archive.map, &cut, &quantities, look), vec![(CUT, table)]))
    }
}

/// Says which values stand for those that an axis does not have.
fn tell_taken(option: &str, taken: &[Taken]) {
    for one in taken {
        note(&format!("{option}: {one}"));
    }
}

/// A further axis with a value of it, as --cut takes them.
fn example(cut: &Cut) -> String {
    let panel = cut.panels.first();
    let beyond = panel.and_then(|panel| panel.of.first());
    let of_curve = panel.and_then(|panel| panel.curves.first()?.of.as_ref());
    beyond.or(of_curve).map_or_else(String::new, |(key, value)| match value {
        Value::Number(number) => format!("{}={number}", key.name()),
        Value::Text(text) => format!("{}={text}", key.name()),
    })
}

/// A number in a sentence: four digits, and powers of ten for large ones.
fn shown(x: f64) -> String {
    Cell::from(format!("{x:.3e}").parse().unwrap_or(x)).to_string()
}

/// Says at which values that were asked for no line is.
fn tell_without_lines(table: &[u8], quantities: &[(&NumberColumn, &[f64])]) {
    let table = String::from_utf8_lossy(table);
    for (column, levels) in quantities {
        let there = |level: f64| {
            table.lines().any(|line| {
                let mut cells = line.split(',').skip(1);
                let of = cells.next() == Some(column.name.as_str());
                of && cells.next().and_then(|cell| cell.parse::<f64>().ok()) == Some(level)
            })
        };
        // −180° and 180° are one line.
        let there = |level: f64| {
            there(level)
                || (column.is_angle() && there(-level) && level.abs().to_bits() == 180.0_f64.to_bits())
        };
        let without: Vec<String> =
            levels.iter().filter(|level| !there(**level)).map(|level| shown(*level)).collect();
        let (low, high) = column
            .values
            .iter()
            .flatten()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(*x), high.max(*x)));
        if !without.is_empty() {
            note(&format!(
                "`{}` has no line at {}; its values go from {} to {}",
                column.name,
                without.join(", "),
                shown(low),
                shown(high)
            ));
        }
    }
}

/// Whether a map has two axes, on which lines can lie.
fn has_planes(archive: &Archive) -> bool {
    let Grid::Axes(axes) = &archive.map.spec.grid else { return false };
    axes.iter().filter(|axis| axis.values.len() > 1).count() > 1
}

/// Whether a name is that of classes.
fn is_class(archive: &Archive, name: &str) -> bool {
    let spec = &archive.map.spec;
    Colouring::of(spec.analysis).any(|colouring| colouring.name() == name) || is_large_regime(archive, name)
}

/// Whether a name is that of the regime from the large start of two.
fn is_large_regime(archive: &Archive, name: &str) -> bool {
    let analysis = archive.map.spec.analysis;
    analysis.response && analysis.starts == Starts::Both && name == LARGE_REGIME
}

/// The content that a name asks for.
fn content<'a>(archive: &'a Archive, name: &str, hatched: bool) -> Result<Content<'a>> {
    let asked = archive.map.spec.analysis;
    if let Some(colouring) = Colouring::of(asked).find(|colouring| colouring.name() == name) {
        return Ok(Content::classes(colouring, hatched));
    }
    if is_large_regime(archive, name) {
        return Ok(Content::LargeRegime);
    }
    column(archive, name).map(Content::quantity).ok_or_else(|| unknown(archive, name, true))
}

/// The column of a quantity.
fn column<'a>(archive: &'a Archive, name: &str) -> Option<&'a NumberColumn> {
    let name = ALIASES.iter().find(|(alias, _)| *alias == name).map_or(name, |(_, column)| column);
    archive.columns.iter().find(|one| one.name == name)
}

/// The error of a name that is none, with everything that can be shown.
fn unknown(archive: &Archive, name: &str, classes: bool) -> Error {
    let shown = Colouring::of(archive.map.spec.analysis).filter(|_| classes);
    let mut names: Vec<&str> = shown.map(|colouring| -> &str { colouring.name() }).collect();
    names.extend((classes && is_large_regime(archive, LARGE_REGIME)).then_some(LARGE_REGIME));
    for column in &archive.columns {
        if !names.contains(&column.name.as_str()) {
            names.push(&column.name);
        }
    }
    names.extend(ALIASES.iter().map(|(alias, _)| *alias).filter(|alias| column(archive, alias).is_some()));
    Error::NoSuchQuantity { name: name.to_owned(), advice: advice(name, &names) }
}
