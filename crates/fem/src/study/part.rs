//! A part as it stands in a description: its kind says which of the other keys it has.

use serde::Deserialize;

use crate::Error;

/// What a part is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PartKind {
    /// A rectangular block along the axes; its sides are the sets x0, x1, y0, y1, z0, z1.
    Block,
    /// A cylinder about an axis along z; its sides are the sets r1, z0, z1.
    Cylinder,
    /// A ring about an axis along z, or a sector of one; its sides are the sets r0, r1, z0, z1, of a sector a0 and a1, too.
    Ring,
    /// A file of Gmsh (`.msh`) or of Abaqus and CalculiX (`.inp`).
    Mesh,
}

impl PartKind {
    /// In a sentence, with the keys that it needs and those that it may have.
    fn words(self) -> (&'static str, &'static [&'static str], &'static [&'static str]) {
        match self {
            Self::Block => ("a block", &["element", "origin", "size", "cells", "material"], &[]),
            Self::Cylinder => {
                ("a cylinder", &["element", "centre", "radius", "height", "cells", "material"], &[])
            }
            Self::Ring => {
                ("a ring", &["element", "centre", "radii", "height", "cells", "material"], &["degrees"])
            }
            Self::Mesh => ("a mesh", &["file"], &["scale", "shift", "materials"]),
        }
    }
}

/// A mesh: a block, a cylinder, a ring or a file. Which keys belong to which kind is checked when the model is built.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Part {
    /// Which of these.
    pub kind: PartKind,
    /// Of all but a file: `hex8`, `hex20`, `hex20r`, `tet4`, `tet10` or `wedge15`; no tetrahedra in a cylinder.
    pub element: Option<String>,
    /// Of a block: the corner with the smallest coordinates, m.
    pub origin: Option<[f64; 3]>,
    /// Of a block: lengths of the edges, m.
    pub size: Option<[f64; 3]>,
    /// Of a cylinder or ring: the middle of the lower end, m.
    pub centre: Option<[f64; 3]>,
    /// Of a cylinder, m.
    pub radius: Option<f64>,
    /// Of a ring: inner and outer radius, m.
    pub radii: Option<[f64; 2]>,
    /// Of a cylinder or ring: length along z, m.
    pub height: Option<f64>,
    /// Of a ring: where a sector begins and ends, degrees from x towards y.
    pub degrees: Option<[f64; 2]>,
    /// Elements along each edge of a block; along each side of a cylinder's square core, from there to the outside, along z; along a ring's
    /// radius, around, along z.
    pub cells: Option<[i64; 3]>,
    /// Of all but a file: name of its material.
    pub material: Option<String>,
    /// Path, relative to the description.
    pub file: Option<String>,
    /// Of a file: metres per unit of its coordinates; none: 1.
    pub scale: Option<f64>,
    /// Of a file: how far it is moved, m, after scaling.
    pub shift: Option<[f64; 3]>,
    /// Of a file: names of the materials of its physical volumes, in the order of their tags; one name is for all. None: those of an `.inp`
    /// file.
    pub materials: Option<Vec<String>>,
}

/// A part with what belongs to its kind.
#[derive(Debug)]
pub(super) enum Body<'a> {
    Block {
        element: &'a str,
        origin: [f64; 3],
        size: [f64; 3],
        cells: [i64; 3],
        material: &'a str,
    },
    Cylinder {
        element: &'a str,
        centre: [f64; 3],
        radius: f64,
        height: f64,
        cells: [i64; 3],
        material: &'a str,
    },
    Ring {
        element: &'a str,
        centre: [f64; 3],
        radii: [f64; 2],
        height: f64,
        degrees: [f64; 2],
        cells: [i64; 3],
        material: &'a str,
    },
    Mesh {
        file: &'a str,
        scale: f64,
        shift: [f64; 3],
        materials: &'a [String],
    },
}

impl Part {
    /// The names of the keys that are given.
    fn given(&self) -> impl Iterator<Item = &'static str> {
        let all = [
            ("element", self.element.is_some()),
            ("origin", self.origin.is_some()),
            ("size", self.size.is_some()),
            ("centre", self.centre.is_some()),
            ("radius", self.radius.is_some()),
            ("radii", self.radii.is_some()),
            ("height", self.height.is_some()),
            ("degrees", self.degrees.is_some()),
            ("cells", self.cells.is_some()),
            ("material", self.material.is_some()),
            ("file", self.file.is_some()),
            ("scale", self.scale.is_some()),
            ("shift", self.shift.is_some()),
            ("materials", self.materials.is_some()),
        ];
        all.into_iter().filter(|(_, is_given)| *is_given).map(|(name, _)| name)
    }

    /// What the part, which stands under a key, is.
    ///
    /// # Errors
    /// A key that its kind does not have, or one that it needs and that is not there.
    pub(super) fn body(&self, key: &str) -> Result<Body<'_>, Error> {
        let (what, needs, may) = self.kind.words();
        let all = [needs, may].concat().join(", ");
        if let Some(other) = self.given().find(|name| !needs.contains(name) && !may.contains(name)) {
            let what = format!("{what} has no such key, it has {all}: leave it out or take another kind");
            return Err(Error::at(format!("{key}.{other}"), what));
        }
        let missing =
            |name: &str| Error::at(format!("{key}.{name}"), format!("it is missing: {what} has {all}"));
        macro_rules! need {
            ($name:ident) => {
                self.$name.as_ref().ok_or_else(|| missing(stringify!($name)))?
            };
        }
        Ok(match self.kind {
            PartKind::Block => Body::Block {
                element: need!(element),
                origin: *need!(origin),
                size: *need!(size),
                cells: *need!(cells),
                material: need!(material),
            },
            PartKind::Cylinder => Body::Cylinder {
                element: need!(element),
                centre: *need!(centre),
                radius: *need!(radius),
                height: *need!(height),
                cells: *need!(cells),
                material: need!(material),
            },
            PartKind::Ring => Body::Ring {
                element: need!(element),
                centre: *need!(centre),
                radii: *need!(radii),
                height: *need!(height),
                degrees: self.degrees.unwrap_or([0.0, 360.0]),
                cells: *need!(cells),
                material: need!(material),
            },
            PartKind::Mesh => Body::Mesh {
                file: need!(file),
                scale: self.scale.unwrap_or(1.0),
                shift: self.shift.unwrap_or_default(),
                materials: self.materials.as_deref().unwrap_or_default(),
            },
        })
    }
}
