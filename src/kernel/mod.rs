//! Kernel twins: what runs on a GPU, in Rust, generic over the scalar.
//!
//! Every file has its WGSL twin of the same name under `shaders/`: same functions, same order, same
//! arithmetic. The f64 reference judges the f32 twin; the f32 twin judges the GPU.

pub mod crossing;
pub mod lane;
pub mod observe;
pub mod response;
pub mod scalar;
pub mod scene;
pub mod series;
