//! Tables, arrays and figures of maps, written and read back.

pub(crate) mod angles;
pub(crate) mod arrays;
pub(crate) mod by_name;
pub(crate) mod compare;
pub(crate) mod crowded;
pub(crate) mod curves;
pub(crate) mod export;
pub(crate) mod figure;
pub(crate) mod gallery;
mod gallery_fem;
mod gallery_measured;
pub(crate) mod gallery_plots;
pub(crate) mod isolines;
pub(crate) mod netcdf_file;
pub(crate) mod page;
pub(crate) mod parquet;
pub(crate) mod pictures;
pub(crate) mod plot;
pub(crate) mod plot_notes;
pub(crate) mod print;
mod readings;
pub(crate) mod scattered;
pub(crate) mod select;
pub(crate) mod sides;
pub(crate) mod snapshots;
pub(crate) mod tikz;
pub(crate) mod unsettled;
