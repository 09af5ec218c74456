//! The door to a page: memory of WebAssembly with a question in it, and an answer.
//!
//! The page asks for room ([`room`]), writes there, and calls [`open`] or [`ask`], which give the place of the answer's bytes, [`length`] how many; or
//! [`begin`] and [`turn`] with a device at hand. One sweep is open at a time. A worker has a thread of its own, and so a sweep of its own.

#![expect(unsafe_code, reason = "names that a page finds are written without Rust's own mangling")]

use std::cell::RefCell;

use squealmap::study::explore::Explorer;
use squealmap::study::explore::answer::Answer;

use crate::device::OnDevice;

/// What stands in the memory that the page sees.
#[derive(Default)]
struct Memory {
    explorer: Option<Explorer>,
    on_device: Option<OnDevice>,
    question: Vec<u8>,
    answer: Vec<u8>,
}

thread_local! {
    static MEMORY: RefCell<Memory> = RefCell::default();
}

/// Room for a question of so many bytes: where to write it.
#[unsafe(no_mangle)]
pub extern "C" fn room(bytes: usize) -> *mut u8 {
    MEMORY.with_borrow_mut(|memory| {
        memory.question = vec![0; bytes];
        memory.question.as_mut_ptr()
    })
}

/// Opens the sweep whose description stands in the room: where the answer begins.
#[unsafe(no_mangle)]
pub extern "C" fn open() -> *const u8 {
    answered(|memory| {
        memory.explorer = None;
        let explorer = Explorer::open(&memory.question)?;
        let about = explorer.answer(r#"{"ask":"about"}"#)?;
        memory.explorer = Some(explorer);
        Ok(about)
    })
}

/// Answers the question that stands in the room: where the answer begins.
#[unsafe(no_mangle)]
pub extern "C" fn ask() -> *const u8 {
    answered(|memory| {
        let question = str::from_utf8(&memory.question).map_err(|_| "this is no question: it is no UTF-8")?;
        memory.explorer.as_ref().ok_or("no sweep is open")?.answer(question)
    })
}

/// Begins a region, which stands in the room, on a device: where the answer begins.
#[unsafe(no_mangle)]
pub extern "C" fn begin(steps: u32) -> *const u8 {
    answered(|memory| {
        memory.on_device = None;
        let question = str::from_utf8(&memory.question).map_err(|_| "this is no region: it is no UTF-8")?;
        let mut region = OnDevice::new(question, memory.explorer.as_ref().ok_or("no sweep is open")?)?;
        let answer = region.turn(&[], steps)?;
        memory.on_device = Some(region);
        Ok(answer)
    })
}

/// Takes what has come back of the device, which stands in the room, and goes on: where the answer begins.
#[unsafe(no_mangle)]
pub extern "C" fn turn(steps: u32) -> *const u8 {
    answered(|memory| memory.on_device.as_mut().ok_or("no region has begun")?.turn(&memory.question, steps))
}

/// The bytes of the last answer.
#[unsafe(no_mangle)]
pub extern "C" fn length() -> usize {
    MEMORY.with_borrow(|memory| memory.answer.len())
}

fn answered(answer: impl FnOnce(&mut Memory) -> Result<Answer, String>) -> *const u8 {
    MEMORY.with_borrow_mut(|memory| {
        memory.answer = answer(memory).unwrap_or_else(|sentence| Answer::error(&sentence)).to_bytes();
        memory.answer.as_ptr()
    })
}
