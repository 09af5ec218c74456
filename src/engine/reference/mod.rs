//! The f64 reference, one instance at a time: the way in is [`records`](mod@records), the arithmetic is [`integrate`].

pub mod integrate;
pub mod observe;
pub mod records;
pub mod respond;
