//! One instance of a sweep: base values, what varies, then the material.

use std::sync::Arc;

use crate::model::friction::LawKind;
use crate::model::instance::Instance;
use crate::model::material::Material;
use crate::model::{Param, Params};
use crate::sweep::grid::{AxisKey, Value};
use crate::sweep::spec::{Spec, start};

impl Spec {
    /// Instance `index` of the grid, material resolved at the instance's temperature.
    ///
    /// # Panics
    /// When `index` is not below the length of the grid.
    #[must_use]
    pub fn instance(&self, index: usize) -> Instance {
        let mut params = self.base;
        let mut kind = self.law;
        let mut material = self.material.as_ref();
        self.grid.each(index, |key, value| match (key, value) {
            (AxisKey::Param(param), Value::Number(number)) => params.set(param, *number),
            (AxisKey::Law, Value::Text(name)) => kind = LawKind::from_name(name).unwrap_or(kind),
            (AxisKey::Material, Value::Text(name)) => material = self.material_named(name),
            // Validation gives numbers to parameters and names to the other keys.
            _ => {}
        });
        start::place(self.pass, &mut params);
        self.assemble(params, kind, material)
    }

    /// A material of the sweep by the name written there.
    pub(super) fn material_named(&self, name: &str) -> Option<&Arc<Material>> {
        self.materials.iter().chain(&self.material).find(|material| material.name == name)
    }

    /// An instance of validated parts.
    pub(super) fn assemble(
        &self,
        mut params: Params,
        kind: LawKind,
        material: Option<&Arc<Material>>,
    ) -> Instance {
        let mut table = self.table.clone();
        if let Some(material) = material {
            let temperature = params.require(Param::Temperature);
            for (param, value) in material.at(temperature) {
                params.set(param, value);
            }
            table = material.table_at(temperature).or(table);
        }
        let law = kind.with(&params, table.as_ref());
        let (motion, modal) = (self.motion.clone(), self.modal.clone());
        Instance { params, law, impact_friction: self.impact_friction, motion, modal }
    }
}
