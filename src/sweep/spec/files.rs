//! The files a sweep file names: materials and tables of μ(v), modes.

use std::path::Path;
use std::sync::Arc;

use crate::model::Param;
use crate::model::friction::{LawKind, MuTable};
use crate::model::material::{Material, Outside};
use crate::model::modal::Modal;
use crate::model::motion::Motion;
use crate::sweep::error::{Error, Result};
use crate::sweep::grid::AxisKey;
use crate::sweep::spec::model;
use crate::sweep::spec::model::Kind;
use crate::sweep::spec::motion;
use crate::sweep::spec::rows::{Role, Rows};
use crate::sweep::spec::sections::Sections;
use crate::sweep::spec::tables;
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
            sections.table.as_ref().map(|(name, span)| tables::read(sweep, span.clone(), name, base_dir));
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

/// What a column of a material holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Column {
    Param(Param),
    Table(tables::Column),
}

/// Reads a material: `temperature` and columns of law parameters, or `temperature` and tables of friction.
fn read_material(
    source: &Source,
    span: std::ops::Range<usize>,
    name: &str,
    base_dir: &Path,
    outside: Outside,
) -> Result<Arc<Material>> {
    let params = std::iter::once(Param::Temperature).chain(LawKind::params());
    let params = params.map(|param| (param.info().name, Column::Param(param)));
    let known: Vec<(&str, Column)> =
        params.chain(tables::COLUMNS.map(|(name, column)| (name, Column::Table(column)))).collect();
    let names: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
    let file = Rows::read(source, span, Role::Material, &names, name, base_dir)?;
    let held =
        file.columns(&names, |text| known.iter().find(|(name, _)| *name == text).map(|(_, column)| *column))?;
    let tabular = held.iter().position(|column| matches!(column, Column::Table(_)));
    let (mut temperature, mut columns) = (None, Vec::new());
    for (index, held) in held.iter().enumerate() {
        let Column::Param(param) = *held else { continue };
        if let Some(tabular) = tabular.filter(|_| param != Param::Temperature) {
            return Err(Error::Conflict {
                at: file.source.place(file.header[index].span.clone()),
                key: format!("column `{}` of a law", param.info().name),
                other: format!("column `{}` of tables of friction", file.header[tabular].text),
            });
        }
        let values = file.numbers(index, param.info().name, param.info().range)?;
        if param == Param::Temperature {
            temperature = Some((index, values));
        } else {
            columns.push((param, values));
        }
    }
    let (index, temperature) = temperature.ok_or_else(|| file.no_column("temperature", "a material"))?;
    let (temperature, tables) = if tabular.is_some() {
        let place = |wanted| held.iter().position(|column| *column == Column::Table(wanted));
        tables::by_temperature(&file, (index, &temperature), place)?
    } else {
        file.rising("temperature", index, &temperature)?;
        (temperature, Vec::new())
    };
    Ok(Arc::new(Material { name: name.to_owned(), temperature, columns, tables, outside }))
}
