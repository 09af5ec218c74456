//! In the place of `gpu` where the crate is built without that feature: no adapter answers.

/// The adapters, of which there is none.
pub mod adapter {
    use crate::engine::error::{Error, Result};
    use crate::engine::precision::Precision;
    use std::fmt;

    /// An adapter that cannot be.
    #[derive(Clone, Copy, Debug)]
    pub enum Adapter {}

    /// What it is.
    #[derive(Clone, Debug)]
    pub struct Description {
        /// Its name.
        pub name: String,
    }

    impl fmt::Display for Description {
        fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str(&self.name)
        }
    }

    impl Adapter {
        /// The best adapter.
        ///
        /// # Errors
        /// Always: there is none.
        pub fn best(_: Precision, _: Option<&str>) -> Result<Adapter> {
            Err(Error::WithoutGpu)
        }

        /// Whether it is a program on the CPU.
        #[must_use]
        pub fn is_software(&self) -> bool {
            match *self {}
        }

        /// What it is and can do.
        #[must_use]
        pub fn describe(&self) -> Description {
            match *self {}
        }
    }
}

/// The device that a sweep is computed on, which there is not.
pub(crate) mod open {
    use crate::engine::Engine;
    use crate::engine::error::{Error, Result};
    use crate::engine::fallback::NoGpu;
    use crate::engine::instances::Instances;
    use crate::engine::options::Options;

    /// The adapter that was asked for.
    pub(crate) fn asked(_: &Options, _: &dyn Instances) -> Result<(Box<dyn Engine>, String, String)> {
        Err(Error::WithoutGpu)
    }

    /// The best hardware GPU.
    pub(crate) fn hardware(
        _: &Options,
        _: &dyn Instances,
    ) -> std::result::Result<(Box<dyn Engine>, String), NoGpu> {
        Err(NoGpu::Failed(Error::WithoutGpu))
    }
}
