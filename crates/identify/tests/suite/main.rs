//! What files of recorders say, beside CSV.

mod broken;
mod common;
mod mat;
mod recorded;
mod tdms;
mod uff;
mod units;
mod wav;
