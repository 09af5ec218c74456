//! The files a sweep file names: materials and tables of μ(v), modes.

use std::path::Path;
use std::sync::Arc;

use crate::model::friction::{LawKind, MuTable};
use crate::model::material::{Material, Outside};
use crate::model::modal::Modal;
use crate::model::motion::Motion;
use crate::model::{Param, Range};
use crate::sweep::error::{Error, Result};
use crate::sweep::grid::AxisKey;
use crate::sweep::spec::model;
use crate::sweep::spec::model::Kind;
use crate::sweep::spec::motion;
use crate::sweep::spec::rows::{Role, Rows};
use crate::sweep::spec::sections::Sections;
use crate::sweep::spec::varied::Varied;
use squealmap_input::place::Source;

/// What was read from the files.
#[derive(Debug)]
pub(super) struct Files {
    /// The structure of a modal model.
    pub(super) modal: Option<Arc<Modal>>,
    pub(super) table: Option<Arc<MuTable>>,
    /// How the belt moves.
    pub(super) motion: Motion,
    /// The material of `[friction]`.
    pub(super) material: Option<Arc<Material>>,
    /// The materials of an axis or column.
    pub(super) materials: Vec<Arc<Material>>,
}

impl Files {
    /// Reads every file that the sweep names.
    pub(super) fn read(
        sweep: &Source,
        base_dir: &Path,
        sections: &Sections,
        varied: &Varied,
    ) -> Result<Files> {
        let table =
            sections.table.as_ref().map(|(name, span)| read_table(sweep, span.clone(), name, base_dir));
        let material = sections
            .material
            .as_ref()
            .map(|(name, span)| read_material(sweep, span.clone(), name, base_dir, sections.outside));
        let materials = varied
            .names(AxisKey::Material)
            .into_iter()
            .map(|(name, span)| read_material(&varied.source, span, name, base_dir, sections.outside))
            .collect::<Result<_>>()?;
        let modal = sections.modes.as_ref().filter(|_| sections.model == Kind::Modal);
        let modal = modal.map(|(name, span)| model::read(sweep, span.clone(), name, base_dir)).transpose()?;
        let table_of_motion = sections.motion_table.as_ref();
        let table_of_motion = table_of_motion
            .map(|(name, span)| motion::read(sweep, span.clone(), name, base_dir))
            .transpose()?;
        let motion = Motion::named(sections.motion, table_of_motion);
        Ok(Files { modal, table: table.transpose()?, motion, material: material.transpose()?, materials })
    }

    /// Every material of the sweep.
    pub(super) fn all_materials(&self) -> impl Iterator<Item = &Arc<Material>> {
        self.material.iter().chain(&self.materials)
    }
}

/// Reads a material: `temperature` and columns of law parameters.
fn read_material(
    source: &Source,
    span: std::ops::Range<usize>,
    name: &str,
    base_dir: &Path,
    outside: Outside,
) -> Result<Arc<Material>> {
    let known: Vec<Param> = std::iter::once(Param::Temperature).chain(LawKind::params()).collect();
    let names: Vec<&str> = known.iter().map(|param| param.info().name).collect();
    let file = Rows::read(source, span, Role::Material, &names, name, base_dir)?;
    let params = file.columns(&names, |text| Param::from_name(text).filter(|param| known.contains(param)))?;
    let mut temperature = None;
    let mut columns = Vec::new();
    for (index, &param) in params.iter().enumerate() {
        let values = column(&file, index, param)?;
        if param == Param::Temperature {
            file.rising("temperature", index, &values)?;
            temperature = Some(values);
        } else {
            columns.push((param, values));
        }
    }
    let temperature = temperature.ok_or_else(|| file.no_column("temperature", "a material"))?;
    Ok(Arc::new(Material { name: name.to_owned(), temperature, columns, outside }))
}

/// Reads a table of friction against velocity: `velocity`, `mu`.
fn read_table(
    source: &Source,
    span: std::ops::Range<usize>,
    name: &str,
    base_dir: &Path,
) -> Result<Arc<MuTable>> {
    table_of(&Rows::read(source, span, Role::Table, &TABLE, name, base_dir)?)
}

/// The columns of a table of friction.
const TABLE: [&str; 2] = ["velocity", "mu"];

/// The table of friction that some rows are.
pub(super) fn table_of(file: &Rows) -> Result<Arc<MuTable>> {
    let columns = file.columns(&TABLE, |text| TABLE.iter().position(|name| *name == text))?;
    let mut values = [None, None];
    for (index, &which) in columns.iter().enumerate() {
        let numbers = file.numbers(index, TABLE[which], Range::NonNegative)?;
        if which == 0 {
            file.rising("velocity", index, &numbers)?;
            if numbers[0] > 0.0 {
                return Err(Error::OutOfRange {
                    at: file.source.place(file.span(0, index)),
                    key: "the first `velocity`".to_owned(),
                    value: numbers[0].to_string(),
                    limit: "0, where the table gives the limit of stick".to_owned(),
                });
            }
        }
        values[which] = Some(numbers);
    }
    if file.len() < 2 {
        let at = file.source.place(file.span(0, 0));
        return Err(Error::OutOfRange {
            at,
            key: "the number of rows of a friction table".to_owned(),
            value: file.len().to_string(),
            limit: "at least 2; for one value choose law = \"constant\"".to_owned(),
        });
    }
    let [velocity, mu] = values;
    let velocity = velocity.ok_or_else(|| file.no_column("velocity", "a friction table"))?;
    let mu = mu.ok_or_else(|| file.no_column("mu", "a friction table"))?;
    Ok(Arc::new(MuTable { velocity, mu }))
}

fn column(file: &Rows, index: usize, param: Param) -> Result<Vec<f64>> {
    let info = param.info();
    file.numbers(index, info.name, info.range)
}
