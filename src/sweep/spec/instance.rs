//! One instance of a sweep: base values, what varies, then the material.

use std::sync::Arc;

use smallvec::smallvec;

use crate::model::friction::LawKind;
use crate::model::heating::Heating;
use crate::model::instance::Instance;
use crate::model::material::Material;
use crate::model::motion::Corners;
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
        let law = match material {
            Some(material) => {
                let temperature = params.require(Param::Temperature);
                material.law_at(temperature, kind, &mut params, self.table.as_ref())
            }
            None => kind.with(&params, self.table.as_ref()),
        };
        let heating = material.and_then(|material| self.heating(&params, kind, material)).map(Arc::new);
        let (motion, modal) = (self.motion.clone(), self.modal.clone());
        Instance { params, law, impact_friction: self.impact_friction, motion, heating, modal }
    }

    /// How the temperature of a material goes over a run; `None` where it stays.
    fn heating(&self, params: &Params, kind: LawKind, material: &Arc<Material>) -> Option<Heating> {
        let corners = if let Some(corners) = self.motion.temperature() {
            Corners::Shared(Arc::clone(corners))
        } else {
            let (end, duration) = (params.get(Param::TemperatureEnd)?, params.get(Param::RampDuration)?);
            Corners::Own(smallvec![[0.0, params.require(Param::Temperature)], [duration, end]])
        };
        Some(Heating::new(Arc::clone(material), kind, self.table.clone(), corners))
    }
}
