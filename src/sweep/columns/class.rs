//! What an instance is called: properties that have few values, each with a name and a code.

use crate::engine::record::Record;

/// A property of an instance that has few values.
#[derive(Clone, Copy, Debug)]
pub struct Class {
    /// The code of its first value, in tiles and arrays; the code below it says that there is none.
    pub(super) first: i8,
    /// Whether every instance has a value.
    pub(super) always: bool,
    /// The name of the value at a position; `None` behind the last.
    pub(super) name: fn(usize) -> Option<&'static str>,
    /// The position of a record's value.
    pub(super) get: fn(&Record) -> Option<usize>,
    /// Gives a record the value at a position.
    pub(super) put: fn(&mut Record, Option<usize>),
}

impl Class {
    /// The names of its values in order.
    pub fn names(&self) -> impl Iterator<Item = &'static str> {
        (0..).map_while(self.name)
    }

    /// Every value with its code.
    pub fn codes(&self) -> impl Iterator<Item = (i8, &'static str)> {
        (self.first..).zip(self.names())
    }

    /// The code that says that there is no value; `None` where there always is one.
    #[must_use]
    pub fn undefined(&self) -> Option<i8> {
        (!self.always).then_some(self.first - 1)
    }

    /// Whether every instance has a value.
    #[must_use]
    pub fn is_always_there(&self) -> bool {
        self.always
    }

    /// The position of a record's value.
    #[must_use]
    pub fn position(&self, record: &Record) -> Option<usize> {
        (self.get)(record)
    }

    /// The name of a record's value.
    #[must_use]
    pub fn name(&self, record: &Record) -> Option<&'static str> {
        (self.get)(record).and_then(self.name)
    }

    /// The code of a record's value.
    #[must_use]
    pub fn code(&self, record: &Record) -> i8 {
        let position = (self.get)(record).and_then(|position| i8::try_from(position).ok());
        position.map_or(self.first - 1, |position| self.first + position)
    }

    /// Gives a record the value at a position.
    pub fn put(&self, record: &mut Record, position: Option<usize>) {
        (self.put)(record, position);
    }

    /// Gives a record the value with a code; `None` of a code that no value has.
    #[must_use]
    pub fn put_code(&self, record: &mut Record, code: i8) -> Option<()> {
        let found = self.codes().position(|(one, _)| one == code);
        (found.is_some() || self.undefined() == Some(code)).then(|| (self.put)(record, found))
    }
}
