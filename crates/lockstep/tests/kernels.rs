//! Small kernels with known results: statements, masks, buffers, functions, roundings.

use squealmap_lockstep::{Count, Program};

const HEAD: &str = "@group(0) @binding(0) var<storage, read> inputs: array<f32>;
@group(0) @binding(1) var<storage, read_write> outputs: array<f32>;
@group(0) @binding(2) var<storage, read_write> count: array<atomic<u32>>;
var<private> level: f32;
";

/// What the body, of invocation `i` with `x`, writes for every input, how many have added themselves, and what was issued and
/// useful.
fn run<const W: usize>(before: &str, body: &str, inputs: &[f32]) -> (Vec<f32>, u64, [u64; 2]) {
    let source = format!(
        "{HEAD}{before}\n@compute @workgroup_size(4)\nfn main(@builtin(global_invocation_id) id: vec3<u32>) {{
        let i = id.x; let x = inputs[i];\n{body}\n}}\n"
    );
    let program = Program::new(&source).expect("a kernel");
    let words = inputs.iter().map(|one| u64::from(one.to_bits())).collect();
    let mut buffers = [words, vec![0; inputs.len()], vec![0]];
    let cost: Count = program.run::<W>(inputs.len(), &mut buffers).into_iter().sum();
    let found = buffers[1].iter().map(|bits| f32::from_bits(u32::try_from(*bits).expect("an f32"))).collect();
    (found, buffers[2][0], [cost.issued, cost.useful])
}

#[test]
#[expect(clippy::float_cmp, reason = "the kernel counts in whole numbers")]
fn lanes_go_their_own_ways() {
    let body = "var n = 0.0; var y = x;
        loop {
            if y >= 100.0 { break; }
            if n == 2.0 { n += 10.0; continue; }
            y = y * 2.0;
            continuing { n += 1.0; break if n > 14.0; }
        }
        for (var k = 0u; k < 3u; k++) { if k == 1u && x > 50.0 { return; } outputs[i] = n + y; }
        atomicAdd(&count[0], 1u);";
    // By hand, one lane after the other.
    let expected = |x: f32| {
        let (mut n, mut y) = (0.0, x);
        loop {
            if y >= 100.0 {
                break;
            }
            if n == 2.0 {
                n += 10.0;
            } else {
                y *= 2.0;
            }
            n += 1.0;
            if n > 14.0 {
                break;
            }
        }
        n + y
    };
    let inputs: Vec<f32> = (0..150_u8).map(|x| f32::from(x) * 0.7).collect();
    let wanted: Vec<f32> = inputs.iter().map(|x| expected(*x)).collect();
    let ended = inputs.iter().filter(|x| **x <= 50.0).count() as u64;
    let (narrow, one, [issued, useful]) = run::<1>("", body, &inputs);
    assert_eq!((narrow, one, issued), (wanted.clone(), ended, useful), "a warp of one lane is always full");
    let (wide, many, [issued, same]) = run::<64>("", body, &inputs);
    assert_eq!((wide, many, same), (wanted, ended, useful));
    assert!(issued * 64 > useful && issued < useful, "{issued} {useful}");
}

#[test]
fn functions_and_pointers() {
    let before = "struct Pair { a: vec2<f32>, b: f32 }
        fn halve(p: ptr<function, f32>) -> bool { *p = *p * 0.5; if *p < 1.0 { return true; } return false; }
        fn pair(x: f32) -> Pair {
            if x < 0.0 { return Pair(vec2<f32>(0.0, x), 1.0); }
            level = x;
            return Pair(vec2<f32>(x, level), 2.0);
        }";
    let body = "var y = x; let small = halve(&y); var p = pair(y); p.b += select(0.0, 8.0, small);
        let v = p.a.yx * vec2<f32>(1.0, 3.0);
        outputs[i] = v.x + v.y + p.b + max(min(abs(x), 2.0), 1.0) + f32(u32(abs(x)) % 3u);";
    for (x, expected) in [(4.0, 2.0 + 6.0 + 2.0 + 2.0 + 1.0), (-4.0, -2.0 + 0.0 + 9.0 + 2.0 + 1.0)] {
        assert_eq!(run::<8>(before, body, &[x]).0, [expected]);
    }
}

/// Neither a product and a sum in one rounding, nor a sum in another order.
#[test]
fn every_operation_is_rounded_by_itself() {
    let x = 1.0 + 3.0 * f32::EPSILON;
    let (found, _, _) = run::<1>("", "outputs[i] = x * x - 1.0;", &[x]);
    assert!(found == [6.0 * f32::EPSILON] && found != [x.mul_add(x, -1.0)]);
    let (found, _, _) = run::<1>("", "outputs[i] = (x + 1e8) - 1e8;", &[1.0]);
    assert_eq!(found, [0.0]);
}

#[test]
fn what_is_not_known_is_refused() {
    let main = |body: &str| format!("{HEAD}@compute @workgroup_size(4) fn main() {{ {body} }}");
    for (body, why) in [
        ("outputs[0] = sin(1.0 + inputs[0]);", "Sin"),
        ("var a = array<f32, 4>(); outputs[0] = a[u32(inputs[0])];", "outside of buffers"),
        ("outputs[0] = f32(i32(inputs[0]));", "Sint"),
        ("workgroupBarrier();", "Barrier"),
        ("outputs[0] = nothing;", "nothing"),
    ] {
        let refused = Program::new(&main(body)).expect_err(body);
        assert!(refused.contains(why), "{body}: {refused}");
    }
}

#[test]
fn operations_of_a_text_and_of_its_functions() {
    let source = format!(
        "{HEAD}fn twice(x: f32) -> f32 {{ return x + x; }}
        @compute @workgroup_size(4)
        fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
            let x = inputs[id.x];
            if x > 0.0 {{ outputs[id.x] = twice(x); }} else {{ outputs[id.x] = twice(x * x); }}
        }}"
    );
    let program = Program::new(&source).expect("a kernel");
    // A load, a comparison, two stores, a product, and the sum of a function that is called twice.
    assert_eq!(program.operations(), 1 + 1 + 2 + 1 + 2);
    assert_eq!(program.functions(), ["main", "twice"]);
    let inputs: Vec<u64> = [1.0_f32, -2.0, 3.0, 4.0].iter().map(|one| u64::from(one.to_bits())).collect();
    let mut buffers = [inputs, vec![0; 4], vec![0]];
    let counts = program.run::<4>(4, &mut buffers);
    // Three lanes take the one call, the last the other.
    assert_eq!([counts[1].issued, counts[1].useful], [2, 4]);
}
