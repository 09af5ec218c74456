//! A region by a device that the test plays: what is sent is what the kernel of the eigenvalues takes, and what comes back is
//! checked before it is believed.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use serde_json::{Value as Json, json};
use squealmap::engine::kernel::linear::analyse;
use squealmap::engine::kernel::places::{filled, place, room};
use squealmap::engine::kernel::words::{FLAG_WORDS, INPUT_WORDS, STATE_WORDS};
use squealmap::study::explore::Explorer;
use squealmap::study::explore::answer::Answer;
use squealmap::sweep::spec::Spec;
use squealmap_explorer::device::OnDevice;

const MAP: &str = "[model]\ntheta = 0.01\n[friction]\nlaw = \"bilinear\"\nknee_velocity = 5\n[axes]\n\
    mu_s = { from = 0.0, to = 0.6, points = 7 }\nmu_d = { from = 0.0, to = 0.5, points = 6 }\n\
    belt_velocity = { values = [1.0, 3.0] }\n";

fn open(text: &str) -> Explorer {
    Explorer::new(Spec::parse(text, "s.toml", ".".as_ref()).unwrap()).unwrap()
}

fn region(response: bool) -> Json {
    json!({
        "x": { "key": "mu_d", "from": 0.0, "to": 0.5, "points": 6 },
        "y": { "key": "mu_s", "from": 0.0, "to": 0.6, "points": 7 },
        "at": { "belt_velocity": 3.0 },
        "response": response,
        "columns": ["type", "growth_rate", "frequency"],
    })
}

/// The bytes of state and flags that the kernel of the eigenvalues makes of what is sent, by its twin.
fn played(sent: &Answer) -> Vec<u8> {
    let turn = &sent.head["turn"];
    let number = |json: &Json| usize::try_from(json.as_u64().unwrap()).unwrap();
    let count = number(&turn["dispatches"][0]["count"]);
    let bytes = &sent.bytes[..number(&turn["sizes"][0])];
    let inputs: Vec<f32> = bytes.chunks(4).map(|four| f32::from_le_bytes(four.try_into().unwrap())).collect();
    assert_eq!(inputs.len(), INPUT_WORDS * room(count));
    let made: Vec<_> =
        (0..count).map(|one| analyse(&|word: usize| inputs[place([word, INPUT_WORDS], one)])).collect();
    let state: Vec<f32> = filled(STATE_WORDS, count, |one| &made[one].state);
    let flags: Vec<u32> = filled(FLAG_WORDS, count, |one| &made[one].flags);
    let back = [bytemuck::cast_slice(&state), bytemuck::cast_slice(&flags)].concat();
    assert_eq!(back.len(), number(&turn["sizes"][1]) + number(&turn["sizes"][2]));
    back
}

#[test]
fn eigenvalues_by_a_device_are_those_of_the_cpu() {
    let explorer = open(MAP);
    let mut on_device = OnDevice::new(&region(false).to_string(), &explorer).unwrap();
    let sent = on_device.turn(&[], 64).unwrap();
    let (_, text) = sent.head["sources"].as_object().unwrap().iter().next().unwrap();
    assert!(text.as_str().unwrap().contains("fn analyse"));
    let found = on_device.turn(&played(&sent), 64).unwrap();
    let mut asked = region(false);
    asked["ask"] = json!("region");
    let wanted = explorer.answer(&asked.to_string()).unwrap();
    assert_eq!(found.head, wanted.head);
    assert_eq!(found.numbers[..42], wanted.numbers[..42], "types");
    for (a, b) in found.numbers[42..].iter().zip(&wanted.numbers[42..]) {
        assert!((a - b).abs() <= 2e-5 * b.abs().max(1.0), "{a} and {b}");
    }
}

#[test]
fn what_a_device_cannot_have_made_is_refused() {
    let begun = || {
        let mut on_device = OnDevice::new(&region(false).to_string(), &open(MAP)).unwrap();
        let back = played(&on_device.turn(&[], 64).unwrap());
        (on_device, back)
    };
    let (mut on_device, back) = begun();
    let why = on_device.turn(&back[4..], 64).unwrap_err();
    assert!(why.contains("words back"), "{why}");
    // A device that has not run leaves zeros: no instance has counted its polynomials.
    let (mut on_device, back) = begun();
    let why = on_device.turn(&vec![0; back.len()], 64).unwrap_err();
    assert!(why.contains("linear"), "{why}");
    assert!(begun().0.turn(&back, 64).is_ok());
}

#[test]
fn what_no_kernel_computes_is_left_to_the_cpu() {
    let text = MAP.to_owned() + "[response]\nsettle = \"cycle\"\n";
    let why = OnDevice::new(&region(true).to_string(), &open(&text)).unwrap_err();
    assert!(why.contains("without a GPU"), "{why}");
    assert!(OnDevice::new(&region(false).to_string(), &open(&text)).is_ok());
    assert!(OnDevice::new("{}", &open(MAP)).unwrap_err().contains("no region"));
}
