//! The figure of a map: types and regimes by colour, quantities by lightness, curves and lines of equal value; and the
//! figure as a source for LaTeX.
//!
//! | question | where |
//! |---|---|
//! | the whole figure, and how it is to look | [`map`], [`look`], [`heading`], [`page`] |
//! | one block of it: panels side by side | [`block`], [`panels`], [`beside`], [`picture_axis`] |
//! | classes in a panel: cells, points, their outlines and fills | [`cells`], [`points`], [`outline`], [`fills`], [`palette`] |
//! | a number in a panel: its values, colours, bar | [`field`], [`quantity`], [`tones`], [`colour_bar`] |
//! | lines of equal value, the line of equal friction coefficients, lines from elsewhere | [`isolines`], [`sides`], [`overlay`] |
//! | curves instead of panels | [`curve_block`], [`starts_block`], [`cut_figure`] |
//! | words: legend, names of columns | [`legend`], [`words`] |
//! | LaTeX | [`tikz`] |

pub mod beside;
pub mod block;
pub mod cells;
pub mod colour_bar;
pub mod curve_block;
pub mod cut_figure;
pub mod field;
pub mod fills;
pub mod heading;
pub mod isolines;
pub mod legend;
pub mod look;
pub mod map;
pub mod outline;
pub mod overlay;
pub mod page;
pub mod palette;
pub mod panels;
pub mod picture_axis;
pub mod points;
pub mod quantity;
pub mod sides;
pub mod starts_block;
pub mod tikz;
pub mod tones;
pub mod words;
