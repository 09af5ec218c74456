//! Named words: tables from which Rust has the places of words as constants, and WGSL as a header.

/// A named run of words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Field {
    /// Its name; WGSL knows its first word by the upper-case name behind a prefix.
    pub name: &'static str,
    /// Its words.
    pub words: usize,
}

impl Field {
    /// One word.
    #[must_use]
    pub const fn one(name: &'static str) -> Field {
        Field { name, words: 1 }
    }

    /// Several words.
    #[must_use]
    pub const fn many(name: &'static str, words: usize) -> Field {
        Field { name, words }
    }
}

/// The words of a list of fields.
#[must_use]
pub const fn words(fields: &[Field]) -> usize {
    first_word(fields, "")
}

/// The first word of a field, whatever the case of its name; the number of all words when there is no such field.
#[must_use]
pub const fn first_word(fields: &[Field], name: &str) -> usize {
    let mut sum = 0;
    let mut k = 0;
    while k < fields.len() && !fields[k].name.eq_ignore_ascii_case(name) {
        sum += fields[k].words;
        k += 1;
    }
    sum
}

/// A table of fields, each a name, its words and its meaning; and the first word of each as a constant of its name.
macro_rules! fields {
    ($($name:ident $words:expr, $meaning:literal;)*) => {
        /// The table.
        pub const FIELDS: [$crate::engine::fields::Field; [$($meaning),*].len()] =
            [$($crate::engine::fields::Field::many(stringify!($name), $words)),*];

        /// All words.
        pub const WORDS: usize = $crate::engine::fields::words(&FIELDS);

        $(
            #[doc = $meaning]
            pub const $name: usize = $crate::engine::fields::first_word(&FIELDS, stringify!($name));
        )*
    };
}

pub(crate) use fields;
